// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QColor>
#include <QStyle>

class QStyleOptionComboBox;
class QStyleOptionSlider;
class QStyleOptionSpinBox;

/// The controls of FlatStyle that have parts.
namespace dynascope {

/// A rounded box whose 1-pixel border lies inside `rect`; an invalid colour leaves fill or border out.
void drawBox(QPainter *painter, const QRect &rect, const QColor &fill, const QColor &border);
/// `share` of `over` on `under`.
QColor blend(const QColor &under, const QColor &over, float share);
QColor controlBorder(const QStyleOption &option); ///< by enabled and focus

void drawComboBox(const QStyleOptionComboBox &option, QPainter *painter, const QStyle &style);
void drawSpinBox(const QStyleOptionSpinBox &option, QPainter *painter, const QStyle &style);

void drawCheckBox(const QStyleOption &option, QPainter *painter);
void drawRadioButton(const QStyleOption &option, QPainter *painter);

/// A rounded handle on a quiet track, without arrows.
void drawScrollBar(const QStyleOptionSlider &option, QPainter *painter);
QRect scrollBarRect(const QStyleOptionSlider &option, QStyle::SubControl part);

} // namespace dynascope
