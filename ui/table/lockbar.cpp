// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/lockbar.h"

#include "ui/common/icons.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QToolButton>

namespace dynascope {

LockBar::LockBar(QWidget *parent)
    : QFrame(parent)
    , m_text(new QLabel(this))
    , m_button(new QPushButton(this))
    , m_other(new QPushButton(this))
{
    setObjectName(QStringLiteral("lockBar"));
    setAutoFillBackground(true);
    setBackgroundRole(QPalette::AlternateBase);
    auto *sign = new QLabel(this);
    sign->setPixmap(icon(QStringLiteral("lock"), IconTint::Warning).pixmap(16, 16));
    m_text->setObjectName(QStringLiteral("lockBarText"));
    m_text->setWordWrap(true);
    m_text->setTextFormat(Qt::PlainText);
    m_button->setObjectName(QStringLiteral("lockBarButton"));
    m_other->setObjectName(QStringLiteral("lockBarOther"));
    auto *close = new QToolButton(this);
    close->setObjectName(QStringLiteral("lockBarClose"));
    close->setIcon(icon(QStringLiteral("close")));
    close->setAutoRaise(true);
    close->setToolTip(tr("Leave it as it is"));
    close->setAccessibleName(close->toolTip());
    auto *layout = new QHBoxLayout(this);
    layout->setContentsMargins(12, 6, 8, 6);
    layout->setSpacing(8);
    layout->addWidget(sign);
    layout->addWidget(m_text, 1);
    layout->addWidget(m_button);
    layout->addWidget(m_other);
    layout->addWidget(close);
    connect(m_button, &QPushButton::clicked, this, &LockBar::wayChosen);
    connect(m_other, &QPushButton::clicked, this, &LockBar::otherChosen);
    connect(close, &QToolButton::clicked, this, [this] {
        hide();
        emit dismissed();
    });
    hide();
}

void LockBar::showReason(const QString &reason, const QString &way, const QString &other)
{
    m_text->setText(reason);
    m_button->setText(way);
    m_button->setVisible(!way.isEmpty());
    m_button->setEnabled(true);
    m_other->setText(other);
    m_other->setVisible(!other.isEmpty());
    show();
}

void LockBar::setBusy(bool busy)
{
    m_button->setEnabled(!busy);
}

} // namespace dynascope
