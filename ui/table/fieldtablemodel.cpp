// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/fieldtablemodel.h"

#include "ui/common/watchmime.h"
#include "ui/table/consequencesdialog.h"

#include <algorithm>
#include <chrono>

namespace dynascope {
namespace {

constexpr quintptr GroupId = 0; ///< internal id of groups; of fields it is the group's row + 1

qint64 steadyMs()
{
    using namespace std::chrono;
    return duration_cast<milliseconds>(steady_clock::now().time_since_epoch()).count();
}

std::vector<FieldTableModel::Column> columnsFor(std::size_t devices)
{
    std::vector<FieldTableModel::Column> columns{
        {ColumnKind::Name, 0}, {ColumnKind::Plot, 0}, {ColumnKind::Address, 0}};
    if (devices <= 1) {
        columns.push_back({ColumnKind::Value, 0});
        columns.push_back({ColumnKind::Physical, 0});
    } else {
        columns.push_back({ColumnKind::All, 0});
        for (std::size_t i = 0; i < devices; ++i)
            columns.push_back({ColumnKind::Device, static_cast<int>(i)});
    }
    if (devices <= 1) { // of several they may be of as many kinds
        columns.push_back({ColumnKind::Default, 0});
        columns.push_back({ColumnKind::Range, 0});
    }
    columns.push_back({ColumnKind::Access, 0});
    return columns;
}

} // namespace

FieldTableModel::FieldTableModel(TableActions actions, ChangeTracker::Clock clock, QObject *parent)
    : QAbstractItemModel(parent)
    , m_actions(std::move(actions))
    , m_tracker(clock ? std::move(clock) : ChangeTracker::Clock(steadyMs))
    , m_columns(columnsFor(0))
{
    m_frame.setSingleShot(true);
    m_frame.setInterval(FrameMs);
    connect(&m_frame, &QTimer::timeout, this, &FieldTableModel::flush);
    connect(&m_tracker, &ChangeTracker::looksChanged, this, [this](int device, int row) {
        const int first = columnOf(m_devices.size() > 1 ? ColumnKind::Device : ColumnKind::Value, device);
        const int last = m_devices.size() > 1 ? first : columnOf(ColumnKind::Physical);
        if (m_live)
            emit dataChanged(indexOf(row, first), indexOf(row, last), {FadeRole, PendingRole});
    });
}

void FieldTableModel::setDevices(const std::vector<Device *> &devices)
{
    beginResetModel();
    for (Device *device : m_devices)
        device->disconnect(this);
    m_devices = devices;
    m_columns = columnsFor(devices.size());
    std::vector<const ControlTable *> tables;
    for (const Device *device : devices)
        tables.push_back(&device->table());
    m_rows = RegisterRows(tables);
    m_dirty.assign(static_cast<std::size_t>(m_rows.count()), 0);
    m_frame.stop();
    m_tracker.reset(static_cast<int>(devices.size()), m_rows.count());
    for (int i = 0; i < static_cast<int>(devices.size()); ++i) {
        Device *device = devices[static_cast<std::size_t>(i)];
        for (int field = 0; field < static_cast<int>(device->table().fields().size()); ++field)
            m_tracker.observe(i, m_rows.rowOf(i, field), device->value(field), false);
        connect(device, &Device::fieldsChanged, this, [this, i](int first, int last) { note(i, first, last); });
        connect(device, &Device::attributesChanged, this, &FieldTableModel::emitEverything);
        connect(device, &QObject::destroyed, this, &FieldTableModel::deviceGone);
    }
    endResetModel();
}

void FieldTableModel::deviceGone(QObject *device)
{
    // Only its address is left: forget it before anything looks at it.
    std::vector<Device *> left;
    for (Device *known : m_devices) {
        if (static_cast<QObject *>(known) != device)
            left.push_back(known);
    }
    beginResetModel();
    m_devices.clear();
    m_rows = RegisterRows();
    m_columns = columnsFor(0);
    endResetModel();
    for (Device *known : left)
        known->disconnect(this);
    setDevices(left);
}

void FieldTableModel::setLive(bool live)
{
    m_live = live;
    if (live)
        flush();
    else
        m_frame.stop();
}

std::vector<Device *> FieldTableModel::targets(int column) const
{
    const Column &of = m_columns[static_cast<std::size_t>(column)];
    return of.kind == ColumnKind::All || m_devices.empty() ? m_devices : std::vector<Device *>{&deviceAt(of.device)};
}

void FieldTableModel::refreshWatches()
{
    refreshColumn(ColumnKind::Plot);
}

void FieldTableModel::refreshMarks()
{
    refreshColumn(ColumnKind::Name);
    emit updated();
}

void FieldTableModel::refreshColumn(ColumnKind kind)
{
    const int column = columnOf(kind);
    for (int group = 0; group < static_cast<int>(groups().size()); ++group) {
        const std::vector<char> all(m_dirty.size(), 1);
        emitRows(group, all, column, column);
    }
}

int FieldTableModel::columnOf(ColumnKind kind, int device) const
{
    const auto found = std::ranges::find_if(
        m_columns, [&](const Column &column) { return column.kind == kind && column.device == device; });
    return found == m_columns.end() ? -1 : static_cast<int>(found - m_columns.begin());
}

int FieldTableModel::firstValueColumn() const
{
    return columnOf(m_devices.size() > 1 ? ColumnKind::All : ColumnKind::Value);
}

int FieldTableModel::lastValueColumn() const
{
    return m_devices.size() > 1 ? columnOf(ColumnKind::Access) - 1 : columnOf(ColumnKind::Physical);
}

int FieldTableModel::mainValueColumn() const
{
    return std::max(columnOf(ColumnKind::Physical), columnOf(ColumnKind::Device));
}

int FieldTableModel::rowOf(const QString &name) const
{
    for (int device = 0; device < static_cast<int>(m_devices.size()); ++device) {
        if (const int field = deviceAt(device).table().indexOf(name); field >= 0)
            return m_rows.rowOf(device, field);
    }
    return -1;
}

QModelIndex FieldTableModel::indexOf(int row, int column) const
{
    for (std::size_t group = 0; group < groups().size(); ++group) {
        const std::vector<int> &rows = groups()[group].fields;
        const auto found = std::ranges::lower_bound(rows, row);
        if (found != rows.end() && *found == row)
            return createIndex(static_cast<int>(found - rows.begin()), column, static_cast<quintptr>(group) + 1);
    }
    return {};
}

std::vector<Watch> FieldTableModel::watches(const QModelIndexList &indexes) const
{
    std::set<int> rows;
    for (const QModelIndex &index : indexes) {
        if (const int row = rowOf(index); row >= 0)
            rows.insert(row);
    }
    std::vector<Watch> found;
    for (const int row : rows) {
        for (int device = 0; device < static_cast<int>(m_devices.size()); ++device) {
            if (const int field = m_rows.fieldOf(row, device); field >= 0)
                found.push_back({deviceAt(device).key(), field});
        }
    }
    return found;
}

int FieldTableModel::rowOf(const QModelIndex &index) const
{
    if (!index.isValid() || index.internalId() == GroupId)
        return -1;
    return groups()[index.internalId() - 1].fields[static_cast<std::size_t>(index.row())];
}

QModelIndex FieldTableModel::index(int row, int column, const QModelIndex &parent) const
{
    if (!hasIndex(row, column, parent))
        return {};
    return createIndex(row, column, parent.isValid() ? static_cast<quintptr>(parent.row() + 1) : GroupId);
}

QModelIndex FieldTableModel::parent(const QModelIndex &child) const
{
    if (!child.isValid() || child.internalId() == GroupId)
        return {};
    return createIndex(static_cast<int>(child.internalId()) - 1, 0, GroupId);
}

int FieldTableModel::rowCount(const QModelIndex &parent) const
{
    if (!parent.isValid())
        return static_cast<int>(groups().size());
    if (parent.internalId() != GroupId || parent.column() != 0)
        return 0;
    return static_cast<int>(groups()[static_cast<std::size_t>(parent.row())].fields.size());
}

int FieldTableModel::columnCount(const QModelIndex & /*parent*/) const
{
    return static_cast<int>(m_columns.size());
}

QVariant FieldTableModel::data(const QModelIndex &index, int role) const
{
    if (!index.isValid())
        return {};
    const Column column = columnAt(index.column());
    if (role == KindRole)
        return static_cast<int>(column.kind);
    if (const int row = rowOf(index); row >= 0)
        return rowData(row, column, role);
    const FieldGroup &group = groups()[static_cast<std::size_t>(index.row())];
    if (role == GroupRole)
        return group.title;
    if (role == GroupHintRole)
        return group.isRun ? tr("%1 registers").arg(group.fields.size()) : QString();
    return {};
}

QVariant FieldTableModel::headerData(int section, Qt::Orientation orientation, int role) const
{
    if (orientation != Qt::Horizontal || section < 0 || section >= columnCount())
        return {};
    const Column column = columnAt(section);
    if (role == KindRole)
        return static_cast<int>(column.kind);
    if (role != Qt::DisplayRole || column.kind != ColumnKind::Device)
        return {};
    const Device &device = deviceAt(column.device);
    return device.nickname().isEmpty() ? device.displayName()
                                       : QStringLiteral("%1 #%2").arg(device.nickname()).arg(device.id());
}

Qt::ItemFlags FieldTableModel::flags(const QModelIndex &index) const
{
    const int row = rowOf(index);
    if (row < 0) // a heading: nothing to be done with it
        return index.isValid() ? Qt::ItemIsEnabled : Qt::NoItemFlags;
    Qt::ItemFlags flags = Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsDragEnabled | Qt::ItemNeverHasChildren;
    const Column column = columnAt(index.column());
    if (column.kind == ColumnKind::Plot)
        flags |= Qt::ItemIsUserCheckable;
    // A cell without register can't be edited, but passed through: the keys go along the column.
    const bool isAbsent = column.kind == ColumnKind::Device && m_rows.fieldOf(row, column.device) < 0;
    if (isValueKind(column.kind) && !isAbsent && isEditable(field(row, column.device)))
        flags |= Qt::ItemIsEditable;
    return flags;
}

QStringList FieldTableModel::mimeTypes() const
{
    return {QString::fromLatin1(WatchMimeType)};
}

QMimeData *FieldTableModel::mimeData(const QModelIndexList &indexes) const
{
    const std::vector<Watch> dragged = watches(indexes);
    return dragged.empty() ? nullptr : watchesToMime(dragged).release();
}

} // namespace dynascope
