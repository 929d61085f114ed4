// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/fieldwordsmodel.h"

#include "ui/common/fieldtexts.h"
#include "ui/common/texts.h"

namespace dynascope {

FieldWordsModel::FieldWordsModel(QObject *parent)
    : QIdentityProxyModel(parent)
{
}

void FieldWordsModel::setAngleUnit(AngleUnit unit)
{
    if (m_angle == unit)
        return;
    beginResetModel();
    m_angle = unit;
    endResetModel();
}

QString rangeText(const EffectiveField &effective)
{
    if (!effective.minimum && !effective.maximum)
        return {};
    const auto text = [](const std::optional<std::int64_t> &bound) {
        return bound ? QString::number(*bound).replace(u'-', QChar(0x2212)) : QString();
    };
    return QStringLiteral("%1 … %2").arg(text(effective.minimum), text(effective.maximum));
}

QVariant FieldWordsModel::data(const QModelIndex &index, int role) const
{
    const Field *field = QIdentityProxyModel::data(index, FieldDataRole).value<const Field *>();
    if (!field) {
        if (role == Qt::DisplayRole && index.column() == 0)
            return QIdentityProxyModel::data(index, GroupRole);
        return QIdentityProxyModel::data(index, role);
    }
    const auto kind = static_cast<ColumnKind>(QIdentityProxyModel::data(index, KindRole).toInt());
    if (role == Qt::ToolTipRole)
        return plainToolTip(toolTip(index, *field, kind));
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
    case ColumnKind::Address: return field->address;
    case ColumnKind::Default: return field->initial ? QVariant(static_cast<qlonglong>(*field->initial)) : QVariant();
    case ColumnKind::Range: return rangeText(QIdentityProxyModel::data(index, EffectiveRole).value<EffectiveField>());
    case ColumnKind::Access:
        return field->mayBeTried() ? QStringLiteral("?")
            : field->isWritable()  ? QStringLiteral("RW")
                                   : QStringLiteral("R");
    default: return {};
    }
}

QVariant FieldWordsModel::valueData(const QModelIndex &index, const Field &field, ColumnKind kind, int role) const
{
    if (role != Qt::DisplayRole && role != NumberRole && role != UnitRole && role != PendingTextRole)
        return QIdentityProxyModel::data(index, role);
    const QVariant raw = QIdentityProxyModel::data(index, role == PendingTextRole ? PendingRole : RawRole);
    if (!raw.isValid())
        return {};
    const Words said = words(index, field, kind, raw.toLongLong());
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
        return {name, {}, {}};
    if (!field.values.empty() || !field.bits.empty()) // a value the table has no name for
        return kind == ColumnKind::Device ? Words{bare, bare, {}} : Words();
    const auto effective = QIdentityProxyModel::data(index, EffectiveRole).value<EffectiveField>();
    if (effective.unit == Unit::None)
        return kind == ColumnKind::Device ? Words{bare, bare, {}} : Words();
    const Physical value
        = physical(effective, QIdentityProxyModel::data(index, ResolutionRole).toInt(), raw, m_angle);
    const QString number = QString::number(value.value, 'f', value.decimals);
    return {value.unit.isEmpty() ? number : number + u' ' + value.unit, number, value.unit};
}

QString FieldWordsModel::toolTip(const QModelIndex &index, const Field &field, ColumnKind kind) const
{
    if (kind == ColumnKind::Plot)
        return tr("Plot %1 (Space)").arg(field.name);
    if (kind == ColumnKind::Name)
        return field.help.isEmpty() ? field.name : QStringLiteral("%1\n%2").arg(field.name, field.help);
    if (kind == ColumnKind::Access)
        return accessText(field);
    if (kind == ColumnKind::Range)
        return rangeText(QIdentityProxyModel::data(index, EffectiveRole).value<EffectiveField>());
    if (!isValueKind(kind))
        return {};
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
        case ColumnKind::Range: return tr("What may be written, as raw values");
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
    case ColumnKind::Device: break;
    }
    return QIdentityProxyModel::headerData(section, orientation, role);
}

} // namespace dynascope
