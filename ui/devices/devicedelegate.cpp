// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/devices/devicedelegate.h"

#include "ui/common/icons.h"
#include "ui/common/theme.h"
#include "ui/devices/devicetreemodel.h"

#include <QApplication>
#include <QPainter>

namespace dynascope {

namespace {

constexpr int Margin = 8;
constexpr int IconSize = 20;
constexpr int SmallIconSize = 16;

/// The colours of one row, selected or not.
struct Inks {
    QColor text, dimmed, warning, good;
};

Inks inksOf(const QStyleOptionViewItem &option, bool dimmedRow)
{
    const bool active = option.state & QStyle::State_Active;
    const bool selected = option.state & QStyle::State_Selected;
    const ThemeColors &theme = colors(option.palette);
    if (selected) {
        const QColor text =
            option.palette.color(active ? QPalette::Active : QPalette::Inactive, QPalette::HighlightedText);
        return {text, text, text, text};
    }
    const QColor text = option.palette.color(QPalette::Active, QPalette::Text);
    return {dimmedRow ? theme.dimmed : text, theme.dimmed, theme.warning, dimmedRow ? theme.dimmed : theme.good};
}

QFont smaller(QFont font)
{
    if (font.pointSizeF() > 0)
        font.setPointSizeF(qMax(7.0, font.pointSizeF() * 0.9));
    return font;
}

void drawText(QPainter *painter, const QRect &rect, const QString &text, Qt::TextElideMode mode = Qt::ElideMiddle)
{
    const QString elided = painter->fontMetrics().elidedText(text, mode, rect.width());
    painter->drawText(rect, Qt::AlignVCenter | Qt::AlignLeft | Qt::TextSingleLine, elided);
}

/// A pill with the ID at the right end of `rect`; its width.
int drawId(QPainter *painter, const QRect &rect, const QFont &base, int id, const QColor &ink)
{
    const QFont font = numberFont(base);
    const QFontMetrics metrics(font);
    const QString text = DeviceDelegate::tr("ID %1").arg(id);
    const int width = metrics.horizontalAdvance(DeviceDelegate::tr("ID %1").arg(252)) + 12; // equal in all rows
    const QRect pill(rect.right() - width + 1, rect.top(), width, metrics.height() + 4);
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    QColor border = ink;
    border.setAlphaF(0.45F);
    painter->setPen(QPen(border, 1));
    painter->setBrush(Qt::NoBrush);
    painter->drawRoundedRect(QRectF(pill).adjusted(0.5, 0.5, -0.5, -0.5), 4, 4);
    painter->setPen(ink);
    painter->setFont(font);
    painter->drawText(pill, Qt::AlignCenter, text);
    painter->restore();
    return width;
}

} // namespace

void DeviceDelegate::paint(QPainter *painter, const QStyleOptionViewItem &option, const QModelIndex &index) const
{
    QStyleOptionViewItem row = option;
    initStyleOption(&row, index);
    const QStyle *style = row.widget ? row.widget->style() : QApplication::style();
    style->drawPrimitive(QStyle::PE_PanelItemViewItem, &row, painter, row.widget);
    painter->save();
    painter->setClipRect(row.rect);
    if (static_cast<DeviceTreeModel::Kind>(index.data(DeviceTreeModel::KindRole).toInt())
        == DeviceTreeModel::Kind::Device)
        paintDevice(painter, row, index);
    else
        paintHeading(painter, row, index);
    painter->restore();
}

void DeviceDelegate::paintHeading(QPainter *painter, const QStyleOptionViewItem &option, const QModelIndex &index) const
{
    const auto kind = static_cast<DeviceTreeModel::Kind>(index.data(DeviceTreeModel::KindRole).toInt());
    const bool isLine = kind == DeviceTreeModel::Kind::Line;
    const bool dimmed = index.data(DeviceTreeModel::DimmedRole).toBool();
    const Inks inks = inksOf(option, dimmed);
    QRect rect = option.rect.adjusted(2, 0, -Margin, 0);
    const QString name = isLine ? QStringLiteral("bus")
        : index.data(DeviceTreeModel::WorkingRole).toBool() ? QStringLiteral("baud") : QStringLiteral("parked");
    paintIcon(painter, QRectF(rect.left(), rect.center().y() - SmallIconSize / 2.0 + 0.5, SmallIconSize, SmallIconSize),
              name, isLine ? inks.text : inks.dimmed);
    rect.setLeft(rect.left() + SmallIconSize + 6);

    QFont font = isLine ? option.font : smaller(option.font);
    font.setBold(isLine);
    painter->setFont(font);
    const QString title = index.data(Qt::DisplayRole).toString();
    painter->setPen(isLine ? inks.text : inks.dimmed);
    drawText(painter, rect, title);
    const int used = painter->fontMetrics().horizontalAdvance(title) + Margin;
    if (isLine && !dimmed)
        return; // its state is in the connection bar
    rect.setLeft(rect.left() + used);
    if (rect.width() < 24)
        return;
    painter->setFont(smaller(option.font));
    painter->setPen(isLine && dimmed ? inks.warning : inks.dimmed);
    drawText(painter, rect,
        (isLine ? QString() : QStringLiteral("· ")) + index.data(DeviceTreeModel::SubtitleRole).toString(),
        Qt::ElideRight);
}

void DeviceDelegate::paintDevice(QPainter *painter, const QStyleOptionViewItem &option, const QModelIndex &index) const
{
    const bool dimmed = index.data(DeviceTreeModel::DimmedRole).toBool();
    const QString alert = index.data(DeviceTreeModel::AlertRole).toString();
    const QVariant torque = index.data(DeviceTreeModel::TorqueRole);
    const Inks inks = inksOf(option, dimmed);
    QRect rect = option.rect.adjusted(2, 5, -Margin, -5);

    QString name = QStringLiteral("servo");
    QColor ink = dimmed ? inks.dimmed : inks.text;
    if (!alert.isEmpty()) {
        name = QStringLiteral("warning");
        ink = inks.warning;
    } else if (!dimmed && torque.toBool()) {
        name = QStringLiteral("torque");
        ink = inks.good;
    }
    paintIcon(painter, QRectF(rect.left(), rect.center().y() - IconSize / 2.0 + 0.5, IconSize, IconSize), name, ink);
    rect.setLeft(rect.left() + IconSize + Margin);

    const int idWidth =
        drawId(painter, rect, smaller(option.font), index.data(DeviceTreeModel::IdRole).toInt(), inks.dimmed);
    const int half = rect.height() / 2;
    const QRect top(rect.left(), rect.top(), rect.width() - idWidth - Margin, half);
    const QRect bottom(rect.left(), rect.top() + half, rect.width(), rect.height() - half);
    QFont font = option.font;
    font.setWeight(QFont::DemiBold);
    painter->setFont(font);
    painter->setPen(inks.text);
    drawText(painter, top, index.data(Qt::DisplayRole).toString());
    painter->setFont(smaller(option.font));
    painter->setPen(alert.isEmpty() ? inks.dimmed : inks.warning);
    drawText(painter, bottom, index.data(DeviceTreeModel::SubtitleRole).toString(), Qt::ElideRight);
}

QSize DeviceDelegate::sizeHint(const QStyleOptionViewItem &option, const QModelIndex &index) const
{
    const int line = option.fontMetrics.height();
    const auto kind = static_cast<DeviceTreeModel::Kind>(index.data(DeviceTreeModel::KindRole).toInt());
    const int height = kind == DeviceTreeModel::Kind::Device ? 2 * line + 14 : line + 12;
    return {160, height};
}

} // namespace dynascope
