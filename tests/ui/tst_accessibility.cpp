// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/support/workbenchfixture.h"
#include "ui/devices/devicepanel.h"
#include "ui/mainwindow.h"
#include "ui/plot/plotarea.h"
#include "ui/table/tablepanel.h"
#include "ui/table/tableroles.h"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAction>
#include <QDialog>
#include <QLabel>
#include <QMenu>
#include <QSettings>
#include <QToolBar>
#include <QTreeView>

using namespace dynascope;

namespace {

/// What a screen reader would call it.
QString nameOf(const QWidget &widget)
{
    if (!widget.accessibleName().isEmpty())
        return widget.accessibleName();
    if (const auto *button = qobject_cast<const QAbstractButton *>(&widget))
        return button->text();
    if (const auto *label = qobject_cast<const QLabel *>(&widget))
        return label->text();
    for (const QLabel *label : widget.window()->findChildren<QLabel *>()) {
        if (label->buddy() == &widget)
            return label->text();
    }
    return {};
}

/// Not what is a part of another: a spin box's line, a list's viewport.
bool takesKeys(const QWidget &widget)
{
    const QWidget *parent = widget.parentWidget();
    return widget.isVisible() && widget.focusPolicy() != Qt::NoFocus && !widget.focusProxy()
        && !widget.objectName().startsWith(QStringLiteral("qt_")) && !widget.inherits("QHeaderView")
        && !(parent && parent->inherits("QComboBox")) && !widget.inherits("QSplitterHandle");
}

QString nameless(const QWidget &in)
{
    QStringList found;
    for (const QWidget *widget : in.findChildren<QWidget *>()) {
        if (takesKeys(*widget) && nameOf(*widget).isEmpty())
            found << QLatin1String(widget->metaObject()->className()) + u' ' + widget->objectName();
    }
    return found.join(QStringLiteral(", "));
}

/// Keys with Alt that two visible widgets want: neither would be obeyed.
QString wantedTwice(const QWidget &in)
{
    QMap<QString, QStringList> wanted;
    for (const QWidget *widget : in.findChildren<QWidget *>()) {
        const auto *button = qobject_cast<const QAbstractButton *>(widget);
        const auto *label = qobject_cast<const QLabel *>(widget);
        const QString text = button ? button->text() : label && label->buddy() ? label->text() : QString();
        const QKeySequence key = QKeySequence::mnemonic(text);
        if (widget->isVisible() && !key.isEmpty())
            wanted[key.toString()] << text;
    }
    QStringList found;
    for (const QStringList &texts : std::as_const(wanted)) {
        if (texts.size() > 1)
            found << texts.join(QStringLiteral(" / "));
    }
    return found.join(QStringLiteral(", "));
}

} // namespace

