// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/health/healthdelegate.h"

#include "ui/common/flatcontrols.h"
#include "ui/common/icons.h"
#include "ui/common/theme.h"
#include "ui/health/healthmodel.h"
#include "ui/table/cellpainter.h"

#include <QPainter>

#include <algorithm>
#include <cmath>

namespace dynascope {
namespace {

constexpr int Margin = 6;
constexpr int SignSize = 14;
constexpr int LeastBar = 24;
constexpr int WidestBar = 200;
constexpr int BarHeight = 6;
constexpr double SmallestShare = 1e-4;
constexpr double Decades = 4;

struct Sign {
    const char *icon;
    QColor color;
};

Sign signOf(Verdict verdict, const ThemeColors &theme)
{
    switch (verdict) {
    case Verdict::Bad: return {"error", theme.bad};
    case Verdict::Poor: return {"warning", theme.warning};
    case Verdict::Good: return {"check", theme.good};
    case Verdict::Unknown: break;
    }
    return {nullptr, theme.dimmed};
}

} // namespace

double HealthDelegate::barPart(double share)
{
    if (share <= SmallestShare)
        return 0;
    return std::clamp(1 + std::log10(share) / Decades, 0.0, 1.0);
}

int HealthDelegate::widthOf(int column, const QFont &font)
{
    const auto kind = static_cast<HealthColumn>(column);
    QFont figures = numberFont(font);
    figures.setWeight(QFont::DemiBold); // the line's row
    const int digits = QFontMetrics(figures).horizontalAdvance(widestHealthCell(kind));
    const int heading = QFontMetrics(font).horizontalAdvance(healthHeading(kind)) + 2 * CellMargin + 1;
    const int extra = kind == HealthColumn::Bad ? SignSize + LeastBar + 2 * Margin : 0;
    return std::max(digits + extra + 2 * Margin, heading);
}

QSize HealthDelegate::sizeHint(const QStyleOptionViewItem &option, const QModelIndex &index) const
{
    return {widthOf(index.column(), option.font), option.fontMetrics.height() + 8};
}

void HealthDelegate::paint(QPainter *painter, const QStyleOptionViewItem &option, const QModelIndex &index) const
{
    painter->save();
    const ThemeColors &theme = colors(option.palette);
    const bool isLine = index.data(HealthModel::LineRole).toBool();
    const bool isSelected = option.state.testFlag(QStyle::State_Selected);
    const QColor base = option.palette.color(QPalette::Base);
    if (isSelected || option.state.testFlag(QStyle::State_MouseOver))
        painter->fillRect(option.rect, blend(base, theme.accent, isSelected ? 0.16F : 0.06F));
    else if (isLine)
        painter->fillRect(option.rect, theme.header);
    if (isLine) {
        painter->setPen(theme.border);
        painter->drawLine(option.rect.topLeft(), option.rect.topRight());
    }
    if (option.state.testFlag(QStyle::State_HasFocus) && option.state.testFlag(QStyle::State_Active)) {
        painter->setPen(theme.accent);
        painter->drawRect(option.rect.adjusted(1, 1, -2, -2));
    }
    const auto column = static_cast<HealthColumn>(index.column());
    QFont font = column == HealthColumn::Name ? option.font : numberFont(option.font);
    if (isLine)
        font.setWeight(QFont::DemiBold);
    painter->setFont(font);
    const QString text = index.data(Qt::DisplayRole).toString();
    const bool isNothing = text == QStringLiteral("0") || text == QStringLiteral("–");
    painter->setPen(isNothing ? theme.dimmed : option.palette.color(QPalette::Active, QPalette::Text));
    const QRect rect = option.rect.adjusted(column == HealthColumn::Name ? CellMargin : Margin, 0, -CellMargin, 0);
    painter->drawText(rect, index.data(Qt::TextAlignmentRole).toInt() | Qt::TextSingleLine,
        painter->fontMetrics().elidedText(text, Qt::ElideMiddle, rect.width()));
    if (column == HealthColumn::Bad)
        paintShare(painter, option, index);
    painter->restore();
}

void HealthDelegate::paintShare(QPainter *painter, const QStyleOptionViewItem &option, const QModelIndex &index)
{
    const ThemeColors &theme = colors(option.palette);
    const Sign sign = signOf(static_cast<Verdict>(index.data(HealthModel::VerdictRole).toInt()), theme);
    if (!sign.icon)
        return;
    const int middle = option.rect.center().y() + 1;
    const int left = option.rect.left() + Margin;
    paintIcon(painter, QRectF(left, middle - SignSize / 2.0, SignSize, SignSize), QLatin1String(sign.icon), sign.color);
    const int digits = painter->fontMetrics().horizontalAdvance(widestHealthCell(HealthColumn::Bad));
    const int room = option.rect.width() - SignSize - digits - 4 * Margin;
    if (room < LeastBar / 2)
        return; // sign and number say it
    const int width = std::min(room, WidestBar);
    const QRectF track(left + SignSize + Margin, middle - BarHeight / 2.0, width, BarHeight);
    painter->setRenderHint(QPainter::Antialiasing);
    painter->setPen(Qt::NoPen);
    painter->setBrush(theme.grid);
    painter->drawRoundedRect(track, BarHeight / 2.0, BarHeight / 2.0);
    QRectF filled = track;
    filled.setWidth(width * barPart(index.data(HealthModel::ShareRole).toDouble()));
    if (filled.width() >= 1) {
        painter->setBrush(sign.color);
        painter->drawRoundedRect(filled, BarHeight / 2.0, BarHeight / 2.0);
    }
    painter->setRenderHint(QPainter::Antialiasing, false);
    painter->setPen(theme.dimmed);
    for (const double mark : {0.001, 0.01}) { // where poor and bad begin
        const int x = qRound(track.left() + width * barPart(mark));
        painter->drawLine(x, middle - BarHeight / 2 - 2, x, middle + BarHeight / 2 + 1);
    }
}

} // namespace dynascope
