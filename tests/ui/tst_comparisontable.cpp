// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/ui/tablewindow.h"
#include "ui/table/fieldtablemodel.h"
#include "ui/table/fieldwordsmodel.h"

#include <QAbstractItemModelTester>
#include <QAction>
#include <QClipboard>
#include <QGuiApplication>
#include <QHeaderView>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QScrollBar>
#include <QSignalSpy>
#include <QToolButton>

using namespace dynascope;

/// Several devices beside each other: XM430 #1 and #2, XL430 #3 (no current), XL-320 #4 (another family).
class TestComparisonTable : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        m_fixture = std::make_unique<TableFixture>();
        for (const int model : {1020, 1020, 1060, 350})
            m_fixture->add(static_cast<int>(m_fixture->devices.size()) + 1, model);
        m_window = std::make_unique<TableWindow>(*m_fixture);
        m_refused = std::make_unique<QSignalSpy>(&m_window->panel, &TablePanel::notWritten);
    }
    void cleanup()
    {
        m_refused.reset();
        m_window.reset();
        m_fixture.reset();
    }

    void modelOfMixedTablesIsSound()
    {
        FieldTableModel model(m_fixture->actions());
        FieldWordsModel words;
        words.setSourceModel(&model);
        const QAbstractItemModelTester tester(&model, QAbstractItemModelTester::FailureReportingMode::QtTest);
        const QAbstractItemModelTester wordsTester(&words, QAbstractItemModelTester::FailureReportingMode::QtTest);
        model.setDevices(m_fixture->all());
        TableFixture::set(device(2), QStringLiteral("Goal Position"), 5);
        model.setDevices({device(4), device(1)});
        m_fixture->devices.pop_back();
        QCOMPARE(model.devices(), std::vector<Device *>{device(1)});
        model.setDevices({});
    }

    void aColumnForEach()
    {
        device(2)->setNickname(QStringLiteral("Elbow"));
        show({1, 2, 3});
        const QAbstractItemModel *model = m_window->view->model();
        QStringList titles;
        for (int column = 0; column < model->columnCount(); ++column)
            titles << model->headerData(column, Qt::Horizontal, Qt::DisplayRole).toString();
        const QStringList expected{QStringLiteral("Name"),          QStringLiteral("Plot"),
                                   QStringLiteral("Address"),       QStringLiteral("All"),
                                   QStringLiteral("XM430-W350 #1"), QStringLiteral("Elbow #2"),
                                   QStringLiteral("XL430-W250 #3"), QStringLiteral("Access")};
        QCOMPARE(titles, expected);
        QCOMPARE(at("Position P Gain", 1).data().toString(), QStringLiteral("800"));
        QVERIFY(!m_window->find<QWidget>("othersLabel")->isVisible());
    }

    void marksWhatDiffers()
    {
        TableFixture::set(device(2), QStringLiteral("Position P Gain"), 640);
        TableFixture::set(device(2), QStringLiteral("Homing Offset"), 12);
        TableFixture::set(device(2), QStringLiteral("Present Position"), 99);
        show({1, 2});
        QVERIFY(at("Position P Gain", 1).data(DiffersRole).toBool());
        QVERIFY(!at("Position P Gain", 0).data(DiffersRole).toBool());
        for (const char *own : {"ID", "Homing Offset", "Present Position"})
            QVERIFY2(!at(own, 1).data(DiffersRole).toBool(), own);
        QCOMPARE(all("Position P Gain").data().toString(), QStringLiteral("mixed"));
        QCOMPARE(all("Position D Gain").data().toString(), QStringLiteral("0"));
        m_window->find<QToolButton>("filterDifferent")->click();
        QCOMPARE(shownRows(), QStringList{QStringLiteral("Position P Gain")});
        TableFixture::set(device(1), QStringLiteral("Position P Gain"), 640);
        QTRY_COMPARE(shownRows(), QStringList());
    }

    void whatAModelLacksIsEmptyAndSaysSo()
    {
        show({1, 3});
        const QModelIndex cell = at("Current Limit", 1);
        QCOMPARE(cell.data().toString(), QString());
        QVERIFY(cell.data(Qt::ToolTipRole).toString().contains(QStringLiteral("Not on this model")));
        QCOMPARE(cell.data(Qt::AccessibleTextRole).toString(), QStringLiteral("not on this model"));
        QVERIFY(!cell.flags().testFlag(Qt::ItemIsEditable));
        go(cell);
        QTest::keyClick(m_window->view, Qt::Key_Return);
        QVERIFY(!m_window->edit());
        QVERIFY(m_window->find<QLabel>("lockBarText")->text().contains(QStringLiteral("XL430-W250 #3")));
        // The keys pass through it.
        QTest::keyClick(m_window->view, Qt::Key_Down);
        QVERIFY(m_window->view->currentIndex() != cell);
    }

    void addressesOfTwoFirmwares()
    {
        Device *old = addFirmware(7, 1200, 51);
        Device *fresh = addFirmware(8, 1200, 53);
        m_window->panel.setDevices({old, fresh});
        const QModelIndex name = m_window->cell(QStringLiteral("Indirect Data 1"), ColumnKind::Address);
        QCOMPARE(name.data().toString(), QStringLiteral("208 …"));
        const QString said = name.data(Qt::ToolTipRole).toString();
        QVERIFY2(said.contains(QStringLiteral("51: 208")) && said.contains(QStringLiteral("53: 224")),
                 qPrintable(said));
        QVERIFY(m_window->view->model()->setData(all("Indirect Data 1"), 7, Qt::EditRole));
        QCOMPARE(m_fixture->written(),
                 (QStringList{QStringLiteral("7 Indirect Data 1=7"), QStringLiteral("8 Indirect Data 1=7")}));
        QVERIFY(TableFixture::field(old, u"Indirect Data 1") != TableFixture::field(fresh, u"Indirect Data 1"));
    }

    void editsOne()
    {
        show({1, 2, 3});
        go(at("Position P Gain", 1));
        type("500");
        QCOMPARE(m_fixture->written(), QStringList{QStringLiteral("2 Position P Gain=500")});
    }

    void editsAll()
    {
        TableFixture::set(device(2), QStringLiteral("Position P Gain"), 500);
        show({1, 2, 3});
        go(all("Position P Gain"));
        type("500");
        // Who has it already is left alone.
        QCOMPARE(m_fixture->written(),
                 (QStringList{QStringLiteral("1 Position P Gain=500"), QStringLiteral("3 Position P Gain=500")}));
        QCOMPARE(m_refused->count(), 0);
    }

    void enterOnANameEditsTheFirstAndNotAll()
    {
        show({1, 2});
        go(m_window->cell(QStringLiteral("Position P Gain"), ColumnKind::Name));
        type("500");
        QCOMPARE(m_fixture->written(), QStringList{QStringLiteral("1 Position P Gain=500")});
    }

    void menuSetsOnAll()
    {
        TableFixture::set(device(2), QStringLiteral("Position P Gain"), 650);
        show({1, 2, 3});
        QAction *copy = menuOf(at("Position P Gain", 1), "copyToAllAction");
        QVERIFY(copy);
        QCOMPARE(copy->text(), QStringLiteral("Set 650 on All 3 Selected"));
        copy->trigger();
        QCOMPARE(m_fixture->written(),
                 (QStringList{QStringLiteral("1 Position P Gain=650"), QStringLiteral("3 Position P Gain=650")}));
        closeMenu();
        QAction *edit = menuOf(at("Position P Gain", 1), "editAllAction");
        QVERIFY(edit);
        edit->trigger();
        QVERIFY(m_window->edit());
        QCOMPARE(kindAt(m_window->view->currentIndex()), ColumnKind::All);
        closeMenu();
    }

    void refusesAsAWhole_data()
    {
        QTest::addColumn<QList<int>>("ids");
        QTest::addColumn<QString>("field");
        QTest::addColumn<int>("raw");
        QTest::addColumn<int>("torqueOn"); // of which device; 0: of none
        QTest::addColumn<QString>("who");
        QTest::newRow("no such register")
            << QList<int>{1, 3} << QStringLiteral("Current Limit") << 5 << 0 << QStringLiteral("XL430-W250 #3");
        QTest::newRow("out of one's range")
            << QList<int>{4, 1} << QStringLiteral("Temperature Limit") << 120 << 0 << QStringLiteral("XM430-W350 #1");
        QTest::newRow("locked by torque")
            << QList<int>{1, 2} << QStringLiteral("Max Position Limit") << 100 << 2 << QStringLiteral("XM430-W350 #2");
    }

    void refusesAsAWhole()
    {
        QFETCH(QList<int>, ids);
        QFETCH(QString, field);
        QFETCH(int, raw);
        QFETCH(int, torqueOn);
        QFETCH(QString, who);
        if (torqueOn > 0)
            TableFixture::set(device(torqueOn), QStringLiteral("Torque Enable"), 1);
        show(ids);
        QVERIFY(!m_window->view->model()->setData(m_window->cell(field, ColumnKind::All), raw, Qt::EditRole));
        QCOMPARE(m_fixture->written(), QStringList());
        QCOMPARE(m_refused->count(), 1);
        const QString said = m_refused->front().front().toString();
        QVERIFY2(said.startsWith(QStringLiteral("Nothing was written")) && said.contains(who), qPrintable(said));
        QVERIFY2(!said.contains(QStringLiteral("..")), qPrintable(said));
    }

    void torqueOfOneLocksAllAndIsTheWay()
    {
        TableFixture::set(device(2), QStringLiteral("Torque Enable"), 1);
        show({1, 2});
        go(all("Max Position Limit"));
        QTest::keyClick(m_window->view, Qt::Key_Return);
        QVERIFY(!m_window->edit());
        auto *way = m_window->find<QPushButton>("lockBarButton");
        QVERIFY(way->isVisible());
        way->click();
        QCOMPARE(m_fixture->torqueOff, std::vector<int>{2}); // only whose torque is on
        QTRY_VERIFY(m_window->edit());
        // Where one has no such register, turning torque off would help nobody.
        show({1, 2, 4});
        TableFixture::set(device(2), QStringLiteral("Torque Enable"), 1);
        go(all("Max Position Limit"));
        QTest::keyClick(m_window->view, Qt::Key_Return);
        QVERIFY(m_window->find<QWidget>("lockBar")->isVisible());
        QVERIFY(!way->isVisible());
    }

    void idIsNobodysTwice()
    {
        show({1, 2});
        QSignalSpy asked(&m_window->panel, &TablePanel::changeIdRequested);
        go(all("ID"));
        QTest::keyClick(m_window->view, Qt::Key_Return);
        QVERIFY(!m_window->edit());
        QCOMPARE(asked.count(), 0);
        QVERIFY(m_window->find<QLabel>("lockBarText")->text().contains(QStringLiteral("one device at a time")));
        go(at("ID", 1));
        QTest::keyClick(m_window->view, Qt::Key_Return);
        QCOMPARE(asked.count(), 1);
        QCOMPARE(asked.front().front().value<Device *>(), device(2));
    }

    void aDeviceThatVanishesTakesTheEditorAlong()
    {
        show({1, 2, 3, 4});
        go(all("Temperature Limit"));
        QTest::keyClick(m_window->view, Qt::Key_Return);
        QVERIFY(m_window->edit());
        m_window->edit()->setText(QStringLiteral("60"));
        m_fixture->devices.pop_back();
        QTRY_VERIFY(!m_window->edit());
        QCOMPARE(m_fixture->written(), QStringList()); // half an edit is none
        QCOMPARE(m_window->view->model()->headerData(6, Qt::Horizontal, Qt::DisplayRole).toString(),
                 QStringLiteral("XL430-W250 #3"));
    }

    void anotherSelectionDropsTheEditor()
    {
        show({1, 2});
        go(all("Position P Gain"));
        QTest::keyClick(m_window->view, Qt::Key_Return);
        QVERIFY(m_window->edit());
        m_window->edit()->setText(QStringLiteral("500"));
        show({1, 2, 3});
        QTRY_VERIFY(!m_window->edit());
        QCOMPARE(m_fixture->written(), QStringList());
    }

    void aDeviceThatMovesKeepsItsColumnAndTheEdit()
    {
        show({1, 2});
        go(at("Position P Gain", 1));
        QTest::keyClick(m_window->view, Qt::Key_Return);
        QVERIFY(m_window->edit());
        Found moved = device(2)->found();
        moved.id = 9;
        device(2)->setFound(moved);
        QVERIFY(m_window->edit());
        m_window->edit()->setText(QStringLiteral("500"));
        QTest::keyClick(m_window->edit(), Qt::Key_Return);
        QTRY_COMPARE(m_fixture->written(), QStringList{QStringLiteral("9 Position P Gain=500")});
        QCOMPARE(m_window->view->model()->headerData(5, Qt::Horizontal, Qt::DisplayRole).toString(),
                 QStringLiteral("XM430-W350 #9"));
    }

    void valuesMoveNothing()
    {
        show({1, 2, 3});
        m_window->go(QStringLiteral("Present Position"), ColumnKind::Device);
        QList<int> widths;
        for (int column = 0; column < m_window->view->model()->columnCount(); ++column)
            widths << m_window->view->columnWidth(column);
        const int scrolled = m_window->view->verticalScrollBar()->value();
        QSignalSpy told(m_window->view->model(), &QAbstractItemModel::dataChanged);
        for (int raw = 0; raw < 4000; raw += 500)
            TableFixture::set(device(2), QStringLiteral("Present Position"), raw - 2000);
        QTRY_VERIFY(!told.isEmpty());
        for (int column = 0; column < m_window->view->model()->columnCount(); ++column)
            QCOMPARE(m_window->view->columnWidth(column), widths[column]);
        QCOMPARE(m_window->view->verticalScrollBar()->value(), scrolled);
    }

    void keysGoAlongTheValuesAndCopy()
    {
        show({1, 2});
        m_window->panel.activateWindow();
        QVERIFY(QTest::qWaitForWindowActive(&m_window->panel));
        m_window->view->setFocus();
        go(all("Position P Gain"));
        QTest::keyClick(m_window->view, Qt::Key_Right);
        QTest::keyClick(m_window->view, Qt::Key_Right);
        QCOMPARE(m_window->view->currentIndex(), at("Position P Gain", 1));
        QTest::keyClick(m_window->view, Qt::Key_C, Qt::ControlModifier);
        QCOMPARE(QGuiApplication::clipboard()->text(), QStringLiteral("800"));
    }

    void namesStayInSight()
    {
        m_window->panel.resize(600, 700);
        show({1, 2, 3, 4});
        auto *names = m_window->find<QWidget>("frozenNames");
        QVERIFY(!names->isVisible());
        m_window->view->horizontalScrollBar()->setValue(300);
        QVERIFY(names->isVisible());
        const QModelIndex cell = m_window->cell(QStringLiteral("Operating Mode"), ColumnKind::Name);
        m_window->view->verticalScrollBar()->setValue(0);
        const QPoint at(20, m_window->view->visualRect(cell).center().y() + m_window->view->header()->height());
        QTest::mouseClick(names, Qt::LeftButton, {}, at);
        QCOMPARE(m_window->view->currentIndex(), cell);
        m_window->view->horizontalScrollBar()->setValue(0);
        QVERIFY(!names->isVisible());
    }

    void manyAreBoundedAndSaid()
    {
        for (int id = 10; id < 50; ++id)
            m_fixture->add(id);
        m_window->panel.setDevices(m_fixture->all());
        m_window->panel.setSelected(m_fixture->devices.size());
        const QModelIndex row = m_window->cell(QStringLiteral("Position P Gain"), ColumnKind::Name);
        int columns = 0;
        for (int column = 0; column < m_window->view->model()->columnCount(); ++column)
            columns += kindAt(row.siblingAtColumn(column)) == ColumnKind::Device ? 1 : 0;
        QCOMPARE(columns, 32);
        QVERIFY(m_window->find<QWidget>("othersLabel")->isVisible());
    }

