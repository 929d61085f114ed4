// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/common/flatstyle.h"

#include "ui/common/theme.h"

#include <QPainter>
#include <QStyleOption>

namespace dynascope {

namespace {

constexpr qreal Radius = 4;

/// A rounded box whose 1-pixel border lies inside `rect`.
void drawBox(QPainter *painter, const QRect &rect, const QColor &fill, const QColor &border)
{
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    painter->setPen(border.isValid() ? QPen(border, 1) : QPen(Qt::NoPen));
    painter->setBrush(fill.isValid() ? QBrush(fill) : QBrush(Qt::NoBrush));
    painter->drawRoundedRect(QRectF(rect).adjusted(0.5, 0.5, -0.5, -0.5), Radius, Radius);
    painter->restore();
}

/// `share` of `over` on `under`.
QColor blend(const QColor &under, const QColor &over, float share)
{
    return QColor::fromRgbF(under.redF() + (over.redF() - under.redF()) * share,
                            under.greenF() + (over.greenF() - under.greenF()) * share,
                            under.blueF() + (over.blueF() - under.blueF()) * share);
}

QColor borderColor(const QStyleOption *option)
{
    const bool enabled = option->state & QStyle::State_Enabled;
    return enabled ? option->palette.color(QPalette::Mid) : colors(option->palette).border;
}

QColor buttonFill(const QStyleOption *option)
{
    const QPalette &palette = option->palette;
    const QColor button = palette.color(QPalette::Button);
    const QColor text = palette.color(QPalette::ButtonText);
    if (!(option->state & QStyle::State_Enabled))
        return button;
    if (option->state & QStyle::State_Sunken)
        return blend(button, text, 0.16F);
    if (option->state & QStyle::State_On)
        return blend(button, colors(palette).accent, 0.22F);
    if (option->state & QStyle::State_MouseOver)
        return blend(button, text, 0.07F);
    return button;
}

void drawPushButton(const QStyleOption *option, QPainter *painter)
{
    const auto *button = qstyleoption_cast<const QStyleOptionButton *>(option);
    const bool flat = button && (button->features & QStyleOptionButton::Flat);
    const bool plain = !(option->state & (QStyle::State_Sunken | QStyle::State_On | QStyle::State_MouseOver));
    const bool focused = (option->state & QStyle::State_HasFocus) && (option->state & QStyle::State_KeyboardFocusChange);
    if (flat && plain && !focused)
        return;
    const bool isDefault = button && (button->features & QStyleOptionButton::DefaultButton);
    QColor border = flat ? QColor() : borderColor(option);
    if (focused || (isDefault && (option->state & QStyle::State_Enabled)))
        border = colors(option->palette).accent;
    drawBox(painter, option->rect, buttonFill(option), border);
}

void drawToolButton(const QStyleOption *option, QPainter *painter)
{
    const bool raised = !(option->state & QStyle::State_AutoRaise);
    const bool active = option->state & (QStyle::State_Sunken | QStyle::State_On | QStyle::State_MouseOver);
    const bool enabled = option->state & QStyle::State_Enabled;
    const bool focused = (option->state & QStyle::State_HasFocus) && (option->state & QStyle::State_KeyboardFocusChange);
    if (!raised && !focused && (!active || !enabled))
        return;
    QStyleOption copy = *option;
    if (!raised)
        copy.palette.setColor(QPalette::Button, option->palette.color(QPalette::Window));
    QColor border = raised ? borderColor(option) : QColor();
    if (focused)
        border = colors(option->palette).accent;
    drawBox(painter, option->rect, buttonFill(&copy), border);
}

void drawField(const QStyleOption *option, QPainter *painter)
{
    const bool focused = option->state & QStyle::State_HasFocus;
    drawBox(painter, option->rect, QColor(), focused ? colors(option->palette).accent : borderColor(option));
}

void drawHeaderSection(const QStyleOption *option, QPainter *painter)
{
    const auto *header = qstyleoption_cast<const QStyleOptionHeader *>(option);
    const ThemeColors &theme = colors(option->palette);
    const QRect &rect = option->rect;
    const bool hovered = (option->state & QStyle::State_MouseOver) && (option->state & QStyle::State_Enabled);
    painter->fillRect(rect, hovered ? blend(theme.header, option->palette.color(QPalette::Text), 0.06F) : theme.header);
    painter->fillRect(QRect(rect.left(), rect.bottom(), rect.width(), 1), theme.border);
    const bool last = header
        && (header->position == QStyleOptionHeader::End || header->position == QStyleOptionHeader::OnlyOneSection);
    if (header && header->orientation == Qt::Horizontal && !last)
        painter->fillRect(QRect(rect.right(), rect.top() + 4, 1, rect.height() - 8), theme.border);
}

} // namespace

FlatStyle::FlatStyle()
    : QProxyStyle(QStringLiteral("Fusion"))
{
}

void FlatStyle::drawPrimitive(PrimitiveElement element, const QStyleOption *option, QPainter *painter,
                              const QWidget *widget) const
{
    switch (element) {
    case PE_PanelButtonCommand: drawPushButton(option, painter); return;
    case PE_PanelButtonTool: drawToolButton(option, painter); return;
    case PE_FrameLineEdit: drawField(option, painter); return;
    case PE_Frame: {
        const auto *frame = qstyleoption_cast<const QStyleOptionFrame *>(option);
        if (!frame || frame->lineWidth <= 0)
            return;
        painter->save();
        painter->setPen(colors(option->palette).border);
        painter->drawRect(option->rect.adjusted(0, 0, -1, -1));
        painter->restore();
        return;
    }
    case PE_FrameStatusBarItem: return;
    case PE_IndicatorToolBarSeparator: {
        const QRect &rect = option->rect;
        const ThemeColors &theme = colors(option->palette);
        if (option->state & State_Horizontal)
            painter->fillRect(QRect(rect.center().x(), rect.top() + 5, 1, rect.height() - 10), theme.border);
        else
            painter->fillRect(QRect(rect.left() + 5, rect.center().y(), rect.width() - 10, 1), theme.border);
        return;
    }
    default: QProxyStyle::drawPrimitive(element, option, painter, widget);
    }
}

void FlatStyle::drawControl(ControlElement element, const QStyleOption *option, QPainter *painter,
                            const QWidget *widget) const
{
    switch (element) {
    case CE_HeaderSection: drawHeaderSection(option, painter); return;
    case CE_HeaderEmptyArea: {
        const ThemeColors &theme = colors(option->palette);
        painter->fillRect(option->rect, theme.header);
        painter->fillRect(QRect(option->rect.left(), option->rect.bottom(), option->rect.width(), 1), theme.border);
        return;
    }
    case CE_Splitter: {
        const ThemeColors &theme = colors(option->palette);
        painter->fillRect(option->rect, (option->state & State_MouseOver) ? theme.accent : theme.border);
        return;
    }
    case CE_ToolBar: painter->fillRect(option->rect, option->palette.color(QPalette::Window)); return;
    default: QProxyStyle::drawControl(element, option, painter, widget);
    }
}

int FlatStyle::pixelMetric(PixelMetric metric, const QStyleOption *option, const QWidget *widget) const
{
    switch (metric) {
    case PM_SplitterWidth: return 1; // QSplitter widens the grip of a 1-pixel handle by itself
    case PM_ToolBarFrameWidth: return 0;
    case PM_ToolBarItemMargin: return 4;
    case PM_ToolBarItemSpacing: return 4;
    case PM_ScrollBarExtent: return 12;
    case PM_ButtonShiftHorizontal:
    case PM_ButtonShiftVertical: return 0;
    default: return QProxyStyle::pixelMetric(metric, option, widget);
    }
}

int FlatStyle::styleHint(StyleHint hint, const QStyleOption *option, const QWidget *widget,
                         QStyleHintReturn *returnData) const
{
    switch (hint) {
    case SH_EtchDisabledText:
    case SH_DitherDisabledText: return 0;
    case SH_DialogButtonBox_ButtonsHaveIcons: return 0;
    default: return QProxyStyle::styleHint(hint, option, widget, returnData);
    }
}

} // namespace dynascope
