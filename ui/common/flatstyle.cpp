// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/common/flatstyle.h"

#include "ui/common/flatcontrols.h"
#include "ui/common/icons.h"
#include "ui/common/theme.h"

#include <QFrame>
#include <QPainter>
#include <QStyleOption>

namespace dynascope {

namespace {

constexpr int IconGap = 7;
constexpr int ButtonPadding = 24; ///< left and right of a button's text, together
constexpr int ButtonHeight = 28;
constexpr int HeaderMargin = 5; ///< around the text of a column's head
constexpr int RowPadding = 6;   ///< above and below a row's text, together

/// Buttons show the focus only where the keyboard brought it.
QColor plainBorder(const QStyleOption *option)
{
    QStyleOption copy = *option;
    copy.state &= ~QStyle::State_HasFocus;
    return controlBorder(copy);
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
    const bool focused =
        (option->state & QStyle::State_HasFocus) && (option->state & QStyle::State_KeyboardFocusChange);
    if (flat && plain && !focused)
        return;
    const bool isDefault = button && (button->features & QStyleOptionButton::DefaultButton);
    QColor border = flat ? QColor() : plainBorder(option);
    if (focused || (isDefault && (option->state & QStyle::State_Enabled)))
        border = colors(option->palette).accent;
    drawBox(painter, option->rect, buttonFill(option), border);
}

void drawToolButton(const QStyleOption *option, QPainter *painter)
{
    const bool raised = !(option->state & QStyle::State_AutoRaise);
    const bool active = option->state & (QStyle::State_Sunken | QStyle::State_On | QStyle::State_MouseOver);
    const bool enabled = option->state & QStyle::State_Enabled;
    const bool focused =
        (option->state & QStyle::State_HasFocus) && (option->state & QStyle::State_KeyboardFocusChange);
    if (!raised && !focused && (!active || !enabled))
        return;
    QStyleOption copy = *option;
    if (!raised)
        copy.palette.setColor(QPalette::Button, option->palette.color(QPalette::Window));
    QColor border = raised ? plainBorder(option) : QColor();
    if (focused)
        border = colors(option->palette).accent;
    drawBox(painter, option->rect, buttonFill(&copy), border);
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

/// Icon and text in the middle with a gap that shows; Fusion lets them touch.
void drawPushButtonLabel(const QStyleOptionButton &button, QPainter *painter, const QStyle &style)
{
    const bool enabled = button.state & QStyle::State_Enabled;
    const QFontMetrics metrics(button.fontMetrics);
    const int textWidth = metrics.size(Qt::TextShowMnemonic, button.text).width();
    const int gap = button.text.isEmpty() ? 0 : IconGap;
    int left = button.rect.center().x() - (button.iconSize.width() + gap + textWidth) / 2 + 1;
    const QRect iconRect(QPoint(left, button.rect.center().y() - button.iconSize.height() / 2 + 1), button.iconSize);
    button.icon.paint(painter, QStyle::visualRect(button.direction, button.rect, iconRect), Qt::AlignCenter,
                      enabled ? QIcon::Normal : QIcon::Disabled);
    left += button.iconSize.width() + gap;
    const QRect textRect(left, button.rect.top(), textWidth + 2, button.rect.height());
    style.drawItemText(painter, QStyle::visualRect(button.direction, button.rect, textRect),
                       Qt::AlignVCenter | Qt::AlignLeft | Qt::TextShowMnemonic, button.palette, enabled, button.text,
                       QPalette::ButtonText);
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
    case PE_FrameLineEdit: drawBox(painter, option->rect, QColor(), controlBorder(*option)); return;
    case PE_PanelMenu: // Fusion's frame is darker than the ground, which a dark scheme swallows
        painter->save();
        painter->setPen(option->palette.color(QPalette::Mid));
        painter->setBrush(option->palette.color(QPalette::Base).lighter(108)); // as Fusion's entries
        painter->drawRect(option->rect.adjusted(0, 0, -1, -1));
        painter->restore();
        return;
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
    case PE_IndicatorCheckBox:
    case PE_IndicatorItemViewItemCheck: drawCheckBox(*option, painter); return;
    case PE_IndicatorRadioButton: drawRadioButton(*option, painter); return;
    case PE_FrameStatusBarItem: return;
    case PE_IndicatorBranch: {
        QStyleOption arrow = *option;
        if (arrow.state & State_Selected) // it stands on the highlight, as the text does
            arrow.palette.setColor(QPalette::WindowText, option->palette.color(QPalette::HighlightedText));
        QProxyStyle::drawPrimitive(element, &arrow, painter, widget);
        return;
    }
    case PE_PanelScrollAreaCorner: painter->fillRect(option->rect, option->palette.color(QPalette::Base)); return;
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
    case CE_HeaderLabel: {
        const auto *header = qstyleoption_cast<const QStyleOptionHeader *>(option);
        if (!header)
            break;
        QStyleOptionHeader quiet = *header;
        quiet.palette.setColor(QPalette::ButtonText, colors(option->palette).dimmed);
        QProxyStyle::drawControl(element, &quiet, painter, widget);
        return;
    }
    case CE_Splitter: {
        const ThemeColors &theme = colors(option->palette);
        painter->fillRect(option->rect, (option->state & State_MouseOver) ? theme.accent : theme.border);
        return;
    }
    case CE_MenuItem: {
        const auto *item = qstyleoption_cast<const QStyleOptionMenuItem *>(option);
        if (!item || item->menuItemType != QStyleOptionMenuItem::Separator || !item->text.isEmpty())
            break;
        const QRect &rect = item->rect;
        painter->fillRect(QRect(rect.left() + 8, rect.center().y(), rect.width() - 16, 1),
                          colors(item->palette).border);
        return;
    }
    case CE_PushButtonLabel: {
        const auto *button = qstyleoption_cast<const QStyleOptionButton *>(option);
        if (!button || button->icon.isNull() || (button->features & QStyleOptionButton::HasMenu))
            break;
        drawPushButtonLabel(*button, painter, *this);
        return;
    }
    case CE_ShapedFrame: {
        const auto *frame = qstyleoption_cast<const QStyleOptionFrame *>(option);
        if (!frame || (frame->frameShape != QFrame::HLine && frame->frameShape != QFrame::VLine))
            break;
        const QPoint centre = frame->rect.center();
        const bool across = frame->frameShape == QFrame::HLine;
        painter->fillRect(across ? QRect(frame->rect.left(), centre.y(), frame->rect.width(), 1)
                                 : QRect(centre.x(), frame->rect.top(), 1, frame->rect.height()),
                          colors(option->palette).border);
        return;
    }
    case CE_ToolBar: painter->fillRect(option->rect, option->palette.color(QPalette::Window)); return;
    default: break;
    }
    QProxyStyle::drawControl(element, option, painter, widget);
}

void FlatStyle::drawComplexControl(ComplexControl control, const QStyleOptionComplex *option, QPainter *painter,
                                   const QWidget *widget) const
{
    if (const auto *combo = qstyleoption_cast<const QStyleOptionComboBox *>(option); combo && control == CC_ComboBox)
        return drawComboBox(*combo, painter, *this);
    if (const auto *spin = qstyleoption_cast<const QStyleOptionSpinBox *>(option); spin && control == CC_SpinBox)
        return drawSpinBox(*spin, painter, *this);
    if (const auto *bar = qstyleoption_cast<const QStyleOptionSlider *>(option); bar && control == CC_ScrollBar)
        return drawScrollBar(*bar, painter);
    QProxyStyle::drawComplexControl(control, option, painter, widget);
}

QRect FlatStyle::subControlRect(ComplexControl control, const QStyleOptionComplex *option, SubControl part,
                                const QWidget *widget) const
{
    if (const auto *bar = qstyleoption_cast<const QStyleOptionSlider *>(option); bar && control == CC_ScrollBar)
        return scrollBarRect(*bar, part);
    return QProxyStyle::subControlRect(control, option, part, widget);
}

QSize FlatStyle::sizeFromContents(ContentsType type, const QStyleOption *option, const QSize &size,
                                  const QWidget *widget) const
{
    QSize result = QProxyStyle::sizeFromContents(type, option, size, widget);
    if (type == CT_ItemViewItem && option)
        return result.expandedTo(QSize(0, option->fontMetrics.height() + RowPadding));
    const auto *button = qstyleoption_cast<const QStyleOptionButton *>(option);
    if (type != CT_PushButton || !button || button->text.isEmpty())
        return result;
    const int gap = button->icon.isNull() ? 0 : IconGap + 2;
    result = result.expandedTo(QSize(size.width() + gap + ButtonPadding, ButtonHeight));
    return result;
}

QIcon FlatStyle::standardIcon(StandardPixmap standard, const QStyleOption *option, const QWidget *widget) const
{
    switch (standard) {
    case SP_MessageBoxQuestion: return icon(QStringLiteral("help"), IconTint::Accent);
    case SP_MessageBoxInformation: return icon(QStringLiteral("info"), IconTint::Accent);
    case SP_MessageBoxWarning: return icon(QStringLiteral("warning"), IconTint::Warning);
    case SP_MessageBoxCritical: return icon(QStringLiteral("error"), IconTint::Bad);
    case SP_LineEditClearButton: return icon(QStringLiteral("close"), IconTint::Dimmed);
    default: return QProxyStyle::standardIcon(standard, option, widget);
    }
}

int FlatStyle::pixelMetric(PixelMetric metric, const QStyleOption *option, const QWidget *widget) const
{
    switch (metric) {
    case PM_SplitterWidth: return 1; // QSplitter widens the grip of a 1-pixel handle by itself
    case PM_HeaderMargin: return HeaderMargin;
    case PM_FocusFrameHMargin: return HeaderMargin - 2; // left and right of a cell's text, and of its icon
    case PM_ToolBarItemMargin:
    case PM_ToolBarItemSpacing: return 4;
    case PM_ScrollBarExtent: return 12;
    case PM_ToolBarFrameWidth:
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
    case SH_DitherDisabledText:
    case SH_DialogButtonBox_ButtonsHaveIcons: return 0;
    default: return QProxyStyle::styleHint(hint, option, widget, returnData);
    }
}

} // namespace dynascope
