// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

class QLabel;

namespace dynascope {

/// What stands where the grid would be: what belongs here, and why there is nothing.
class TableEmpty : public QWidget
{
    Q_OBJECT

public:
    explicit TableEmpty(QWidget *parent = nullptr);

    void setTexts(const QString &title, const QString &text);

private:
    QLabel *m_title;
    QLabel *m_text;
};

} // namespace dynascope
