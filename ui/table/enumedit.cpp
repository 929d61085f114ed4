// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/enumedit.h"

#include "core/table/units.h"
#include "ui/common/texts.h"

#include <QAbstractItemView>
#include <QTimer>

#include <algorithm>

namespace dynascope {

EnumEdit::EnumEdit(const Field &field, const EffectiveField &effective, std::optional<std::int64_t> raw,
                   QWidget *parent)
    : QComboBox(parent)
{
    setObjectName(QStringLiteral("enumEdit"));
    setAccessibleName(field.name);
    for (const EnumValue &value : field.values) {
        if (checkRange(field, effective, value.value))
            addItem(QStringLiteral("%1  %2").arg(value.value).arg(withBaudTexts(value.text)),
                    static_cast<qlonglong>(value.value));
    }
    setCurrentIndex(raw ? findData(static_cast<qlonglong>(*raw)) : -1);
    connect(this, &QComboBox::activated, this, [this] { m_picked = true; });
    view()->setTextElideMode(Qt::ElideRight);
}

void EnumEdit::showEvent(QShowEvent *event)
{
    QComboBox::showEvent(event);
    view()->setMinimumWidth(std::max(width(), view()->sizeHintForColumn(0) + 32));
    QTimer::singleShot(0, this, [this] { showPopup(); });
}

void EnumEdit::hidePopup()
{
    QComboBox::hidePopup();
    // What was picked is told after the list has closed.
    QTimer::singleShot(0, this, [this] {
        if (!m_finished && !view()->isVisible()) {
            m_finished = true;
            emit finished();
        }
    });
}

} // namespace dynascope
