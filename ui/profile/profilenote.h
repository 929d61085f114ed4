// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/common/messagebar.h"

class QLabel;

namespace dynascope {

/// What a page has to say now: an icon and some lines, which can be copied.
class ProfileNote : public QWidget
{
    Q_OBJECT

public:
    explicit ProfileNote(QWidget *parent = nullptr);

    void say(MessageKind kind, const QString &text);
    QString text() const;
    MessageKind kind() const { return m_kind; }

protected:
    void changeEvent(QEvent *event) override;

private:
    void draw();

    QLabel *m_icon;
    QLabel *m_text;
    MessageKind m_kind = MessageKind::Info;
};

} // namespace dynascope
