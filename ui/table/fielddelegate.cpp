// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/fielddelegate.h"

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
        option.font.setBold(true);
        paintText(painter, option, index);
        return;
    }
    paintCell(painter, option);
    const ColumnKind kind = kindAt(index);
    if (kind == ColumnKind::Plot)
        paintPlotTick(painter, option, static_cast<Qt::CheckState>(index.data(Qt::CheckStateRole).toInt()));
    else if (isValueKind(kind))
        paintValue(painter, option, index);
    else
        paintText(painter, option, index);
}

void FieldDelegate::paintText(QPainter *painter, const QStyleOptionViewItem &option, const QModelIndex &index) const
{
    const ColumnKind kind = kindAt(index);
    const bool digits = kind == ColumnKind::Address || kind == ColumnKind::Default || kind == ColumnKind::Range;
    const QColor color = kind == ColumnKind::Name ? option.palette.color(QPalette::Active, QPalette::Text)
                                                  : colors(option.palette).dimmed;
    const QRect rect = option.rect.adjusted(kind == ColumnKind::Name ? 2 : CellMargin, 0, -CellMargin, 0);
    painter->save();
    painter->setFont(digits ? numberFont(option.font) : option.font);
    painter->setPen(color);
    painter->drawText(rect, static_cast<int>(option.displayAlignment | Qt::AlignVCenter) | Qt::TextSingleLine,
                      painter->fontMetrics().elidedText(index.data().toString(), Qt::ElideMiddle, rect.width()));
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
    const bool inUnits = kindAt(index) != ColumnKind::Value && effective.unit != Unit::None;
    const int resolution = index.data(ResolutionRole).toInt();
    QString text;
    if (raw)
        text = inUnits ? valueText(*field, effective, resolution, *raw, m_angle) : QString::number(*raw);
    return new ValueEdit({*field, effective, resolution, m_angle, inUnits}, text, raw, parent);
}

void FieldDelegate::setEditorData(QWidget * /*editor*/, const QModelIndex & /*index*/) const
{
    // The editor got its value when it was made. The view calls this at every change of the cell, which would take the
    // text away from under the person's hands.
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
