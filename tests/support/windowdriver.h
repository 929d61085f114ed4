// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/device.h"
#include "ui/table/tableroles.h"

#include <QLineEdit>
#include <QMainWindow>
#include <QTest>

namespace dynascope::test {

/// A person at the window. Clicks and keys go to native windows, so that what is in front, modal, or has the focus gets
/// them, as with a real mouse.
class WindowDriver
{
public:
    explicit WindowDriver(QMainWindow &window) : m_window(window) {}

    template <typename Widget>
    Widget *child(const char *name) const
    {
        for (auto *found : m_window.findChildren<Widget *>(QString::fromLatin1(name))) {
            if (found->isVisible())
                return found;
        }
        return nullptr;
    }

    static void click(QWidget *widget, QPoint at, Qt::MouseButton button = Qt::LeftButton);
    static void click(QWidget *widget) { click(widget, widget->rect().center()); }
    bool click(const char *name) const;

    /// To whatever has the focus: an open popup before a dialog before the window.
    static void key(Qt::Key key, Qt::KeyboardModifiers modifiers = {});
    static void type(const QString &text);
    static QWidget *front();

    bool clickDevice(const Device &device, Qt::MouseButton button = Qt::LeftButton) const;

    /// An entry of the menu that is open.
    static bool pick(const char *action);
    bool openMenu(const QString &title) const;
    bool pickForDevice(const Device &device, const char *action) const;

    /// A cell of the table, searched for by the register's name and brought into view.
    QModelIndex cell(const QString &field, ColumnKind kind) const;
    bool clickCell(const QString &field, ColumnKind kind) const;
    /// By a double click on the raw value.
    bool openEditor(const QString &field) const;
    QLineEdit *editor() const { return child<QLineEdit>("valueEdit"); }
    bool edit(const QString &field, const QString &text) const;

    QString message() const;

    /// How much of the plot's height its first trace covers as it is painted, 0 to 1; −1 where it isn't painted.
    double paintedHeight() const;

private:
    QMainWindow &m_window;
};

} // namespace dynascope::test
