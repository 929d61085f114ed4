// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/ui/tablefixture.h"
#include "ui/table/bitpopup.h"
#include "ui/table/enumedit.h"
#include "ui/table/tablepanel.h"
#include "ui/table/tableview.h"
#include "ui/table/valueedit.h"

#include <QAbstractItemView>
#include <QCheckBox>
#include <QClipboard>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QSignalSpy>
#include <QToolButton>

using namespace dynascope;

namespace {

/// A panel on screen with what a test reaches for.
struct Window {
    explicit Window(TableFixture &fixture)
        : panel(fixture.actions())
        , view(panel.findChild<TableView *>(QStringLiteral("tableView")))
    {
        panel.resize(900, 900);
        panel.show();
    }

    QModelIndex cell(const QString &name, ColumnKind kind) const
    {
        const QAbstractItemModel *model = view->model();
        for (int group = 0; group < model->rowCount(); ++group) {
            const QModelIndex parent = model->index(group, 0);
            for (int row = 0; row < model->rowCount(parent); ++row) {
                const QModelIndex first = model->index(row, 0, parent);
                if (first.data().toString() != name)
                    continue;
                for (int column = 0; column < model->columnCount(); ++column) {
                    if (kindAt(first.siblingAtColumn(column)) == kind)
                        return first.siblingAtColumn(column);
                }
            }
        }
        return {};
    }

    void go(const QString &name, ColumnKind kind = ColumnKind::Value)
    {
        view->scrollTo(cell(name, kind));
        view->setCurrentIndex(cell(name, kind));
    }

    ValueEdit *edit() const { return view->findChild<ValueEdit *>(); }
    template <typename Widget>
    Widget *find(const char *name) const
    {
        return panel.findChild<Widget *>(QString::fromLatin1(name));
    }

    TablePanel panel;
    TableView *view;
};

} // namespace

class TestTablePanel : public QObject
{
    Q_OBJECT

private slots:
    void understandsWhatIsTyped_data()
    {
        QTest::addColumn<QString>("field");
        QTest::addColumn<QString>("text");
        QTest::addColumn<bool>("physical");
        QTest::addColumn<QString>("result"); // the raw value, or a piece of the message
        const auto row = [](const char *name, const QString &field, const QString &text, bool physical,
                            const QString &result) {
            QTest::newRow(name) << field << text << physical << result;
        };
        const QString goal = QStringLiteral("Goal Position");
        row("raw", goal, QStringLiteral("2048"), false, QStringLiteral("2048"));
        row("hexadecimal", goal, QStringLiteral("0x10"), true, QStringLiteral("16"));
        row("unit in the raw column", goal, QStringLiteral("90deg"), false, QStringLiteral("1024"));
        row("a bare number is degrees where degrees stand", goal, QStringLiteral("90"), true, QStringLiteral("1024"));
        row("with the sign that stands there", goal, QStringLiteral("90.00 °"), true, QStringLiteral("1024"));
        row("fraction", goal, QStringLiteral("180.5"), true, QStringLiteral("2054"));
        row("out of range", goal, QStringLiteral("5000"), false, QStringLiteral("0 to 4095"));
        row("out of range in degrees", goal, QStringLiteral("400"), true, QStringLiteral("range"));
        row("no number", goal, QStringLiteral("far"), true, QStringLiteral("Goal Position"));
        row("nothing", goal, QString(), true, QStringLiteral("needs a value"));
        row("volt", QStringLiteral("Max Voltage Limit"), QStringLiteral("12.1V"), false, QStringLiteral("121"));
        row("bare volt", QStringLiteral("Max Voltage Limit"), QStringLiteral("12.1"), true, QStringLiteral("121"));
        row("a foreign unit", QStringLiteral("Max Voltage Limit"), QStringLiteral("12mA"), false,
            QStringLiteral("does not fit"));
        row("no unit to take", QStringLiteral("Position P Gain"), QStringLiteral("12V"), true,
            QStringLiteral("no unit"));
        row("name of a value", QStringLiteral("Bus Watchdog"), QStringLiteral("off"), true, QStringLiteral("0"));
    }