private:
    Device *device(int id) const { return m_fixture->devices[static_cast<std::size_t>(id - 1)].get(); }

    Device *addFirmware(int id, int model, int firmware)
    {
        Found found;
        found.id = static_cast<std::uint8_t>(id);
        found.modelNumber = static_cast<std::uint16_t>(model);
        found.firmware = firmware;
        m_fixture->devices.push_back(std::make_unique<Device>(
            static_cast<DeviceKey>(id), nullptr, TableFixture::catalog().findOrRaw(model, firmware), found));
        return m_fixture->devices.back().get();
    }

    void show(const QList<int> &ids)
    {
        std::vector<Device *> devices;
        for (const int id : ids)
            devices.push_back(device(id));
        m_window->panel.setDevices(devices);
    }

    QModelIndex all(const char *field) const { return m_window->cell(QString::fromLatin1(field), ColumnKind::All); }

    /// Of the column's device, counted from 0.
    QModelIndex at(const char *field, int column) const
    {
        const QModelIndex first = m_window->cell(QString::fromLatin1(field), ColumnKind::Device);
        return first.siblingAtColumn(first.column() + column);
    }

    void go(const QModelIndex &cell)
    {
        QVERIFY(cell.isValid());
        m_window->view->scrollTo(cell);
        m_window->view->setCurrentIndex(cell);
    }

    void type(const char *text)
    {
        QTest::keyClick(m_window->view, Qt::Key_Return);
        QVERIFY(m_window->edit());
        m_window->edit()->selectAll();
        QTest::keyClicks(m_window->edit(), QString::fromLatin1(text));
        QTest::keyClick(m_window->edit(), Qt::Key_Return);
        QTRY_VERIFY(!m_window->edit());
    }

    QAction *menuOf(const QModelIndex &cell, const char *action)
    {
        go(cell);
        emit m_window->view->customContextMenuRequested(m_window->view->visualRect(cell).center());
        auto *menu = m_window->find<QMenu>("tableMenu");
        return menu ? menu->findChild<QAction *>(QString::fromLatin1(action)) : nullptr;
    }

    void closeMenu() { delete m_window->find<QMenu>("tableMenu"); }

    QStringList shownRows() const
    {
        QStringList names;
        const QAbstractItemModel *model = m_window->view->model();
        for (int group = 0; group < model->rowCount(); ++group) {
            const QModelIndex parent = model->index(group, 0);
            for (int row = 0; row < model->rowCount(parent); ++row)
                names << model->index(row, 0, parent).data().toString();
        }
        return names;
    }

    std::unique_ptr<TableFixture> m_fixture;
    std::unique_ptr<TableWindow> m_window;
    std::unique_ptr<QSignalSpy> m_refused;
};

DYNASCOPE_UI_TEST(TestComparisonTable)
#include "tst_comparisontable.moc"
