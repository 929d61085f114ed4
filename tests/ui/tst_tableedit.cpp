// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/ui/tablewindow.h"
#include "ui/table/bitpopup.h"
#include "ui/table/enumedit.h"

#include <QAbstractItemView>
#include <QCheckBox>
#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>

using namespace dynascope;

/// The editors of the table: what is typed, picked and ticked, and what of it is written.
class TestTableEdit : public QObject
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
        TableWindow window(fixture);
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
        TableWindow window(fixture);
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
        TableWindow window(fixture);
        window.panel.setDevices({fixture.add(3)});
        QSignalSpy message(&window.panel, &TablePanel::notWritten);
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
        TableWindow window(fixture);
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
        TableWindow window(fixture);
        window.panel.setDevices({fixture.add(3)});
        window.go(QStringLiteral("Present Position"));
        QTest::keyClick(window.view, Qt::Key_F2);
        QVERIFY(!window.edit());
        QVERIFY(!window.find<QWidget>("lockBar")->isVisible());
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
        TableWindow window(fixture);
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
        TableWindow window(fixture);
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
};

DYNASCOPE_UI_TEST(TestTableEdit)
#include "tst_tableedit.moc"