    void understandsWhatIsTyped()
    {
        QFETCH(QString, field);
        QFETCH(QString, text);
        QFETCH(bool, physical);
        QFETCH(QString, result);
        TableFixture fixture;
        const Device *device = fixture.add(1);
        const int index = TableFixture::field(device, field);
        const EffectiveField effective = device->effective(index);
        ValueEdit edit({device->table().fields()[static_cast<std::size_t>(index)], effective, 4096, AngleUnit::Degrees,
                        physical && effective.unit != Unit::None},
                       QStringLiteral("-"), 0);
        edit.setText(text);
        const auto value = edit.value();
        if (value)
            QCOMPARE(QString::number(*value), result);
        else
            QVERIFY2(value.error().text.contains(result), qPrintable(value.error().text));
    }

    void anEditIsWritten()
    {
        TableFixture fixture;
        Window window(fixture);
        window.panel.setDevices({fixture.add(3)});
        window.go(QStringLiteral("Goal Position"), ColumnKind::Name); // Enter finds the value by itself
        QTest::keyClick(window.view, Qt::Key_Return);
        QVERIFY(window.edit());
        QCOMPARE(window.edit()->text(), QStringLiteral("0.00 °"));
        window.edit()->setText(QStringLiteral("90"));
        QTest::keyClick(window.edit(), Qt::Key_Return);
        QTRY_COMPARE(fixture.written(), QStringList{QStringLiteral("3 Goal Position=1024")});
        QTRY_VERIFY(!window.edit());
    }

    void anUntouchedEditorWritesNothing()
    {
        TableFixture fixture;
        Window window(fixture);
        Device *device = fixture.add(3);
        window.panel.setDevices({device});
        window.go(QStringLiteral("Goal Position"));
        QTest::keyClick(window.view, Qt::Key_F2);
        QVERIFY(window.edit());
        // Somebody else moves the goal meanwhile: neither the text nor the servo may be touched.
        TableFixture::set(device, QStringLiteral("Goal Position"), 77);
        QTest::qWait(60);
        QCOMPARE(window.edit()->text(), QStringLiteral("0"));
        QTest::keyClick(window.edit(), Qt::Key_Return);
        QTRY_VERIFY(!window.edit());
        QCOMPARE(fixture.written(), QStringList());
    }

    void whatCantBeStaysOpenAndSaysWhy()
    {
        TableFixture fixture;
        Window window(fixture);
        window.panel.setDevices({fixture.add(3)});
        QSignalSpy message(&window.panel, &TablePanel::message);
        window.go(QStringLiteral("Goal Position"));
        QTest::keyClick(window.view, Qt::Key_F2);
        QTest::keyClicks(window.edit(), QStringLiteral("99999"));
        auto *hint = window.find<QLabel>("valueHint");
        QVERIFY(hint && hint->isVisible());
        QVERIFY(hint->text().contains(QStringLiteral("0 to 4095")));
        QTest::keyClick(window.edit(), Qt::Key_Return);
        QVERIFY(window.edit() && window.edit()->isVisible());
        QTest::keyClick(window.edit(), Qt::Key_Escape);
        QTRY_VERIFY(!window.edit());
        QCOMPARE(fixture.written(), QStringList());
        QCOMPARE(message.count(), 0);
    }

    void stepsWithArrows()
    {
        TableFixture fixture;
        Window window(fixture);
        window.panel.setDevices({fixture.add(3)});
        window.go(QStringLiteral("Position P Gain"));
        QTest::keyClick(window.view, Qt::Key_F2);
        QTest::keyClick(window.edit(), Qt::Key_Up);
        QTest::keyClick(window.edit(), Qt::Key_PageUp);
        QTest::keyClick(window.edit(), Qt::Key_Return);
        QTRY_COMPARE(fixture.written(), QStringList{QStringLiteral("3 Position P Gain=811")});
    }

    void readOnlyHasNoEditor()
    {
        TableFixture fixture;
        Window window(fixture);
        window.panel.setDevices({fixture.add(3)});
        window.go(QStringLiteral("Present Position"));
        QTest::keyClick(window.view, Qt::Key_F2);
        QVERIFY(!window.edit());
        QVERIFY(!window.find<QWidget>("lockBar")->isVisible());
    }

