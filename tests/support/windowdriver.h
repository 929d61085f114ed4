// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/device.h"
#include "ui/devices/devicetreemodel.h"
#include "ui/plot/plotarea.h"
#include "ui/plot/plotchart.h"
#include "ui/plot/plotpanel.h"
#include "ui/table/tableroles.h"

#include <QApplication>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QTest>
#include <QTreeView>
#include <QWindow>

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

    static void click(QWidget *widget, QPoint at, Qt::MouseButton button = Qt::LeftButton)
    {
        QTest::mouseClick(widget->window()->windowHandle(), button, {}, widget->mapTo(widget->window(), at));
    }
    static void click(QWidget *widget) { click(widget, widget->rect().center()); }
    bool click(const char *name) const
    {
        auto *widget = child<QWidget>(name);
        if (!widget || !widget->isEnabled())
            return false;
        click(widget);
        return true;
    }

    /// To whatever has the focus: an open popup before a dialog before the window.
    static void key(Qt::Key key, Qt::KeyboardModifiers modifiers = {})
    {
        QTest::keyClick(front()->windowHandle(), key, modifiers);
    }
    static void type(const QString &text)
    {
        for (const QChar letter : text)
            QTest::keyClick(front()->windowHandle(), letter.toLatin1());
    }
    static QWidget *front()
    {
        QWidget *popup = QApplication::activePopupWidget();
        return popup ? popup : QApplication::activeWindow();
    }

    bool clickDevice(const Device &device, Qt::MouseButton button = Qt::LeftButton) const
    {
        auto *tree = child<QTreeView>("deviceTree");
        if (!tree)
            return false;
        const QModelIndex row = static_cast<DeviceTreeModel *>(tree->model())->indexOf(&device);
        tree->scrollTo(row);
        click(tree->viewport(), tree->visualRect(row).center(), button);
        return tree->selectionModel()->isSelected(row);
    }

    /// An entry of the menu that is open.
    static bool pick(const char *action)
    {
        auto *menu = qobject_cast<QMenu *>(QApplication::activePopupWidget());
        if (!menu)
            return false;
        for (QAction *entry : menu->actions()) {
            if (entry->objectName() == QLatin1String(action) && entry->isEnabled()) {
                click(menu, menu->actionGeometry(entry).center());
                return true;
            }
        }
        return false;
    }
    bool openMenu(const QString &title) const
    {
        for (QAction *menu : m_window.menuBar()->actions()) {
            if (menu->text().remove(u'&') == title)
                click(m_window.menuBar(), m_window.menuBar()->actionGeometry(menu).center());
        }
        return qobject_cast<QMenu *>(QApplication::activePopupWidget()) != nullptr;
    }
    bool pickForDevice(const Device &device, const char *action) const
    {
        return clickDevice(device, Qt::RightButton) && pick(action);
    }

    /// A cell of the table, searched for by the register's name and brought into view.
    QModelIndex cell(const QString &field, ColumnKind kind) const
    {
        auto *view = child<QTreeView>("tableView");
        auto *search = child<QLineEdit>("tableSearch");
        if (!view || !search)
            return {};
        click(search);
        key(Qt::Key_A, Qt::ControlModifier);
        type(field);
        const QModelIndexList rows = view->model()->match(
            view->model()->index(0, 0), Qt::DisplayRole, field, 1, Qt::MatchExactly | Qt::MatchRecursive);
        for (int column = 0; !rows.isEmpty() && column < view->model()->columnCount(); ++column) {
            if (kindAt(rows.front().siblingAtColumn(column)) == kind) {
                view->scrollTo(rows.front().siblingAtColumn(column));
                return rows.front().siblingAtColumn(column);
            }
        }
        return {};
    }
    bool clickCell(const QString &field, ColumnKind kind) const
    {
        const QModelIndex at = cell(field, kind);
        auto *view = child<QTreeView>("tableView");
        if (at.isValid())
            click(view->viewport(), view->visualRect(at).center());
        return at.isValid();
    }
    /// By a double click on the raw value.
    bool openEditor(const QString &field) const
    {
        if (!clickCell(field, ColumnKind::Value))
            return false;
        auto *view = child<QTreeView>("tableView");
        const QPoint at = view->viewport()->mapTo(&m_window, view->visualRect(view->currentIndex()).center());
        QTest::mouseDClick(m_window.windowHandle(), Qt::LeftButton, {}, at);
        return QTest::qWaitFor([this] { return editor() && editor()->hasFocus(); });
    }
    QLineEdit *editor() const { return child<QLineEdit>("valueEdit"); }
    bool edit(const QString &field, const QString &text) const
    {
        if (!openEditor(field))
            return false;
        key(Qt::Key_A, Qt::ControlModifier);
        type(text);
        key(Qt::Key_Return);
        return true;
    }

    QString message() const
    {
        QStringList texts;
        for (const QLabel *label : m_window.findChildren<QLabel *>(QStringLiteral("messageText"))) {
            if (label->isVisible())
                texts << label->text();
        }
        return texts.join(u' ');
    }

    /// How much of the plot's height its first trace covers as it is painted, 0 to 1; −1 where it isn't painted.
    double paintedHeight() const
    {
        const PlotChart &chart = m_window.findChild<PlotArea *>()->panels().front()->chart();
        if (chart.traces().empty())
            return -1;
        const QImage picture = const_cast<PlotChart &>(chart).grab().toImage();
        const QRect area = chart.plotArea().toRect();
        const QRgb ink = chart.traces().front().color.rgb();
        int top = area.bottom() + 1;
        int bottom = -1;
        for (int y = area.top(); y <= area.bottom(); ++y) {
            for (int x = area.left(); x <= area.right(); ++x) {
                if (picture.pixel(x, y) == ink) {
                    top = std::min(top, y);
                    bottom = y;
                }
            }
        }
        return bottom < top ? -1 : double(bottom - top) / area.height();
    }

private:
    QMainWindow &m_window;
};

} // namespace dynascope::test
