// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/common/texts.h"

#include "core/bus/networkaddress_values.h"
#include "core/session/neighbours.h"
#include "core/table/units.h"

#include <QCoreApplication>
#include <QRegularExpression>
#include <QTextDocument>

#include <chrono>

namespace dynascope {

namespace {

/// The context of what is translated here.
class Texts
{
    Q_DECLARE_TR_FUNCTIONS(Texts)
};

} // namespace

QString grouped(quint64 number)
{
    QString text = QString::number(number);
    for (qsizetype at = text.size() - 3; at > 0; at -= 3)
        text.insert(at, QChar(0x2009));
    return text;
}

QString withMinus(QString number)
{
    return number.replace(u'-', QChar(0x2212));
}

QString asSentence(QString text)
{
    text = withBaudTexts(text);
    const QString ends = QStringLiteral(".?!…");
    if (text.isEmpty())
        return text;
    if (!ends.contains(text.back()))
        text += u'.';
    const bool isAddress = text.section(u' ', 0, 0).contains(QStringLiteral("://"));
    if (!isAddress)
        text.front() = text.front().toUpper();
    return text;
}

QString baudText(int bitsPerSecond)
{
    if (bitsPerSecond >= 1'000'000 && bitsPerSecond % 100'000 == 0)
        return Texts::tr("%1 Mbps").arg(bitsPerSecond / 1e6, 0, 'g', 4);
    return Texts::tr("%1 bps").arg(grouped(static_cast<quint64>(bitsPerSecond)));
}

QString withBaudTexts(const QString &text)
{
    static const QRegularExpression digits(QStringLiteral(R"((?<![\w.\x{2009}])([0-9]{4,8}) bps\b)"));
    if (!text.contains(QStringLiteral(" bps")))
        return text;
    QString said;
    qsizetype from = 0;
    for (auto all = digits.globalMatch(text); all.hasNext();) {
        const QRegularExpressionMatch match = all.next();
        said += text.mid(from, match.capturedStart() - from) + baudText(match.captured(1).toInt());
        from = match.capturedEnd();
    }
    return said + text.mid(from);
}

QString agoText(LineTime at)
{
    const LineTime now = std::chrono::steady_clock::now().time_since_epoch();
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(now - at).count();
    if (seconds < 10)
        return Texts::tr("just now");
    if (seconds < 60)
        return Texts::tr("%1 s ago").arg(seconds / 10 * 10);
    if (seconds < 3600)
        return Texts::tr("%1 min ago").arg(seconds / 60);
    return Texts::tr("%1 h ago").arg(seconds / 3600);
}

QString portText(const QString &name)
{
    return name == QStringLiteral("sim") ? Texts::tr("Simulated bus") : name;
}

QString plainToolTip(const QString &text)
{
    return Qt::mightBeRichText(text) ? Qt::convertFromPlainText(text, Qt::WhiteSpaceNormal) : text;
}

QString plainLabel(QString text)
{
    return text.replace(u'&', QStringLiteral("&&"));
}

QString lineStateText(const LineSession &line)
{
    switch (line.state()) {
    case BusThread::State::Opening: return Texts::tr("Opening…");
    case BusThread::State::Open:
        if (line.isRecorded())
            return Texts::tr("Recorded at %1").arg(baudText(line.baudRate()));
        if (isRateTheServers(line.name()))
            return Texts::tr("Connected at the server's rate");
        return Texts::tr("Connected at %1").arg(baudText(line.baudRate()));
    case BusThread::State::Lost: return Texts::tr("Connection lost");
    case BusThread::State::Closed: break;
    }
    return Texts::tr("Not connected");
}

QString deviceStateText(const Device &device)
{
    const LineSession *line = device.line();
    if (line && line->state() != BusThread::State::Open)
        return Texts::tr("No connection");
    switch (device.state()) {
    case Device::State::Present: break;
    case Device::State::Parked:
        return Texts::tr("Parked, heard %1").arg(agoText(device.lastHeard()));
    case Device::State::Silent:
        return device.answersOnlyPing() ? Texts::tr("Answers Ping but no Read") : Texts::tr("Does not answer");
    case Device::State::Rebooting: return Texts::tr("Rebooting…");
    }
    if (!device.doubt().isEmpty())
        return device.doubt();
    if (!device.isKnownModel())
        return Texts::tr("Model %1, bare bytes").arg(device.modelNumber());
    const int enable = device.table().indexOf(Known::TorqueEnable);
    if (enable >= 0 && device.value(enable).unconfirmed) {
        return *device.value(enable).unconfirmed != 0 ? Texts::tr("Torque on sent, not confirmed")
                                                      : Texts::tr("Torque off sent, not confirmed");
    }
    const auto torque = device.raw(u"Torque Enable");
    if (!torque)
        return Texts::tr("Present");
    return *torque != 0 ? Texts::tr("Torque on") : Texts::tr("Torque off");
}

QString deviceStateHelp(const Device &device)
{
    switch (device.state()) {
    case Device::State::Parked:
        return Texts::tr("Parked at %1, last heard %2. It isn't polled while the line works at another baud rate.")
            .arg(baudText(device.baudRate()), agoText(device.lastHeard()));
    case Device::State::Silent:
        if (device.line() && device.line()->isRecorded())
            return Texts::tr("It did not answer then.");
        if (device.answersOnlyPing()) {
            return Texts::tr("It answers Ping but no Read, as a Status Return Level of 0 tells a device to. Set Status "
                             "Return Level to 1 or 2 and it can be read again.");
        }
        return Texts::tr("%1. Is it powered, and still at this ID and baud rate?")
            .arg(withNeighbours(
                device, Texts::tr("It does not answer; last heard %1").arg(agoText(device.lastHeard()))));
    case Device::State::Present:
    case Device::State::Rebooting: break;
    }
    return {};
}

QString alertText(const Device &device)
{
    if (!device.alert())
        return {};
    if (const Field *field = device.table().find(u"Hardware Error Status")) {
        const auto raw = device.raw(field->name);
        if (raw && *raw != 0)
            return meaning(*field, *raw);
    }
    return Texts::tr("Hardware error");
}

} // namespace dynascope
