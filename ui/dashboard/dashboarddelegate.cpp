// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/dashboard/dashboarddelegate.h"

#include "ui/common/flatcontrols.h"
#include "ui/common/icons.h"
#include "ui/common/theme.h"
#include "ui/dashboard/alarmmodel.h"
#include "ui/dashboard/dashboardmodel.h"
#include "ui/table/cellpainter.h"

#include <QIcon>
#include <QPainter>

#include <algorithm>

namespace dynascope {
namespace {

constexpr int RowHeight = 24;
constexpr int SignSize = 14;
constexpr int Gap = 4;
constexpr int Bar = 48; ///< its usual width
constexpr int LeastBar = 16;
constexpr int WidestBar = 128;
constexpr int BarHeight = 6;
constexpr int MarkWidth = 4;

/// Numbers of a column line up whatever their unit.
int unitWidth(Vital vital, const QFont &font)
{
    const QFontMetrics metrics(font);
    switch (vital) {
    case Vital::Position: return metrics.horizontalAdvance(QStringLiteral(" turn"));
    case Vital::Load: return metrics.horizontalAdvance(QStringLiteral(" mA"));
    default: return metrics.horizontalAdvance(QStringLiteral(" °C"));
    }
}

struct Sign {
    const char *icon;
    QColor color;
};

Sign signOf(Severity severity, const ThemeColors &theme)
{
    switch (severity) {
    case Severity::Fault: return {"error", theme.bad};
    case Severity::Silent: return {"disconnect", theme.bad};
    case Severity::Over: return {"error", theme.bad};
    case Severity::Near: return {"warning", theme.warning};
    case Severity::Good: return {"check", theme.good};
    case Severity::Unknown: break;
    }
    return {"parked", theme.dimmed};
}

Sign signOf(AlarmLevel level, const ThemeColors &theme)
{
    switch (level) {
    case AlarmLevel::Over: return {"error", theme.bad};
    case AlarmLevel::Near: return {"warning", theme.warning};
    case AlarmLevel::None: break;
    }
    return {nullptr, theme.accent};
}

void paintSign(QPainter *painter, int left, int middle, const Sign &sign)
{
    const int top = middle - SignSize / 2;
    if (sign.icon)
        paintIcon(painter, QRectF(left, top, SignSize, SignSize), QLatin1String(sign.icon), sign.color);
}

/// From the left what is used up, or, where both ends are limits, a mark.
void paintBar(QPainter *painter, const QRectF &track, double part, bool isMark, const QColor &color,
              const QColor &quiet)
{
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    painter->setPen(Qt::NoPen);
    painter->setBrush(quiet);
    painter->drawRoundedRect(track, BarHeight / 2.0, BarHeight / 2.0);
    painter->setBrush(color);
    const double at = std::clamp(part, 0.0, 1.0);
    if (isMark) {
        const double left = track.left() + at * (track.width() - MarkWidth);
        painter->drawRoundedRect(QRectF(left, track.top() - 2, MarkWidth, BarHeight + 4), 2, 2);
    } else if (at * track.width() >= 1) {
        painter->setClipRect(QRectF(track.topLeft(), QSizeF(at * track.width(), track.height())));
        painter->drawRoundedRect(track, BarHeight / 2.0, BarHeight / 2.0);
    }
    painter->restore();
}

void paintBackground(QPainter *painter, const QStyleOptionViewItem &option, const ThemeColors &theme)
{
    const bool isSelected = option.state.testFlag(QStyle::State_Selected);
    if (isSelected || option.state.testFlag(QStyle::State_MouseOver)) {
        const QColor base = option.palette.color(QPalette::Base);
        painter->fillRect(option.rect, blend(base, theme.accent, isSelected ? 0.16F : 0.06F));
    }
}

} // namespace

int DashboardDelegate::widthOf(DashboardColumn column, const QFont &font)
{
    const QFontMetrics words(font);
    const int heading = words.horizontalAdvance(dashboardHeading(column)) + 2 * CellMargin;
    const QFontMetrics figures(numberFont(font));
    if (column == DashboardColumn::Id)
        return std::max(heading, figures.horizontalAdvance(QStringLiteral("252")) + 2 * CellMargin);
    if (column == DashboardColumn::Device)
        return SignSize + Gap + words.horizontalAdvance(QStringLiteral("XM430-W350-T")) + 2 * CellMargin;
    if (column == DashboardColumn::State)
        return words.horizontalAdvance(QStringLiteral("Does not answer")) + 2 * CellMargin;
    const int number = figures.horizontalAdvance(widestNumber(*vitalOf(column)));
    return std::max(heading,
                    CellMargin + SignSize + Gap + Bar + Gap + number + unitWidth(*vitalOf(column), font) + CellMargin);
}

QSize DashboardDelegate::sizeHint(const QStyleOptionViewItem &option, const QModelIndex &index) const
{
    return {widthOf(static_cast<DashboardColumn>(index.column()), option.font),
            std::max(RowHeight, option.fontMetrics.height() + 8)};
}

void DashboardDelegate::paint(QPainter *painter, const QStyleOptionViewItem &option, const QModelIndex &index) const
{
    painter->save();
    const ThemeColors &theme = colors(option.palette);
    paintBackground(painter, option, theme);
    const auto column = static_cast<DashboardColumn>(index.column());
    const auto severity = static_cast<Severity>(index.data(DashboardModel::SeverityRole).toInt());
    const QColor text = option.palette.color(QPalette::Active, QPalette::Text);
    if (const auto vital = vitalOf(column)) {
        paintVital(painter, option, index, *vital);
    } else {
        QRect rect = option.rect.adjusted(CellMargin, 0, -CellMargin, 0);
        if (column == DashboardColumn::Device) {
            paintSign(painter, rect.left(), rect.center().y() + 1, signOf(severity, theme));
            rect.setLeft(rect.left() + SignSize + Gap);
        }
        const bool isFault = index.data(DashboardModel::LevelRole).toInt() != static_cast<int>(AlarmLevel::None);
        painter->setFont(column == DashboardColumn::Id ? numberFont(option.font) : option.font);
        const bool isQuiet = severity == Severity::Unknown
                             || (column == DashboardColumn::State && !isFault && severity != Severity::Silent);
        painter->setPen(isFault ? theme.bad : isQuiet ? theme.dimmed : text);
        painter->drawText(rect, index.data(Qt::TextAlignmentRole).toInt() | Qt::TextSingleLine,
                          painter->fontMetrics().elidedText(index.data().toString(), Qt::ElideMiddle, rect.width()));
    }
    if (option.state.testFlag(QStyle::State_HasFocus) && option.state.testFlag(QStyle::State_Active)) {
        painter->setPen(theme.accent);
        painter->drawRect(option.rect.adjusted(1, 1, -2, -2));
    }
    painter->restore();
}

void DashboardDelegate::paintVital(QPainter *painter, const QStyleOptionViewItem &option, const QModelIndex &index,
                                   Vital vital)
{
    const ThemeColors &theme = colors(option.palette);
    const Sign sign = signOf(static_cast<AlarmLevel>(index.data(DashboardModel::LevelRole).toInt()), theme);
    QRect rect = option.rect.adjusted(CellMargin, 0, -CellMargin, 0);
    paintSign(painter, rect.left(), rect.center().y() + 1, sign);
    rect.setLeft(rect.left() + SignSize + Gap);

    const QFont figures = numberFont(option.font);
    const int unitLane = unitWidth(vital, figures);
    const int number = QFontMetrics(figures).horizontalAdvance(widestNumber(vital));
    const QString value = index.data(DashboardModel::NumberRole).toString();
    const QRect unitRect(rect.right() + 1 - unitLane, rect.top(), unitLane, rect.height());
    const QRect numberRect(rect.left(), rect.top(), rect.width() - unitLane, rect.height());
    painter->setFont(figures);
    painter->setPen(value.isEmpty() ? theme.dimmed : option.palette.color(QPalette::Active, QPalette::Text));
    painter->drawText(numberRect, Qt::AlignRight | Qt::AlignVCenter | Qt::TextSingleLine,
                      value.isEmpty() ? QStringLiteral("–") : value);
    painter->setPen(theme.dimmed);
    painter->drawText(unitRect, Qt::AlignLeft | Qt::AlignVCenter | Qt::TextSingleLine,
                      u' ' + index.data(DashboardModel::UnitRole).toString());

    const QVariant part = index.data(DashboardModel::PartRole);
    const int used = std::max(number, painter->fontMetrics().horizontalAdvance(value));
    const int room = std::min(numberRect.width() - used - Gap, WidestBar);
    if (!part.isValid() || room < LeastBar)
        return; // the number says it
    const int top = rect.center().y() + 1 - BarHeight / 2;
    const QRectF track(rect.left(), top, room, BarHeight);
    const bool isMark = vital == Vital::Position || vital == Vital::Voltage;
    paintBar(painter, track, part.toDouble(), isMark, sign.color, theme.grid);
}

QSize AlarmDelegate::sizeHint(const QStyleOptionViewItem &option, const QModelIndex &index) const
{
    const QSize size = QStyledItemDelegate::sizeHint(option, index);
    return {size.width(), std::max(RowHeight, option.fontMetrics.height() + 8)};
}

void AlarmDelegate::paint(QPainter *painter, const QStyleOptionViewItem &option, const QModelIndex &index) const
{
    painter->save();
    const ThemeColors &theme = colors(option.palette);
    paintBackground(painter, option, theme);
    QRect rect = option.rect.adjusted(CellMargin, 0, -CellMargin, 0);
    if (const auto sign = index.data(Qt::DecorationRole).value<QIcon>(); !sign.isNull()) {
        sign.paint(painter, rect.left(), rect.center().y() + 1 - SignSize / 2, SignSize, SignSize);
        rect.setLeft(rect.left() + SignSize + Gap);
    }
    const auto column = static_cast<AlarmColumn>(index.column());
    const bool isTime = column == AlarmColumn::Time || column == AlarmColumn::Cleared;
    painter->setFont(isTime ? numberFont(option.font) : option.font);
    painter->setPen(index.data(AlarmModel::ActiveRole).toBool() ? option.palette.color(QPalette::Active, QPalette::Text)
                                                                : theme.dimmed);
    painter->drawText(rect, Qt::AlignLeft | Qt::AlignVCenter | Qt::TextSingleLine,
                      painter->fontMetrics().elidedText(index.data().toString(), Qt::ElideMiddle, rect.width()));
    painter->restore();
}

} // namespace dynascope
