// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/health/packingbox.h"

#include "core/session/indirectreads.h"
#include "ui/common/texts.h"
#include "ui/health/ratetexts.h"

#include <QCheckBox>
#include <QLabel>
#include <QPromise>
#include <QThreadPool>
#include <QVBoxLayout>

namespace dynascope {

PackingBox::PackingBox(IndirectReads &reads, LineSession &line, QWidget *parent)
    : QWidget(parent)
    , m_reads(reads)
    , m_line(&line)
    , m_pack(new QCheckBox(tr("Pack scattered registers by indirect addressing"), this))
    , m_used(new QCheckBox(tr("Also by Indirect Addresses that are in use"), this))
    , m_gain(new QLabel(this))
{
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(4);
    for (QWidget *widget :
         {static_cast<QWidget *>(m_pack), static_cast<QWidget *>(m_gain), static_cast<QWidget *>(m_used)})
        layout->addWidget(widget);
    m_pack->setObjectName(QStringLiteral("packBox"));
    m_pack->setToolTip(
        tr("Sets Indirect Addresses (RAM) in the devices so that what is plotted at full rate is read as one "
           "piece. What they held is put back when this is switched off."));
    m_used->setObjectName(QStringLiteral("packUsedBox"));
    m_used->setToolTip(tr("Other programs may read or write by them meanwhile. What they held is put back."));
    m_gain->setObjectName(QStringLiteral("packGain"));
    m_gain->setTextFormat(Qt::PlainText);
    m_gain->setForegroundRole(QPalette::PlaceholderText);
    m_gain->setWordWrap(true);
    m_pack->setChecked(reads.isOn(line));
    connect(m_pack, &QCheckBox::clicked, this, [this](bool on) {
        if (m_line)
            m_reads.setOn(*m_line, on, m_used->isChecked() ? UsedEntries::Take : UsedEntries::Refuse);
    });
    connect(&m_predicting, &QFutureWatcherBase::finished, this, &PackingBox::showGain);
    connect(&reads, &IndirectReads::changed, this, &PackingBox::refresh);
    refresh();
}

void PackingBox::refresh()
{
    if (!m_line)
        return;
    const bool isOn = m_reads.isOn(*m_line);
    const int packed = m_reads.packedDevices(*m_line);
    const IndirectReads::Forecast forecast = m_reads.forecast(*m_line);
    m_pack->setChecked(isOn);
    m_pack->setEnabled(isOn || forecast.devices > 0 || !forecast.obstacle.isEmpty());
    m_used->setVisible(!isOn && m_pack->isEnabled());
    m_state.clear();
    if (m_reads.isBusy(*m_line))
        m_state = tr("Setting the Indirect Addresses…");
    else if (isOn && packed > 0)
        m_state = packed == 1 ? tr("One device is read so") : tr("%1 devices are read so").arg(packed);
    else if (forecast.devices == 0)
        m_state = forecast.obstacle.isEmpty() ? tr("Nothing is plotted at full rate") : forecast.obstacle;
    m_predicting.cancel();
    m_predicting.setFuture({});
    if (forecast.devices > 0)
        predict(forecast.without, forecast.with);
    showGain();
}

/// Elsewhere: it takes longer than a frame where there are many devices.
void PackingBox::predict(const PolledLine &without, const PolledLine &with)
{
    const auto promise = std::make_shared<QPromise<std::pair<double, double>>>();
    promise->start();
    m_predicting.setFuture(promise->future());
    QThreadPool::globalInstance()->start([promise, without, with] {
        const auto rateOf = [](const PolledLine &line) {
            return predictPoll(line.plan, line.baudRate, line.delays, line.silent).cycleRate;
        };
        promise->addResult(std::pair(rateOf(without), rateOf(with)));
        promise->finish();
    });
}

void PackingBox::showGain()
{
    QString text = m_state;
    if (m_predicting.isFinished() && m_predicting.future().resultCount() > 0) {
        const auto [without, with] = m_predicting.result();
        if (!text.isEmpty())
            text += QStringLiteral(". ");
        text += tr("Predicted: %1 with it, %2 without").arg(hertzText(with), hertzText(without));
    }
    m_gain->setText(text);
}

} // namespace dynascope
