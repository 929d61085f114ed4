// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

class QLabel;
class QPlainTextEdit;

namespace dynascope {

/// What is wrong with a file, a line each with its place, to be read and copied.
class ProfileFaults : public QWidget
{
    Q_OBJECT

public:
    explicit ProfileFaults(QWidget *parent = nullptr);

    /// `text` as profileFromYaml() says it: "path:line:column: sentence" in each line.
    void show(const QString &path, const QString &text);

private:
    QLabel *m_title;
    QPlainTextEdit *m_list;
};

} // namespace dynascope
