// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/fieldwordsmodel.h"

#include "core/table/indirect.h"
#include "ui/common/fieldtexts.h"
#include "ui/common/texts.h"
#include "ui/table/limitwords.h"

namespace dynascope {
namespace {

QString nameToolTip(const Field &field, RamState state)
{
    QStringList lines{field.name};
    if (!field.help.isEmpty())
        lines << field.help;
    if (!field.doubt.isEmpty())
        lines << FieldWordsModel::tr("Doubtful: %1").arg(field.doubt);
    if (state != RamState::NotSet)
        lines << ramStateText(state);
    return lines.join(u'\n');
}

} // namespace

QString ramStateText(RamState state)
{
    switch (state) {
    case RamState::Set: return FieldWordsModel::tr("Set in this session; gone at power-off.");
    case RamState::Lost: return FieldWordsModel::tr("Was set in this session; gone since the device has restarted.");
    case RamState::NotSet: break;
    }
    return {};
}

FieldWordsModel::FieldWordsModel(QObject *parent)
    : QIdentityProxyModel(parent)
{
}

void FieldWordsModel::setUnits(const UnitPreferences &units)
{
    if (m_units == units)
        return;
    m_units = units;
    // What was said changes, not what there is: selection and folding stay.
    for (int group = 0; group < rowCount(); ++group) {
        const QModelIndex parent = index(group, 0);
        if (const int rows = rowCount(parent); rows > 0)
            emit dataChanged(index(0, 0, parent), index(rows - 1, columnCount() - 1, parent));
    }
}

QVariant FieldWordsModel::data(const QModelIndex &index, int role) const
{
    const Field *field = QIdentityProxyModel::data(index, FieldDataRole).value<const Field *>();
    if (!field) {
        if ((role == Qt::DisplayRole || role == Qt::AccessibleTextRole) && index.column() == 0)
            return QIdentityProxyModel::data(index, GroupRole);
        return QIdentityProxyModel::data(index, role);
    }
    const auto kind = static_cast<ColumnKind>(QIdentityProxyModel::data(index, KindRole).toInt());
    if (role == HasMeaningRole)
        return hasMeaning(index, *field);
    if (role == Qt::ToolTipRole)
        return plainToolTip(toolTip(index, *field, kind));
    if (role == Qt::AccessibleTextRole && !QIdentityProxyModel::data(index, AbsentRole).toString().isEmpty())
        return tr("not on this model");
    if (isValueKind(kind))
        return valueData(index, *field, kind, role);
    if (role == Qt::TextAlignmentRole) {
        const bool number = kind == ColumnKind::Address || kind == ColumnKind::Default || kind == ColumnKind::Range;
        return static_cast<int>((number ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter);
    }
    if (role != Qt::DisplayRole)
        return QIdentityProxyModel::data(index, role);
    switch (kind) {
    case ColumnKind::Name: return field->name;
    case ColumnKind::Address:
        return QIdentityProxyModel::data(index, AddressesRole).toStringList().isEmpty()
            ? QVariant(field->address) : QVariant(QStringLiteral("%1 …").arg(field->address));
    case ColumnKind::Default: return limit(index, *field, defaultText);
    case ColumnKind::Range: return limit(index, *field, rangeText);
    case ColumnKind::Access:
        return field->mayBeTried() ? QStringLiteral("?")
            : field->isWritable()  ? QStringLiteral("RW")
                                   : QStringLiteral("R");
    default: return {};
    }
}

/// What a function of limitwords.h says of the register as it is now.
QString FieldWordsModel::limit(const QModelIndex &index, const Field &field, LimitText text) const
{
    return text(field, QIdentityProxyModel::data(index, EffectiveRole).value<EffectiveField>(),
                QIdentityProxyModel::data(index, ResolutionRole).toInt(), m_units);
}

bool FieldWordsModel::hasMeaning(const QModelIndex &index, const Field &field) const
{
    if (!field.values.empty() || !field.bits.empty() || indirectAddressNumber(field) > 0)
        return true;
    const auto effective = QIdentityProxyModel::data(index, EffectiveRole).value<EffectiveField>();
    return effective.unit != Unit::None && !m_units.raw;
}

QVariant FieldWordsModel::valueData(const QModelIndex &index, const Field &field, ColumnKind kind, int role) const
{
    if (role != Qt::DisplayRole && role != NumberRole && role != UnitRole && role != PendingTextRole)
        return QIdentityProxyModel::data(index, role);
    if (role == Qt::DisplayRole && QIdentityProxyModel::data(index, MixedRole).toBool())
        return tr("mixed");
    const QVariant raw = QIdentityProxyModel::data(index, role == PendingTextRole ? PendingRole : RawRole);
    if (!raw.isValid())
        return {};
    Words said = words(index, field, kind, raw.toLongLong());
    if (role == PendingTextRole && said.text.startsWith(u'→'))
        said.text = said.text.sliced(2); // the arrow before what is being written stands there already
    switch (role) {
    case NumberRole:
        return said.number.isEmpty() ? QVariant() : QVariant(QString(said.number).replace(u'-', QChar(0x2212)));
    case UnitRole: return said.unit;
    default: return said.text;
    }
}

FieldWordsModel::Words FieldWordsModel::words(const QModelIndex &index, const Field &field, ColumnKind kind,
                                              std::int64_t raw) const
{
    const QString bare = QString::number(raw);
    if (kind == ColumnKind::Value)
        return {bare, bare, {}};
    if (const QString name = meaning(field, raw); !name.isEmpty())
        return {withBaudTexts(name), {}, {}};
    if (const QString name = indirectText(index, field, raw); !name.isEmpty())
        return indirectDataNumber(field) > 0 && isComparingKind(kind) ? Words{bare, bare, {}} : Words{name, {}, {}};
    if (!field.values.empty() || !field.bits.empty()) // a value the table has no name for
        return isComparingKind(kind) ? Words{bare, bare, {}} : Words();
    const auto effective = QIdentityProxyModel::data(index, EffectiveRole).value<EffectiveField>();
    if (effective.unit == Unit::None || m_units.raw)
        return isComparingKind(kind) ? Words{bare, bare, {}} : Words();
    const Physical value
        = physical(effective, QIdentityProxyModel::data(index, ResolutionRole).toInt(), raw, m_units);
    const QString number = QString::number(value.value, 'f', value.decimals);
    return {value.unit.isEmpty() ? number : number + u' ' + value.unit, number, value.unit};
}

/// What an Indirect Address points at, or an Indirect Data shows; empty for other registers.
QString FieldWordsModel::indirectText(const QModelIndex &index, const Field &field, std::int64_t raw) const
{
    const bool isAddress = indirectAddressNumber(field) > 0;
    const QVariant stands = isAddress ? QVariant(static_cast<qlonglong>(raw))
                                      : QIdentityProxyModel::data(index, PointsAtRole);
    const auto table = QIdentityProxyModel::data(index, ControlTableRole).value<ControlTablePtr>();
    if (!stands.isValid() || !table)
        return {};
    const QString text = addressText(*table, stands.toLongLong());
    // As it leaves the factory: it shows the byte of its own data register, which is nothing of any other.
    const int number = isAddress ? indirectAddressNumber(field) : indirectDataNumber(field);
    if (text == QStringLiteral("Indirect Data %1").arg(number))
        return isAddress ? tr("→ %1 (not assigned)").arg(text) : tr("not assigned");
    return isAddress ? QStringLiteral("→ %1").arg(text) : tr("of %1").arg(text);
}

QString FieldWordsModel::toolTip(const QModelIndex &index, const Field &field, ColumnKind kind) const
{
    if (kind == ColumnKind::Plot)
        return tr("Plot %1 (Space)").arg(field.name);
    if (kind == ColumnKind::Name)
        return nameToolTip(field, static_cast<RamState>(QIdentityProxyModel::data(index, RamStateRole).toInt()));
    if (kind == ColumnKind::Access)
        return field.mayBeTried() ? tr("Whether it may be written isn't known: an edit asks before it is sent")
                                  : accessText(field);
    if (kind == ColumnKind::Range)
        return limit(index, field, rangeToolTip);
    if (kind == ColumnKind::Default)
        return limit(index, field, defaultToolTip);
    if (kind == ColumnKind::Address)
        return QIdentityProxyModel::data(index, AddressesRole).toStringList().join(u'\n');
    if (!isValueKind(kind))
        return {};
    if (const QString absent = QIdentityProxyModel::data(index, AbsentRole).toString(); !absent.isEmpty())
        return absent;
    if (kind == ColumnKind::All)
        return isEditable(field) ? tr("An edit here is written to all selected devices") : QString();
    if (const QString error = QIdentityProxyModel::data(index, ErrorRole).toString(); !error.isEmpty())
        return error;
    switch (static_cast<FieldState>(QIdentityProxyModel::data(index, StateRole).toInt())) {
    case FieldState::Unknown: return tr("Not read yet");
    case FieldState::Stale: return tr("Not up to date: this was the last value the servo gave");
    case FieldState::Pending: return tr("Being written");
    default: break;
    }
    const QString text = valueData(index, field, ColumnKind::Device, Qt::DisplayRole).toString();
    const QString raw = QIdentityProxyModel::data(index, RawRole).toString();
    return text == raw ? QString() : tr("%1 (raw %2)").arg(text, raw);
}

QVariant FieldWordsModel::headerData(int section, Qt::Orientation orientation, int role) const
{
    const QVariant kind = QIdentityProxyModel::headerData(section, orientation, KindRole);
    if (!kind.isValid())
        return QIdentityProxyModel::headerData(section, orientation, role);
    const auto column = static_cast<ColumnKind>(kind.toInt());
    if (role == Qt::TextAlignmentRole) {
        const bool right = column == ColumnKind::Address || column == ColumnKind::Value || column == ColumnKind::Default
            || column == ColumnKind::Range;
        const bool centred = column == ColumnKind::Plot;
        const Qt::Alignment side = centred ? Qt::AlignHCenter : right ? Qt::AlignRight : Qt::AlignLeft;
        return static_cast<int>(side | Qt::AlignVCenter);
    }
    if (role == Qt::ToolTipRole) {
        switch (column) {
        case ColumnKind::Plot: return tr("Tick what shall be plotted");
        case ColumnKind::Value: return tr("The number in the register");
        case ColumnKind::Physical: return tr("What the number means");
        case ColumnKind::Range: return tr("What may be written; hover over it for the raw values");
        case ColumnKind::All: return tr("What all selected devices have; an edit here is written to all of them");
        case ColumnKind::Device:
            return plainToolTip(QIdentityProxyModel::headerData(section, orientation, Qt::DisplayRole).toString());
        default: return {};
        }
    }
    if (role != Qt::DisplayRole)
        return QIdentityProxyModel::headerData(section, orientation, role);
    switch (column) {
    case ColumnKind::Name: return tr("Name");
    case ColumnKind::Plot: return tr("Plot");
    case ColumnKind::Address: return tr("Address");
    case ColumnKind::Value: return tr("Raw");
    case ColumnKind::Physical: return tr("Value");
    case ColumnKind::Default: return tr("Default");
    case ColumnKind::Range: return tr("Range");
    case ColumnKind::Access: return tr("Access");
    case ColumnKind::All: return tr("All");
    case ColumnKind::Device: break;
    }
    return QIdentityProxyModel::headerData(section, orientation, role);
}

} // namespace dynascope
