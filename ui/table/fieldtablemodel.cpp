// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/fieldtablemodel.h"

#include "core/table/indirect.h"
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
        for (std::size_t i = 0; i < devices; ++i)
            columns.push_back({ColumnKind::Device, static_cast<int>(i)});
    }
    columns.push_back({ColumnKind::Default, 0});
    columns.push_back({ColumnKind::Range, 0});
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
    connect(&m_tracker, &ChangeTracker::looksChanged, this, [this](int device, int field) {
        const int first = columnOf(m_devices.size() > 1 ? ColumnKind::Device : ColumnKind::Value, device);
        const int last = m_devices.size() > 1 ? first : columnOf(ColumnKind::Physical);
        if (m_live)
            emit dataChanged(indexOf(field, first), indexOf(field, last), {FadeRole, PendingRole});
    });
}

void FieldTableModel::setDevices(const std::vector<Device *> &devices)
{
    beginResetModel();
    for (Device *device : m_devices)
        device->disconnect(this);
    m_devices = devices;
    m_columns = columnsFor(devices.size());
    m_groups = devices.empty() ? std::vector<FieldGroup>() : fieldGroups(devices.front()->table());
    m_deciding = devices.empty() ? std::set<int>() : decidingFields(devices.front()->table());
    const std::size_t fields = devices.empty() ? 0 : devices.front()->table().fields().size();
    m_dirty.assign(fields, 0);
    m_frame.stop();
    m_tracker.reset(static_cast<int>(devices.size()), static_cast<int>(fields));
    for (int i = 0; i < static_cast<int>(devices.size()); ++i) {
        Device *device = devices[static_cast<std::size_t>(i)];
        for (int field = 0; field < static_cast<int>(fields); ++field)
            m_tracker.observe(i, field, device->value(field), false);
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
    m_groups.clear();
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
    if (m_editsAll || m_devices.empty())
        return m_devices;
    return {m_devices[static_cast<std::size_t>(columnAt(column).device)]};
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
    for (int group = 0; group < static_cast<int>(m_groups.size()); ++group) {
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

QModelIndex FieldTableModel::indexOf(int field, int column) const
{
    for (std::size_t group = 0; group < m_groups.size(); ++group) {
        const std::vector<int> &fields = m_groups[group].fields;
        const auto found = std::ranges::lower_bound(fields, field);
        if (found != fields.end() && *found == field)
            return createIndex(static_cast<int>(found - fields.begin()), column, static_cast<quintptr>(group + 1));
    }
    return {};
}

std::vector<Watch> FieldTableModel::watches(const QModelIndexList &rows) const
{
    std::set<int> fields;
    for (const QModelIndex &row : rows) {
        if (const int field = fieldOf(row); field >= 0)
            fields.insert(field);
    }
    std::vector<Watch> found;
    for (const int field : fields) {
        for (const Device *device : m_devices)
            found.push_back({device->key(), field});
    }
    return found;
}

int FieldTableModel::fieldOf(const QModelIndex &index) const
{
    if (!index.isValid() || index.internalId() == GroupId)
        return -1;
    return m_groups[index.internalId() - 1].fields[static_cast<std::size_t>(index.row())];
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
        return static_cast<int>(m_groups.size());
    if (parent.internalId() != GroupId || parent.column() != 0)
        return 0;
    return static_cast<int>(m_groups[static_cast<std::size_t>(parent.row())].fields.size());
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
    const int field = fieldOf(index);
    if (field >= 0)
        return fieldData(field, column, role);
    const FieldGroup &group = m_groups[static_cast<std::size_t>(index.row())];
    if (role == GroupRole)
        return group.title;
    if (role == GroupHintRole)
        return group.isRun ? tr("%1 registers").arg(group.fields.size()) : QString();
    return {};
}

QVariant FieldTableModel::fieldData(int field, const Column &column, int role) const
{
    switch (role) {
    case FieldRole: return field;
    case FieldDataRole: return QVariant::fromValue(&this->field(field));
    case EffectiveRole:
        return QVariant::fromValue(m_devices[static_cast<std::size_t>(column.device)]->effective(field));
    case ControlTableRole: return QVariant::fromValue(m_devices.front()->sharedTable());
    case ResolutionRole: return m_devices.front()->table().resolution();
    case WatchedRole: return static_cast<int>(watched(field));
    case RamStateRole: return static_cast<int>(ramState(field, column));
    case Qt::CheckStateRole:
        return column.kind == ColumnKind::Plot ? QVariant(static_cast<int>(watched(field))) : QVariant();
    case ChangedFromDefaultRole:
    case DiffersRole: {
        const auto is = [&](int device) {
            return role == DiffersRole ? differs(field, device) : isChangedFromDefault(field, device);
        };
        if (isValueKind(column.kind))
            return is(column.device);
        for (int device = 0; device < static_cast<int>(m_devices.size()); ++device) {
            if (is(device))
                return true;
        }
        return false;
    }
    default: return isValueKind(column.kind) ? valueData(field, column.device, role) : QVariant();
    }
}

QVariant FieldTableModel::valueData(int field, int device, int role) const
{
    const Device &of = *m_devices[static_cast<std::size_t>(device)];
    const FieldValue &value = of.value(field);
    switch (role) {
    case RawRole:
    case Qt::EditRole: return value.raw ? QVariant(static_cast<qlonglong>(*value.raw)) : QVariant();
    case StateRole: return static_cast<int>(value.state);
    case ErrorRole: return value.error;
    case FadeRole: return m_tracker.fade(device, field);
    case PendingRole:
        return value.pending && m_tracker.showsPending(device, field)
            ? QVariant(static_cast<qlonglong>(*value.pending)) : QVariant();
    case LockRole: {
        for (const Device *target : m_editsAll ? m_devices : std::vector<Device *>{m_devices[std::size_t(device)]}) {
            if (const QString reason = target->lockReason(field, true); !reason.isEmpty())
                return reason;
        }
        return QString();
    }
    case PointsAtRole: {
        const std::optional<std::int64_t> address = pointsAt(field, of);
        return address ? QVariant(static_cast<qlonglong>(*address)) : QVariant();
    }
    default: return {};
    }
}

std::optional<std::int64_t> FieldTableModel::pointsAt(int field, const Device &device) const
{
    const Field &of = this->field(field);
    if (indirectAddressNumber(of) > 0)
        return device.value(field).raw;
    const int address = indirectAddressOf(device.table(), of);
    return address < 0 ? std::nullopt : device.value(address).raw;
}

bool FieldTableModel::differs(int field, int device) const
{
    const auto first = m_devices.front()->value(field).raw;
    const auto own = m_devices[static_cast<std::size_t>(device)]->value(field).raw;
    return this->field(field).isWritable() && first && own && *first != *own;
}

bool FieldTableModel::isChangedFromDefault(int field, int device) const
{
    const Field &of = this->field(field);
    const auto raw = m_devices[static_cast<std::size_t>(device)]->value(field).raw;
    return of.isWritable() && of.initial && raw && *raw != *of.initial;
}

Qt::CheckState FieldTableModel::watched(int field) const
{
    const auto count = std::ranges::count_if(
        m_devices, [&](const Device *device) { return m_actions.isWatched({device->key(), field}); });
    if (count == 0)
        return Qt::Unchecked;
    return count == std::ssize(m_devices) ? Qt::Checked : Qt::PartiallyChecked;
}

/// The one that matters most.
RamState FieldTableModel::ramState(int field, const Column &column) const
{
    RamState state = RamState::NotSet;
    for (int i = 0; m_actions.ramState && i < static_cast<int>(m_devices.size()); ++i) {
        if (!isValueKind(column.kind) || column.device == i)
            state = std::max(state, m_actions.ramState({m_devices[static_cast<std::size_t>(i)]->key(), field}));
    }
    return state;
}

QVariant FieldTableModel::headerData(int section, Qt::Orientation orientation, int role) const
{
    if (orientation != Qt::Horizontal || section < 0 || section >= columnCount())
        return {};
    const Column column = columnAt(section);
    if (role == KindRole)
        return static_cast<int>(column.kind);
    if (role == Qt::DisplayRole && column.kind == ColumnKind::Device)
        return m_devices[static_cast<std::size_t>(column.device)]->displayName();
    return {};
}

Qt::ItemFlags FieldTableModel::flags(const QModelIndex &index) const
{
    const int field = fieldOf(index);
    if (field < 0) // a heading: nothing to be done with it
        return index.isValid() ? Qt::ItemIsEnabled : Qt::NoItemFlags;
    Qt::ItemFlags flags = Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsDragEnabled | Qt::ItemNeverHasChildren;
    const ColumnKind kind = columnAt(index.column()).kind;
    if (kind == ColumnKind::Plot)
        flags |= Qt::ItemIsUserCheckable;
    if (isValueKind(kind) && isEditable(this->field(field)))
        flags |= Qt::ItemIsEditable;
    return flags;
}

bool FieldTableModel::setData(const QModelIndex &index, const QVariant &value, int role)
{
    const int field = fieldOf(index);
    if (field < 0)
        return false;
    const ColumnKind kind = columnAt(index.column()).kind;
    if (role == Qt::CheckStateRole && kind == ColumnKind::Plot) {
        const bool plot = value.toInt() == Qt::Checked;
        for (const Device *device : std::vector<Device *>(m_devices)) {
            if (plot)
                emit plotRequested({device->key(), field});
            else
                emit unplotRequested({device->key(), field});
        }
        return true;
    }
    if (role != Qt::EditRole || !isValueKind(kind) || !isEditable(this->field(field)))
        return false;
    bool written = false;
    std::vector<Device *> unknown, asked;
    const std::int64_t raw = value.toLongLong();
    for (Device *device : targets(index.column())) {
        const FieldValue &now = device->value(field);
        const bool same = now.raw == raw && !now.pending && now.state != FieldState::Failed;
        const bool isAsked = !same && isToBeAsked(*device, field, raw);
        if (same || (!isAsked && !device->lockReason(field, true).isEmpty()))
            continue;
        if (isAsked)
            asked.push_back(device);
        else if (this->field(field).mayBeTried())
            unknown.push_back(device);
        else
            m_actions.write(*device, field, raw);
        written = true;
    }
    if (!unknown.empty())
        emit confirmationWanted(unknown, field, raw);
    if (!asked.empty())
        emit consequencesWanted(asked, field, raw);
    return written;
}

bool FieldTableModel::isToBeAsked(const Device &device, int field, std::int64_t raw) const
{
    if (!m_actions.writeSafely || this->field(field).mayBeTried())
        return false;
    const bool isLocked = !device.lockReason(field, true).isEmpty();
    return isLocked ? isLockedByTorqueAlone(device, field) : areSerious(consequencesOf(device, field, raw));
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
