// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/common/flatcontrols.h"

#include "ui/common/icons.h"
#include "ui/common/theme.h"

#include <QPainter>
#include <QStyleOption>

namespace dynascope {

namespace {

constexpr qreal Radius = 4;
constexpr int ShortestHandle = 28;

QColor arrowColor(const QStyleOption &option, bool enabled)
{
    return enabled ? colors(option.palette).dimmed : option.palette.color(QPalette::Disabled, QPalette::ButtonText);
}

void drawArrow(QPainter *painter, const QRect &rect, const QString &name, int side, const QColor &color)
{
    const QPointF centre = QRectF(rect).center();
    paintIcon(painter, QRectF(centre.x() - side / 2.0, centre.y() - side / 2.0, side, side), name, color);
}

} // namespace

void drawBox(QPainter *painter, const QRect &rect, const QColor &fill, const QColor &border)
{
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    painter->setPen(border.isValid() ? QPen(border, 1) : QPen(Qt::NoPen));
    painter->setBrush(fill.isValid() ? QBrush(fill) : QBrush(Qt::NoBrush));
    painter->drawRoundedRect(QRectF(rect).adjusted(0.5, 0.5, -0.5, -0.5), Radius, Radius);
    painter->restore();
}

QColor blend(const QColor &under, const QColor &over, float share)
{
    return QColor::fromRgbF(under.redF() + (over.redF() - under.redF()) * share,
                            under.greenF() + (over.greenF() - under.greenF()) * share,
                            under.blueF() + (over.blueF() - under.blueF()) * share);
}

QColor controlBorder(const QStyleOption &option)
{
    if (!(option.state & QStyle::State_Enabled))
        return colors(option.palette).border;
    return option.state & QStyle::State_HasFocus ? colors(option.palette).accent : option.palette.color(QPalette::Mid);
}

/// An empty box or circle is nothing but its border: that has to be seen on any ground.
QColor ringColor(const QStyleOption &option)
{
    const bool quiet = (option.state & QStyle::State_Enabled) && !(option.state & QStyle::State_HasFocus);
    return quiet ? blend(option.palette.color(QPalette::Mid), option.palette.color(QPalette::Text), 0.4F)
                 : controlBorder(option);
}

void drawComboBox(const QStyleOptionComboBox &option, QPainter *painter, const QStyle &style)
{
    const bool enabled = option.state & QStyle::State_Enabled;
    QColor fill = option.palette.color(option.editable ? QPalette::Base : QPalette::Button);
    if (!option.editable && enabled && (option.state & QStyle::State_MouseOver))
        fill = blend(fill, option.palette.color(QPalette::ButtonText), 0.07F);
    if (option.frame)
        drawBox(painter, option.rect, fill, controlBorder(option));
    else
        painter->fillRect(option.rect, fill);
    const QRect arrow = style.subControlRect(QStyle::CC_ComboBox, &option, QStyle::SC_ComboBoxArrow);
    drawArrow(painter, arrow, QStringLiteral("chevron-down"), 14, arrowColor(option, enabled));
}

void drawSpinBox(const QStyleOptionSpinBox &option, QPainter *painter, const QStyle &style)
{
    const QColor base = option.palette.color(QPalette::Base);
    if (option.frame)
        drawBox(painter, option.rect, base, controlBorder(option));
    else
        painter->fillRect(option.rect, base);
    if (option.buttonSymbols == QAbstractSpinBox::NoButtons)
        return;
    const auto button = [&](QStyle::SubControl part, QAbstractSpinBox::StepEnabledFlag step, const QString &name) {
        const QRect rect = style.subControlRect(QStyle::CC_SpinBox, &option, part);
        const bool enabled = (option.state & QStyle::State_Enabled) && (option.stepEnabled & step);
        if (enabled && option.activeSubControls == part && (option.state & QStyle::State_MouseOver)) {
            const float share = option.state & QStyle::State_Sunken ? 0.18F : 0.08F;
            painter->fillRect(rect.adjusted(0, 1, -1, -1), blend(base, option.palette.color(QPalette::Text), share));
        }
        drawArrow(painter, rect, name, 11, arrowColor(option, enabled));
    };
    button(QStyle::SC_SpinBoxUp, QAbstractSpinBox::StepUpEnabled, QStringLiteral("chevron-up"));
    button(QStyle::SC_SpinBoxDown, QAbstractSpinBox::StepDownEnabled, QStringLiteral("chevron-down"));
}

void drawCheckBox(const QStyleOption &option, QPainter *painter)
{
    const bool enabled = option.state & QStyle::State_Enabled;
    const bool set = option.state & (QStyle::State_On | QStyle::State_NoChange);
    const QColor mark = enabled ? option.palette.color(QPalette::Highlight) : option.palette.color(QPalette::Mid);
    const int side = qMin(option.rect.width(), option.rect.height());
    QRect box(0, 0, side, side);
    box.moveCenter(option.rect.center());
    drawBox(painter, box, set ? mark : option.palette.color(QPalette::Base), set ? mark : ringColor(option));
    if (set) {
        const bool half = option.state & QStyle::State_NoChange;
        paintIcon(painter, QRectF(box).adjusted(1, 1, -1, -1), half ? QStringLiteral("minus") : QStringLiteral("check"),
            Qt::white);
    }
}

void drawRadioButton(const QStyleOption &option, QPainter *painter)
{
    const bool enabled = option.state & QStyle::State_Enabled;
    const bool set = option.state & QStyle::State_On;
    const QColor mark = enabled ? option.palette.color(QPalette::Highlight) : option.palette.color(QPalette::Mid);
    const qreal side = qMin(option.rect.width(), option.rect.height()) - 1;
    QRectF circle(0, 0, side, side);
    circle.moveCenter(QRectF(option.rect).center());
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    painter->setPen(QPen(set ? mark : ringColor(option), 1));
    painter->setBrush(set ? mark : option.palette.color(QPalette::Base));
    painter->drawEllipse(circle);
    if (set) {
        painter->setPen(Qt::NoPen);
        painter->setBrush(Qt::white);
        const qreal inset = side * 0.32;
        painter->drawEllipse(circle.adjusted(inset, inset, -inset, -inset));
    }
    painter->restore();
}

void drawScrollBar(const QStyleOptionSlider &option, QPainter *painter)
{
    const QColor base = option.palette.color(QPalette::Base);
    const QColor text = option.palette.color(QPalette::Text);
    painter->fillRect(option.rect, base);
    if (option.minimum >= option.maximum)
        return;
    const bool across = option.orientation == Qt::Horizontal;
    const bool active = option.activeSubControls & QStyle::SC_ScrollBarSlider;
    const float share = active && (option.state & QStyle::State_Sunken) ? 0.5F
        : active && (option.state & QStyle::State_MouseOver)            ? 0.4F
                                                                         : 0.24F;
    const QRectF handle = QRectF(scrollBarRect(option, QStyle::SC_ScrollBarSlider));
    const QRectF thin = across ? handle.adjusted(2, 3, -2, -3) : handle.adjusted(3, 2, -3, -2);
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    painter->setPen(Qt::NoPen);
    painter->setBrush(blend(base, text, share));
    const qreal radius = qMin(thin.width(), thin.height()) / 2;
    painter->drawRoundedRect(thin, radius, radius);
    painter->restore();
}

QRect scrollBarRect(const QStyleOptionSlider &option, QStyle::SubControl part)
{
    const bool across = option.orientation == Qt::Horizontal;
    const int whole = across ? option.rect.width() : option.rect.height();
    const auto range = static_cast<qint64>(option.maximum) - option.minimum;
    int length = whole;
    if (range > 0) {
        const auto share = static_cast<qint64>(option.pageStep) * whole / (range + option.pageStep);
        length = qBound(qMin(ShortestHandle, whole), static_cast<int>(share), whole);
    }
    const int begin = QStyle::sliderPositionFromValue(
        option.minimum, option.maximum, option.sliderPosition, whole - length, option.upsideDown);
    const auto along = [&option, across](int from, int size) {
        const QRect &rect = option.rect;
        return across ? QRect(rect.left() + from, rect.top(), size, rect.height())
                      : QRect(rect.left(), rect.top() + from, rect.width(), size);
    };
    QRect result;
    switch (part) {
    case QStyle::SC_ScrollBarSlider: result = along(begin, length); break;
    case QStyle::SC_ScrollBarSubPage: result = along(0, begin); break;
    case QStyle::SC_ScrollBarAddPage: result = along(begin + length, whole - begin - length); break;
    case QStyle::SC_ScrollBarGroove: result = option.rect; break;
    default: break; // no arrows, no buttons for the ends
    }
    return QStyle::visualRect(option.direction, option.rect, result);
}

} // namespace dynascope
