// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/units.h"
#include "ui/table/tableactions.h"
#include "ui/table/writethrottle.h"

#include <QPointer>
#include <QWidget>

class QDoubleSpinBox;
class QLabel;
class QSlider;

namespace dynascope {

/// One goal register under the hand: a slider and a number. Writes while it moves, shows what the servo says while it
/// doesn't. Only devices under torque are written to: a goal may turn torque on (Drive Mode bit 3).
class GoalSlider : public QWidget
{
    Q_OBJECT

public:
    using Writer = std::function<void(Device &, int field, std::int64_t raw)>;

    explicit GoalSlider(Writer writer, QWidget *parent = nullptr);

    /// Follows the first, writes to all.
    void setTarget(const std::vector<Device *> &devices, int field);
    void setWhom(const QString &whom); ///< said beside the slider
    void setUnits(const UnitPreferences &units);
    /// Stands at signed numbers (signedFromRaw), so that left is always less.
    QSlider *slider() const { return m_slider; }
    QDoubleSpinBox *spin() const { return m_spin; }

private:
    void refresh();
    void setUpRange(const Device &device);
    void show(std::int64_t raw);
    void send(std::int64_t raw);
    double toPhysical(std::int64_t raw) const;

    Writer m_writer;
    std::vector<QPointer<Device>> m_devices;
    QString m_whom;
    int m_field = -1;
    UnitPreferences m_chosen;
    UnitPreferences m_units; ///< of what the spin box shows: follows once nobody drags or types
    EffectiveField m_effective;
    int m_resolution = 4096;
    WriteThrottle m_throttle;
    QTimer m_frame;  ///< collects what the device reports
    QTimer m_settle; ///< after the hand is off: back to what the servo says, whatever became of the write
    QLabel *m_name;
    QLabel *m_note;
    QSlider *m_slider;
    QDoubleSpinBox *m_spin;
    bool m_showing = false;
    bool m_typing = false;
};

} // namespace dynascope
