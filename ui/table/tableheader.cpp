// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/tableheader.h"

#include "ui/common/theme.h"
#include "ui/table/cellpainter.h"

#include <QPainter>

namespace dynascope {

TableHeader::TableHeader(QWidget *parent)
    : QHeaderView(Qt::Horizontal, parent)
{
    setStretchLastSection(true);
    setSectionsMovable(false);
    setMinimumSectionSize(36);
    setHighlightSections(false);
}

QSize TableHeader::sizeHint() const
{
    return {QHeaderView::sizeHint().width(), fontMetrics().height() + 10};
}

void TableHeader::paintSection(QPainter *painter, const QRect &rect, int section) const
{
    const ThemeColors &theme = colors(palette());
    painter->fillRect(rect, theme.header);
    painter->setPen(theme.border);
    painter->drawLine(rect.bottomLeft(), rect.bottomRight());
    if (section + 1 < count()) // where the mouse can pull
        painter->drawLine(rect.right(), rect.top() + 6, rect.right(), rect.bottom() - 6);
    const auto said = [&](int role) { return model()->headerData(section, orientation(), role); };
    const auto alignment = static_cast<Qt::Alignment>(said(Qt::TextAlignmentRole).toInt());
    const int margin = alignment & Qt::AlignHCenter ? 0 : CellMargin;
    const QRect text = rect.adjusted(margin, 0, -margin, 0);
    painter->setPen(theme.dimmed);
    painter->drawText(text, static_cast<int>(alignment) | Qt::TextSingleLine,
                      fontMetrics().elidedText(said(Qt::DisplayRole).toString(), Qt::ElideMiddle, text.width()));
}

} // namespace dynascope
