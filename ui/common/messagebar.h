// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QElapsedTimer>
#include <QFrame>
#include <QTimer>

#include <functional>
#include <optional>

class QLabel;
class QPushButton;
class QToolButton;

namespace dynascope {

enum class MessageKind { Info, Success, Warning, Error }; ///< in the order of how much they matter

struct Message {
    MessageKind kind = MessageKind::Info;
    QString text;
    QString actionText;           ///< empty: no button
    std::function<void()> action; ///< called on the GUI thread; the bar closes then
    QString topic{};                ///< what it is about: the newest of a topic replaces those before it, whatever their rank
    QString otherText{};            ///< of a second button, beside `actionText`
    std::function<void()> other{};
    bool staysForOther = false; ///< the second button is a look at something: the bar stays
};

/// One line over the lower edge of the work area: icon, text, perhaps one button or two. Shows the message that matters
/// most; of those of lower rank the one that matters most waits behind it, the newest where several do alike. A success
/// passes a warning that has stood for a while, which comes back. The same text again counts up. Success and info go by
/// themselves. Texts may begin in lower case and end without a full stop.
class MessageBar : public QFrame
{
    Q_OBJECT

public:
    explicit MessageBar(QWidget *parent = nullptr);

    void post(Message message);
    void post(MessageKind kind, const QString &text) { post(Message{kind, text, {}, {}}); }
    void dismiss(); ///< shows what waits, else hides
    void clear();   ///< also what waits
    void retract(const QString &text); ///< what this message said is no longer so; nothing where it isn't here
    /// The trouble that was said of it is over. What went well stays for its time.
    void retractTopic(const QString &topic);
    /// Off for a bar whose owner alone decides when it goes.
    void setDismissable(bool dismissable);

    QString text() const { return m_current ? m_current->text : QString(); }
    std::optional<MessageKind> kind() const;
    int count() const { return m_count; } ///< how often the present message came

protected:
    void paintEvent(QPaintEvent *event) override;
    void changeEvent(QEvent *event) override;

private:
    void show(Message message);
    void wait(Message message); ///< behind the present one
    void updateText();

    QLabel *m_icon;
    QLabel *m_label;
    QPushButton *m_action;
    QPushButton *m_other;
    QToolButton *m_close;
    QTimer m_hideTimer;
    QElapsedTimer m_sinceShown;
    std::optional<Message> m_current;
    std::optional<Message> m_waiting;
    int m_count = 0;
    bool m_dismissable = true;
};

} // namespace dynascope
