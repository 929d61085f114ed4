// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/support/windowdriver.h"
#include "tests/support/workbenchfixture.h"
#include "ui/common/messagebar.h"
#include "ui/devices/devicetreemodel.h"
#include "ui/mainwindow.h"
#include "ui/table/tableview.h"

#include <QHeaderView>
#include <QSettings>
#include <QTreeView>

using namespace dynascope;

/// Several servos of a simulated bus, selected in the tree and edited together.
class TestComparisonWindow : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        QSettings().clear();
        m_bench = std::make_unique<test::WorkbenchFixture>(QStringLiteral(
            "XM430-W350@1000000:1,XL430-W250@1000000:4,XL330-M288/51@1000000:5,XL330-M288/53@1000000:6"));
        m_window = std::make_unique<MainWindow>(m_bench->workbench());
        m_window->resize(1600, 900);
        m_window->show();
        m_window->activateWindow();
        QVERIFY(QTest::qWaitForWindowActive(m_window.get()));
        m_window->connectTo(QStringLiteral("sim"), 1000000);
        QTRY_COMPARE(m_bench->session.devices().size(), std::size_t(4));
        QTRY_VERIFY(!m_bench->scanner.isRunning());
    }
    void cleanup()
    {
        m_window.reset();
        m_bench.reset();
    }

    void columnsStandAsInTheTree()
    {
        select({4, 1});
        QTRY_COMPARE(titles(), (QStringList{QStringLiteral("XM430-W350 #1"), QStringLiteral("XL430-W250 #4")}));
        QTRY_COMPARE(m_bench->device(4, 1000000)->raw(u"ID"), 4); // each is read once
    }

    void anEditOfAllReachesEach()
    {
        select({1, 4});
        editAll(QStringLiteral("Position P Gain"), QStringLiteral("500"));
        for (const int id : {1, 4})
            QTRY_COMPARE(m_bench->device(id, 1000000)->raw(u"Position P Gain"), 500);
    }

    void eachFirmwareIsWrittenAtItsOwnAddress()
    {
        select({5, 6});
        const Device *old = m_bench->device(5, 1000000);
        const Device *fresh = m_bench->device(6, 1000000);
        QVERIFY(old->table().find(u"Indirect Address 1")->address
                == fresh->table().find(u"Indirect Address 1")->address);
        QVERIFY(old->table().find(u"Indirect Data 1")->address != fresh->table().find(u"Indirect Data 1")->address);
        // They point at the LED: what is written to the data is seen there.
        for (const int id : {5, 6}) {
            Device *device = m_bench->device(id, 1000000);
            m_bench->commands.writeField(*device, device->table().indexOf(u"Indirect Address 1"), 65);
            QTRY_COMPARE(device->raw(u"Indirect Address 1"), 65);
        }
        editAll(QStringLiteral("Indirect Data 1"), QStringLiteral("1"));
        for (const int id : {5, 6}) {
            Device *device = m_bench->device(id, 1000000);
            QTRY_COMPARE(device->raw(u"Indirect Data 1"), 1);
            m_bench->commands.readAll(*device);
            QTRY_COMPARE(device->raw(u"LED"), 1);
        }
    }

    void aRefusalIsSaidAndNothingWritten()
    {
        select({1, 4});
        test::WindowDriver driver(*m_window);
        const QModelIndex cell = driver.cell(QStringLiteral("Temperature Limit"), ColumnKind::All);
        QVERIFY(cell.isValid());
        const QModelIndex current = driver.cell(QStringLiteral("Current Limit"), ColumnKind::All);
        QVERIFY(!view()->model()->setData(current, 100, Qt::EditRole));
        auto *messages = m_window->findChild<MessageBar *>(QStringLiteral("messageBar"));
        QVERIFY2(messages->text().startsWith(QStringLiteral("Nothing was written")), qPrintable(messages->text()));
        QVERIFY2(messages->text().contains(QStringLiteral("XL430-W250 #4")), qPrintable(messages->text()));
    }

private:
    TableView *view() const { return m_window->findChild<TableView *>(QStringLiteral("tableView")); }

    void select(const QList<int> &ids)
    {
        auto *tree = m_window->findChild<QTreeView *>(QStringLiteral("deviceTree"));
        auto *model = static_cast<DeviceTreeModel *>(tree->model());
        Qt::KeyboardModifiers modifiers;
        for (const int id : ids) {
            const QModelIndex row = model->indexOf(m_bench->device(id, 1000000));
            tree->scrollTo(row);
            QTest::mouseClick(tree->viewport(), Qt::LeftButton, modifiers, tree->visualRect(row).center());
            modifiers = Qt::ControlModifier;
        }
        for (const int id : ids)
            QTRY_VERIFY(m_bench->device(id, 1000000)->raw(u"ID").has_value());
    }

    void editAll(const QString &field, const QString &text)
    {
        test::WindowDriver driver(*m_window);
        const QModelIndex cell = driver.cell(field, ColumnKind::All);
        QVERIFY(cell.isValid());
        view()->setCurrentIndex(cell);
        QTRY_VERIFY(cell.data(LockRole).toString().isEmpty());
        QTest::keyClick(view(), Qt::Key_Return);
        QVERIFY(driver.editor());
        driver.editor()->setText(text);
        QTest::keyClick(driver.editor(), Qt::Key_Return);
        QTRY_VERIFY(!driver.editor());
    }

    QStringList titles() const
    {
        QStringList found;
        for (int column = 0; column < view()->model()->columnCount(); ++column) {
            const auto said = [&](int role) { return view()->model()->headerData(column, Qt::Horizontal, role); };
            if (said(KindRole).toInt() == static_cast<int>(ColumnKind::Device))
                found << said(Qt::DisplayRole).toString();
        }
        return found;
    }

    std::unique_ptr<test::WorkbenchFixture> m_bench;
    std::unique_ptr<MainWindow> m_window;
};

DYNASCOPE_UI_TEST(TestComparisonWindow)
#include "tst_comparisonwindow.moc"
