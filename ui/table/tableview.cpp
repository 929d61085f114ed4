// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/tableview.h"

#include "ui/common/texts.h"
#include "ui/common/theme.h"
#include "ui/table/cellpainter.h"
#include "ui/table/fieldwordsmodel.h"
#include "ui/table/frozennames.h"
#include "ui/table/tableheader.h"

#include <QDrag>
#include <QKeyEvent>
#include <QMimeData>
#include <QPainter>

namespace dynascope {
namespace {

int defaultWidth(ColumnKind kind)
{
    switch (kind) {
    case ColumnKind::Name: return 190;
    case ColumnKind::Plot: return 38;
    case ColumnKind::Address: return 68;
    case ColumnKind::Value: return 70;
    case ColumnKind::Physical: return 164;
    case ColumnKind::Device:
    case ColumnKind::All: return 132;
    case ColumnKind::Default: return 66;
    case ColumnKind::Range: return 152; // both fit beside the plots; what is cut off stands in the tool tip
    case ColumnKind::Access: return 58;
    }
    return 80;
}

constexpr int WidestName = 256;  ///< longer ones elide: there is more to see
constexpr int WidestValue = 164; ///< and longer values, which have a tool tip
constexpr int WidestOfMany = 152; ///< of one device among several: more of them are to be seen at once
constexpr int ValueMark = 18;    ///< what a mark at the left of a value takes

} // namespace

TableView::TableView(QWidget *parent)
    : QTreeView(parent)
{
    setObjectName(QStringLiteral("tableView"));
    setAccessibleName(tr("Control table"));
    setFrameShape(QFrame::NoFrame);
    setUniformRowHeights(true);
    setAllColumnsShowFocus(false);
    setSelectionMode(QAbstractItemView::ExtendedSelection);
    setSelectionBehavior(QAbstractItemView::SelectRows);
    setEditTriggers(QAbstractItemView::DoubleClicked | QAbstractItemView::EditKeyPressed);
    setExpandsOnDoubleClick(true);
    setDragEnabled(true);
    setDragDropMode(QAbstractItemView::DragOnly);
    setTextElideMode(Qt::ElideMiddle);
    setContextMenuPolicy(Qt::CustomContextMenu);
    setIndentation(16);
    setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
    setHeader(new TableHeader(this)); // the view owns it
    new FrozenNames(*this);           // and this
    connect(header(), &QHeaderView::sectionResized, this, [this](int section, int, int size) {
        const bool isLast = section == header()->count() - 1;
        if (!m_applying && !isLast && model())
            m_widths[model()->headerData(section, Qt::Horizontal, KindRole).toInt()] = size;
    });
}

void TableView::makeRoomFor(const std::vector<const ControlTable *> &tables)
{
    m_needed.clear();
    const ControlTable *last = nullptr;
    for (const ControlTable *table : tables) {
        if (table != last)
            makeRoomFor(*table);
        last = table;
    }
}

void TableView::needRoom(ColumnKind kind, int width)
{
    int &known = m_needed[static_cast<int>(kind)];
    known = std::max(known, width);
}

void TableView::makeRoomFor(const ControlTable &table)
{
    const QFontMetrics digits(numberFont(font()));
    const auto need = [&](ColumnKind kind, const QString &text) {
        needRoom(kind, digits.horizontalAdvance(text) + 2 * CellMargin + 2);
    };
    for (const Field &field : table.fields()) {
        if (field.initial)
            need(ColumnKind::Value, withMinus(QString::number(*field.initial)));
        const int marks = (field.doubt.isEmpty() ? 0 : 1) + (isLostAtPowerOff(table, field) ? 1 : 0);
        const int mark = marks * (NameMark + 4);
        QString whole = field.name;
        if (!field.suggested.isEmpty())
            whole += QStringLiteral("  %1?").arg(field.suggested);
        const int name = fontMetrics().horizontalAdvance(whole) + 2 * indentation() + CellMargin + 4 + mark;
        needRoom(ColumnKind::Name, std::min(name, WidestName));
        for (const EnumValue &value : field.values) {
            const int said = fontMetrics().horizontalAdvance(withBaudTexts(value.text)) + 2 * CellMargin + 2;
            needRoom(ColumnKind::Physical, std::min(said, WidestValue));
            needRoom(ColumnKind::Device, std::min(said + ValueMark, WidestOfMany));
            needRoom(ColumnKind::All, std::min(said, WidestOfMany));
        }
    }
    // Nor the largest that fits into four bytes: few registers ever get there.
    need(ColumnKind::Value, withMinus(QString::number(-table.resolution())));
}

void TableView::applyColumnWidths()
{
    m_applying = true;
    for (int section = 0; section < header()->count(); ++section) {
        const int kind = model()->headerData(section, Qt::Horizontal, KindRole).toInt();
        const auto kept = m_widths.find(kind);
        const int fitting = std::max(defaultWidth(ColumnKind(kind)), m_needed[kind]);
        header()->resizeSection(section, kept != m_widths.end() ? kept->second : fitting);
    }
    m_applying = false;
}

void TableView::setColumnWidths(std::map<int, int> widths)
{
    m_widths = std::move(widths);
    if (model())
        applyColumnWidths();
}

QModelIndex TableView::editTarget(const QModelIndex &index) const
{
    const Field *field = fieldAt(index);
    if (!field)
        return {};
    // Names are picked by name: the raw column is too narrow for them.
    const bool byName = !field->values.empty() || !field->bits.empty();
    const ColumnKind kind = kindAt(index);
    if (isComparingKind(kind) || kind == ColumnKind::Physical || (kind == ColumnKind::Value && !byName)) {
        if (kind != ColumnKind::Physical || index.data(HasMeaningRole).toBool())
            return index;
    }
    const ColumnKind wanted = index.data(HasMeaningRole).toBool() ? ColumnKind::Physical : ColumnKind::Value;
    QModelIndex fallback;
    for (int column = 0; column < model()->columnCount(); ++column) {
        const QModelIndex there = index.siblingAtColumn(column);
        if (kindAt(there) == wanted)
            return there;
        // Of several devices the first: what goes to all is edited only where that is meant.
        if (!fallback.isValid() && isValueKind(kindAt(there)) && kindAt(there) != ColumnKind::All)
            fallback = there;
    }
    return fallback;
}

bool TableView::edit(const QModelIndex &index, EditTrigger trigger, QEvent *event)
{
    const bool asked = trigger == AllEditTriggers || (trigger & editTriggers() & (DoubleClicked | EditKeyPressed));
    if (!asked)
        return QTreeView::edit(index, trigger, event);
    if (!fieldAt(index) || (trigger == DoubleClicked && kindAt(index) == ColumnKind::Plot))
        return false;
    const QModelIndex target = editTarget(index);
    if (!target.isValid() || (m_gate && !m_gate(target)))
        return false;
    if (target != currentIndex())
        selectionModel()->setCurrentIndex(target, QItemSelectionModel::NoUpdate);
    return QTreeView::edit(target, AllEditTriggers, event);
}

void TableView::keyPressEvent(QKeyEvent *event)
{
    const bool isField = fieldAt(currentIndex()) != nullptr;
    if (isField && state() != EditingState) {
        switch (event->key()) {
        case Qt::Key_Return:
        case Qt::Key_Enter:
            edit(currentIndex(), AllEditTriggers, event);
            return;
        case Qt::Key_Space:
            emit plotToggled(currentIndex());
            return;
        default: break;
        }
    }
    QTreeView::keyPressEvent(event);
}

QModelIndex TableView::moveCursor(CursorAction action, Qt::KeyboardModifiers modifiers)
{
    const QModelIndex current = currentIndex();
    if (!fieldAt(current) || (action != MoveLeft && action != MoveRight))
        return QTreeView::moveCursor(action, modifiers);
    const int step = action == MoveLeft ? -1 : 1;
    for (int column = current.column() + step; column >= 0 && column < model()->columnCount(); column += step) {
        const QModelIndex next = current.siblingAtColumn(column);
        if (isValueKind(kindAt(next)) || column == 0)
            return next;
    }
    return current;
}

void TableView::drawRow(QPainter *painter, const QStyleOptionViewItem &option, const QModelIndex &index) const
{
    if (!fieldAt(index))
        painter->fillRect(option.rect, colors(option.palette).header);
    // A light tint in place of the full accent: units, marks and fading stay readable on it.
    QStyleOptionViewItem quiet = option;
    const QColor tint = selectionTint(option.palette);
    const QColor text = option.palette.color(QPalette::Active, QPalette::Text);
    for (const QPalette::ColorGroup group : {QPalette::Active, QPalette::Inactive}) {
        quiet.palette.setColor(group, QPalette::Highlight, tint);
        quiet.palette.setColor(group, QPalette::HighlightedText, text);
    }
    QTreeView::drawRow(painter, quiet, index);
}

void TableView::startDrag(Qt::DropActions /*actions*/)
{
    // The base class would show a picture of whole rows; a name says it.
    const QModelIndexList rows = selectionModel()->selectedRows();
    QMimeData *mime = model()->mimeData(rows);
    if (!mime)
        return;
    const QString name = rows.size() == 1 ? rows.front().data().toString() : tr("%1 registers").arg(rows.size());
    const QSize size(fontMetrics().horizontalAdvance(name) + 24, fontMetrics().height() + 12);
    QPixmap picture(size * devicePixelRatioF());
    picture.setDevicePixelRatio(devicePixelRatioF());
    picture.fill(palette().color(QPalette::Highlight));
    QPainter painter(&picture);
    painter.setPen(palette().color(QPalette::HighlightedText));
    painter.setFont(font());
    painter.drawText(QRect(QPoint(0, 0), size), Qt::AlignCenter, name);
    painter.end();
    auto *drag = new QDrag(this); // Qt deletes it when it is over
    drag->setMimeData(mime);
    drag->setPixmap(picture);
    drag->exec(Qt::CopyAction);
}

} // namespace dynascope
