// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/table/tableroles.h"

#include <QStyleOptionViewItem>

class QPainter;

namespace dynascope {

inline constexpr int CellMargin = 8; ///< left and right of what a cell says
inline constexpr int NameMark = 14; ///< how large a mark beside a name is: of what is doubtful, of what was set

/// How wide the lane is in which units stand, so that the numbers left of it line up whatever their unit.
int unitLaneWidth(const QFont &font);

/// Of selected rows, in place of the full accent: units, marks and fading stay readable on it.
QColor selectionTint(const QPalette &palette);

/// The text of one value: number right, unit dimmed, what is being written, a mark where the last try failed or where
/// this device differs from the others. Knows roles only.
void paintValue(QPainter *painter, const QStyleOptionViewItem &option, const QModelIndex &index);

/// Background, selection and focus of a cell, without its content.
void paintCell(QPainter *painter, const QStyleOptionViewItem &option);

/// The box in which a watched register's tick is painted.
QRect plotTickRect(const QRect &cell);
void paintPlotTick(QPainter *painter, const QStyleOptionViewItem &option, Qt::CheckState state);

} // namespace dynascope
