// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/tracemodel.h"

#include "ui/common/texts.h"
#include "ui/common/theme.h"

#include <algorithm>

namespace dynascope {

TraceModel::TraceModel(Session &session, const Monitor &monitor, TraceColors &colors, QObject *parent)
    : QAbstractListModel(parent), m_session(session), m_monitor(monitor), m_colors(colors)
{
    connect(&session, &Session::deviceAboutToBeRemoved, this, &TraceModel::onDeviceGone);
    connect(&session, &Session::deviceAdded, this, &TraceModel::onDeviceBack);
}

int TraceModel::indexOf(const TraceKey &key) const
{
    const auto at = std::ranges::find(m_traces, key, &Trace::key);
    return at == m_traces.end() ? -1 : static_cast<int>(at - m_traces.begin());
}

std::vector<TraceKey> TraceModel::keys() const
{
    std::vector<TraceKey> keys;
    for (const Trace &trace : m_traces)
        keys.push_back(trace.key);
    return keys;
}

std::vector<Watch> TraceModel::watches() const
{
    std::vector<Watch> watches;
    for (const Trace &trace : m_traces) {
        if (!trace.key.isDerived())
            watches.push_back(trace.key.watch);
    }
    return watches;
}

std::set<Watch> TraceModel::needed() const
{
    std::set<Watch> all;
    for (const Trace &trace : m_traces) {
        all.insert(trace.key.watch);
        if (trace.key.derivation.kind == Derivation::Kind::Difference)
            all.insert(trace.key.derivation.other);
    }
    return all;
}

/// What the device says of itself and of the field: names, and how raw values become physical ones.
void TraceModel::describe(Trace &trace) const
{
    const Device *device = m_session.device(trace.key.watch.device);
    if (!device || trace.gone)
        return;
    trace.effective = device->effective(trace.key.watch.field);
    trace.resolution = device->table().resolution();
    trace.device = device->displayName();
    trace.field = nameOf(trace.key);
    relate(trace);
    measure(trace);
}

void TraceModel::setUnits(const UnitPreferences &units)
{
    if (units == m_units)
        return;
    m_units = units;
    for (Trace &trace : m_traces) {
        describe(trace);
        measure(trace);
    }
    if (rowCount() > 0)
        emit dataChanged(index(0), index(rowCount() - 1));
    refreshValues();
}

bool TraceModel::isSilent(const Trace &trace) const
{
    const Device *device = m_session.device(trace.key.watch.device);
    return device && device->state() == Device::State::Silent;
}

bool TraceModel::add(const TraceKey &key)
{
    const auto names = [this](const Watch &watch) {
        const Device *device = m_session.device(watch.device);
        return device && watch.field >= 0 && watch.field < static_cast<int>(device->table().fields().size());
    };
    if (!names(key.watch) || indexOf(key) >= 0)
        return false;
    if (key.derivation.kind == Derivation::Kind::Difference
        && (!names(key.derivation.other) || !areComparable(key.watch, key.derivation.other)))
        return false;
    Device *device = m_session.device(key.watch.device);
    Trace trace;
    trace.key = key;
    trace.color = m_colors.take(key);
    if (key.isDerived() && key.derivation.kind != Derivation::Kind::Scaled)
        trace.derived = std::make_shared<DerivedHistory>(key.derivation);
    describe(trace);
    follow(device);
    beginInsertRows({}, rowCount(), rowCount());
    m_traces.push_back(std::move(trace));
    endInsertRows();
    return true;
}

void TraceModel::remove(int row)
{
    m_colors.release(this->key(row));
    const DeviceKey key = watch(row).device;
    beginRemoveRows({}, row, row);
    m_traces.erase(m_traces.begin() + row);
    endRemoveRows();
    Device *device = m_session.device(key);
    if (device && std::ranges::none_of(m_traces, [key](const Trace &trace) { return trace.key.watch.device == key; }))
        disconnect(device, nullptr, this, nullptr);
}

void TraceModel::setVisible(int row, bool visible)
{
    setData(index(row), visible ? Qt::Checked : Qt::Unchecked, Qt::CheckStateRole);
}

void TraceModel::setColorIndex(int row, int color)
{
    m_traces[static_cast<std::size_t>(row)].color = color;
    m_colors.remember(key(row), color);
    emit dataChanged(index(row), index(row), {ColorIndexRole});
}

void TraceModel::updateDevice(Device *device)
{
    for (int row = 0; row < rowCount(); ++row) {
        Trace &trace = m_traces[static_cast<std::size_t>(row)];
        if (trace.key.watch.device != device->key())
            continue;
        describe(trace);
        emit dataChanged(index(row), index(row));
    }
}

void TraceModel::onDeviceGone(Device *device)
{
    for (int row = 0; row < rowCount(); ++row) {
        Trace &trace = m_traces[static_cast<std::size_t>(row)];
        if (trace.key.watch.device != device->key())
            continue;
        trace.gone = true;
        trace.value.clear();
        emit dataChanged(index(row), index(row));
    }
}

/// Closed with its line and found there again: it has its former number, and its traces go on.
void TraceModel::onDeviceBack(Device *device)
{
    bool isShown = false;
    for (Trace &trace : m_traces) {
        if (trace.key.watch.device != device->key())
            continue;
        trace.gone = false;
        isShown = true;
    }
    if (!isShown)
        return;
    follow(device);
    updateDevice(device);
}

void TraceModel::follow(Device *device)
{
    connect(device, &Device::attributesChanged, this, [this, device] { updateDevice(device); });
}

std::vector<TraceData> TraceModel::drawn(const QPalette &palette) const
{
    std::vector<TraceData> traces;
    traces.reserve(m_traces.size());
    for (const Trace &trace : m_traces) {
        TraceData data;
        data.history = historyOf(trace);
        data.scale = trace.scale;
        data.offset = trace.offset;
        data.decimals = trace.decimals;
        data.device = trace.device;
        data.field = trace.field;
        data.unit = trace.unit;
        data.color = traceColor(trace.color, palette);
        data.dash = dashOf(trace.color);
        data.visible = trace.visible;
        data.dimmed = trace.gone || isSilent(trace);
        traces.push_back(std::move(data));
    }
    return traces;
}

void TraceModel::refreshValues()
{
    int first = -1;
    int last = -1;
    for (int row = 0; row < rowCount(); ++row) {
        Trace &trace = m_traces[static_cast<std::size_t>(row)];
        const Trace before = trace;
        describe(trace); // a register may have changed what this one measures
        if (trace.scale != before.scale || trace.offset != before.offset || trace.unit != before.unit)
            emit dataChanged(index(row), index(row));
        const Device *device = m_session.device(trace.key.watch.device);
        const History *history = historyOf(trace);
        QString value;
        const bool isThere = device && !trace.gone && history;
        if (const auto newest = isThere ? m_monitor.newest(*history) : std::nullopt)
            value = withMinus(QString::number(newest->raw * trace.scale + trace.offset, 'f', trace.decimals));
        if (value == trace.value)
            continue;
        trace.value = value;
        first = first < 0 ? row : first;
        last = row;
    }
    if (first >= 0)
        emit dataChanged(index(first), index(last), {ValueRole});
}

int TraceModel::rowCount(const QModelIndex &parent) const
{
    return parent.isValid() ? 0 : static_cast<int>(m_traces.size());
}

QVariant TraceModel::data(const QModelIndex &index, int role) const
{
    if (!index.isValid())
        return {};
    const Trace &trace = m_traces[static_cast<std::size_t>(index.row())];
    switch (role) {
    case Qt::DisplayRole:
    case Qt::AccessibleTextRole: return trace.device + QStringLiteral(" · ") + trace.field;
    case Qt::ToolTipRole: {
        const QString name = trace.device + QStringLiteral(" · ") + trace.field;
        return plainToolTip(trace.gone ? tr("%1\nThis device is gone.").arg(name) : name);
    }
    case Qt::CheckStateRole: return trace.visible ? Qt::Checked : Qt::Unchecked;
    case ColorIndexRole: return trace.color;
    case FieldRole: return trace.field;
    case DeviceRole: return trace.device;
    case ValueRole: return trace.value;
    case UnitRole: return trace.unit;
    case GoneRole: return trace.gone || isSilent(trace);
    case NoteRole: return trace.gone ? tr("gone") : isSilent(trace) ? tr("silent") : QString();
    default: return {};
    }
}

bool TraceModel::setData(const QModelIndex &index, const QVariant &value, int role)
{
    if (!index.isValid() || role != Qt::CheckStateRole)
        return false;
    Trace &trace = m_traces[static_cast<std::size_t>(index.row())];
    const bool visible = value.toInt() == Qt::Checked;
    if (visible != trace.visible) {
        trace.visible = visible;
        emit dataChanged(index, index, {Qt::CheckStateRole});
    }
    return true;
}

Qt::ItemFlags TraceModel::flags(const QModelIndex &index) const
{
    if (!index.isValid())
        return {};
    return Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable | Qt::ItemNeverHasChildren;
}

} // namespace dynascope
