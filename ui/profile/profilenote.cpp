// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/profile/profilenote.h"

#include "ui/common/icons.h"
#include "ui/common/theme.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>

namespace dynascope {

ProfileNote::ProfileNote(QWidget *parent) : QWidget(parent), m_icon(new QLabel(this)), m_text(new QLabel(this))
{
    m_text->setObjectName(QStringLiteral("profileNote"));
    m_text->setTextFormat(Qt::PlainText); // names from a file are in it
    m_text->setAccessibleName(tr("What was found"));
    m_text->setWordWrap(true);
    m_text->setAlignment(Qt::AlignLeft | Qt::AlignTop);
    m_text->setMinimumHeight(2 * m_text->fontMetrics().lineSpacing()); // so that the dialog doesn't jump
    m_text->setTextInteractionFlags(Qt::TextSelectableByMouse);
    auto *layout = new QHBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(8);
    layout->addWidget(m_icon, 0, Qt::AlignTop);
    layout->addWidget(m_text, 1);
}

void ProfileNote::say(MessageKind kind, const QString &text)
{
    m_kind = kind;
    m_text->setText(text);
    draw();
}

QString ProfileNote::text() const
{
    return m_text->text();
}

void ProfileNote::draw()
{
    QPalette palette = this->palette();
    if (m_kind == MessageKind::Error)
        palette.setColor(QPalette::WindowText, colors(palette).bad);
    m_text->setPalette(palette);
    const auto picture = [this] {
        switch (m_kind) {
        case MessageKind::Error: return icon(QStringLiteral("error"), IconTint::Bad);
        case MessageKind::Warning: return icon(QStringLiteral("warning"), IconTint::Warning);
        case MessageKind::Success: return icon(QStringLiteral("success"), IconTint::Good);
        case MessageKind::Info: break;
        }
        return icon(QStringLiteral("info"), IconTint::Accent);
    };
    m_icon->setPixmap(m_text->text().isEmpty() ? QPixmap() : picture().pixmap(QSize(20, 20), devicePixelRatioF()));
}

void ProfileNote::changeEvent(QEvent *event)
{
    if (event->type() == QEvent::PaletteChange)
        draw();
    QWidget::changeEvent(event);
}

} // namespace dynascope