    void aLockOffersTheWay()
    {
        TableFixture fixture;
        Window window(fixture);
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
        Window window(fixture);
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
        Window window(fixture);
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

    void listsOnlyAllowedValues()
    {
        TableFixture fixture;
        const Device *device = fixture.add(3);
        const int field = TableFixture::field(device, u"Operating Mode");
        const Field &mode = device->table().fields()[static_cast<std::size_t>(field)];
        const EnumEdit list(mode, device->effective(field), 3);
        QCOMPARE(list.count(), static_cast<int>(mode.values.size()));
        QCOMPARE(list.value(), std::int64_t(3));
        QVERIFY(!list.isPicked());
    }

    void bitsAreTicked()
    {
        TableFixture fixture;
        const Device *device = fixture.add(3);
        const int field = TableFixture::field(device, u"Shutdown");
        auto *popup = new BitPopup(device->table().fields()[static_cast<std::size_t>(field)], 52, nullptr);
        qint64 taken = -1;
        connect(popup, &BitPopup::accepted, this, [&](qint64 raw) { taken = raw; });
        auto *first = popup->findChild<QCheckBox *>();
        QVERIFY(first && !first->isChecked());
        first->click();
        QTest::keyClick(popup, Qt::Key_Return);
        QCOMPARE(taken, qint64(53));
        delete popup;
    }

    void picksFromTheList()
    {
        TableFixture fixture;
        Window window(fixture);
        window.panel.setDevices({fixture.add(3)});
        window.go(QStringLiteral("Operating Mode"));
        QTest::keyClick(window.view, Qt::Key_Return);
        auto *list = window.view->findChild<EnumEdit *>();
        QVERIFY(list);
        QTRY_VERIFY(list->view()->isVisible());
        QTest::keyClick(list->view(), Qt::Key_Down);
        QTest::keyClick(list->view(), Qt::Key_Return);
        QTRY_COMPARE(fixture.written(), QStringList{QStringLiteral("3 Operating Mode=4")});
        QTRY_VERIFY(!window.view->findChild<EnumEdit *>());

        // A list that is only looked at writes nothing and goes away.
        QTest::keyClick(window.view, Qt::Key_Return);
        list = window.view->findChild<EnumEdit *>();
        QVERIFY(list);
        QTRY_VERIFY(list->view()->isVisible());
        list->hidePopup();
        QTRY_VERIFY(!window.view->findChild<EnumEdit *>());
        QCOMPARE(fixture.written().size(), 1);
    }

    void ticksBitsInAPopUp()
    {
        TableFixture fixture;
        Window window(fixture);
        window.panel.setDevices({fixture.add(3)});
        window.go(QStringLiteral("Shutdown"));
        QTest::keyClick(window.view, Qt::Key_Return);
        QPointer<BitPopup> popup = window.view->findChild<BitPopup *>();
        QVERIFY(popup && popup->isVisible());
        QTest::keyClick(popup, Qt::Key_Escape);
        QTRY_VERIFY(!popup);
        QCOMPARE(fixture.written(), QStringList());
        QTest::keyClick(window.view, Qt::Key_Return);
        popup = window.view->findChild<BitPopup *>();
        QVERIFY(popup);
        popup->findChild<QCheckBox *>()->click();
        popup->findChild<QPushButton *>(QStringLiteral("bitPopupWrite"))->click();
        QCOMPARE(fixture.written(), QStringList{QStringLiteral("3 Shutdown=53")});
    }

    void theMenuResetsToDefault()
    {
        TableFixture fixture;
        Window window(fixture);
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
        Window window(fixture);
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
        Window window(fixture);
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
        Window window(fixture);
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
        window.find<QToolButton>("editAll")->click();
        edit(QStringLiteral("600"));
        const QStringList expected{QStringLiteral("1 Position P Gain=600"), QStringLiteral("2 Position P Gain=600"),
                                   QStringLiteral("3 Position P Gain=600")};
        QCOMPARE(fixture.written(), expected);
    }

    void keysSearchPlotAndCopy()
    {
        TableFixture fixture;
        Window window(fixture);
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

    void saysWhenThereIsNothing()
    {
        TableFixture fixture;
        Window window(fixture);
        auto *title = window.find<QLabel>("tableEmptyTitle");
        QVERIFY(title->isVisible());
        QCOMPARE(title->text(), QStringLiteral("No device selected"));
        window.panel.setDevices({fixture.add(9, 4711)});
        QVERIFY(title->isVisible());
        QVERIFY(title->text().contains(QStringLiteral("4711")));
        window.panel.setDevices({fixture.add(3)});
        QVERIFY(!title->isVisible());
        QVERIFY(window.view->isVisible());
    }

    void staysWhereItIsWhenTheDeviceChanges()
    {
        TableFixture fixture;
        Window window(fixture);
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
            Window window(fixture);
            window.panel.setDevices({fixture.add(1)});
            window.view->setColumnWidth(0, 251);
            window.view->collapse(window.view->model()->index(0, 0));
            window.find<QToolButton>("helpFold")->click();
            state = window.panel.saveState();
        }
        Window window(fixture);
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
