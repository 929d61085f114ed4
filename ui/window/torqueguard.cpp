// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/torqueguard.h"

#include "core/session/settingscommands.h"
#include "ui/common/present.h"

#include <QMessageBox>
#include <QPushButton>

#include <algorithm>

namespace dynascope {

TorqueGuard::TorqueGuard(const Workbench &workbench, QWidget *window)
    : QObject(window)
    , m_workbench(workbench)
    , m_window(window)
{
    connect(&workbench.session, &Session::deviceAdded, this, &TorqueGuard::follow);
    connect(&workbench.session, &Session::deviceAboutToBeRemoved, this,
            [this](Device *device) { m_enabled.erase(device->key()); });
    if (workbench.settings)
        connect(workbench.settings, &SettingsCommands::torqueTurnedOn, this,
                [this](DeviceKey key) { noteEnabled({key}); });
    for (Device *device : workbench.session.devices())
        follow(device);
}

void TorqueGuard::follow(Device *device)
{
    connect(
        device, &Device::fieldsChanged, this, [this, device](int first, int last) { onFields(device, first, last); });
}

void TorqueGuard::onFields(Device *device, int first, int last)
{
    // A write of 1 to Torque Enable, wherever in the window it was made, shows as a pending value.
    const int torque = device->table().indexOf(Known::TorqueEnable);
    // So does that of a goal, where Drive Mode lets it turn torque on.
    for (int i = first; i <= last && device->goalTurnsTorqueOn() && !device->isTorqueOn(); ++i) {
        if (device->value(i).pending && isGoal(device->table().fields()[static_cast<std::size_t>(i)]))
            m_enabled.insert_or_assign(device->key(), false);
    }
    if (torque < first || torque > last)
        return;
    const FieldValue &value = device->value(torque);
    const auto known = m_enabled.find(device->key());
    if (value.pending == 1)
        m_enabled.insert_or_assign(device->key(), false);
    else if (known != m_enabled.end() && value.raw == 1)
        known->second = true;
    else if (known != m_enabled.end() && value.raw == 0 && known->second && !value.unconfirmed)
        m_enabled.erase(known); // whoever turns it on next is not necessarily us
}

void TorqueGuard::noteEnabled(const std::vector<DeviceKey> &devices)
{
    for (const DeviceKey key : devices)
        m_enabled.insert_or_assign(key, true);
}

std::vector<Device *> TorqueGuard::holding() const
{
    std::vector<Device *> devices;
    for (const auto &[key, seen] : m_enabled) {
        Device *device = m_workbench.session.device(key);
        if (device && device->mayHaveTorqueOn() && device->line()->state() == BusThread::State::Open)
            devices.push_back(device);
    }
    return devices;
}

bool TorqueGuard::mayClose()
{
    const std::vector<Device *> devices = holding();
    if (m_agreed || devices.empty())
        return true;
    if (raiseOpen(*m_window, QStringLiteral("torqueBox")))
        return false; // it is being asked
    QStringList names;
    for (const Device *device : devices)
        names << device->displayName();
    const bool isSure = std::ranges::all_of(devices, &Device::isTorqueOn); // else nobody could read it back
    const QString who = names.join(QStringLiteral(", "));
    const QString verb = !isSure ? tr("%1 may stand").arg(who) : names.size() == 1 ? tr("%1 stands").arg(who)
                                                                                  : tr("%1 stand").arg(who);
    auto *box = new QMessageBox(QMessageBox::Question, tr("Devices under torque"),
        tr("%1 under torque, which was turned on here. Closing the window changes nothing about it.").arg(verb),
        QMessageBox::Cancel, m_window);
    box->setObjectName(QStringLiteral("torqueBox"));
    box->setTextFormat(Qt::PlainText); // nicknames are in it
    QPushButton *leave = box->addButton(tr("Leave it on and close"), QMessageBox::AcceptRole);
    leave->setObjectName(QStringLiteral("leaveTorqueButton"));
    QPushButton *off = box->addButton(tr("Turn it off and close"), QMessageBox::DestructiveRole);
    off->setObjectName(QStringLiteral("turnTorqueOffButton"));
    box->setDefaultButton(QMessageBox::Cancel);
    const auto agree = [this] {
        m_agreed = true;
        emit closeAgreed();
    };
    connect(leave, &QPushButton::clicked, this, agree);
    connect(off, &QPushButton::clicked, this, [this, agree] {
        // A failure is said in the message bar, and the window stays.
        m_workbench.commands.setTorque(
            holding(), false, [here = QPointer<TorqueGuard>(this), agree](const Result<void> &result) {
                if (here && result)
                    agree();
            });
    });
    present(*box);
    return false;
}

} // namespace dynascope
