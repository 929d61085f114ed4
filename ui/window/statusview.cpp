// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/statusview.h"

#include "core/bus/networkaddress_values.h"
#include "core/session/linesession.h"
#include "ui/common/elidedlabel.h"
#include "ui/common/texts.h"
#include "ui/common/theme.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>

#include <algorithm>

namespace dynascope {

namespace {


} // namespace

StatusView::StatusView(QWidget *parent)
    : QWidget(parent)
    , m_name(new ElidedLabel(this))
{
    setObjectName(QStringLiteral("statusView"));
    auto *layout = new QHBoxLayout(this);
    layout->setContentsMargins(12, 2, 12, 2);
    layout->setSpacing(6);
    m_name->setObjectName(QStringLiteral("statusLine"));
    layout->addWidget(m_name, 1);
    m_devices = addFigure(QStringLiteral("statusDevices"), tr("Devices"), QStringLiteral("252 + 252"),
                          tr("Devices at the line's baud rate, and those parked at others"));
    m_rate = addFigure(QStringLiteral("statusRate"), tr("Cycle"), QStringLiteral("0000 of 0000 Hz"), QString());
    addRateButton();
    m_load = addFigure(QStringLiteral("statusLoad"), tr("Bus load"), QStringLiteral("100 %"),
                       tr("Part of the last second in which the wire carried bytes. The rest is waiting: for answers, for the "
                          "adapter, for this computer."));
    m_errors = addFigure(QStringLiteral("statusErrors"), tr("Errors"), QStringLiteral("000000"), QString());
    setLine(nullptr);
}

QLabel *StatusView::addFigure(const QString &name, const QString &caption, const QString &widest, const QString &tip)
{
    auto *label = new QLabel(caption, this);
    label->setForegroundRole(QPalette::PlaceholderText);
    label->setToolTip(tip);
    auto *figure = new QLabel(this);
    figure->setObjectName(name);
    figure->setAccessibleName(caption);
    figure->setFont(numberFont(font()));
    figure->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
    figure->setMinimumWidth(QFontMetrics(figure->font()).horizontalAdvance(widest));
    figure->setToolTip(tip);
    auto *box = static_cast<QHBoxLayout *>(layout());
    box->addSpacing(12);
    box->addWidget(label);
    box->addWidget(figure);
    return figure;
}

/// Behind the cycle rate: why it is no higher.
void StatusView::addRateButton()
{
    m_rateButton = new QToolButton(this);
    m_rateButton->setObjectName(QStringLiteral("statusRateButton"));
    m_rateButton->setAutoRaise(true);
    m_rateButton->setText(tr("Why?"));
    m_rateButton->setAccessibleName(tr("What holds polling up"));
    m_rateButton->setToolTip(tr("What is read how often, what takes the time, and what can be done about it"));
    layout()->addWidget(m_rateButton);
    connect(m_rateButton, &QToolButton::clicked, this, [this] {
        if (m_line)
            emit ratesRequested(m_line, m_rateButton);
    });
}

QString StatusView::rateToolTip() const
{
    QStringList lines{tr("Poll cycles a second of what is plotted, over the last second, of those that the wire allows at "
                         "this baud rate with these Return Delay Times")};
    const double predicted = m_line ? m_line->prediction().cycleRate : 0;
    if (predicted > 0)
        lines << tr("With what adapter and computer were seen to add %1 Hz are predicted.").arg(qRound(predicted));
    return lines.join(QLatin1Char('\n'));
}

void StatusView::setLine(LineSession *line)
{
    if (m_line && m_line != line)
        m_line->disconnect(this);
    if (line && m_line != line) {
        connect(line, &LineSession::rateChanged, this, &StatusView::update);
        connect(line, &LineSession::stateChanged, this, &StatusView::update);
        connect(line, &LineSession::deviceAdded, this, &StatusView::countDevices);
        connect(line, &LineSession::deviceChanged, this, &StatusView::countDevices);
        connect(line, &LineSession::deviceLocated, this, &StatusView::countDevices);
        connect(line, &LineSession::deviceAboutToBeRemoved, this, &StatusView::countDevices, Qt::QueuedConnection);
    }
    m_line = line;
    update();
}

void StatusView::countDevices()
{
    int present = 0;
    int parked = 0;
    if (m_line) {
        for (const auto &device : m_line->devices())
            ++(device->baudRate() == m_line->baudRate() ? present : parked);
    }
    m_devices->setText(parked > 0 ? QStringLiteral("%1 + %2").arg(present).arg(parked) : QString::number(present));
}

/// The errors' colour goes with light and dark.
void StatusView::changeEvent(QEvent *event)
{
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange && m_errors)
        updateErrors();
}

void StatusView::update()
{
    const bool open = m_line && m_line->state() == BusThread::State::Open;
    m_name->setText(m_line ? QStringLiteral("%1 · %2").arg(portText(m_line->name()), lineStateText(*m_line))
                           : tr("No line is open"));
    const QString none = QStringLiteral("–");
    const bool polls = open && m_line->cycleRate() > 0;
    if (polls && m_line->possibleRate() >= 1)
        m_rate->setText(tr("%1 of %2 Hz").arg(qRound(m_line->cycleRate())).arg(qRound(m_line->possibleRate())));
    else
        m_rate->setText(polls ? tr("%1 Hz").arg(qRound(m_line->cycleRate())) : none);
    m_rate->setToolTip(rateToolTip());
    m_rateButton->setVisible(open);
    const bool isKnown = open && !isRateTheServers(m_line->name()); // nobody here knows at which rate a server works
    m_load->setText(isKnown ? tr("%1 %").arg(qRound(m_line->busLoad() * 100)) : none);
    updateErrors();
    countDevices();
}

void StatusView::updateErrors()
{
    if (!m_line) {
        m_errors->setText(QStringLiteral("–"));
        m_errors->setToolTip({});
        return;
    }
    const LineQuality &quality = m_line->health().quality(); // the same counts as in Bus health
    const DeviceQuality all = quality.sum();
    const BusStatistics &seen = quality.totals;
    const quint64 errors = all.bad();
    m_errors->setText(QString::number(errors));
    QPalette ink = palette();
    if (errors > 0)
        ink.setColor(QPalette::WindowText, colors(palette()).warning);
    m_errors->setPalette(ink);
    const QStringList lines{tr("Since counting began, as Bus health shows:"),
                            tr("%1 answers that didn't come or were cut off").arg(all.timeouts),
                            tr("%1 damaged packets (CRC)").arg(all.crcErrors),
                            tr("%1 answers of a wrong length").arg(all.lengthErrors),
                            tr("%1 answers that came late").arg(all.lateAnswers),
                            tr("%1 packets nobody asked for").arg(seen.strays),
                            tr("%1 requests sent again").arg(all.retries),
                            tr("%1 exchanges, %2 answers").arg(seen.exchanges).arg(seen.replies)};
    m_errors->setToolTip(lines.join(QLatin1Char('\n')));
}

} // namespace dynascope
