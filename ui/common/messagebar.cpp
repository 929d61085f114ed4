// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/common/messagebar.h"

#include "ui/common/icons.h"
#include "ui/common/texts.h"
#include "ui/common/theme.h"

#include <QAccessible>
#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QToolButton>

#include <chrono>

namespace dynascope {

namespace {

using namespace std::chrono_literals;

constexpr auto ShortTime = 5s; ///< a success
constexpr auto ReadTime = 2s;  ///< a warning that nobody is to miss
constexpr auto LongTime = 12s; ///< something to know

QString iconName(MessageKind kind)
{
    switch (kind) {
    case MessageKind::Info: break;
    case MessageKind::Success: return QStringLiteral("success");
    case MessageKind::Warning: return QStringLiteral("warning");
    case MessageKind::Error: return QStringLiteral("error");
    }
    return QStringLiteral("info");
}

QString withoutStop(const QString &text)
{
    return text.endsWith(u'.') ? text.chopped(1) : text;
}

IconTint tintOf(MessageKind kind)
{
    switch (kind) {
    case MessageKind::Info: break;
    case MessageKind::Success: return IconTint::Good;
    case MessageKind::Warning: return IconTint::Warning;
    case MessageKind::Error: return IconTint::Bad;
    }
    return IconTint::Accent;
}

} // namespace

MessageBar::MessageBar(QWidget *parent)
    : QFrame(parent)
    , m_icon(new QLabel(this))
    , m_label(new QLabel(this))
    , m_action(new QPushButton(this))
    , m_other(new QPushButton(this))
    , m_close(new QToolButton(this))
{
    setObjectName(QStringLiteral("messageBar"));
    setAccessibleName(tr("Messages"));
    m_label->setObjectName(QStringLiteral("messageText"));
    m_label->setWordWrap(true);
    m_label->setTextFormat(Qt::PlainText);
    m_label->setTextInteractionFlags(Qt::TextSelectableByMouse);
    m_label->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
    m_action->setObjectName(QStringLiteral("messageAction"));
    m_other->setObjectName(QStringLiteral("messageOther"));
    m_close->setObjectName(QStringLiteral("messageClose"));
    m_close->setIcon(icon(QStringLiteral("close")));
    m_close->setIconSize(QSize(16, 16));
    m_close->setAutoRaise(true);
    m_close->setToolTip(tr("Dismiss this message"));
    m_close->setAccessibleName(tr("Dismiss"));

    auto *layout = new QHBoxLayout(this);
    layout->setContentsMargins(12, 6, 8, 6);
    layout->setSpacing(8);
    layout->addWidget(m_icon);
    layout->addWidget(m_label, 1);
    layout->addWidget(m_action);
    layout->addWidget(m_other);
    layout->addWidget(m_close);

    m_hideTimer.setSingleShot(true);
    connect(&m_hideTimer, &QTimer::timeout, this, &MessageBar::dismiss);
    connect(m_close, &QToolButton::clicked, this, &MessageBar::dismiss);
    const auto obey = [this](std::function<void()> Message::*order, bool stays) {
        const auto action = m_current ? *m_current.*order : nullptr;
        if (m_dismissable && !stays)
            dismiss();
        if (action)
            action();
    };
    connect(m_action, &QPushButton::clicked, this, [obey] { obey(&Message::action, false); });
    connect(m_other, &QPushButton::clicked, this,
            [this, obey] { obey(&Message::other, m_current && m_current->staysForOther); });
    hide();
}

std::optional<MessageKind> MessageBar::kind() const
{
    return m_current ? std::optional(m_current->kind) : std::nullopt;
}

void MessageBar::setDismissable(bool dismissable)
{
    m_dismissable = dismissable;
    m_close->setVisible(dismissable);
}

void MessageBar::post(Message message)
{
    if (m_current && m_current->kind == message.kind && m_current->text == message.text) {
        ++m_count;
        m_current = std::move(message);
        updateText();
        if (m_hideTimer.isActive())
            m_hideTimer.start();
        return;
    }
    const auto isAbout = [&message](const std::optional<Message> &other) {
        return other && !message.topic.isEmpty() && other->topic == message.topic;
    };
    if (isAbout(m_waiting))
        m_waiting.reset();
    const bool isApart = m_dismissable && m_current && !isAbout(m_current);
    const bool isWarned = isApart && m_current->kind == MessageKind::Warning;
    // What a person has just done went well: said at once, for its short time, before what has been read by now.
    const bool passes = isWarned && message.kind == MessageKind::Success && message.actionText.isEmpty()
        && m_sinceShown.hasExpired(std::chrono::milliseconds(ReadTime).count());
    if (isApart && message.kind < m_current->kind && !passes)
        return wait(std::move(message));
    // Who has to dismiss a message must have seen it: it comes back.
    if (isWarned && (passes || message.kind > m_current->kind))
        wait(std::move(*m_current));
    show(std::move(message));
}

void MessageBar::wait(Message message)
{
    if (!m_waiting || message.kind >= m_waiting->kind)
        m_waiting = std::move(message);
}

void MessageBar::show(Message message)
{
    m_current = std::move(message);
    m_count = 1;
    m_sinceShown.start();
    m_hideTimer.stop();
    if (m_dismissable && m_current->actionText.isEmpty()) {
        if (m_current->kind == MessageKind::Success)
            m_hideTimer.start(ShortTime);
        else if (m_current->kind == MessageKind::Info)
            m_hideTimer.start(LongTime);
    }
    m_icon->setPixmap(
        icon(iconName(m_current->kind), tintOf(m_current->kind)).pixmap(QSize(20, 20), devicePixelRatioF()));
    m_action->setText(m_current->actionText);
    m_action->setVisible(!m_current->actionText.isEmpty());
    m_other->setText(m_current->otherText);
    m_other->setVisible(!m_current->otherText.isEmpty());
    updateText();
    setVisible(true);
    update();
}

void MessageBar::updateText()
{
    const QString text =
        asSentence(m_count > 1 ? tr("%1 (%2 times)").arg(withoutStop(m_current->text)).arg(m_count) : m_current->text);
    m_label->setText(text);
    m_label->setAccessibleName(text);
    QAccessibleEvent event(m_label, QAccessible::NameChanged);
    QAccessible::updateAccessibility(&event);
}

void MessageBar::dismiss()
{
    m_hideTimer.stop();
    m_current.reset();
    m_count = 0;
    if (m_waiting) {
        Message next = std::move(*m_waiting);
        m_waiting.reset();
        show(std::move(next));
        return;
    }
    hide();
}

void MessageBar::clear()
{
    m_waiting.reset();
    dismiss();
}

void MessageBar::retract(const QString &text)
{
    if (m_waiting && m_waiting->text == text)
        m_waiting.reset();
    if (m_current && m_current->text == text)
        dismiss();
}

void MessageBar::retractTopic(const QString &topic)
{
    const auto isOver = [&topic](const std::optional<Message> &message) {
        return message && message->topic == topic && message->kind >= MessageKind::Warning;
    };
    if (isOver(m_waiting))
        m_waiting.reset();
    if (isOver(m_current))
        dismiss();
}

void MessageBar::changeEvent(QEvent *event)
{
    if (event->type() == QEvent::PaletteChange && m_current) {
        m_icon->setPixmap(
            icon(iconName(m_current->kind), tintOf(m_current->kind)).pixmap(QSize(20, 20), devicePixelRatioF()));
    }
    QFrame::changeEvent(event);
}

void MessageBar::paintEvent(QPaintEvent *)
{
    if (!m_current)
        return;
    QPainter painter(this);
    const QColor tint = tintColor(tintOf(m_current->kind), palette());
    QColor wash = tint;
    wash.setAlphaF(colors(palette()).dark ? 0.16F : 0.09F);
    painter.fillRect(rect(), palette().color(QPalette::Base));
    painter.fillRect(rect(), wash);
    painter.fillRect(QRect(0, 0, 4, height()), tint);
    painter.fillRect(QRect(0, 0, width(), 1), colors(palette()).border);
}

} // namespace dynascope
