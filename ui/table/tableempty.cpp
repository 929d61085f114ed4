// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/tableempty.h"

#include "ui/common/icons.h"

#include <QLabel>
#include <QVBoxLayout>

namespace dynascope {

TableEmpty::TableEmpty(QWidget *parent)
    : QWidget(parent)
    , m_title(new QLabel(this))
    , m_text(new QLabel(this))
{
    auto *picture = new QLabel(this);
    picture->setPixmap(icon(QStringLiteral("servo"), IconTint::Dimmed).pixmap(40, 40));
    QFont large = font();
    large.setPointSizeF(large.pointSizeF() * 1.25);
    m_title->setFont(large);
    m_title->setObjectName(QStringLiteral("tableEmptyTitle"));
    m_text->setObjectName(QStringLiteral("tableEmptyText"));
    m_text->setWordWrap(true);
    for (QLabel *label : {m_title, m_text})
        label->setTextFormat(Qt::PlainText);
    m_text->setFixedWidth(340);
    m_text->setAlignment(Qt::AlignHCenter);
    m_text->setForegroundRole(QPalette::PlaceholderText);
    m_text->setTextInteractionFlags(Qt::TextSelectableByMouse);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(24, 24, 24, 24);
    layout->setSpacing(8);
    layout->addStretch(2);
    layout->addWidget(picture, 0, Qt::AlignHCenter);
    layout->addWidget(m_title, 0, Qt::AlignHCenter);
    layout->addWidget(m_text, 0, Qt::AlignHCenter);
    layout->addStretch(3);
}

void TableEmpty::setTexts(const QString &title, const QString &text)
{
    m_title->setText(title);
    m_text->setText(text);
    // Centred labels get too little by themselves.
    m_text->setFixedHeight(m_text->heightForWidth(m_text->maximumWidth()));
}

} // namespace dynascope
