// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/bitpopup.h"

#include "ui/common/texts.h"
#include "ui/common/theme.h"

#include <QCheckBox>
#include <QComboBox>
#include <QKeyEvent>
#include <QLabel>
#include <QPushButton>
#include <QScreen>
#include <QVBoxLayout>

#include <algorithm>

namespace dynascope {
namespace {

std::uint32_t maskOf(const BitField &bits)
{
    return (bits.count >= 32 ? 0xFFFFFFFFU : (1U << bits.count) - 1U) << bits.first;
}

} // namespace

BitPopup::BitPopup(const Field &field, std::int64_t raw, QWidget *parent)
    : QFrame(parent, Qt::Popup)
    , m_initial(static_cast<std::uint32_t>(raw))
    , m_raw(m_initial)
{
    setObjectName(QStringLiteral("bitPopup"));
    setAttribute(Qt::WA_DeleteOnClose);
    setFrameShape(QFrame::StyledPanel);
    setAccessibleName(field.name);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(16, 12, 16, 12);
    layout->setSpacing(8);
    auto *title = new QLabel(field.name, this);
    title->setTextFormat(Qt::PlainText);
    title->setFont(boldened(title->font()));
    layout->addWidget(title);
    for (const BitField &bits : field.bits)
        layout->addWidget(makeRow(bits));
    auto *write = new QPushButton(tr("Write"), this);
    write->setObjectName(QStringLiteral("bitPopupWrite"));
    write->setToolTip(tr("Write what is ticked (Enter)"));
    connect(write, &QPushButton::clicked, this, &BitPopup::accept);
    layout->addSpacing(4);
    layout->addWidget(write, 0, Qt::AlignRight);
    if (auto *first = findChild<QCheckBox *>())
        first->setFocus();
}

QWidget *BitPopup::makeRow(const BitField &bits)
{
    const std::uint32_t present = (m_raw & maskOf(bits)) >> bits.first;
    if (bits.count == 1 && bits.values.empty()) {
        auto *box = new QCheckBox(plainLabel(bits.name), this);
        box->setToolTip(tr("Bit %1").arg(bits.first));
        box->setChecked(present != 0);
        connect(box, &QCheckBox::toggled, this, [this, bits](bool on) { set(bits, on ? 1U : 0U); });
        return box;
    }
    auto *row = new QWidget(this);
    auto *layout = new QHBoxLayout(row);
    layout->setContentsMargins(0, 0, 0, 0);
    auto *name = new QLabel(bits.name, row);
    name->setTextFormat(Qt::PlainText);
    layout->addWidget(name);
    auto *list = new QComboBox(row);
    list->setAccessibleName(bits.name);
    for (const EnumValue &value : bits.values)
        list->addItem(value.text, static_cast<qlonglong>(value.value));
    if (bits.values.empty()) {
        for (int value = 0; value < (1 << std::min(bits.count, 8)); ++value)
            list->addItem(QString::number(value), static_cast<qlonglong>(value));
    }
    list->setCurrentIndex(list->findData(static_cast<qlonglong>(present)));
    connect(list, &QComboBox::activated, this,
            [this, bits, list] { set(bits, static_cast<std::uint32_t>(list->currentData().toLongLong())); });
    layout->addWidget(list, 1);
    return row;
}

void BitPopup::set(const BitField &bits, std::uint32_t value)
{
    m_raw = (m_raw & ~maskOf(bits)) | ((value << bits.first) & maskOf(bits));
}

void BitPopup::open(const QPoint &globalPosition)
{
    adjustSize();
    QPoint at = globalPosition;
    if (const QScreen *screen = parentWidget() ? parentWidget()->screen() : nullptr) {
        const QRect area = screen->availableGeometry();
        at.setX(std::clamp(at.x(), area.left(), std::max(area.left(), area.right() - width())));
        at.setY(std::clamp(at.y(), area.top(), std::max(area.top(), area.bottom() - height())));
    }
    move(at);
    show();
}

void BitPopup::keyPressEvent(QKeyEvent *event)
{
    if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter)
        return accept();
    if (event->key() == Qt::Key_Down)
        focusNextChild();
    else if (event->key() == Qt::Key_Up)
        focusPreviousChild();
    else
        QFrame::keyPressEvent(event);
}

void BitPopup::accept()
{
    if (m_raw != m_initial)
        emit accepted(value());
    close();
}

} // namespace dynascope
