// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/ui/tablewindow.h"
#include "ui/table/enumedit.h"

#include <QClipboard>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QSignalSpy>
#include <QToolButton>

using namespace dynascope;

class TestTablePanel : public QObject
{
    Q_OBJECT

private slots:
    void aLockOffersTheWay()
    {
        TableFixture fixture;
        TableWindow window(fixture);
        Device *device = fixture.add(3);
        TableFixture::set(device, QStringLiteral("Torque Enable"), 1);
        window.panel.setDevices({device});
        window.go(QStringLiteral("Max Position Limit"));
        QTest::keyClick(window.view, Qt::Key_Return);
        QVERIFY(!window.edit());
        auto *bar = window.find<QWidget>("lockBar");
        QVERIFY(bar->isVisible());
        auto *way = window.find<QPushButton>("lockBarButton");
        QCOMPARE(way->text(), QStringLiteral("Turn torque off and edit"));

        fixture.torqueGoesOff = false;
        QTest::mouseClick(way, Qt::LeftButton);
        QCOMPARE(fixture.torqueOff, std::vector<int>{3});
        QVERIFY(window.find<QLabel>("lockBarText")->text().contains(QStringLiteral("nothing came back")));
        QVERIFY(!window.edit());

        fixture.torqueGoesOff = true;
        QTest::mouseClick(way, Qt::LeftButton);
        QTRY_VERIFY(window.edit());
        QVERIFY(!bar->isVisible());
        window.edit()->setText(QStringLiteral("3000"));
        QTest::keyClick(window.edit(), Qt::Key_Return);
        QTRY_COMPARE(fixture.written(), QStringList{QStringLiteral("3 Max Position Limit=3000")});
    }

    void aLockThatEndsByItselfTakesItsBarAlong()
    {
        TableFixture fixture;
        TableWindow window(fixture);
        Device *device = fixture.add(3);
        TableFixture::set(device, QStringLiteral("Torque Enable"), 1);
        window.panel.setDevices({device});
        window.go(QStringLiteral("Max Position Limit"));
        QTest::keyClick(window.view, Qt::Key_Return);
        auto *bar = window.find<QWidget>("lockBar");
        QVERIFY(bar->isVisible());
        TableFixture::set(device, QStringLiteral("Torque Enable"), 0);
        QTRY_VERIFY(!bar->isVisible());
        QVERIFY(!window.edit()); // nobody asked for it any more
    }

    void idAndBaudAreProcedures()
    {
        TableFixture fixture;
        TableWindow window(fixture);
        Device *device = fixture.add(3);
        window.panel.setDevices({device});
        QSignalSpy id(&window.panel, &TablePanel::changeIdRequested);
        QSignalSpy baud(&window.panel, &TablePanel::changeBaudRequested);
        window.go(QStringLiteral("ID"));
        QTest::keyClick(window.view, Qt::Key_Return);
        window.go(QStringLiteral("Baud Rate"));
        QTest::keyClick(window.view, Qt::Key_F2);
        QCOMPARE(id.count(), 1);
        QCOMPARE(id.front().front().value<Device *>(), device);
        QCOMPARE(baud.count(), 1);
        QVERIFY(!window.edit() && !window.view->findChild<EnumEdit *>());
        QCOMPARE(fixture.written(), QStringList());
    }

    void theMenuResetsToDefault()
    {
        TableFixture fixture;
        TableWindow window(fixture);
        Device *device = fixture.add(3);
        TableFixture::set(device, QStringLiteral("Position P Gain"), 1);
        window.panel.setDevices({device});
        window.go(QStringLiteral("Position P Gain"));
        const QPoint at = window.view->visualRect(window.view->currentIndex()).center();
        emit window.view->customContextMenuRequested(at);
        auto *menu = window.find<QMenu>("tableMenu");
        QVERIFY(menu && menu->isVisible());
        const auto actions = menu->actions();
        const auto entry = std::ranges::find(actions, QStringLiteral("Reset to default"), &QAction::text);
        QVERIFY(entry != actions.end() && (*entry)->isEnabled());
        (*entry)->trigger();
        menu->close();
        QCOMPARE(fixture.written(), QStringList{QStringLiteral("3 Position P Gain=800")});
    }

    void aClickTicksAPlot()
    {
        TableFixture fixture;
        TableWindow window(fixture);
        window.panel.setDevices({fixture.add(3)});
        QSignalSpy plot(&window.panel, &TablePanel::plotRequested);
        window.go(QStringLiteral("Present Current"));
        const QRect tick = window.view->visualRect(window.cell(QStringLiteral("Present Current"), ColumnKind::Plot));
        QTest::mouseClick(window.view->viewport(), Qt::LeftButton, {}, tick.center());
        QCOMPARE(plot.count(), 1);
    }

    void anotherRowPutsTheLockBarAway()
    {
        TableFixture fixture;
        TableWindow window(fixture);
        Device *device = fixture.add(3);
        TableFixture::set(device, QStringLiteral("Torque Enable"), 1);
        window.panel.setDevices({device});
        window.go(QStringLiteral("Max Position Limit"));
        QTest::keyClick(window.view, Qt::Key_Return);
        QVERIFY(window.find<QWidget>("lockBar")->isVisible());
        window.go(QStringLiteral("LED"));
        QVERIFY(!window.find<QWidget>("lockBar")->isVisible());
    }

