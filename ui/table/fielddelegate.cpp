// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/fielddelegate.h"

#include "core/table/indirect.h"
#include "ui/common/icons.h"
#include "ui/common/theme.h"
#include "ui/table/cellpainter.h"
#include "ui/table/enumedit.h"
#include "ui/table/valueedit.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>

#include <algorithm>

namespace dynascope {
namespace {

std::optional<std::int64_t> rawAt(const QModelIndex &index)
{
    const QVariant raw = index.data(RawRole);
    return raw.isValid() ? std::optional<std::int64_t>(raw.toLongLong()) : std::nullopt;
}

/// Writes `text` at the left of `rect` and takes its width away from it.
void takeLeft(QPainter *painter, QRect &rect, const QString &text)
{
    const QString shown = painter->fontMetrics().elidedText(text, Qt::ElideMiddle, rect.width());
    painter->drawText(rect, Qt::AlignLeft | Qt::AlignVCenter | Qt::TextSingleLine, shown);
    rect.setLeft(rect.left() + painter->fontMetrics().horizontalAdvance(shown) + CellMargin);
}

/// Paints a mark at the right end of `rect` and takes its width away from it.
void takeMark(QPainter *painter, QRect &rect, const QString &name, const QColor &color)
{
    const QRect mark(rect.right() + 1 - NameMark, rect.center().y() - NameMark / 2, NameMark, NameMark);
    paintIcon(painter, mark, name, color);
    rect.setRight(mark.left() - 4);
}

} // namespace

FieldDelegate::FieldDelegate(QObject *parent)
    : QStyledItemDelegate(parent)
{
}

void FieldDelegate::paint(QPainter *painter, const QStyleOptionViewItem &given, const QModelIndex &index) const
{
    QStyleOptionViewItem option = given;
    initStyleOption(&option, index);
    if (!fieldAt(index)) {
        paintGroup(painter, option, index);
        return;
    }
    paintCell(painter, option);
    const ColumnKind kind = kindAt(index);
    if (kind == ColumnKind::Plot)
        paintPlotTick(painter, option, static_cast<Qt::CheckState>(index.data(Qt::CheckStateRole).toInt()));
    else if (isValueKind(kind))
        paintValue(painter, option, index);
    else if (kind == ColumnKind::Name)
        paintName(painter, option, index);
    else
        paintText(painter, option, index);
}

void FieldDelegate::paintGroup(QPainter *painter, const QStyleOptionViewItem &option, const QModelIndex &index) const
{
    QRect rect = option.rect.adjusted(CellMargin, 0, -CellMargin, 0);
    painter->save();
    painter->setFont(boldened(option.font));
    painter->setPen(colors(option.palette).dimmed);
    takeLeft(painter, rect, index.data().toString());
    painter->setFont(option.font);
    takeLeft(painter, rect, index.data(GroupHintRole).toString());
    painter->restore();
}

/// The name, a guess beside it, and at the right end marks: something is doubtful, it was set and goes with the power.
void FieldDelegate::paintName(QPainter *painter, const QStyleOptionViewItem &option, const QModelIndex &index) const
{
    const Field &field = *fieldAt(index);
    const ThemeColors &theme = colors(option.palette);
    QRect rect = option.rect.adjusted(2, 0, -CellMargin, 0);
    const auto state = static_cast<RamState>(index.data(RamStateRole).toInt());
    painter->save();
    if (!field.doubt.isEmpty())
        takeMark(painter, rect, QStringLiteral("help"), theme.warning);
    if (state == RamState::Set)
        takeMark(painter, rect, QStringLiteral("plug"), theme.accent);
    else if (state == RamState::Lost)
        takeMark(painter, rect, QStringLiteral("reboot"), theme.warning);
    painter->setFont(option.font);
    painter->setPen(option.palette.color(QPalette::Active, QPalette::Text));
    takeLeft(painter, rect, field.name);
    if (!field.suggested.isEmpty()) {
        painter->setPen(theme.dimmed);
        takeLeft(painter, rect, tr("%1?").arg(field.suggested));
    }
    painter->restore();
}

void FieldDelegate::paintText(QPainter *painter, const QStyleOptionViewItem &option, const QModelIndex &index) const
{
    const ColumnKind kind = kindAt(index);
    const bool digits = kind == ColumnKind::Address || kind == ColumnKind::Default || kind == ColumnKind::Range;
    const QRect rect = option.rect.adjusted(CellMargin, 0, -CellMargin, 0);
    painter->save();
    painter->setFont(digits ? numberFont(option.font) : option.font);
    painter->setPen(colors(option.palette).dimmed);
    // Of a name the beginning says most, of a range both ends.
    const Qt::TextElideMode elide = kind == ColumnKind::Default ? Qt::ElideRight : Qt::ElideMiddle;
    painter->drawText(rect, static_cast<int>(option.displayAlignment | Qt::AlignVCenter) | Qt::TextSingleLine,
                      painter->fontMetrics().elidedText(index.data().toString(), elide, rect.width()));
    painter->restore();
}

QSize FieldDelegate::sizeHint(const QStyleOptionViewItem &option, const QModelIndex & /*index*/) const
{
    return {80, std::max(24, option.fontMetrics.height() + 8)};
}

QWidget *FieldDelegate::createEditor(QWidget *parent, const QStyleOptionViewItem & /*option*/,
                                     const QModelIndex &index) const
{
    const Field *field = fieldAt(index);
    if (!field || !isValueKind(kindAt(index)))
        return nullptr;
    const auto effective = index.data(EffectiveRole).value<EffectiveField>();
    const std::optional<std::int64_t> raw = rawAt(index);
    if (!field->values.empty()) {
        auto *list = new EnumEdit(*field, effective, raw, parent);
        auto *self = const_cast<FieldDelegate *>(this); // Qt's own signature: making an editor is const
        connect(list, &EnumEdit::finished, self, [self, list] {
            emit self->commitData(list);
            emit self->closeEditor(list);
        });
        return list;
    }
    const bool inUnits = kindAt(index) != ColumnKind::Value && index.data(HasMeaningRole).toBool();
    ValueMeaning meaning{*field, effective, index.data(ResolutionRole).toInt(), m_units, inUnits};
    if (indirectAddressNumber(*field) > 0)
        meaning.pointsInto = index.data(ControlTableRole).value<ControlTablePtr>();
    return new ValueEdit(meaning, raw ? meaning.text(*raw) : QString(), raw, parent);
}

void FieldDelegate::setEditorData(QWidget *editor, const QModelIndex &index) const
{
    // The view calls this at every change of the cell.
    if (auto *edit = qobject_cast<ValueEdit *>(editor))
        edit->setEffective(index.data(EffectiveRole).value<EffectiveField>());
}

void FieldDelegate::setModelData(QWidget *editor, QAbstractItemModel *model, const QModelIndex &index) const
{
    if (const auto *list = qobject_cast<EnumEdit *>(editor)) {
        if (list->isPicked())
            model->setData(index, static_cast<qlonglong>(list->value()), Qt::EditRole);
        return;
    }
    const auto *edit = qobject_cast<ValueEdit *>(editor);
    if (!edit || !edit->isChanged())
        return;
    if (const auto raw = edit->value())
        model->setData(index, static_cast<qlonglong>(*raw), Qt::EditRole);
    else
        emit notWritten(tr("Not written: %1.").arg(raw.error().text));
}

void FieldDelegate::updateEditorGeometry(QWidget *editor, const QStyleOptionViewItem &option,
                                         const QModelIndex & /*index*/) const
{
    QRect rect = option.rect;
    rect.setLeft(std::min(rect.left(), rect.right() - 119));
    editor->setGeometry(rect);
}

bool FieldDelegate::editorEvent(QEvent *event, QAbstractItemModel *model, const QStyleOptionViewItem &option,
                                const QModelIndex &index)
{
    if (kindAt(index) != ColumnKind::Plot || !fieldAt(index))
        return false;
    const auto type = event->type();
    if (type != QEvent::MouseButtonRelease && type != QEvent::MouseButtonDblClick)
        return false;
    const auto *mouse = static_cast<QMouseEvent *>(event);
    if (mouse->button() != Qt::LeftButton || !option.rect.contains(mouse->position().toPoint()))
        return false;
    if (type == QEvent::MouseButtonDblClick)
        return true;
    const bool on = index.data(Qt::CheckStateRole).toInt() == Qt::Checked;
    return model->setData(index, static_cast<int>(on ? Qt::Unchecked : Qt::Checked), Qt::CheckStateRole);
}

bool FieldDelegate::eventFilter(QObject *watched, QEvent *event)
{
    if (event->type() == QEvent::KeyPress) {
        const int key = static_cast<QKeyEvent *>(event)->key();
        const auto *edit = qobject_cast<ValueEdit *>(watched);
        // What can't be written stays open: the hint beside it says why.
        if (edit && (key == Qt::Key_Return || key == Qt::Key_Enter) && edit->isChanged() && !edit->value())
            return true;
    }
    return QStyledItemDelegate::eventFilter(watched, event);
}

} // namespace dynascope
