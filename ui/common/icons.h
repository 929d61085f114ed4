// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QIcon>
#include <QPalette>

class QPainter;
class QRectF;

namespace dynascope {

/// What an icon is coloured with. A colour of the theme, so it follows a change from light to dark.
enum class IconTint { Text, Dimmed, Accent, Good, Warning, Bad, White };

/// Our own line icon ":/icons/NAME.svg", tinted with the application's palette, also when that changes.
QIcon icon(const QString &name, IconTint tint = IconTint::Text);

/// For delegates: the same icon in any colour. Fractional scale factors are sharp.
void paintIcon(QPainter *painter, const QRectF &rect, const QString &name, const QColor &color);
QColor tintColor(IconTint tint, const QPalette &palette);

/// The program's own, in colour.
QIcon applicationIcon();

} // namespace dynascope
