// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/ui/tablewindow.h"
#include "ui/common/elidedlabel.h"

#include <QLabel>
#include <QMessageBox>
#include <QPushButton>
#include <QToolButton>

using namespace dynascope;

/// What isn't known for certain, and what a person may try nevertheless.
class TestTableDoubt : public QObject
{
    Q_OBJECT

    static constexpr int Unknown = 4711;
    static constexpr int AddressesOnly = 1700; // XC335-T332

    static QString note(const TableWindow &window)
    {
        const auto *strip = window.find<QWidget>("tableNote");
        return strip->isVisible() ? window.find<ElidedLabel>("tableNoteText")->text() : QString();
    }

private slots:
    void aDoubtfulRegisterSaysSo()
    {
        TableFixture fixture;
        TableWindow window(fixture);
        Device *device = fixture.add(1, 4000);
        window.panel.setDevices({device});
        const QString name = QStringLiteral("Present Input Voltage");
        QVERIFY(!device->table().find(name)->doubt.isEmpty());
        QVERIFY(window.cell(name, ColumnKind::Name)
                    .data(Qt::ToolTipRole)
                    .toString()
                    .contains(QStringLiteral("Doubtful: 0.01 V in every manual")));
        window.go(name);
        QVERIFY(window.find<QLabel>("helpText")->text().contains(QStringLiteral("Doubtful: 0.01 V in every manual")));
        window.go(QStringLiteral("Present Position"));
        QVERIFY(!window.find<QLabel>("helpText")->text().contains(QStringLiteral("Doubtful")));
    }

    void aDoubtfulTableSaysSo_data()
    {
        QTest::addColumn<int>("model");
        QTest::addColumn<QString>("note"); // a piece of it; empty: there is none
        QTest::newRow("nothing doubtful") << 1020 << "";
        QTest::newRow("doubtful ranges") << 30 << "prints no ranges";
        QTest::newRow("only addresses") << AddressesOnly << "Only names, addresses and sizes are public";
        QTest::newRow("unknown") << Unknown << "Nothing is known of this model";
    }

    void aDoubtfulTableSaysSo()
    {
        QFETCH(int, model);
        QFETCH(QString, note);
        TableFixture fixture;
        TableWindow window(fixture);
        window.panel.setDevices({fixture.add(1, model)});
        const QString said = TestTableDoubt::note(window);
        QVERIFY2(note.isEmpty() == said.isEmpty() && said.contains(note), qPrintable(said));
    }

    void newerFirmwareThanKnownIsSaid()
    {
        TableFixture fixture;
        TableWindow window(fixture);
        Device *device = fixture.add(1);
        Found found = device->found();
        found.firmware = 99;
        device->setFound(found);
        window.panel.setDevices({device});
        QVERIFY2(note(window).contains(QStringLiteral("Firmware 99 is newer")), qPrintable(note(window)));
        // Whole in the strip above it is not said again below; where the strip is too narrow it is.
        const auto isBelow = [&window] {
            return window.find<QLabel>("helpText")->text().contains(QStringLiteral("Firmware 99 is newer"));
        };
        QTRY_VERIFY(!isBelow());
        window.panel.resize(300, 900);
        QTRY_VERIFY(isBelow());
        window.panel.resize(900, 900);
        QTRY_VERIFY(!isBelow());
    }

    void anUnknownModelIsShownAsBytes()
    {
        TableFixture fixture;
        TableWindow window(fixture);
        Device *device = fixture.add(1, Unknown);
        QCOMPARE(device->model(), QStringLiteral("unknown model 4711"));
        window.panel.setDevices({device});
        QVERIFY(window.view->isVisible());
        const QModelIndex first = window.view->model()->index(0, 0);
        QCOMPARE(first.data().toString(), QStringLiteral("Bytes 0 – 127"));
        QVERIFY(window.view->isExpanded(first));
        QVERIFY(!window.view->isExpanded(first.siblingAtRow(1)));
        QCOMPARE(window.cell(QStringLiteral("Byte 7"), ColumnKind::Access).data().toString(), QStringLiteral("?"));
    }

