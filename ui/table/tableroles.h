// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/device.h"
#include "core/session/rammarks.h"

#include <QMetaType>
#include <QModelIndex>

namespace dynascope {

/// What a column of the table shows.
enum class ColumnKind { Name, Plot, Address, Value, Physical, Device, Default, Range, Access, All };

/// Raw roles of FieldTableModel, and below them the words FieldWordsModel adds. Delegates, filters and editors know
/// these and no model. A group's row has none but GroupRole and GroupHintRole.
enum TableRole {
    GroupRole = Qt::UserRole, ///< QString: the group's title
    GroupHintRole,            ///< QString: what a group says beside its title; empty where that is plain
    FieldRole,                ///< int: the row among RegisterRows; missing for groups
    FieldDataRole,            ///< const Field *: the cell's device's; where it has none, another's (AbsentRole)
    AbsentRole,               ///< QString: why this device has no such register; empty where it has
    KindRole,                 ///< int: ColumnKind
    RawRole,                  ///< qlonglong: what the servo said last; missing where it never did
    StateRole,                ///< int: FieldState
    PendingRole,              ///< qlonglong: what is being written, once that takes long enough to be worth showing
    ErrorRole,                ///< QString
    EffectiveRole,            ///< EffectiveField
    ResolutionRole,           ///< int: pulses per revolution
    DiffersRole,              ///< bool: not what the first device has, in a setting they share (isSharedSetting)
    AddressesRole,            ///< QStringList: which table has it at which address, where these differ
    MixedRole,                ///< bool: of the column for all devices: they hold different values
    ChangedFromDefaultRole,   ///< bool: writable, not as it left the factory; of any device but in values' columns
    RamStateRole,             ///< int: RamState; of any device but in values' columns
    WatchedRole,              ///< int: Qt::CheckState over all devices
    LockRole,                 ///< QString: why it can't be written now; empty where it can
    PointsAtRole,             ///< qlonglong: the address that an Indirect Address or Data stands for; missing elsewhere
    ControlTableRole,         ///< ControlTablePtr
    FadeRole,                 ///< double: 1 just changed … 0
    NumberRole,               ///< QString, words: the number without its unit; missing where the value has a name
    UnitRole,                 ///< QString, words: its unit
    PendingTextRole,          ///< QString, words: what is being written
    HasMeaningRole,           ///< bool, words: raw values have a name or a unit, and are edited by it
};

inline const Field *fieldAt(const QModelIndex &index)
{
    return index.data(FieldDataRole).value<const Field *>();
}

/// Has an editor: what may be written, and what a person may try to write.
inline bool isEditable(const Field &field)
{
    return field.isWritable() || field.mayBeTried();
}

/// A column of several devices' values: one device's, or that of all together.
inline bool isComparingKind(ColumnKind kind)
{
    return kind == ColumnKind::Device || kind == ColumnKind::All;
}

inline bool isValueKind(ColumnKind kind)
{
    return kind == ColumnKind::Value || kind == ColumnKind::Physical || isComparingKind(kind);
}

inline ColumnKind kindAt(const QModelIndex &index)
{
    return static_cast<ColumnKind>(index.data(KindRole).toInt());
}

/// Those two are changed by procedures (other registers and the line follow), never by a plain write.
inline bool isProcedureField(const Field &field)
{
    return field.name == u"ID" || field.name.startsWith(u"Baud Rate");
}

} // namespace dynascope

Q_DECLARE_METATYPE(const dynascope::Field *)
Q_DECLARE_METATYPE(dynascope::EffectiveField)
Q_DECLARE_METATYPE(dynascope::ControlTablePtr)
