// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/goalbar.h"

#include <QDoubleSpinBox>
#include <QSlider>
#include <QVBoxLayout>

namespace dynascope {
namespace {

/// Operating Mode, as the X, MX(2.0) and P manuals number it.
QStringList goalNames(std::optional<std::int64_t> mode)
{
    if (!mode)
        return {};
    switch (*mode) {
    case 0: return {QStringLiteral("Goal Current")};
    case 1: return {QStringLiteral("Goal Velocity")};
    case 3:
    case 4: return {QStringLiteral("Goal Position")};
    case 5: return {QStringLiteral("Goal Position"), QStringLiteral("Goal Current")};
    case 16: return {QStringLiteral("Goal PWM")};
    default: return {};
    }
}

} // namespace

std::vector<int> goalFields(const Device &device)
{
    const bool hasModes = device.table().indexOf(u"Operating Mode") >= 0;
    const QStringList names
        = hasModes ? goalNames(device.raw(u"Operating Mode")) : QStringList{QStringLiteral("Goal Position")};
    std::vector<int> fields;
    for (const QString &name : names) {
        if (const int field = device.table().indexOf(name); field >= 0)
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
            [this, mode = devices.front()->table().indexOf(u"Operating Mode")](int first, int last) {
                if (mode >= first && mode <= last)
                    choose();
            });
    }
    choose();
}

void GoalBar::setAngleUnit(AngleUnit unit)
{
    m_first->setAngleUnit(unit);
    m_second->setAngleUnit(unit);
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