    void severalDevicesAtOnce()
    {
        TableFixture fixture;
        TableWindow window(fixture);
        window.panel.setDevices({fixture.add(1), fixture.add(2), fixture.add(3)});
        window.go(QStringLiteral("Position P Gain"), ColumnKind::Device);
        const auto edit = [&](const QString &text) {
            QTest::keyClick(window.view, Qt::Key_F2);
            QVERIFY(window.edit());
            window.edit()->setText(text);
            QTest::keyClick(window.edit(), Qt::Key_Return);
            QTRY_VERIFY(!window.edit());
        };
        QTest::keyClick(window.view, Qt::Key_Right);
        edit(QStringLiteral("500"));
        QCOMPARE(fixture.written(), QStringList{QStringLiteral("2 Position P Gain=500")});
        fixture.writes.clear();
        QTest::keyClick(window.view, Qt::Key_Left);
        QTest::keyClick(window.view, Qt::Key_Left);
        QCOMPARE(kindAt(window.view->currentIndex()), ColumnKind::All);
        edit(QStringLiteral("600"));
        const QStringList expected{QStringLiteral("1 Position P Gain=600"), QStringLiteral("2 Position P Gain=600"),
                                   QStringLiteral("3 Position P Gain=600")};
        QCOMPARE(fixture.written(), expected);
    }

    void keysSearchPlotAndCopy()
    {
        TableFixture fixture;
        TableWindow window(fixture);
        Device *device = fixture.add(3);
        TableFixture::set(device, QStringLiteral("Present Position"), 1024);
        window.panel.setDevices({device});
        std::vector<Watch> asked;
        connect(&window.panel, &TablePanel::plotRequested, this, [&](const Watch &watch) { asked.push_back(watch); });
        window.go(QStringLiteral("Present Position"), ColumnKind::Physical);
        QTest::keyClick(window.view, Qt::Key_Space);
        QCOMPARE(asked, (std::vector<Watch>{{device->key(), TableFixture::field(device, u"Present Position")}}));
        window.panel.activateWindow();
        QVERIFY(QTest::qWaitForWindowActive(&window.panel));
        window.view->setFocus();
        QTest::keyClick(window.view, Qt::Key_F, Qt::ControlModifier);
        auto *search = window.find<QLineEdit>("tableSearch");
        QTRY_VERIFY(search->hasFocus());
        QTest::keyClicks(search, QStringLiteral("132"));
        QCOMPARE(window.view->model()->rowCount(), 1);
        QTest::keyClick(search, Qt::Key_Return);
        QVERIFY(window.view->hasFocus());
        QCOMPARE(window.view->currentIndex().siblingAtColumn(0).data().toString(), QStringLiteral("Present Position"));
        QTest::keyClick(window.view, Qt::Key_C, Qt::ControlModifier);
        QCOMPARE(QGuiApplication::clipboard()->text(), QStringLiteral("90.00 °"));
        QTest::keyClick(search, Qt::Key_Escape);
        QVERIFY(search->text().isEmpty());
    }

    void searchEndsOnASelectedRow()
    {
        TableFixture fixture;
        TableWindow window(fixture);
        window.panel.setDevices({fixture.add(3)});
        window.go(QStringLiteral("Max Voltage Limit"));
        auto *search = window.find<QLineEdit>("tableSearch");
        QTest::keyClicks(search, QStringLiteral("velo"));
        QTest::keyClick(search, Qt::Key_Return);
        const QModelIndex current = window.view->currentIndex();
        QVERIFY(current.isValid() && window.view->selectionModel()->isSelected(current));
    }

    void headingsAreNotSelected()
    {
        TableFixture fixture;
        TableWindow window(fixture);
        window.panel.setDevices({fixture.add(3)});
        window.view->selectAll();
        const QItemSelectionModel *selection = window.view->selectionModel();
        QVERIFY(selection->isSelected(window.cell(QStringLiteral("ID"), ColumnKind::Name)));
        QVERIFY(!selection->isSelected(window.view->model()->index(0, 0)));
    }

    void saysWhenThereIsNothing()
    {
        TableFixture fixture;
        TableWindow window(fixture);
        auto *title = window.find<QLabel>("tableEmptyTitle");
        QVERIFY(title->isVisible());
        QCOMPARE(title->text(), QStringLiteral("No device selected"));
        window.panel.setDevices({fixture.add(3)});
        QVERIFY(!title->isVisible());
        QVERIFY(window.view->isVisible());
    }

    void staysWhereItIsWhenTheDeviceChanges()
    {
        TableFixture fixture;
        TableWindow window(fixture);
        Device *one = fixture.add(1);
        Device *two = fixture.add(2);
        window.panel.setDevices({one});
        window.go(QStringLiteral("Goal Position"));
        window.panel.setDevices({two});
        QCOMPARE(window.view->currentIndex().siblingAtColumn(0).data().toString(), QStringLiteral("Goal Position"));
        fixture.devices.clear(); // the line was closed
        QVERIFY(window.find<QLabel>("tableEmptyTitle")->isVisible());
    }

    void remembersItsLook()
    {
        TableFixture fixture;
        QByteArray state;
        {
            TableWindow window(fixture);
            window.panel.setDevices({fixture.add(1)});
            window.view->setColumnWidth(0, 251);
            window.view->collapse(window.view->model()->index(0, 0));
            window.find<QToolButton>("helpFold")->click();
            state = window.panel.saveState();
        }
        TableWindow window(fixture);
        window.panel.restoreState(QByteArrayLiteral("garbage"));
        window.panel.restoreState(state);
        window.panel.setDevices({fixture.devices.front().get()});
        QCOMPARE(window.view->columnWidth(0), 251);
        QVERIFY(!window.view->isExpanded(window.view->model()->index(0, 0)));
        QVERIFY(window.view->isExpanded(window.view->model()->index(1, 0)));
        QVERIFY(!window.find<QLabel>("helpText")->isVisible());
    }
};

DYNASCOPE_UI_TEST(TestTablePanel)
#include "tst_tablepanel.moc"
