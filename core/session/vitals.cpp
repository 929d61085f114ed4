// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/vitals.h"

#include "core/session/linesession.h"

#include <QCoreApplication>

#include <algorithm>
#include <cmath>

namespace dynascope {
namespace {

/// The context of what is translated here.
class VitalTexts
{
    Q_DECLARE_TR_FUNCTIONS(VitalTexts)
};

/// A register that says it, and those that bound it.
struct Names {
    Vital vital;
    const char *value;
    const char *low;
    std::array<const char *, 2> high; ///< the first that the model has
    bool alone = true;                ///< only where no other register says it
};
constexpr std::array KnownVitals{
    Names{Vital::Position, "Present Position", nullptr, {nullptr, nullptr}},
    Names{Vital::Load, "Present Current", nullptr, {"Current Limit", "Torque Limit"}},
    Names{Vital::Load, "Present Load", nullptr, {"PWM Limit", "Torque Limit"}},
    Names{Vital::Temperature, "Present Temperature", nullptr, {"Temperature Limit", nullptr}},
    Names{Vital::Temperature, "Present Inverter Temperature", nullptr, {"Inverter Temperature Limit", nullptr}, false},
    Names{Vital::Temperature, "Present Motor Temperature", nullptr, {"Motor Temperature Limit", nullptr}, false},
    Names{Vital::Voltage, "Present Input Voltage", "Min Voltage Limit", {"Max Voltage Limit", nullptr}},
    Names{Vital::Voltage, "Present Voltage", "Min Voltage Limit", {"Max Voltage Limit", nullptr}},
    Names{Vital::Error, "Hardware Error Status", nullptr, {nullptr, nullptr}},
    Names{Vital::Error, "Error Code", nullptr, {nullptr, nullptr}},
};

int find(const ControlTable &table, const char *name)
{
    return name ? table.indexOf(QString::fromLatin1(name)) : -1;
}

Physical physicalOf(const Device &device, int field, std::int64_t raw)
{
    return physical(device.effective(field), device.table().resolution(), raw);
}

VitalLimit limitOf(const Device &device, int register_, const QString &unit)
{
    if (register_ < 0)
        return {};
    const Field &field = device.table().fields()[static_cast<std::size_t>(register_)];
    const FieldValue &own = device.value(register_);
    std::optional<std::int64_t> raw = own.raw;
    if (!raw)
        raw = field.initial ? field.initial : field.maximum.number;
    if (!raw || *raw <= 0)
        return {};
    const Physical value = physicalOf(device, register_, *raw);
    if (value.unit != unit) // of an old table: what the one counts the other doesn't
        return {};
    return {value.value, own.raw ? LimitSource::Device : LimitSource::Table, field.name};
}

/// Where a position may be: the range of its goal, or a turn.
void boundPosition(const Device &device, VitalReading &reading)
{
    const int goal = device.table().indexOf(u"Goal Position");
    if (goal < 0)
        return;
    const EffectiveField range = device.effective(goal);
    const int resolution = device.table().resolution();
    if (range.unit != device.effective(reading.field).unit)
        return;
    const bool isRead = range.minimum && range.maximum && *range.minimum < *range.maximum;
    if (!isRead && resolution <= 0)
        return;
    const Physical low = physical(range, resolution, isRead ? *range.minimum : 0);
    const Physical high = physical(range, resolution, isRead ? *range.maximum : resolution - 1);
    const LimitSource source = isRead ? LimitSource::Device : LimitSource::Table;
    reading.low = {low.value, source, isRead ? range.minimumFrom : QString()};
    reading.high = {high.value, source, isRead ? range.maximumFrom : QString()};
}

VitalReading read(const Device &device, const VitalField &of)
{
    VitalReading reading;
    reading.field = of.field;
    const FieldValue &value = device.value(of.field);
    if (value.state != FieldState::Stale)
        reading.raw = value.raw;
    reading.at = value.at;
    reading.value = physicalOf(device, of.field, value.raw.value_or(0));
    reading.low = limitOf(device, of.low, reading.value.unit);
    reading.high = limitOf(device, of.high, reading.value.unit);
    if (of.vital == Vital::Position)
        boundPosition(device, reading);
    return reading;
}

bool isWorse(Vital vital, const VitalReading &one, const VitalReading &than)
{
    if (than.field < 0 || one.raw.has_value() != than.raw.has_value())
        return than.field < 0 || one.raw.has_value();
    return partOf(vital, one).value_or(0) > partOf(vital, than).value_or(0);
}

QString errorText(const Device &device, const VitalReading &error)
{
    if (error.raw.value_or(0) != 0) {
        const Field &field = device.table().fields()[static_cast<std::size_t>(error.field)];
        const QString text = meaning(field, *error.raw);
        return text.isEmpty() ? VitalTexts::tr("%1 is %2").arg(field.name).arg(*error.raw) : text;
    }
    return !error.raw && device.alert() ? VitalTexts::tr("Hardware error") : QString();
}

} // namespace

bool isVital(const Field &field, Vital vital)
{
    return std::ranges::any_of(KnownVitals, [&](const Names &names) {
        return names.vital == vital && field.name == QLatin1String(names.value);
    });
}

std::vector<VitalField> vitalFields(const ControlTable &table)
{
    std::vector<VitalField> fields;
    if (table.description().isRaw)
        return fields;
    for (const Names &names : KnownVitals) {
        const int field = find(table, names.value);
        const bool hasOther = std::ranges::find(fields, names.vital, &VitalField::vital) != fields.end();
        if (field < 0 || (names.alone && hasOther))
            continue;
        VitalField one{names.vital, field, find(table, names.low), find(table, names.high[0])};
        if (one.high < 0)
            one.high = find(table, names.high[1]);
        fields.push_back(one);
    }
    return fields;
}

LimitSource Vitals::limits() const
{
    LimitSource weakest = LimitSource::None;
    for (const Vital vital : {Vital::Load, Vital::Temperature, Vital::Voltage}) {
        const VitalLimit &limit = (*this)[vital].high;
        if (limit.isKnown())
            weakest = weakest == LimitSource::None ? limit.source : std::min(weakest, limit.source);
    }
    return weakest;
}

Vitals vitalsOf(const Device &device, const std::vector<VitalField> &fields)
{
    Vitals vitals;
    const LineSession *line = device.line();
    const bool isOpen = !line || line->state() == BusThread::State::Open;
    vitals.isThere = isOpen && device.state() == Device::State::Present;
    vitals.isSilent = isOpen && device.state() == Device::State::Silent;
    for (const VitalField &field : fields) {
        VitalReading reading = read(device, field);
        if (!vitals.isThere)
            reading.raw.reset();
        if (isWorse(field.vital, reading, vitals[field.vital]))
            vitals[field.vital] = std::move(reading);
    }
    if (vitals.isThere)
        vitals.errors = errorText(device, vitals[Vital::Error]);
    return vitals;
}

std::optional<double> partOf(Vital vital, const VitalReading &reading)
{
    if (!reading.raw || !reading.high.isKnown())
        return std::nullopt;
    const double value = vital == Vital::Load ? std::abs(reading.value.value) : reading.value.value;
    const double low = reading.low.isKnown() ? reading.low.value : 0;
    if (reading.high.value <= low)
        return std::nullopt;
    return (value - low) / (reading.high.value - low);
}

} // namespace dynascope
