// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/goalbar.h"

#include <QDoubleSpinBox>
#include <QSlider>
#include <QVBoxLayout>

namespace dynascope {
namespace {

/// What says which goal counts; −1 where nothing does. XL-320 has a mode of its own.
int modeField(const ControlTable &table)
{
    const int mode = table.indexOf(Known::OperatingMode);
    return mode >= 0 ? mode : table.indexOf(u"Control Mode");
}

/// Control Mode, as the XL-320 manual numbers it.
QStringList goalsOfControlMode(std::int64_t mode)
{
    switch (mode) {
    case 1: return {QStringLiteral("Moving Speed")};
    case 2: return {QStringLiteral("Goal Position"), QStringLiteral("Moving Speed")};
    default: return {};
    }
}

/// Operating Mode, as all other manuals number it. PRO says Torque where the others say Current; each has one of them.
QStringList goalsOfOperatingMode(std::int64_t mode)
{
    switch (mode) {
    case 0: return {QStringLiteral("Goal Current"), QStringLiteral("Goal Torque")};
    case 1: return {QStringLiteral("Goal Velocity")};
    case 3:
    case 4: return {QStringLiteral("Goal Position")};
    case 5: return {QStringLiteral("Goal Position"), QStringLiteral("Goal Current")};
    case 16: return {QStringLiteral("Goal PWM")};
    default: return {};
    }
}

QStringList goalNames(const Device &device)
{
    const ControlTable &table = device.table();
    const int field = modeField(table);
    if (field < 0)
        return {QStringLiteral("Goal Position")};
    const std::optional<std::int64_t> mode = device.value(field).raw;
    if (!mode)
        return {};
    return field == table.indexOf(Known::OperatingMode) ? goalsOfOperatingMode(*mode) : goalsOfControlMode(*mode);
}

} // namespace

std::vector<int> goalFields(const Device &device)
{
    std::vector<int> fields;
    for (const QString &name : goalNames(device)) {
        const int field = device.table().indexOf(name);
        if (field >= 0 && device.table().fields()[static_cast<std::size_t>(field)].isWritable())
            fields.push_back(field);
    }
    return fields;
}

GoalBar::GoalBar(GoalSlider::Writer writer, QWidget *parent)
    : QFrame(parent)
    , m_first(new GoalSlider(writer, this))
    , m_second(new GoalSlider(writer, this))
{
    setObjectName(QStringLiteral("goalBar"));
    m_first->slider()->setObjectName(QStringLiteral("goalSlider"));
    m_first->spin()->setObjectName(QStringLiteral("goalSpin"));
    m_second->slider()->setObjectName(QStringLiteral("secondGoalSlider"));
    m_second->spin()->setObjectName(QStringLiteral("secondGoalSpin"));
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(12, 8, 12, 8);
    layout->setSpacing(8);
    layout->addWidget(m_first);
    layout->addWidget(m_second);
    hide();
}

void GoalBar::setDevices(const std::vector<Device *> &devices, const QString &whom)
{
    m_first->setWhom(whom);
    m_second->setWhom(whom);
    const bool same = devices.size() == m_devices.size()
        && std::equal(devices.begin(), devices.end(), m_devices.begin(),
                      [](Device *one, const QPointer<Device> &other) { return one == other.data(); });
    if (same)
        return;
    for (const QPointer<Device> &device : m_devices) {
        if (device)
            device->disconnect(this);
    }
    m_devices.assign(devices.begin(), devices.end());
    m_fields.clear();
    m_first->setTarget({}, -1);
    m_second->setTarget({}, -1);
    if (!devices.empty()) {
        // A thousand times a second for what is plotted: only the mode counts.
        connect(devices.front(), &Device::fieldsChanged, this,
            [this, mode = modeField(devices.front()->table())](int first, int last) {
                if (mode >= first && mode <= last)
                    choose();
            });
    }
    choose();
}

void GoalBar::setUnits(const UnitPreferences &units)
{
    m_first->setUnits(units);
    m_second->setUnits(units);
}

void GoalBar::choose()
{
    std::vector<Device *> devices;
    for (const QPointer<Device> &device : m_devices) {
        if (device)
            devices.push_back(device);
    }
    const std::vector<int> fields = devices.empty() ? std::vector<int>() : goalFields(*devices.front());
    setVisible(!fields.empty());
    if (fields == m_fields)
        return;
    m_fields = fields;
    m_second->setVisible(fields.size() > 1);
    m_first->setTarget(devices, fields.empty() ? -1 : fields.front());
    m_second->setTarget(fields.size() > 1 ? devices : std::vector<Device *>(), fields.size() > 1 ? fields[1] : -1);
}

} // namespace dynascope
