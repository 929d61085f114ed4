// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/connection/connector.h"

#include "core/bus/networkaddress_values.h"
#include "core/session/stopcontrol.h"
#include "ui/common/texts.h"

#include <QSettings>
#include <QUrl>

#include <algorithm>
#include <utility>

namespace dynascope {

namespace {

constexpr int MostRecent = 6;

const QString PortKey = QStringLiteral("connection/port");
const QString RecentKey = QStringLiteral("connection/recent");
const QString ReopenKey = QStringLiteral("connection/reopen");

/// What was said last of a port outdates what was said before it.
QString portTopic(const LineSession &line)
{
    return QStringLiteral("port ") + line.name();
}

QString scanTopic(const LineSession &line)
{
    return QStringLiteral("scan ") + line.name();
}

/// A path has slashes, which would make groups of settings.
QString baudKey(const QString &port)
{
    return QStringLiteral("connection/baudOf/") + QString::fromLatin1(QUrl::toPercentEncoding(port));
}

} // namespace

Connector::Connector(const Workbench &workbench, QObject *parent)
    : QObject(parent), m_workbench(workbench), m_reopener(workbench.session, workbench.ports)
{
    m_reopener.setAutomatic(isReopening());
    connect(&m_reopener, &Reopener::portsChanged, this, &Connector::portsChanged);
    connect(&m_reopener, &Reopener::lineBack, this, &Connector::onBack);
    connect(&m_reopener, &Reopener::lineRefused, this, [this](LineSession *line, const Error &why) {
        emit posted({MessageKind::Warning, why.text, {}, {}, portTopic(*line)});
    });
    connect(&workbench.session, &Session::lineAdded, this, &Connector::follow);
    connect(&workbench.session, &Session::lineAboutToBeRemoved, this, [this](LineSession *line) {
        forget(line);
        QMetaObject::invokeMethod(this, &Connector::changed, Qt::QueuedConnection);
    });
    connect(&workbench.scanner, &Scanner::finished, this, &Connector::onScanned);
    for (const auto &line : workbench.session.lines())
        follow(line.get());
}

LineSession *Connector::line(const QString &port) const
{
    const auto &lines = m_workbench.session.lines();
    const auto at = std::ranges::find_if(lines, [&port](const auto &line) { return line->name() == port; });
    return at == lines.end() ? nullptr : at->get();
}

void Connector::connectTo(const QString &port, int baudRate)
{
    if (port.isEmpty()) {
        emit posted({MessageKind::Info, tr("Choose a port first"), {}, {}});
        return;
    }
    LineSession *present = line(port);
    if (present && present->state() != BusThread::State::Closed && present->state() != BusThread::State::Lost)
        return;
    if (present && !present->devices().empty()) {
        reconnect(*present);
        return;
    }
    m_workbench.session.open(port, baudRate);
}

void Connector::disconnectFrom(LineSession &line)
{
    if (m_scanned == &line)
        m_workbench.scanner.cancel();
    m_workbench.session.close(line);
    emit changed();
}

void Connector::reconnect(LineSession &line)
{
    if (line.state() != BusThread::State::Lost && line.state() != BusThread::State::Closed)
        return; // it is back already
    const Result<void> asked = m_reopener.reopen(line);
    if (asked)
        return;
    const auto giveUp = [this, where = QPointer<LineSession>(&line)] {
        if (where)
            disconnectFrom(*where);
    };
    emit posted({MessageKind::Warning, asked.error().text, tr("Disconnect"), giveUp, portTopic(line)});
}

void Connector::scan(LineSession &line, const ScanRange &range)
{
    if (line.state() != BusThread::State::Open || range.bauds.empty())
        return;
    if (m_workbench.scanner.isRunning() && m_scanned != &line) {
        m_waiting.push_back({&line, range});
        return;
    }
    m_scanned = &line;
    m_rates = range.bauds;
    m_workbench.scanner.start(line, range);
}

void Connector::cancelScan()
{
    m_workbench.scanner.cancel();
}

void Connector::follow(LineSession *line)
{
    connect(line, &LineSession::stateChanged, this, [this, line] { onState(line); });
    emit changed();
}

void Connector::onState(LineSession *line)
{
    switch (line->state()) {
    case BusThread::State::Opening: break;
    case BusThread::State::Open: onOpen(line); break;
    case BusThread::State::Lost: onLost(line); break;
    case BusThread::State::Closed: onRefused(line); break;
    }
    emit changed();
}

void Connector::onOpen(LineSession *line)
{
    // Whichever port didn't open before: somebody has found another way.
    for (const QString &refused : std::exchange(m_refused, {}))
        emit retracted(refused);
    if (m_lost.contains(line)) {
        emit retracted(m_lost.take(line));
        emit posted({MessageKind::Success, tr("%1 is back").arg(portText(line->name())), {}, {}, portTopic(*line)});
    }
    if (m_opened.contains(line))
        return;
    m_opened.insert(line);
    remember(line->name(), line->baudRate());
    if (line->devices().empty())
        scan(*line, {likelyBauds(line->baudRate()), 0, 252});
}

void Connector::onLost(LineSession *line)
{
    if (m_lost.contains(line))
        return;
    const QString why = line->bus().error().text;
    QString text = asSentence(why.isEmpty() ? tr("%1 is gone").arg(portText(line->name())) : why);
    if (m_reopener.isAutomatic())
        text += u' ' + tr("It is opened again when it comes back.");
    m_lost.insert(line, text);
    emit posted({MessageKind::Error, text, tr("Reconnect"), [this, where = QPointer<LineSession>(line)] {
                     if (where)
                         reconnect(*where);
                 }, portTopic(*line)});
}

void Connector::onRefused(LineSession *line)
{
    const Error error = line->bus().error();
    if (m_lost.contains(line))
        return; // not back yet; said already
    if (!m_opened.contains(line)) {
        // Nothing to keep of a line that never was: say why and leave the window as it was. Not from inside its signal.
        QMetaObject::invokeMethod(
            this,
            [this, where = QPointer<LineSession>(line)] {
                if (where && where->state() == BusThread::State::Closed)
                    m_workbench.session.close(*where);
            },
            Qt::QueuedConnection);
    }
    if (error.text.isEmpty())
        return;
    const QString port = line->name();
    const int baud = line->baudRate();
    m_refused.insert(port, error.text);
    emit posted({MessageKind::Error, error.text, tr("Try again"), [this, port, baud] { connectTo(port, baud); },
                 portTopic(*line)});
}

void Connector::onScanned(int found, const QString &trouble)
{
    reportScan(found, trouble);
    m_scanned.clear();
    if (m_workbench.stop.isActive())
        m_waiting.clear();
    emit changed();
    // Not from inside the scanner's signal: the others who listen are still to hear that it has ended.
    QMetaObject::invokeMethod(this, &Connector::scanNext, Qt::QueuedConnection);
}

void Connector::scanNext()
{
    while (!m_waiting.empty() && !m_workbench.scanner.isRunning()) {
        const Waiting next = std::move(m_waiting.front());
        m_waiting.erase(m_waiting.begin());
        if (next.line)
            scan(*next.line, next.range);
    }
}

void Connector::reportScan(int found, const QString &trouble)
{
    if (!m_scanned || m_scanned->state() != BusThread::State::Open)
        return;
    if (m_workbench.scanner.wasCancelled())
        return; // who did it knows
    const QString topic = scanTopic(*m_scanned);
    if (!trouble.isEmpty()) {
        emit posted({MessageKind::Warning, tr("Scan: %1").arg(trouble), {}, {}, topic});
    } else if (found == 0) {
        const QString port = portText(m_scanned->name());
        emit posted({MessageKind::Warning,
            tr("No device answered on %1 at %2. Is the servo powered? Try more baud rates.").arg(port, ratesText()), {},
            {}, topic});
    } else {
        emit posted({MessageKind::Success, found == 1 ? tr("1 device found") : tr("%1 devices found").arg(found), {}, {},
            topic});
    }
}

QString Connector::ratesText() const
{
    if (m_scanned && isRateTheServers(m_scanned->name()))
        return tr("the server's rate");
    QStringList rates;
    for (const int rate : m_rates)
        rates << baudText(rate);
    if (rates.size() == 1)
        return rates.front();
    const QString last = rates.takeLast();
    return tr("%1 and %2").arg(rates.join(QStringLiteral(", ")), last);
}

void Connector::forget(LineSession *line)
{
    if (m_opened.contains(line)) { // why one never opened is still to be read
        emit retractedTopic(portTopic(*line));
        emit retractedTopic(scanTopic(*line));
    }
    m_opened.remove(line);
    std::erase_if(m_waiting, [line](const Waiting &waiting) { return waiting.line == line; });
    if (m_lost.contains(line))
        emit retracted(m_lost.take(line));
}

void Connector::onBack(LineSession *line, const QString &formerPort)
{
    if (line->name() == formerPort)
        return;
    remember(line->name(), line->baudRate());
    emit moved(formerPort, line->name());
    emit posted({MessageKind::Info, tr("The adapter of %1 is at %2 now").arg(formerPort, line->name()), {}, {}});
}

void Connector::setReopening(bool byItself)
{
    QSettings().setValue(ReopenKey, byItself);
    m_reopener.setAutomatic(byItself);
}

bool Connector::isReopening()
{
    return QSettings().value(ReopenKey, true).toBool();
}

QString Connector::lastPort()
{
    return QSettings().value(PortKey).toString();
}

int Connector::lastBaudRate(const QString &port)
{
    const int baud = QSettings().value(baudKey(port)).toInt();
    if (baud > 0)
        return baud;
    return port == QStringLiteral("sim") ? 1'000'000 : 57600;
}

QStringList Connector::recentPorts()
{
    return QSettings().value(RecentKey).toStringList();
}

void Connector::remember(const QString &port, int baudRate)
{
    QSettings settings;
    settings.setValue(PortKey, port);
    settings.setValue(baudKey(port), baudRate);
    QStringList recent = settings.value(RecentKey).toStringList();
    recent.removeAll(port);
    recent.prepend(port);
    settings.setValue(RecentKey, QStringList(recent.first(qMin(recent.size(), qsizetype(MostRecent)))));
}

} // namespace dynascope