    void neighboursSuggestAndNoMore()
    {
        TableFixture fixture;
        TableWindow window(fixture);
        Device *device = fixture.add(1, 1025); // between two X
        window.panel.setDevices({device});
        const Field *byte = device->table().find(u"Byte 132");
        QCOMPARE(byte->suggested, QStringLiteral("Present Position"));
        QCOMPARE(window.cell(byte->name, ColumnKind::Name).data().toString(), QStringLiteral("Byte 132"));
        QVERIFY(window.cell(byte->name, ColumnKind::Name)
                    .data(Qt::ToolTipRole)
                    .toString()
                    .contains(QStringLiteral("Only a guess")));
        QVERIFY(!window.find<QWidget>("goalBar")->isVisible());
    }

    void anUnknownRegisterIsWrittenOnlyAfterAQuestion_data()
    {
        QTest::addColumn<int>("model");
        QTest::addColumn<QString>("field");
        QTest::addColumn<QString>("typed");
        QTest::addColumn<QString>("question");
        QTest::addColumn<QString>("written");
        QTest::newRow("a byte") << Unknown << "Byte 64"
                                << "17"
                                << "Write the byte 11 (17) to address 64 of unknown model 4711 #1?"
                                << "1 Byte 64=17";
        QTest::newRow("a register of several bytes")
            << AddressesOnly << "Goal Position"
            << "0x1234"
            << "Write the bytes 34 12 00 00 (4660) from address 116 on to XC335-T332 #1?"
            << "1 Goal Position=4660";
    }

    void anUnknownRegisterIsWrittenOnlyAfterAQuestion()
    {
        QFETCH(int, model);
        QFETCH(QString, field);
        QFETCH(QString, typed);
        QFETCH(QString, question);
        QFETCH(QString, written);
        TableFixture fixture;
        TableActions actions = fixture.actions();
        QStringList insisted;
        actions.writeUnknown = [&](Device &device, int index, std::int64_t raw) {
            insisted << QStringLiteral("%1 %2=%3")
                            .arg(device.id())
                            .arg(device.table().fields()[std::size_t(index)].name)
                            .arg(raw);
        };
        TableWindow window(actions);
        window.panel.setDevices({fixture.add(1, model)});
        for (const bool agrees : {false, true}) {
            window.go(field);
            QTest::keyClick(window.view, Qt::Key_Return);
            QVERIFY(window.edit());
            window.edit()->setText(typed);
            QTest::keyClick(window.edit(), Qt::Key_Return);
            QPointer<QMessageBox> box;
            QTRY_VERIFY(box = window.find<QMessageBox>("unknownWriteBox"));
            QCOMPARE(box->text(), question);
            QCOMPARE(insisted, QStringList());
            QPushButton *button = agrees ? box->findChild<QPushButton *>(QStringLiteral("unknownWriteButton"))
                                         : qobject_cast<QPushButton *>(box->button(QMessageBox::Cancel));
            QTest::mouseClick(button, Qt::LeftButton);
            QTRY_VERIFY(!box);
        }
        QCOMPARE(insisted, QStringList{written});
        QCOMPARE(fixture.written(), QStringList()); // never by the usual way
    }

    void theQuestionGoesWithItsDevice()
    {
        TableFixture fixture;
        TableActions actions = fixture.actions();
        actions.writeUnknown = [](Device &, int, std::int64_t) { QFAIL("nobody agreed"); };
        TableWindow window(actions);
        window.panel.setDevices({fixture.add(1, Unknown)});
        window.go(QStringLiteral("Byte 64"));
        QTest::keyClick(window.view, Qt::Key_Return);
        window.edit()->setText(QStringLiteral("1"));
        QTest::keyClick(window.edit(), Qt::Key_Return);
        QPointer<QMessageBox> box;
        QTRY_VERIFY(box = window.find<QMessageBox>("unknownWriteBox"));
        fixture.devices.clear();
        QTRY_VERIFY(!box);
    }
};

DYNASCOPE_UI_TEST(TestTableDoubt)
#include "tst_tabledoubt.moc"
