// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/tracedelegate.h"

#include "ui/common/icons.h"
#include "ui/common/theme.h"
#include "ui/plot/tracecolors.h"
#include "ui/plot/tracemodel.h"

#include <QAbstractItemView>
#include <QHelpEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QToolTip>

namespace dynascope {

namespace {

constexpr int RowMargin = 8;
constexpr int IconSize = 16;
constexpr int SwatchWidth = 4;

QFont smallFont(QFont font)
{
    font.setPointSizeF(font.pointSizeF() * 0.9);
    return font;
}

/// Upright, with the pattern of the line.
void paintSwatch(QPainter &painter, const QRectF &box, int dash)
{
    if (dash == 0) {
        painter.drawRoundedRect(box, 2, 2);
        return;
    }
    qreal begin = box.top();
    for (qreal y = box.top(); y <= box.bottom(); ++y) {
        const bool hasInk = y < box.bottom() && traceInk(dash, static_cast<std::int64_t>(y - box.top()), 1);
        if (hasInk)
            continue;
        if (y > begin)
            painter.drawRect(QRectF(box.left(), begin, box.width(), y - begin));
        begin = y + 1;
    }
}

} // namespace

QRect TraceDelegate::eyeRect(const QRect &row)
{
    return {row.right() - 2 * (IconSize + RowMargin) + 1, row.top() + (row.height() - IconSize) / 2, IconSize, IconSize};
}

QRect TraceDelegate::removeRect(const QRect &row)
{
    return eyeRect(row).translated(IconSize + RowMargin, 0);
}

QSize TraceDelegate::sizeHint(const QStyleOptionViewItem &option, const QModelIndex &) const
{
    const int first = QFontMetrics(option.font).height();
    const int second = QFontMetrics(smallFont(option.font)).height();
    return {200, first + second + RowMargin};
}

void TraceDelegate::paint(QPainter *painter, const QStyleOptionViewItem &option, const QModelIndex &index) const
{
    painter->save();
    const ThemeColors &theme = colors(option.palette);
    const bool isSelected = option.state.testFlag(QStyle::State_Selected);
    const bool isHot = option.state.testFlag(QStyle::State_MouseOver) || isSelected;
    if (isHot) { // a tint only: the trace's own colour must show on it
        QColor tint = theme.accent;
        tint.setAlphaF(isSelected ? 0.18F : 0.07F);
        painter->fillRect(option.rect, tint);
    }
    const bool isVisible = index.data(Qt::CheckStateRole).toInt() == Qt::Checked;
    const bool isGone = index.data(TraceModel::GoneRole).toBool();
    const QColor text = option.palette.color(QPalette::Text);
    const QColor dimmed = theme.dimmed;
    const QRect row = option.rect;

    QColor swatch = traceColor(index.data(TraceModel::ColorIndexRole).toInt(), option.palette);
    if (isGone || !isVisible)
        swatch.setAlphaF(0.35F);
    painter->setRenderHint(QPainter::Antialiasing);
    painter->setPen(Qt::NoPen);
    painter->setBrush(swatch);
    paintSwatch(*painter, QRectF(row.left() + RowMargin, row.top() + 6, SwatchWidth, row.height() - 12),
        dashOf(index.data(TraceModel::ColorIndexRole).toInt()));

    const QFont small = smallFont(option.font);
    const QFont numbers = numberFont(option.font);
    const int left = row.left() + 2 * RowMargin + SwatchWidth;
    const int right = eyeRect(row).left() - RowMargin;
    const int firstHeight = QFontMetrics(option.font).height();
    const int top = row.top() + RowMargin / 2;
    const QString unit = index.data(TraceModel::UnitRole).toString();
    QString value = index.data(TraceModel::ValueRole).toString();
    if (value.isEmpty())
        value = QStringLiteral("–");

    // The unit has a place of its own, wide enough for most, so that numbers stand under each other.
    const int unitWidth =
        qMax(QFontMetrics(small).horizontalAdvance(QStringLiteral("mA")), QFontMetrics(small).horizontalAdvance(unit));
    const int valueWidth = QFontMetrics(numbers).horizontalAdvance(value);
    const QRect valueRect(right - unitWidth - 4 - valueWidth, top, valueWidth, firstHeight);
    painter->setFont(numbers);
    painter->setPen(isGone || !isVisible ? dimmed : text);
    painter->drawText(valueRect, Qt::AlignRight | Qt::AlignVCenter, value);
    painter->setFont(small);
    painter->setPen(dimmed);
    painter->drawText(QRect(right - unitWidth, top, unitWidth, firstHeight), Qt::AlignLeft | Qt::AlignVCenter, unit);

    painter->setFont(option.font);
    painter->setPen(isGone || !isVisible ? dimmed : text);
    const QRect nameRect(left, top, qMax(0, valueRect.left() - RowMargin - left), firstHeight);
    painter->drawText(nameRect, Qt::AlignLeft | Qt::AlignVCenter,
        QFontMetrics(option.font)
            .elidedText(index.data(TraceModel::FieldRole).toString(), Qt::ElideMiddle, nameRect.width()));
    painter->setFont(small);
    painter->setPen(dimmed);
    const QRect deviceRect(left, top + firstHeight, right - left, QFontMetrics(small).height());
    QString device = index.data(TraceModel::DeviceRole).toString();
    if (const QString note = index.data(TraceModel::NoteRole).toString(); !note.isEmpty())
        device += QStringLiteral(" · ") + note;
    painter->drawText(deviceRect, Qt::AlignLeft | Qt::AlignVCenter,
        QFontMetrics(small).elidedText(device, Qt::ElideMiddle, deviceRect.width()));

    paintIcon(painter, eyeRect(row), isVisible ? QStringLiteral("eye") : QStringLiteral("eye-off"), dimmed);
    if (isHot)
        paintIcon(painter, removeRect(row), QStringLiteral("close"), dimmed);
    painter->restore();
}

bool TraceDelegate::editorEvent(
    QEvent *event, QAbstractItemModel *model, const QStyleOptionViewItem &option, const QModelIndex &index)
{
    if (event->type() == QEvent::KeyPress)
        return QStyledItemDelegate::editorEvent(event, model, option, index);
    const auto *mouse = dynamic_cast<QMouseEvent *>(event);
    if (!mouse || mouse->button() != Qt::LeftButton)
        return false;
    const QPoint at = mouse->position().toPoint();
    const bool isEye = eyeRect(option.rect).adjusted(-4, -8, 4, 8).contains(at);
    const bool isRemove = removeRect(option.rect).adjusted(-4, -8, 4, 8).contains(at);
    if (event->type() == QEvent::MouseButtonRelease) {
        if (isEye)
            model->setData(index, index.data(Qt::CheckStateRole).toInt() == Qt::Checked ? Qt::Unchecked : Qt::Checked,
                Qt::CheckStateRole);
        else if (isRemove)
            emit removeRequested(index);
    }
    return isEye || isRemove;
}

bool TraceDelegate::helpEvent(
    QHelpEvent *event, QAbstractItemView *view, const QStyleOptionViewItem &option, const QModelIndex &index)
{
    const bool isEye = eyeRect(option.rect).contains(event->pos());
    if (event->type() != QEvent::ToolTip || (!isEye && !removeRect(option.rect).contains(event->pos())))
        return QStyledItemDelegate::helpEvent(event, view, option, index);
    const bool isVisible = index.data(Qt::CheckStateRole).toInt() == Qt::Checked;
    const QString text = !isEye ? tr("Remove from the plot (Del)")
        : isVisible             ? tr("Hide this trace (Space)")
                                : tr("Show this trace (Space)");
    QToolTip::showText(event->globalPos(), text, view);
    return true;
}

} // namespace dynascope
