// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/health/rateremedies.h"

#include "core/session/monitor.h"
#include "core/session/settingscommands.h"
#include "ui/common/present.h"
#include "ui/health/ratepopup.h"

#include <QCheckBox>
#include <QMessageBox>
#include <QPointer>
#include <QPushButton>

#include <memory>

namespace dynascope {

struct RateRemedies::Delays {
    int set = 0, locked = 0, failed = 0, open = 0;
};

RateRemedies::RateRemedies(const Workbench &workbench, QWidget *window)
    : QObject(window)
    , m_workbench(workbench)
    , m_window(window)
{
}

void RateRemedies::show(LineSession *line, QWidget *over)
{
    auto *popup = new RatePopup(m_workbench, *line, m_window);
    connect(popup, &RatePopup::remedyChosen, this, [this, line = QPointer(line)](const RateLimit &limit) {
        if (line)
            apply(*line, limit);
    });
    popup->open(*over);
}

void RateRemedies::apply(LineSession &line, const RateLimit &limit)
{
    switch (limit.what) {
    case RateLimit::What::ReturnDelay: return askForReturnDelay(line, limit.devices);
    case RateLimit::What::LatencyTimer: return lowerLatency(line);
    case RateLimit::What::PlainReads: return m_workbench.monitor.setMayReadFast(true);
    default: return;
    }
}

/// EEPROM: never without being asked for, and torque only where a person lets it go.
void RateRemedies::askForReturnDelay(LineSession &line, const std::vector<std::uint8_t> &ids)
{
    const QString name = QStringLiteral("returnDelayBox");
    if (raiseOpen(*m_window, name) || !m_workbench.settings)
        return;
    std::vector<DeviceKey> devices;
    QStringList names, underTorque;
    for (const std::uint8_t id : ids) {
        const Device *device = line.deviceAt(id, line.baudRate());
        if (!device || device->table().indexOf(Known::ReturnDelayTime) < 0)
            continue;
        devices.push_back(device->key());
        names << device->displayName();
        if (device->mayHaveTorqueOn())
            underTorque << device->displayName();
    }
    if (devices.empty())
        return;
    QString text = tr("Set Return Delay Time to 0 in %1?").arg(names.join(QStringLiteral(", ")));
    QString more = tr("It is kept in EEPROM. The journal can take it back.");
    if (!underTorque.isEmpty())
        more += QLatin1Char(' ')
                + tr("%1 under torque, which locks it.")
                      .arg(underTorque.size() == 1 ? tr("%1 is").arg(underTorque.front())
                                                   : tr("%1 are").arg(underTorque.join(QStringLiteral(", "))));
    auto *box = new QMessageBox(QMessageBox::Question, tr("Return Delay Time"), text, QMessageBox::Cancel, m_window);
    box->setObjectName(name);
    box->setTextFormat(Qt::PlainText); // nicknames are in it
    box->setInformativeText(more);
    QPushButton *set = box->addButton(tr("Set to 0"), QMessageBox::AcceptRole);
    set->setObjectName(QStringLiteral("setReturnDelayButton"));
    QCheckBox *torque = nullptr;
    if (!underTorque.isEmpty()) {
        torque = new QCheckBox(tr("Turn torque off for it: what these hold may fall. It stays off."), box);
        torque->setObjectName(QStringLiteral("torqueOffBox"));
        box->setCheckBox(torque);
    }
    box->setDefaultButton(QMessageBox::Cancel);
    connect(set, &QPushButton::clicked, this,
            [this, devices, torque] { setReturnDelay(devices, torque && torque->isChecked()); });
    present(*box);
}

void RateRemedies::setReturnDelay(const std::vector<DeviceKey> &devices, bool mayTurnTorqueOff)
{
    std::vector<Device *> present;
    for (const DeviceKey key : devices) {
        if (Device *device = m_workbench.session.device(key))
            present.push_back(device);
    }
    const auto delays = std::make_shared<Delays>();
    delays->open = static_cast<int>(present.size());
    SettingsOptions options;
    options.mayTurnTorqueOff = mayTurnTorqueOff;
    for (Device *device : present) {
        const auto done = [this, delays, here = QPointer<RateRemedies>(this)](const Result<SettingsOutcome> &outcome) {
            if (!outcome)
                ++delays->failed;
            else if (outcome->missing != Consent::None)
                ++delays->locked;
            else
                ++(outcome->isDone() ? delays->set : delays->failed);
            if (here && --delays->open == 0)
                finish(*delays);
        };
        m_workbench.settings->apply(*device, {{device->table().indexOf(Known::ReturnDelayTime), 0}}, options, done);
    }
}

/// Failures have been said by Commands.
void RateRemedies::finish(const Delays &delays)
{
    const auto devices = [](int count) { return count == 1 ? tr("one device") : tr("%1 devices").arg(count); };
    if (delays.locked > 0)
        emit posted(MessageKind::Warning,
                    tr("Return Delay Time stays as it was in %1: torque is on, which locks EEPROM")
                        .arg(devices(delays.locked)));
    if (delays.set > 0)
        emit posted(MessageKind::Success, tr("Return Delay Time is 0 in %1").arg(devices(delays.set)));
}

void RateRemedies::lowerLatency(LineSession &line)
{
    line.lowerLatency(this, [this, name = line.name()](const Result<void> &done) {
        if (done)
            emit posted(MessageKind::Success, tr("%1 hands over answers as they come").arg(name));
        else
            emit posted(MessageKind::Warning, done.error().text);
    });
}

} // namespace dynascope
