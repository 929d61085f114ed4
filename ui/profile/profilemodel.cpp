// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/profile/profilemodel.h"

#include "ui/common/icons.h"
#include "ui/common/texts.h"
#include "ui/common/theme.h"
#include "ui/profile/profiletexts.h"

#include <QApplication>
#include <QFont>

#include <algorithm>

namespace dynascope {
namespace {

using Kind = ProfileModel::Kind;

constexpr int RowHeight = 22;

QVariant iconOf(Kind kind)
{
    switch (kind) {
    case Kind::Unknown: return {};
    case Kind::Same:
    case Kind::Written: return icon(QStringLiteral("success"), IconTint::Good);
    case Kind::Differs: return icon(QStringLiteral("differs"), IconTint::Bad);
    case Kind::Problem:
    case Kind::Failed: return icon(QStringLiteral("error"), IconTint::Bad);
    case Kind::Waiting: return icon(QStringLiteral("minus"), IconTint::Dimmed);
    case Kind::Writing: return icon(QStringLiteral("play"), IconTint::Accent);
    case Kind::Other: return icon(QStringLiteral("info"), IconTint::Accent);
    }
    return {};
}

QVariant inkOf(Kind kind)
{
    const ThemeColors &theme = colors(QApplication::palette());
    switch (kind) {
    case Kind::Same:
    case Kind::Written: return theme.good;
    case Kind::Differs:
    case Kind::Problem:
    case Kind::Failed: return theme.bad;
    case Kind::Unknown:
    case Kind::Waiting: return theme.dimmed;
    case Kind::Writing:
    case Kind::Other: break;
    }
    return {};
}

bool isSameRegister(const ProfileRegister &one, const ProfileRegister &other)
{
    return one.name == other.name && one.text == other.text && one.line == other.line;
}

bool isSameJoint(const ProfileJoint &one, const ProfileJoint &other)
{
    return one.name == other.name && one.id == other.id && one.baudRate == other.baudRate && one.model == other.model
           && one.firmware == other.firmware && std::ranges::equal(one.registers, other.registers, isSameRegister);
}

} // namespace

ProfileModel::ProfileModel(const Catalog &catalog, QObject *parent) : QAbstractItemModel(parent), m_catalog(catalog) {}

bool ProfileModel::isSameProfile(const ProfileRun &run) const
{
    static const std::vector<ProfileJoint> none;
    const std::vector<ProfileJoint> &joints = run.profile() ? run.profile()->joints : none;
    return std::ranges::equal(m_joints, joints, isSameJoint, &Joint::wanted);
}

void ProfileModel::show(const ProfileRun &run)
{
    if (!isSameProfile(run)) {
        beginResetModel();
        m_joints.clear();
        m_others.clear();
        if (run.profile()) {
            for (const ProfileJoint &joint : run.profile()->joints)
                m_joints.push_back({joint, {}, {}, {}, true});
        }
        endResetModel();
    }
    for (std::size_t at = 0; at < m_joints.size(); ++at)
        updateJoint(at, run);
    setOthers(run.comparison() ? run.comparison()->others : std::vector<Found>());
    emit chosenChanged();
}

void ProfileModel::updateJoint(std::size_t at, const ProfileRun &run)
{
    Joint &joint = m_joints[at];
    const std::optional<JointComparison> before = std::exchange(joint.found, std::nullopt);
    if (run.comparison())
        joint.found = run.comparison()->joints[at];
    joint.progress = run.jointProgress(at);
    if (joint.progress.state == JointProgress::State::None)
        joint.written.clear();
    else if (before && joint.found && before->rows.size() == joint.found->rows.size()) {
        using Compared = RegisterComparison::State;
        for (std::size_t i = 0; i < before->rows.size(); ++i) {
            if (before->rows[i].state == Compared::Differs && joint.found->rows[i].state == Compared::Same)
                joint.written.insert(static_cast<int>(i));
        }
    }
    const int row = static_cast<int>(at);
    emit dataChanged(index(row, 0), index(row, Columns - 1));
    const QModelIndex parent = index(row, 0);
    if (const int rows = rowCount(parent); rows > 0)
        emit dataChanged(index(0, 0, parent), index(rows - 1, Columns - 1, parent));
}

void ProfileModel::setOthers(const std::vector<Found> &others)
{
    const int first = static_cast<int>(m_joints.size());
    if (!m_others.empty()) {
        beginRemoveRows({}, first, first + static_cast<int>(m_others.size()) - 1);
        m_others.clear();
        endRemoveRows();
    }
    if (others.empty())
        return;
    beginInsertRows({}, first, first + static_cast<int>(others.size()) - 1);
    m_others = others;
    endInsertRows();
}

void ProfileModel::setUnits(const UnitPreferences &units)
{
    m_units = units;
    for (int row = 0; row < static_cast<int>(m_joints.size()); ++row) {
        const QModelIndex parent = index(row, 0);
        if (const int rows = rowCount(parent); rows > 0)
            emit dataChanged(index(0, Wanted, parent), index(rows - 1, Held, parent));
    }
}

std::set<std::size_t> ProfileModel::chosen() const
{
    std::set<std::size_t> joints;
    for (std::size_t at = 0; at < m_joints.size(); ++at) {
        if (m_joints[at].isChosen)
            joints.insert(at);
    }
    return joints;
}

void ProfileModel::setChosen(std::size_t joint, bool isChosen)
{
    if (joint >= m_joints.size() || m_joints[joint].isChosen == isChosen)
        return;
    m_joints[joint].isChosen = isChosen;
    const QModelIndex changed = index(static_cast<int>(joint), Name);
    emit dataChanged(changed, changed, {Qt::CheckStateRole});
    emit chosenChanged();
}

QModelIndex ProfileModel::index(int row, int column, const QModelIndex &parent) const
{
    if (!hasIndex(row, column, parent))
        return {};
    return createIndex(row, column, parent.isValid() ? quintptr(parent.row()) + 1 : quintptr(0));
}

QModelIndex ProfileModel::parent(const QModelIndex &index) const
{
    if (!index.isValid() || isJoint(index))
        return {};
    return createIndex(static_cast<int>(index.internalId()) - 1, 0, quintptr(0));
}

int ProfileModel::rowCount(const QModelIndex &parent) const
{
    if (!parent.isValid())
        return static_cast<int>(m_joints.size() + m_others.size());
    const bool hasRows = isJoint(parent) && parent.column() == 0
                         && static_cast<std::size_t>(parent.row()) < m_joints.size();
    return hasRows ? static_cast<int>(m_joints[static_cast<std::size_t>(parent.row())].wanted.registers.size()) : 0;
}

int ProfileModel::columnCount(const QModelIndex &) const
{
    return Columns;
}

const ProfileModel::Joint *ProfileModel::jointOf(const QModelIndex &index) const
{
    const auto at = isJoint(index) ? static_cast<std::size_t>(index.row())
                                   : static_cast<std::size_t>(index.internalId()) - 1;
    return at < m_joints.size() ? &m_joints[at] : nullptr;
}

const RegisterComparison *ProfileModel::rowOf(const QModelIndex &index) const
{
    const Joint *joint = isJoint(index) ? nullptr : jointOf(index);
    const auto row = static_cast<std::size_t>(index.row());
    return joint && joint->found && row < joint->found->rows.size() ? &joint->found->rows[row] : nullptr;
}

Kind ProfileModel::kindOf(const Joint &joint) const
{
    switch (joint.progress.state) {
    case JointProgress::State::Waiting: return Kind::Waiting;
    case JointProgress::State::Writing: return Kind::Writing;
    case JointProgress::State::Failed: return Kind::Failed;
    case JointProgress::State::None:
    case JointProgress::State::Done: break;
    }
    if (!joint.found)
        return Kind::Unknown;
    if (joint.found->state == JointComparison::State::AsWanted)
        return joint.written.empty() ? Kind::Same : Kind::Written;
    return joint.found->state == JointComparison::State::Differs ? Kind::Differs : Kind::Problem;
}

Kind ProfileModel::kind(const QModelIndex &index) const
{
    const Joint *joint = jointOf(index);
    if (!joint)
        return Kind::Other;
    if (isJoint(index))
        return kindOf(*joint);
    const RegisterComparison *row = rowOf(index);
    if (!row)
        return Kind::Unknown;
    switch (row->state) {
    case RegisterComparison::State::Same: return joint->written.contains(index.row()) ? Kind::Written : Kind::Same;
    case RegisterComparison::State::Differs: return Kind::Differs;
    default: return Kind::Problem;
    }
}

QString ProfileModel::stateText(const Joint &joint) const
{
    const QString found = joint.found ? jointStateText(joint.wanted, *joint.found) : tr("Not compared");
    switch (joint.progress.state) {
    case JointProgress::State::None: return found;
    case JointProgress::State::Waiting: return tr("Waiting");
    case JointProgress::State::Writing: return tr("Writing…");
    case JointProgress::State::Failed: return tr("Failed: %1").arg(joint.progress.why);
    case JointProgress::State::Done:
        return joint.progress.written > 0 ? tr("%1, %2 written").arg(found).arg(joint.progress.written) : found;
    }
    return {};
}

/// What the wanted side says already, its model, isn't said twice.
QString ProfileModel::heldText(const Found &found, const ProfileJoint &wanted) const
{
    const QString place = tr("ID %1, %2, firmware %3").arg(found.id).arg(baudText(found.baudRate)).arg(found.firmware);
    if (found.modelNumber == wanted.modelNumber)
        return place;
    return tr("%1, %2").arg(modelName(m_catalog, found.modelNumber), place);
}

QString ProfileModel::jointText(const Joint &joint, int column) const
{
    switch (column) {
    case Name: return joint.wanted.name;
    case Wanted: return profilePlaceText(joint.wanted.model, joint.wanted.id, joint.wanted.baudRate);
    case Held:
        if (!joint.found || !joint.found->found)
            return joint.found ? QStringLiteral("–") : QString();
        return heldText(*joint.found->found, joint.wanted);
    case State: return stateText(joint);
    default: return {};
    }
}

QString ProfileModel::registerText(const Joint &joint, int at, int column) const
{
    const ProfileRegister &wanted = joint.wanted.registers[static_cast<std::size_t>(at)];
    const bool isCompared = joint.found && static_cast<std::size_t>(at) < joint.found->rows.size();
    if (column == Name)
        return wanted.name;
    if (!isCompared)
        return column == Wanted ? wanted.text : QString();
    const RegisterComparison &row = joint.found->rows[static_cast<std::size_t>(at)];
    const auto value = [&](const std::optional<ProfileValue> &side, const EffectiveField &as) {
        if (!side || row.field < 0 || !joint.found->table)
            return QString();
        const Field &field = joint.found->table->fields()[static_cast<std::size_t>(row.field)];
        return profileValueText(*joint.found->table, field, as, side->raw, m_units);
    };
    switch (column) {
    case Wanted: return row.wanted ? value(row.wanted, row.wantedAs) : wanted.text;
    case Held: return row.held ? value(row.held, row.heldAs) : QStringLiteral("–");
    case State: return joint.written.contains(at) && row.state == RegisterComparison::State::Same
                           ? tr("Written, read back")
                           : registerStateText(row);
    default: return {};
    }
}

QString ProfileModel::otherText(const Found &found, int column) const
{
    switch (column) {
    case Name: return modelName(m_catalog, found.modelNumber);
    case Held:
        return tr("%1, firmware %2")
            .arg(profilePlaceText(modelName(m_catalog, found.modelNumber), found.id, found.baudRate))
            .arg(found.firmware);
    case State: return tr("No joint names it");
    default: return {};
    }
}

QString ProfileModel::text(const QModelIndex &index) const
{
    const Joint *joint = jointOf(index);
    if (!joint)
        return otherText(m_others[static_cast<std::size_t>(index.row()) - m_joints.size()], index.column());
    return isJoint(index) ? jointText(*joint, index.column()) : registerText(*joint, index.row(), index.column());
}

QString ProfileModel::toolTip(const QModelIndex &index) const
{
    const Joint *joint = jointOf(index);
    QString why;
    if (const RegisterComparison *row = rowOf(index))
        why = row->why;
    else if (joint && isJoint(index))
        why = joint->progress.why.isEmpty() && joint->found ? joint->found->why : joint->progress.why;
    return plainToolTip(why.isEmpty() ? text(index) : asSentence(why));
}

QVariant ProfileModel::data(const QModelIndex &index, int role) const
{
    if (!checkIndex(index, CheckIndexOption::IndexIsValid))
        return {};
    const bool isTitle = isJoint(index) && index.column() == Name;
    switch (role) {
    case Qt::DisplayRole: return text(index);
    case Qt::ToolTipRole: return toolTip(index);
    case Qt::DecorationRole: return index.column() == State ? iconOf(kind(index)) : QVariant();
    case Qt::ForegroundRole: return index.column() == State ? inkOf(kind(index)) : QVariant();
    // The last column decides on the height, with or without its icon.
    case Qt::SizeHintRole: return index.column() == State ? QSize(0, RowHeight) : QVariant();
    case KindRole: return static_cast<int>(kind(index));
    case Qt::CheckStateRole:
        if (const Joint *joint = isTitle ? jointOf(index) : nullptr)
            return joint->isChosen ? Qt::Checked : Qt::Unchecked;
        return {};
    case Qt::FontRole:
        if (isTitle)
            return boldened(QApplication::font());
        return {};
    default: return {};
    }
}

bool ProfileModel::setData(const QModelIndex &index, const QVariant &value, int role)
{
    if (role != Qt::CheckStateRole || !index.isValid() || !isJoint(index) || index.column() != Name || !jointOf(index))
        return false;
    setChosen(static_cast<std::size_t>(index.row()), value.toInt() == Qt::Checked);
    return true;
}

QVariant ProfileModel::headerData(int section, Qt::Orientation orientation, int role) const
{
    if (orientation != Qt::Horizontal || role != Qt::DisplayRole)
        return {};
    switch (section) {
    case Name: return tr("Joint, register");
    case Wanted: return tr("Wanted");
    case Held: return tr("On the device");
    case State: return tr("State");
    default: return {};
    }
}

Qt::ItemFlags ProfileModel::flags(const QModelIndex &index) const
{
    Qt::ItemFlags flags = QAbstractItemModel::flags(index);
    if (index.isValid() && isJoint(index) && index.column() == Name && jointOf(index))
        flags |= Qt::ItemIsUserCheckable;
    return flags;
}

} // namespace dynascope
