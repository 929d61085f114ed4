// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/device.h"
#include "ui/table/tableroles.h"

#include <QAbstractItemModel>

#include <memory>

namespace dynascope {

inline QString markOf(const QModelIndex &cell)
{
    switch (static_cast<FieldState>(cell.data(StateRole).toInt())) {
    case FieldState::Unknown: return QStringLiteral("?");
    case FieldState::Stale: return QStringLiteral("~");
    case FieldState::Failed: return QStringLiteral("!");
    default: return cell.data(DiffersRole).toBool() ? QStringLiteral("#") : QString();
    }
}

/// Each row as "name | cell | cell"; groups as "[title]". States as a mark, a write as "old>new".
inline QStringList printed(const QAbstractItemModel &model)
{
    QStringList lines;
    for (int group = 0; group < model.rowCount(); ++group) {
        const QModelIndex parent = model.index(group, 0);
        lines << QStringLiteral("[%1]").arg(parent.data().toString());
        for (int row = 0; row < model.rowCount(parent); ++row) {
            QStringList cells;
            for (int column = 0; column < model.columnCount(); ++column) {
                const QModelIndex cell = model.index(row, column, parent);
                if (kindAt(cell) == ColumnKind::Plot) {
                    if (cell.data(Qt::CheckStateRole).toInt() != Qt::Unchecked)
                        cells.back() += QStringLiteral(" (plot)");
                    continue;
                }
                QString text = cell.data().toString();
                if (isValueKind(kindAt(cell)) && kindAt(cell) != ColumnKind::Physical)
                    text += markOf(cell);
                if (const QString next = cell.data(PendingTextRole).toString(); !next.isEmpty())
                    text += u'>' + next;
                cells << text;
            }
            lines << cells.join(QStringLiteral(" | "));
        }
    }
    return lines;
}

inline Field makeField(int address, int size, const QString &name, Area area, bool writable, Unit unit, double scale)
{
    Field field;
    field.address = static_cast<std::uint16_t>(address);
    field.size = static_cast<std::uint8_t>(size);
    field.name = name;
    field.area = area;
    field.access = writable ? Access::ReadWrite : Access::Read;
    field.unit = unit;
    field.scale = scale;
    field.isSigned = size == 4;
    return field;
}

inline ControlTablePtr smallTable()
{
    ControlTable::Description table;
    table.modelNumber = 1;
    table.model = QStringLiteral("Small");
    Field id = makeField(7, 1, QStringLiteral("ID"), Area::Eeprom, true, Unit::None, 1);
    id.initial = 1;
    id.minimum.number = 0;
    id.maximum.number = 252;
    Field mode = makeField(11, 1, QStringLiteral("Operating Mode"), Area::Eeprom, true, Unit::None, 1);
    mode.initial = 3;
    mode.values = {{1, QStringLiteral("Velocity")}, {3, QStringLiteral("Position")}};
    Field limit = makeField(48, 4, QStringLiteral("Max Position Limit"), Area::Eeprom, true, Unit::Pulse, 1);
    limit.initial = 4095;
    limit.help = QStringLiteral("How far the joint may turn.");
    Field torque = makeField(64, 1, QStringLiteral("Torque Enable"), Area::Ram, true, Unit::None, 1);
    torque.values = {{0, QStringLiteral("Off")}, {1, QStringLiteral("On")}};
    torque.initial = 0;
    Field goal = makeField(116, 4, QStringLiteral("Goal Position"), Area::Ram, true, Unit::Pulse, 1);
    goal.minimum.number = 0;
    goal.maximum.reg = QStringLiteral("Max Position Limit");
    Field volt = makeField(144, 2, QStringLiteral("Present Input Voltage"), Area::Ram, false, Unit::Volt, 0.1);
    Field address = makeField(168, 2, QStringLiteral("Indirect Address 1"), Area::Ram, true, Unit::None, 1);
    Field data = makeField(224, 1, QStringLiteral("Indirect Data 1"), Area::Ram, true, Unit::None, 1);
    table.fields = {id, mode, limit, torque, goal, volt, address, data};
    return std::make_shared<ControlTable>(table);
}

inline std::unique_ptr<Device> smallDevice(int id)
{
    Found found;
    found.id = static_cast<std::uint8_t>(id);
    return std::make_unique<Device>(static_cast<DeviceKey>(id), nullptr, smallTable(), found);
}

} // namespace dynascope
