// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/devices/deviceactions.h"

#include "core/session/commands.h"
#include "ui/common/icons.h"
#include "ui/common/present.h"
#include "ui/common/texts.h"
#include "ui/devices/changebauddialog.h"
#include "ui/devices/changeiddialog.h"
#include "ui/devices/nicknames.h"
#include "ui/table/consequencesdialog.h"
#include "ui/table/tableactions.h"
#include "ui/window/unitmenu.h"

#include <QInputDialog>
#include <QMessageBox>
#include <QPushButton>
#include <QWidget>

#include <algorithm>

namespace dynascope {

DeviceActions::DeviceActions(const Workbench &workbench, QWidget *window)
    : QObject(window)
    , m_workbench(workbench)
    , m_window(window)
    , m_backups(new BackupActions(workbench, window))
{
    const auto key = [](const char *text) { return QString::fromLatin1(text); };
    m_identify = add(key("identify"), key("led"), tr("Identify (LED)"), key("Ctrl+I"),
                     tr("Switch the LED of the selected devices on or off"), &DeviceActions::identify);
    m_torqueOn = add(key("torqueOn"), key("torque"), tr("Torque on"), key("Ctrl+T"),
                     tr("The selected devices hold their position"), &DeviceActions::torqueOn);
    m_torqueOff = add(key("torqueOff"), key("torque-off"), tr("Torque off"), key("Ctrl+Shift+T"),
                      tr("The selected devices let go"), &DeviceActions::torqueOff);
    m_readAll = add(key("readAll"), key("refresh"), tr("Read all"), key("F5"),
                    tr("Read every register of the selected devices"), &DeviceActions::readAll);
    m_reboot = add(key("reboot"), key("reboot"), tr("Reboot"), key("Ctrl+Shift+B"),
                   tr("Restart: torque goes off, RAM goes back to defaults, a latched hardware error is cleared"),
                   &DeviceActions::reboot);
    m_rename = add(key("rename"), key("edit"), tr("Nickname…"), key("F2"),
        tr("A name of your own; the servo knows nothing of it"), &DeviceActions::rename);
    m_changeId = add(key("changeId"), key("id"), tr("Change ID…"), key("Ctrl+Shift+I"),
        tr("Give this device another ID"), &DeviceActions::changeId);
    m_changeBaud = add(key("changeBaud"), key("baud"), tr("Change baud rate…"), key("Ctrl+Shift+U"),
                       tr("Let this device work at another baud rate"), &DeviceActions::changeBaud);
    m_moveMany = add(key("moveMany"), key("id"), tr("Move to other IDs or baud…"), key("Ctrl+Shift+M"),
                     tr("New IDs and baud rates for the selected devices, or, with less than two of them, for all "
                        "at their baud rate, planned before anything is written"),
                     &DeviceActions::moveMany);
    m_workAtBaud = add(key("workAtBaud"), key("parked"), tr("Work at this baud"), key("Ctrl+Shift+W"),
                       tr("Move the line to this baud rate; devices at others are parked"), &DeviceActions::workAtBaud);
    m_clearMultiTurn = add(key("clearMultiTurn"), key("turns"), tr("Clear multi-turn"), QString(),
                           tr("Present Position goes back into one turn"), &DeviceActions::clearMultiTurn);
    m_saveHybrid = add(key("saveHybrid"), key("save"), tr("Save Hybrid registers"), QString(),
                       tr("Hybrid Save: gains, profiles and the like stay after power-off; torque must be off"),
                       &DeviceActions::saveHybrid);
    m_factoryReset = add(key("factoryReset"), key("factory-reset"), tr("Factory reset…"), QString(),
                         tr("Put registers back to the factory's values"), &DeviceActions::factoryReset);
    m_forget = add(key("forget"), key("trash"), tr("Remove from the list"), key("Del"),
                   tr("Only here; the next scan finds it again if it answers"), &DeviceActions::forget);
    m_identify->setIconText(tr("Identify"));
    connect(m_backups, &BackupActions::posted, this, &DeviceActions::posted);
    update();
}

QAction *DeviceActions::add(const QString &name, const QString &iconName, const QString &text, const QString &shortcut,
                            const QString &tip, void (DeviceActions::*slot)())
{
    auto *action = new QAction(icon(iconName), text, this);
    action->setObjectName(name + QStringLiteral("Action"));
    action->setShortcut(QKeySequence(shortcut));
    action->setAutoRepeat(false); // a key held down is one order
    QString whole = tip;
    if (!shortcut.isEmpty())
        whole += QStringLiteral(" (%1)").arg(action->shortcut().toString(QKeySequence::NativeText));
    action->setToolTip(whole);
    action->setStatusTip(QString());
    connect(action, &QAction::triggered, this, slot);
    return action;
}

std::vector<QAction *> DeviceActions::menuActions() const
{
    std::vector<QAction *> actions{m_identify, m_torqueOn, m_torqueOff,  nullptr,      m_readAll, m_reboot, nullptr,
                                   m_rename, m_changeId, m_changeBaud, m_moveMany, m_workAtBaud, nullptr};
    for (QAction *action : m_backups->actions())
        actions.push_back(action);
    actions.insert(actions.end(), {nullptr, m_clearMultiTurn, m_saveHybrid, m_factoryReset, m_forget});
    return actions;
}

void DeviceActions::setSelection(const std::vector<Device *> &devices, LineSession *line, int baudRate)
{
    m_selected.clear();
    for (const Device *device : devices)
        m_selected.push_back(device->key());
    m_line = line;
    m_baudRate = baudRate;
    update();
}

std::vector<Device *> DeviceActions::devices() const
{
    return living(m_selected);
}

std::vector<Device *> DeviceActions::living(const std::vector<DeviceKey> &keys) const
{
    std::vector<Device *> devices;
    for (const DeviceKey key : keys) {
        if (Device *device = m_workbench.session.device(key))
            devices.push_back(device);
    }
    return devices;
}

std::vector<Device *> DeviceActions::reachable() const
{
    std::vector<Device *> devices = this->devices();
    std::erase_if(devices, [](const Device *device) { return device->line()->state() != BusThread::State::Open; });
    return devices;
}

Device *DeviceActions::single() const
{
    const std::vector<Device *> devices = reachable();
    return devices.size() == 1 ? devices.front() : nullptr;
}

void DeviceActions::update()
{
    const std::vector<Device *> devices = reachable();
    const bool any = !devices.empty();
    const auto has = [&devices](const char *name) {
        return std::ranges::any_of(devices,
            [name](const Device *device) { return device->table().find(QString::fromLatin1(name)) != nullptr; });
    };
    Device *one = single();
    if (!this->devices().empty()) // it may have moved since it was selected
        m_baudRate = this->devices().front()->baudRate();
    m_identify->setEnabled(std::ranges::any_of(
        devices, [](const Device *device) { return identifyField(device->table()) >= 0; }));
    m_torqueOn->setEnabled(has("Torque Enable")); // also while STOP holds: the refusal says what to do
    m_torqueOff->setEnabled(has("Torque Enable"));
    m_readAll->setEnabled(any);
    m_reboot->setEnabled(any);
    m_rename->setEnabled(this->devices().size() == 1);
    m_changeId->setEnabled(one && one->table().find(u"ID"));
    m_changeBaud->setEnabled(one && one->table().find(u"Baud Rate"));
    m_moveMany->setEnabled(m_line && m_line->state() == BusThread::State::Open && !m_line->devices().empty());
    m_workAtBaud->setEnabled(m_line && m_baudRate > 0 && m_line->state() == BusThread::State::Open
                             && m_line->baudRate() != m_baudRate);
    m_workAtBaud->setText(
        m_workAtBaud->isEnabled() ? tr("Work at %1").arg(baudText(m_baudRate)) : tr("Work at this baud"));
    m_clearMultiTurn->setEnabled(any);
    m_saveHybrid->setVisible(has("Hybrid Save")); // of one series only; before it is enabled: Qt enables nothing hidden
    m_saveHybrid->setEnabled(m_saveHybrid->isVisible());
    m_factoryReset->setEnabled(any && std::ranges::all_of(devices, [&devices](const Device *device) {
        return device->isKnownModel() && device->line() == devices.front()->line();
    }));
    m_forget->setEnabled(!this->devices().empty());
    m_backups->setDevices(devices);
}

QString DeviceActions::subjectOf(const std::vector<Device *> &devices)
{
    QStringList keys;
    for (const Device *device : devices)
        keys << QString::number(device->key());
    return keys.join(u' ');
}

QString DeviceActions::namesOf(const std::vector<Device *> &devices)
{
    static constexpr std::size_t MostNamed = 6;
    QStringList names;
    for (const Device *device : devices) {
        if (names.size() < static_cast<qsizetype>(MostNamed))
            names << device->displayName();
    }
    if (devices.size() > MostNamed)
        names << tr("%1 more").arg(devices.size() - MostNamed);
    return names.join(QStringLiteral(", "));
}

template <typename Dialog>
void DeviceActions::open(Device &device, const QString &name)
{
    const QString subject = subjectOf({&device});
    if (!raiseOpen(*m_window, name, subject))
        present(*new Dialog(device, m_workbench.commands, m_window), subject);
}

void DeviceActions::confirm(const QString &title, const QString &text, const std::vector<Device *> &devices,
                            std::function<void(const std::vector<Device *> &)> action)
{
    const QString name = QStringLiteral("confirmBox");
    const QString subject = title + u' ' + subjectOf(devices);
    if (raiseOpen(*m_window, name, subject))
        return;
    auto *box = new QMessageBox(QMessageBox::Warning, title, text, QMessageBox::Cancel, m_window);
    box->setObjectName(name);
    box->setTextFormat(Qt::PlainText); // nicknames are in it
    QPushButton *accept = box->addButton(title, QMessageBox::AcceptRole);
    accept->setObjectName(QStringLiteral("confirmButton"));
    std::vector<DeviceKey> keys;
    for (const Device *device : devices) {
        keys.push_back(device->key());
        connect(device, &QObject::destroyed, box, &QDialog::reject);
    }
    connect(accept, &QPushButton::clicked, this, [this, keys, action = std::move(action)] { action(living(keys)); });
    present(*box, subject);
}

void DeviceActions::identify()
{
    const std::vector<Device *> devices = reachable();
    std::vector<Device *> lit;
    std::ranges::copy_if(devices, std::back_inserter(lit),
                         [](const Device *device) { return identifyField(device->table()) >= 0; });
    const bool allOn = std::ranges::all_of(lit, [](const Device *device) {
        return device->value(identifyField(device->table())).raw.value_or(0) != 0;
    });
    for (Device *device : lit)
        m_workbench.commands.setLed(*device, !allOn);
}

void DeviceActions::torqueOn()
{
    const std::vector<Device *> devices = reachable();
    if (devices.size() == 1 && tellOfTorqueOn(*devices.front()))
        return;
    if (devices.size() <= 1 || m_workbench.commands.isStopped())
        return turnTorqueOn(devices);
    confirm(tr("Torque on"),
            tr("Turn the torque of %1 devices on? Each holds its position, and may move to a goal it was given before.")
                    .arg(devices.size())
                + QStringLiteral("\n\n") + namesOf(devices) + jumpsText(devices, savedUnits()),
            devices, [this](const std::vector<Device *> &present) { turnTorqueOn(present); });
}

/// Where the joint would jump, or run, it asks first. False: there is nothing to tell.
bool DeviceActions::tellOfTorqueOn(Device &device)
{
    const int torque = device.table().indexOf(Known::TorqueEnable);
    const auto safely = safeWrites(m_workbench);
    if (!safely || torque < 0 || m_workbench.commands.isStopped() || !areSerious(consequencesOf(device, torque, 1)))
        return false;
    AskedWrite write{{&device}, torque, 1, savedUnits(), {}, {}};
    write.writeOnly = [this](Device &present) { turnTorqueOn({&present}); };
    write.writeSafely = [safely, torque](Device &present, bool) { safely(present, torque, 1, false); };
    askAboutConsequences(std::move(write), m_window);
    return true;
}

void DeviceActions::turnTorqueOn(const std::vector<Device *> &devices)
{
    std::vector<DeviceKey> keys;
    for (const Device *device : devices)
        keys.push_back(device->key());
    m_workbench.commands.setTorque(
        devices, true, [this, here = QPointer<DeviceActions>(this), keys](const Result<void> &result) {
            // Also where some failed: each is asked for its torque when it matters.
            if (here && (result || result.error().kind != ErrorKind::Stopped))
                emit torqueEnabled(keys);
        });
}

void DeviceActions::torqueOff()
{
    m_workbench.commands.setTorque(reachable(), false);
}

void DeviceActions::readAll()
{
    for (Device *device : reachable()) {
        const DeviceKey key = device->key();
        if (m_reading.insert(key).second) {
            m_workbench.commands.readAll(*device, [here = QPointer<DeviceActions>(this), key](const Result<void> &) {
                if (here)
                    here->m_reading.erase(key);
            });
        }
    }
}

void DeviceActions::rename()
{
    const std::vector<Device *> devices = this->devices();
    if (devices.size() != 1)
        return;
    const QString dialogName = QStringLiteral("nicknameDialog");
    if (raiseOpen(*m_window, dialogName, subjectOf(devices)))
        return;
    auto *dialog = new QInputDialog(m_window);
    dialog->setObjectName(dialogName);
    dialog->setWindowTitle(tr("Nickname"));
    dialog->setLabelText(tr("Nickname of %1, ID %2:").arg(devices.front()->model()).arg(devices.front()->id()));
    dialog->setMinimumWidth(360);
    dialog->setTextValue(devices.front()->nickname());
    connect(dialog, &QInputDialog::textValueSelected, this,
        [device = QPointer<Device>(devices.front())](const QString &name) {
            if (device)
                device->setNickname(asNickname(name));
        });
    connect(devices.front(), &QObject::destroyed, dialog, &QDialog::reject);
    present(*dialog, subjectOf(devices));
}

void DeviceActions::changeId()
{
    openChangeId(single());
}

void DeviceActions::openChangeId(Device *device)
{
    if (device)
        open<ChangeIdDialog>(*device, QStringLiteral("changeIdDialog"));
}

void DeviceActions::changeBaud()
{
    openChangeBaud(single());
}

void DeviceActions::openChangeBaud(Device *device)
{
    if (device)
        open<ChangeBaudDialog>(*device, QStringLiteral("changeBaudDialog"));
}

/// The selected devices, or where a line or one of its rates is selected all that stand there.
void DeviceActions::moveMany()
{
    if (!m_line)
        return;
    std::vector<Device *> devices = reachable();
    std::erase_if(devices, [this](const Device *device) { return device->line() != m_line; });
    if (devices.size() < 2) { // of one there are Change ID and Change baud rate
        devices.clear();
        for (const auto &device : m_line->devices()) {
            if (m_baudRate == 0 || device->baudRate() == m_baudRate)
                devices.push_back(device.get());
        }
    }
    emit moveRequested(m_line, devices);
}

void DeviceActions::workAtBaud()
{
    if (!m_line || m_baudRate <= 0)
        return;
    m_workbench.commands.workAtBaud(*m_line, m_baudRate);
}

void DeviceActions::saveHybrid()
{
    static constexpr int Save = 1;
    static constexpr int Saved = 2;
    for (Device *device : reachable()) {
        const int field = device->table().indexOf(u"Hybrid Save");
        if (field < 0)
            continue;
        if (device->isTorqueOn()) {
            emit posted({MessageKind::Warning,
                         tr("%1 saves its Hybrid registers only with torque off").arg(device->displayName()), {}, {}});
            continue;
        }
        const auto say = [this, here = QPointer<DeviceActions>(this), device = QPointer<Device>(device),
                          field](const Result<void> &result) {
            if (!here || !device || !result) // a failure is told by who wrote
                return;
            const bool isSaved = device->value(field).raw == Saved;
            emit posted({isSaved ? MessageKind::Success : MessageKind::Info,
                         isSaved ? tr("%1 has saved its Hybrid registers").arg(device->displayName())
                                 : tr("%1 is saving its Hybrid registers: Hybrid Save reads 2 when it is done")
                                       .arg(device->displayName()), {}, {}});
        };
        m_workbench.commands.writeField(*device, field, Save, say);
    }
}

void DeviceActions::forget()
{
    for (Device *device : devices())
        device->line()->forget(device->key());
}

} // namespace dynascope
