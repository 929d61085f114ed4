// SPDX-License-Identifier: GPL-3.0-or-later
// What a trace is called, how it is scaled, and where its samples come from, derived or not.
#include "ui/plot/tracemodel.h"

#include <algorithm>
#include <cmath>

namespace dynascope {

namespace {

TraceModel::Linear linearOf(const EffectiveField &field, int resolution, const UnitPreferences &units)
{
    const Physical zero = physical(field, resolution, 0, units);
    return {physical(field, resolution, 1, units).value - zero.value, zero.value, zero.decimals, zero.unit};
}

const Field &fieldOf(const Device &device, int field)
{
    return device.table().fields()[static_cast<std::size_t>(field)];
}

} // namespace

/// "Goal − Present Position" of one device, "Present Position − elbow · Present Position" of two.
QString TraceModel::nameOf(const TraceKey &key) const
{
    const Device *device = m_session.device(key.watch.device);
    if (!device)
        return {};
    const QString name = fieldOf(*device, key.watch.field).name;
    const Derivation &how = key.derivation;
    switch (how.kind) {
    case Derivation::Kind::None: return name;
    case Derivation::Kind::Difference: {
        const Device *other = m_session.device(how.other.device);
        if (!other)
            return tr("%1 − another").arg(name);
        const QString otherName = fieldOf(*other, how.other.field).name;
        if (other != device)
            return tr("%1 − %2 · %3").arg(name, other->displayName(), otherName);
        const QString first = name.section(u' ', 0, 0);
        const bool isShort = name.section(u' ', 1) == otherName.section(u' ', 1) && name.contains(u' ');
        return tr("%1 − %2").arg(isShort ? first : name, otherName);
    }
    case Derivation::Kind::Derivative: return tr("d/dt %1").arg(name);
    case Derivation::Kind::Average:
        return tr("%1, mean of %2 ms").arg(name).arg(std::chrono::duration_cast<std::chrono::milliseconds>(how.span).count());
    case Derivation::Kind::Scaled: return tr("%1, scaled").arg(name);
    }
    return name;
}

/// How the other one counts is asked in fixed units: in those that a person chose, raw numbers may be among them.
void TraceModel::relate(Trace &trace) const
{
    if (!trace.derived || trace.key.derivation.kind != Derivation::Kind::Difference)
        return;
    const Watch &other = trace.key.derivation.other;
    const Device *device = m_session.device(other.device);
    if (!device)
        return;
    const Linear here = linearOf(trace.effective, trace.resolution, {});
    const Linear there = linearOf(device->effective(other.field), device->table().resolution(), {});
    if (here.unit == there.unit && here.scale != 0)
        trace.derived->setRelation(there.scale / here.scale, (there.offset - here.offset) / here.scale);
}

/// In the chosen units. Linear, for histories keep signed numbers.
void TraceModel::measure(Trace &trace) const
{
    trace.source = linearOf(trace.effective, trace.resolution, m_units);
    const Linear &source = trace.source;
    trace.scale = source.scale;
    trace.offset = source.offset;
    trace.decimals = source.decimals;
    trace.unit = source.unit;
    const Derivation &how = trace.key.derivation;
    if (trace.derived)
        trace.scale /= trace.derived->resolution();
    switch (how.kind) {
    case Derivation::Kind::None: break;
    case Derivation::Kind::Difference: trace.offset = 0; break;
    case Derivation::Kind::Derivative:
        trace.offset = 0;
        trace.unit = source.unit.isEmpty() ? tr("1/s") : tr("%1/s").arg(source.unit);
        break;
    case Derivation::Kind::Average: trace.decimals = source.decimals + 1; break;
    case Derivation::Kind::Scaled:
        if (how.unit.isEmpty()) {
            trace.scale = how.factor * source.scale;
            trace.offset = how.factor * source.offset + how.offset * source.scale;
        } else {
            trace.scale = how.factor;
            trace.offset = how.offset;
            trace.unit = how.unit;
            trace.decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(std::abs(how.factor) + 1e-9))), 0, 6);
        }
        break;
    }
}

TraceModel::Linear TraceModel::scaleOf(int row) const
{
    const Trace &trace = m_traces[static_cast<std::size_t>(row)];
    return {trace.scale, trace.offset, trace.decimals, trace.unit};
}

bool TraceModel::areComparable(const Watch &one, const Watch &other) const
{
    const Device *first = m_session.device(one.device);
    const Device *second = m_session.device(other.device);
    if (!first || !second || one == other)
        return false;
    return linearOf(first->effective(one.field), first->table().resolution(), {}).unit
        == linearOf(second->effective(other.field), second->table().resolution(), {}).unit;
}

std::optional<TraceKey> TraceModel::goalLessPresent(int row) const
{
    const TraceKey &of = key(row);
    const Device *device = m_session.device(of.watch.device);
    if (!device || of.isDerived())
        return std::nullopt;
    const QString name = fieldOf(*device, of.watch.field).name;
    const QString what = name.section(u' ', 1);
    const int goal = device->table().indexOf(QStringLiteral("Goal ") + what);
    const int present = device->table().indexOf(QStringLiteral("Present ") + what);
    if (goal < 0 || present < 0 || (of.watch.field != goal && of.watch.field != present))
        return std::nullopt;
    Derivation difference;
    difference.kind = Derivation::Kind::Difference;
    difference.other = {device->key(), present};
    const TraceKey made(Watch{device->key(), goal}, difference);
    if (indexOf(made) >= 0 || !areComparable(made.watch, difference.other))
        return std::nullopt;
    return made;
}

const History *TraceModel::historyOf(const Trace &trace) const
{
    return trace.derived ? &trace.derived->history() : m_monitor.history(trace.key.watch);
}

std::shared_ptr<const DerivedHistory> TraceModel::derivedHistory(int row) const
{
    return m_traces[static_cast<std::size_t>(row)].derived;
}

std::optional<LineTime> TraceModel::derive(std::size_t &budget)
{
    std::optional<LineTime> first;
    for (Trace &trace : m_traces) {
        if (!trace.derived)
            continue;
        const History *other = trace.key.derivation.kind == Derivation::Kind::Difference
            ? m_monitor.history(trace.key.derivation.other)
            : nullptr;
        const std::optional<LineTime> made = trace.derived->advance(m_monitor.history(trace.key.watch), other, budget);
        if (made && (!first || *made < *first))
            first = made;
    }
    return first;
}

} // namespace dynascope
