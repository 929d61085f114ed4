// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/cellpainter.h"

#include "ui/common/icons.h"
#include "ui/common/theme.h"

#include <QPainter>
#include <QStyle>
#include <QWidget>

#include <algorithm>

namespace dynascope {
namespace {

constexpr int IconSize = 14;
constexpr int TickSize = 14;

struct Ink {
    QColor text, dimmed, accent, bad;
};

Ink inkFor(const QStyleOptionViewItem &option)
{
    // Selected rows are tinted lightly (see TableView::drawRow): every ink stays readable on them.
    const ThemeColors &theme = colors(option.palette);
    return {option.palette.color(QPalette::Active, QPalette::Text), theme.dimmed, theme.accent, theme.bad};
}

/// Writes `text` at the right end of `rect` and takes its width away from it.
void takeRight(QPainter *painter, QRect &rect, const QString &text, const QColor &color)
{
    const QFontMetrics metrics = painter->fontMetrics();
    painter->setPen(color);
    painter->drawText(rect, Qt::AlignRight | Qt::AlignVCenter | Qt::TextSingleLine,
                      metrics.elidedText(text, Qt::ElideMiddle, rect.width()));
    rect.setRight(rect.right() - metrics.horizontalAdvance(text));
}

/// Marks at the left edge: they must not move the digits.
void paintMark(QPainter *painter, QRect &rect, const QModelIndex &index, const Ink &ink, FieldState state)
{
    const QRect mark(rect.left(), rect.center().y() - IconSize / 2, IconSize, IconSize);
    const ColumnKind kind = kindAt(index);
    if (state == FieldState::Failed && kind != ColumnKind::Physical) { // once a row and device
        paintIcon(painter, mark, QStringLiteral("warning"), ink.bad);
    } else if (kind == ColumnKind::Device && index.data(DiffersRole).toBool()) {
        painter->setPen(ink.accent);
        painter->drawText(mark, Qt::AlignCenter, QString(QChar(0x2260)));
    } else {
        return;
    }
    rect.setLeft(mark.right() + 4);
}

/// No register: an empty cell that looks as if nothing could stand there.
void paintAbsent(QPainter *painter, const QStyleOptionViewItem &option)
{
    QColor line = colors(option.palette).border;
    line.setAlphaF(0.55F);
    painter->fillRect(option.rect, QBrush(line, Qt::BDiagPattern));
}

/// They differ: in words, and not looking like a value.
void paintMixed(QPainter *painter, const QStyleOptionViewItem &option, const QString &text)
{
    QFont italic = option.font;
    italic.setItalic(true);
    painter->save();
    painter->setFont(italic);
    painter->setPen(inkFor(option).dimmed);
    painter->drawText(option.rect.adjusted(CellMargin, 0, -CellMargin, 0),
                      Qt::AlignLeft | Qt::AlignVCenter | Qt::TextSingleLine, text);
    painter->restore();
}

} // namespace

QColor selectionTint(const QPalette &palette)
{
    const QColor base = palette.color(QPalette::Active, QPalette::Base);
    const ThemeColors &theme = colors(palette);
    const float share = theme.dark ? 0.22F : 0.13F;
    return QColor::fromRgbF(base.redF() + (theme.accent.redF() - base.redF()) * share,
                            base.greenF() + (theme.accent.greenF() - base.greenF()) * share,
                            base.blueF() + (theme.accent.blueF() - base.blueF()) * share);
}

int unitLaneWidth(const QFont &font)
{
    const QFontMetrics metrics(font);
    return std::max(metrics.horizontalAdvance(QStringLiteral("rev/min²")),
                    metrics.horizontalAdvance(QStringLiteral("pulse/ms")));
}

void paintCell(QPainter *painter, const QStyleOptionViewItem &option)
{
    const QStyle *style = option.widget ? option.widget->style() : nullptr;
    if (style)
        style->drawPrimitive(QStyle::PE_PanelItemViewItem, &option, painter, option.widget);
    if ((option.state & QStyle::State_HasFocus) && (option.state & QStyle::State_Active)) {
        painter->save();
        painter->setPen(inkFor(option).accent);
        painter->setBrush(Qt::NoBrush);
        painter->drawRect(option.rect.adjusted(1, 1, -2, -2));
        painter->restore();
    }
}

void paintValue(QPainter *painter, const QStyleOptionViewItem &option, const QModelIndex &index)
{
    if (!index.data(AbsentRole).toString().isEmpty())
        return paintAbsent(painter, option);
    if (index.data(MixedRole).toBool())
        return paintMixed(painter, option, index.data().toString());
    painter->save();
    const Ink ink = inkFor(option);
    const auto state = static_cast<FieldState>(index.data(StateRole).toInt());
    const double fade = index.data(FadeRole).toDouble();
    if (fade > 0) {
        QColor changed = colors(option.palette).changed;
        changed.setAlphaF(static_cast<float>(fade));
        painter->fillRect(option.rect, changed);
    }
    QRect rect = option.rect.adjusted(CellMargin, 0, -CellMargin, 0);
    const ColumnKind kind = kindAt(index);
    const QString number = index.data(NumberRole).toString();
    const QString whole = index.data(Qt::DisplayRole).toString();
    const QString pending = index.data(PendingTextRole).toString();
    paintMark(painter, rect, index, ink, state);
    const bool dim = state == FieldState::Stale || !pending.isEmpty();
    const QColor textColor = dim ? ink.dimmed : ink.text;

    QFont words = option.font;
    words.setBold(kind == ColumnKind::Device && index.data(DiffersRole).toBool());
    QFont digits = numberFont(option.font);
    digits.setBold(words.bold());
    if (whole.isEmpty() && state == FieldState::Unknown && kind != ColumnKind::Physical) {
        painter->setFont(digits);
        takeRight(painter, rect, QStringLiteral("–"), ink.dimmed);
    } else if (!number.isEmpty()) {
        if (kind != ColumnKind::Value) {
            QRect lane = rect;
            lane.setLeft(rect.right() + 1 - unitLaneWidth(option.font));
            painter->setFont(option.font);
            painter->setPen(ink.dimmed);
            painter->drawText(lane, Qt::AlignLeft | Qt::AlignVCenter, index.data(UnitRole).toString());
            rect.setRight(lane.left() - 5);
        }
        painter->setFont(digits);
        if (!pending.isEmpty()) {
            const QString next = kind == ColumnKind::Value ? pending : pending.section(u' ', 0, 0);
            takeRight(painter, rect, QStringLiteral(" → ") + next, ink.accent);
        }
        takeRight(painter, rect, number, textColor);
    } else {
        painter->setFont(words);
        const QString text = pending.isEmpty() ? whole : whole + QStringLiteral(" → ") + pending;
        painter->setPen(pending.isEmpty() ? textColor : ink.accent);
        painter->drawText(rect, Qt::AlignLeft | Qt::AlignVCenter | Qt::TextSingleLine,
                          painter->fontMetrics().elidedText(text, Qt::ElideRight, rect.width()));
    }
    painter->restore();
}

QRect plotTickRect(const QRect &cell)
{
    return QRect(cell.center().x() - TickSize / 2, cell.center().y() - TickSize / 2, TickSize, TickSize);
}

void paintPlotTick(QPainter *painter, const QStyleOptionViewItem &option, Qt::CheckState state)
{
    const Ink ink = inkFor(option);
    const QRectF box = QRectF(plotTickRect(option.rect)).adjusted(0.5, 0.5, -0.5, -0.5);
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    if (state == Qt::Unchecked) {
        painter->setPen(option.state & QStyle::State_Selected ? ink.dimmed : option.palette.color(QPalette::Mid));
        painter->setBrush(Qt::NoBrush);
        painter->drawRoundedRect(box, 3, 3);
    } else {
        painter->setPen(Qt::NoPen);
        painter->setBrush(ink.accent);
        painter->drawRoundedRect(box, 3, 3);
        painter->setBrush(Qt::NoBrush);
        const QColor tick = option.palette.color(QPalette::Base);
        paintIcon(painter, box.adjusted(1, 1, -1, -1),
                  state == Qt::Checked ? QStringLiteral("check") : QStringLiteral("minus"), tick);
    }
    painter->restore();
}

} // namespace dynascope