/// Nothing that can have the focus is without a name, whatever is open.
class TestAccessibility : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        QSettings().clear();
        m_bench = std::make_unique<test::WorkbenchFixture>();
        m_window = std::make_unique<MainWindow>(m_bench->workbench());
        m_window->resize(1400, 900);
        m_window->show();
        QVERIFY(QTest::qWaitForWindowExposed(m_window.get()));
    }
    void cleanup()
    {
        m_window.reset();
        m_bench.reset();
    }

    void theWelcome() { QCOMPARE(nameless(*m_window), QString()); }

    void theWindowAtWork()
    {
        Device *device = connectNow();
        QVERIFY(device);
        action("busHealthAction")->trigger();
        auto *plots = m_window->findChild<PlotArea *>();
        plots->addTrace({device->key(), device->table().indexOf(u"Present Position")});
        plots->addPanel();
        m_bench->commands.setTorque({device}, true);
        QTRY_VERIFY(device->isTorqueOn());
        QVERIFY(edit(u"Return Delay Time")); // is locked now: the bar says so
        QTRY_VERIFY(m_window->findChild<QWidget *>(QStringLiteral("lockBar"))->isVisible());
        QTRY_VERIFY(m_window->findChild<QWidget *>(QStringLiteral("goalSpin"))->isEnabled());
        QCOMPARE(nameless(*m_window), QString());
    }

    void editors_data()
    {
        QTest::addColumn<QString>("field");
        QTest::addColumn<QString>("editor");
        QTest::newRow("number") << QStringLiteral("Profile Velocity") << QStringLiteral("valueEdit");
        QTest::newRow("list") << QStringLiteral("Status Return Level") << QStringLiteral("enumEdit");
        QTest::newRow("bits") << QStringLiteral("Shutdown") << QStringLiteral("bitPopup");
        QTest::newRow("bits and lists") << QStringLiteral("Drive Mode") << QStringLiteral("bitPopup");
    }
    void editors()
    {
        QFETCH(QString, field);
        QFETCH(QString, editor);
        QVERIFY(connectNow());
        QVERIFY(edit(field));
        auto *shown = m_window->findChild<QWidget *>(editor);
        QVERIFY(shown && shown->isVisible());
        QCOMPARE(nameOf(*shown), field);
        QCOMPARE(nameless(*m_window), QString());
    }

    void dialogs_data()
    {
        QTest::addColumn<QByteArray>("action");
        for (const char *name :
             {"renameAction", "changeIdAction", "changeBaudAction", "moveManyAction", "factoryResetAction",
                 "scanOptionsAction", "libraryAction", "profileAction", "commissionAction", "compareAction", "shortcutsAction", "aboutAction"})
            QTest::newRow(name) << QByteArray(name);
    }
    void dialogs()
    {
        QFETCH(QByteArray, action);
        QVERIFY(connectNow());
        this->action(action.constData())->trigger();
        QTRY_VERIFY(qobject_cast<QDialog *>(QApplication::activeWindow()) || QApplication::activePopupWidget());
        QWidget *popup = QApplication::activePopupWidget();
        const QWidget *front = popup ? popup : QApplication::activeWindow();
        QCOMPARE(nameless(*front), QString());
        QCOMPARE(wantedTwice(*front), QString());
    }

    void actions()
    {
        QVERIFY(connectNow());
        int seen = 0;
        QWidgetList holders;
        for (QMenu *menu : m_window->findChildren<QMenu *>())
            holders << menu;
        for (QToolBar *bar : m_window->findChildren<QToolBar *>())
            holders << bar;
        for (const QWidget *holder : holders) {
            for (const QAction *each : holder->actions()) {
                if (each->isSeparator() || each->inherits("QWidgetAction"))
                    continue;
                ++seen;
                QVERIFY2(!each->text().isEmpty() && !each->toolTip().isEmpty(), qPrintable(each->objectName()));
                QVERIFY2(!each->toolTip().contains(u'\t'), qPrintable(each->toolTip())); // the menu's own
            }
        }
        QVERIFY(seen > 30);
    }

    void aKeyHeldDownIsOneOrder()
    {
        int seen = 0;
        for (const QAction *each : m_window->findChildren<QAction *>()) {
            if (each->shortcut().isEmpty() || each->shortcutContext() != Qt::WindowShortcut)
                continue;
            ++seen;
            QVERIFY2(!each->autoRepeat(), qPrintable(each->text()));
        }
        QVERIFY(seen > 15);
    }

private:
    Device *connectNow()
    {
        m_window->connectTo(QStringLiteral("sim"), 1000000);
        const bool found = QTest::qWaitFor([this] {
            const std::vector<Device *> selected = m_window->findChild<DevicePanel *>()->selectedDevices();
            return m_bench->session.devices().size() == 3 && !m_bench->scanner.isRunning() && !selected.empty()
                && selected.front()->raw(u"Drive Mode") && selected.front()->raw(u"Present Position");
        });
        return found ? m_window->findChild<DevicePanel *>()->selectedDevices().front() : nullptr;
    }

    QAction *action(const char *name) const { return m_window->findChild<QAction *>(QString::fromLatin1(name)); }

    /// Enter on the register's row.
    bool edit(QStringView field) const
    {
        auto *view = m_window->findChild<QTreeView *>(QStringLiteral("tableView"));
        const QModelIndexList rows = view->model()->match(view->model()->index(0, 0), Qt::DisplayRole,
            field.toString(), 1, Qt::MatchExactly | Qt::MatchRecursive);
        if (rows.isEmpty())
            return false;
        view->setCurrentIndex(rows.front());
        QTest::keyClick(view, Qt::Key_Return);
        return true;
    }

    std::unique_ptr<test::WorkbenchFixture> m_bench;
    std::unique_ptr<MainWindow> m_window;
};

DYNASCOPE_UI_TEST(TestAccessibility)
#include "tst_accessibility.moc"
