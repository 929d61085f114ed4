// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/windowdriver.h"

#include "ui/devices/devicetreemodel.h"
#include "ui/plot/plotarea.h"
#include "ui/plot/plotchart.h"
#include "ui/plot/plotpanel.h"

#include <QApplication>
#include <QLabel>
#include <QMenu>
#include <QMenuBar>
#include <QTreeView>
#include <QWindow>

namespace dynascope::test {

void WindowDriver::click(QWidget *widget, QPoint at, Qt::MouseButton button)
{
    QTest::mouseClick(widget->window()->windowHandle(), button, {}, widget->mapTo(widget->window(), at));
}

bool WindowDriver::click(const char *name) const
{
    auto *widget = child<QWidget>(name);
    if (!widget || !widget->isEnabled())
        return false;
    click(widget);
    return true;
}

void WindowDriver::key(Qt::Key key, Qt::KeyboardModifiers modifiers)
{
    QTest::keyClick(front()->windowHandle(), key, modifiers);
}

void WindowDriver::type(const QString &text)
{
    for (const QChar letter : text)
        QTest::keyClick(front()->windowHandle(), letter.toLatin1());
}

QWidget *WindowDriver::front()
{
    QWidget *popup = QApplication::activePopupWidget();
    return popup ? popup : QApplication::activeWindow();
}

bool WindowDriver::clickDevice(const Device &device, Qt::MouseButton button) const
{
    auto *tree = child<QTreeView>("deviceTree");
    if (!tree)
        return false;
    const QModelIndex row = static_cast<DeviceTreeModel *>(tree->model())->indexOf(&device);
    tree->scrollTo(row);
    click(tree->viewport(), tree->visualRect(row).center(), button);
    return tree->selectionModel()->isSelected(row);
}

bool WindowDriver::pick(const char *action)
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

bool WindowDriver::openMenu(const QString &title) const
{
    for (QAction *menu : m_window.menuBar()->actions()) {
        if (menu->text().remove(u'&') == title)
            click(m_window.menuBar(), m_window.menuBar()->actionGeometry(menu).center());
    }
    return qobject_cast<QMenu *>(QApplication::activePopupWidget()) != nullptr;
}

bool WindowDriver::pickForDevice(const Device &device, const char *action) const
{
    return clickDevice(device, Qt::RightButton) && pick(action);
}

QModelIndex WindowDriver::cell(const QString &field, ColumnKind kind) const
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

bool WindowDriver::clickCell(const QString &field, ColumnKind kind) const
{
    const QModelIndex at = cell(field, kind);
    auto *view = child<QTreeView>("tableView");
    if (at.isValid())
        click(view->viewport(), view->visualRect(at).center());
    return at.isValid();
}

bool WindowDriver::openEditor(const QString &field) const
{
    if (!clickCell(field, ColumnKind::Value))
        return false;
    auto *view = child<QTreeView>("tableView");
    const QPoint at = view->viewport()->mapTo(&m_window, view->visualRect(view->currentIndex()).center());
    QTest::mouseDClick(m_window.windowHandle(), Qt::LeftButton, {}, at);
    return QTest::qWaitFor([this] { return editor() && editor()->hasFocus(); });
}

bool WindowDriver::edit(const QString &field, const QString &text) const
{
    if (!openEditor(field))
        return false;
    key(Qt::Key_A, Qt::ControlModifier);
    type(text);
    key(Qt::Key_Return);
    return true;
}

QString WindowDriver::message() const
{
    QStringList texts;
    for (const QLabel *label : m_window.findChildren<QLabel *>(QStringLiteral("messageText"))) {
        if (label->isVisible())
            texts << label->text();
    }
    return texts.join(u' ');
}

double WindowDriver::paintedHeight() const
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

} // namespace dynascope::test
