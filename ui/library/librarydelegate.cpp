// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/library/librarydelegate.h"

#include "ui/common/flatcontrols.h"
#include "ui/common/theme.h"
#include "ui/table/cellpainter.h"

#include <QIcon>
#include <QPainter>

namespace dynascope {
namespace {

constexpr int IconSize = 14;

} // namespace

QSize LibraryDelegate::sizeHint(const QStyleOptionViewItem &, const QModelIndex &) const
{
    return {0, RowHeight};
}

void LibraryDelegate::paint(QPainter *painter, const QStyleOptionViewItem &option, const QModelIndex &index) const
{
    painter->save();
    const ThemeColors &theme = colors(option.palette);
    const bool isSelected = option.state.testFlag(QStyle::State_Selected);
    const QColor base = option.palette.color(QPalette::Base);
    if (isSelected || option.state.testFlag(QStyle::State_MouseOver))
        painter->fillRect(option.rect, blend(base, theme.accent, isSelected ? 0.16F : 0.06F));
    const QVariant font = index.data(Qt::FontRole);
    painter->setFont(font.isValid() ? font.value<QFont>() : option.font);
    QRect rect = option.rect.adjusted(CellMargin, 0, -CellMargin, 0);
    const QIcon icon = index.data(Qt::DecorationRole).value<QIcon>();
    const QString text = index.data(Qt::DisplayRole).toString();
    painter->setPen(index.data(MarkedRole).toBool() ? theme.accent
                                                    : option.palette.color(QPalette::Active, QPalette::Text));
    const int room = rect.width() - (icon.isNull() ? 0 : IconSize + 6);
    const QString shown = painter->fontMetrics().elidedText(text, Qt::ElideMiddle, room);
    const int alignment = index.data(Qt::TextAlignmentRole).toInt() | Qt::TextSingleLine;
    painter->drawText(rect, alignment, shown);
    if (!icon.isNull()) { // behind the text: names stay below each other
        const int left = rect.left() + painter->fontMetrics().horizontalAdvance(shown) + 6;
        icon.paint(painter, QRect(left, rect.center().y() - IconSize / 2 + 1, IconSize, IconSize));
    }
    painter->restore();
}

} // namespace dynascope
