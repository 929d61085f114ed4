// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/goalslider.h"

#include "core/session/linesession.h"
#include "ui/common/texts.h"
#include "ui/common/theme.h"

#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QSlider>

#include <algorithm>
#include <cmath>

namespace dynascope {

GoalSlider::GoalSlider(Writer writer, QWidget *parent)
    : QWidget(parent)
    , m_writer(std::move(writer))
    , m_throttle([this](std::int64_t raw) { send(raw); })
    , m_name(new QLabel(this))
    , m_note(new QLabel(this))
    , m_slider(new QSlider(Qt::Horizontal, this))
    , m_spin(new QDoubleSpinBox(this))
{
    auto *layout = new QHBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(12);
    m_name->setMinimumWidth(fontMetrics().horizontalAdvance(QStringLiteral("Goal Position")) + 4);
    m_name->setTextFormat(Qt::PlainText);
    m_note->setTextFormat(Qt::PlainText);
    m_note->setForegroundRole(QPalette::PlaceholderText);
    m_slider->setMinimumWidth(120);
    m_slider->setFocusPolicy(Qt::StrongFocus);
    m_spin->setKeyboardTracking(false);
    m_spin->setLocale(QLocale::c()); // a decimal point, as everywhere in the grid
    m_spin->setAlignment(Qt::AlignRight);
    m_spin->setFont(numberFont(font()));
    m_spin->setMinimumWidth(132);
    layout->addWidget(m_name);
    layout->addWidget(m_slider, 1);
    layout->addWidget(m_note);
    layout->addWidget(m_spin);

    for (QTimer *timer : {&m_frame, &m_settle}) {
        timer->setSingleShot(true);
        connect(timer, &QTimer::timeout, this, &GoalSlider::refresh);
    }
    m_frame.setInterval(33);
    m_settle.setInterval(400);
    connect(m_slider, &QSlider::valueChanged, this, [this](int value) {
        if (m_showing)
            return;
        const std::int64_t raw = rawFromSigned(m_effective, value);
        show(raw);
        m_throttle.submit(raw);
    });
    connect(m_slider, &QSlider::sliderReleased, &m_settle, qOverload<>(&QTimer::start));
    connect(m_spin, &QDoubleSpinBox::valueChanged, this, [this](double value) {
        if (m_showing)
            return;
        const std::int64_t wanted = rawFromPhysical(m_effective, m_resolution, value, m_units);
        const std::int64_t raw = rawFromSigned(
            m_effective, std::clamp<std::int64_t>(signedFromRaw(m_effective, wanted), m_slider->minimum(),
                                                  m_slider->maximum()));
        show(raw);
        m_throttle.submit(raw);
    });
    if (auto *line = m_spin->findChild<QLineEdit *>()) {
        connect(line, &QLineEdit::textEdited, this, [this] { m_typing = true; });
        connect(line, &QLineEdit::editingFinished, this, [this] { m_typing = false; });
    }
}

void GoalSlider::setTarget(const std::vector<Device *> &devices, int field)
{
    for (const QPointer<Device> &device : m_devices) {
        if (device)
            device->disconnect(this);
    }
    m_throttle.drop();
    m_typing = false;
    m_devices.assign(devices.begin(), devices.end());
    m_field = field;
    for (Device *device : devices) {
        const auto soon = [this] {
            if (!m_frame.isActive())
                m_frame.start();
        };
        connect(device, &Device::fieldsChanged, this, soon);
        connect(device, &Device::attributesChanged, this, soon);
    }
    refresh();
}

void GoalSlider::setWhom(const QString &whom)
{
    m_whom = whom;
    refresh();
}

void GoalSlider::setUnits(const UnitPreferences &units)
{
    m_chosen = units;
    m_typing = false; // what stands there was typed in the old ones
    refresh();
}

void GoalSlider::refresh()
{
    Device *device = m_devices.empty() ? nullptr : m_devices.front().data();
    if (!device || m_field < 0) {
        setEnabled(false);
        return;
    }
    const Field &field = device->table().fields()[static_cast<std::size_t>(m_field)];
    const FieldValue &value = device->value(m_field);
    m_name->setText(field.name);
    m_slider->setAccessibleName(field.name);
    m_spin->setAccessibleName(field.name);
    const QString lock = device->lockReason(m_field);
    const bool ready = device->isTorqueOn() && lock.isEmpty() && value.raw;
    const QString why = !lock.isEmpty() ? lock : tr("Goals can be moved while torque is on.");
    const bool connected = !device->line() || device->line()->state() == BusThread::State::Open;
    m_note->setText(ready               ? m_whom
                    : !connected        ? tr("not connected")
                    : device->isTorqueOn() ? tr("not known yet")
                                           : tr("torque is off"));
    m_note->setVisible(!m_note->text().isEmpty());
    for (QWidget *part : {static_cast<QWidget *>(m_slider), static_cast<QWidget *>(m_spin)}) {
        part->setEnabled(ready);
        part->setToolTip(ready ? tr("%1: arrows and page keys, or the wheel").arg(field.name) : plainToolTip(why));
    }
    setEnabled(true);
    if (!ready)
        m_throttle.drop();
    if (m_slider->isSliderDown() || m_throttle.isWaiting() || m_typing)
        return;
    setUpRange(*device);
    if (value.raw)
        show(value.pending.value_or(*value.raw));
}

void GoalSlider::setUpRange(const Device &device)
{
    const Field &field = device.table().fields()[static_cast<std::size_t>(m_field)];
    m_units = m_chosen;
    m_effective = device.effective(m_field);
    m_resolution = device.table().resolution();
    const auto [least, most] = signedRange(field, m_effective);
    const Physical one = physical(m_effective, m_resolution, 1, m_units);
    // A step is about 1°, 1 rev/min, 1 mA, whatever they are shown as (one turn for a key would be a blow), never less
    // than the register can tell apart; a page is ten.
    const std::int64_t unit = std::max<std::int64_t>(1, rawFromPhysical(m_effective, m_resolution, 1.0));
    m_showing = true;
    m_slider->setRange(static_cast<int>(least), static_cast<int>(most));
    m_slider->setSingleStep(static_cast<int>(unit));
    m_slider->setPageStep(static_cast<int>(unit * 10));
    m_spin->setDecimals(one.decimals);
    m_spin->setRange(toPhysical(rawFromSigned(m_effective, least)), toPhysical(rawFromSigned(m_effective, most)));
    m_spin->setSingleStep(std::abs(one.value) * static_cast<double>(unit));
    m_spin->setSuffix(one.unit.isEmpty() ? QString() : u' ' + one.unit);
    m_showing = false;
}

double GoalSlider::toPhysical(std::int64_t raw) const
{
    return physical(m_effective, m_resolution, raw, m_units).value;
}

void GoalSlider::show(std::int64_t raw)
{
    m_showing = true;
    m_slider->setValue(static_cast<int>(signedFromRaw(m_effective, raw)));
    m_spin->setValue(toPhysical(raw));
    m_showing = false;
}

void GoalSlider::send(std::int64_t raw)
{
    m_settle.start();
    const std::vector<QPointer<Device>> devices = m_devices;
    for (const QPointer<Device> &device : devices) {
        if (device && device->isTorqueOn())
            m_writer(*device, m_field, raw);
    }
}

} // namespace dynascope
