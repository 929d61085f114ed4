// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/ui/tablewindow.h"
#include "ui/common/theme.h"
#include "ui/table/bitpopup.h"
#include "ui/table/cellpainter.h"
#include "ui/table/enumedit.h"
#include "ui/table/limitwords.h"

#include <QComboBox>
#include <QLabel>

using namespace dynascope;
using namespace Qt::StringLiterals;

namespace {

using Values = QList<std::pair<QString, int>>;

} // namespace

/// Only what mode, firmware and other registers allow is offered, and it follows them.
class TestTableRanges : public QObject
{
    Q_OBJECT

private slots:
    void rangesFollowOtherRegisters_data()
    {
        QTest::addColumn<int>("model");
        QTest::addColumn<QString>("field");
        QTest::addColumn<Values>("values");
        QTest::addColumn<QString>("range");
        const QString goal = QStringLiteral("Goal Position");
        const QString mode = QStringLiteral("Operating Mode");
        QTest::newRow("as it leaves the factory") << 1020 << goal << Values{} << "0 … 4095";
        QTest::newRow("a limit") << 1020 << goal
                                 << Values{{u"Max Position Limit"_s, 3000}, {u"Min Position Limit"_s, 7}} << "7 … 3000";
        QTest::newRow("the mode") << 1020 << goal << Values{{mode, 4}} << "−1048575 … 1048575";
        QTest::newRow("a limit with its sign turned")
            << 1020 << "Goal Current" << Values{{u"Current Limit"_s, 500}} << "−500 … 500";
        QTest::newRow("a bit") << 1020 << "Profile Velocity" << Values{{u"Drive Mode"_s, 4}} << "0 … 32737";
        QTest::newRow("XL-320 as a joint")
            << 350 << "Moving Speed" << Values{{u"Control Mode"_s, 1}, {u"Control Mode"_s, 2}} << "0 … 1023";
        QTest::newRow("XL-320 as a wheel") << 350 << "Moving Speed" << Values{{u"Control Mode"_s, 1}} << "0 … 2047";
        QTest::newRow("Y") << 4000 << "Goal Velocity" << Values{{u"Velocity Limit"_s, 99}} << "−99 … 99";
        QTest::newRow("Y speaking Modbus") << 4000 << "ID" << Values{{u"Protocol Type"_s, 10}} << "0 … 247";
        QTest::newRow("PRO") << 54024 << "Goal Torque" << Values{{u"Torque Limit"_s, 50}} << "−50 … 50";
        QTest::newRow("gripper") << 35074 << goal << Values{{u"Max Position Limit"_s, 700}} << "0 … 700";
    }

    void rangesFollowOtherRegisters()
    {
        QFETCH(int, model);
        QFETCH(QString, field);
        QFETCH(Values, values);
        TableFixture fixture;
        TableWindow window(fixture);
        Device *device = fixture.add(1, model);
        UnitPreferences units;
        units.raw = true;
        window.panel.setUnits(units);
        window.panel.setDevices({device});
        const QPersistentModelIndex cell = window.cell(field, ColumnKind::Range);
        int told = 0;
        connect(window.view->model(), &QAbstractItemModel::dataChanged, this,
                [&](const QModelIndex &first, const QModelIndex &last) {
                    told += first.parent() == cell.parent() && first.row() <= cell.row() && cell.row() <= last.row()
                            && last.column() >= cell.column();
                });
        for (const auto &[name, raw] : values)
            TableFixture::set(device, name, raw);
        QTRY_VERIFY(told > 0 || values.isEmpty());
        QTEST(cell.data().toString(), "range");
        window.go(field);
        const QString help = window.find<QLabel>("helpText")->text();
        QVERIFY2(help.contains(u"Range "_s + cell.data().toString()), qPrintable(help));
    }

    void limitsAreInTheChosenUnit_data()
    {
        QTest::addColumn<QString>("field");
        QTest::addColumn<QString>("range");
        QTest::addColumn<QString>("rangeTip");
        QTest::addColumn<QString>("initial");
        QTest::addColumn<QString>("initialTip");
        QTest::newRow("angle") << "Max Position Limit" << "0.00 … 359.91 °" << "0.00 … 359.91 ° (raw 0 … 4095)"
                               << "359.91" << "359.91 ° (raw 4095)";
        QTest::newRow("set by another") << "Goal Velocity" << "±45.8 rev/min"
                                        << "±45.8 rev/min (raw −200 … 200), set by Velocity Limit" << "" << "";
        QTest::newRow("long") << "Homing Offset" << "±91799.91 °" << "±91799.91 ° (raw −1044479 … 1044479)" << "0.00"
                              << "0.00 ° (raw 0)";
        QTest::newRow("baud rate") << "Baud Rate" << "0 … 7" << "0 … 7" << "1" << "57\u2009600 bps (raw 1)";
        QTest::newRow("names") << "Operating Mode" << "0 … 16" << "0 … 16" << "3"
                               << "Position control (raw 3)";
        QTest::newRow("bits") << "Shutdown" << "" << "" << "52"
                              << "Overheating, Electrical shock, Overload (raw 52)";
        QTest::newRow("no unit") << "ID" << "0 … 252" << "0 … 252" << "1" << "1";
    }

    void limitsAreInTheChosenUnit()
    {
        QFETCH(QString, field);
        TableFixture fixture;
        TableWindow window(fixture);
        window.panel.setDevices({fixture.add(1)});
        const QModelIndex range = window.cell(field, ColumnKind::Range);
        const QModelIndex initial = window.cell(field, ColumnKind::Default);
        QTEST(range.data().toString(), "range");
        QTEST(range.data(Qt::ToolTipRole).toString(), "rangeTip");
        QTEST(initial.data().toString(), "initial");
        QTEST(initial.data(Qt::ToolTipRole).toString(), "initialTip");
    }

    void aBaudRateIsSaidAsEverywhere()
    {
        TableFixture fixture;
        TableWindow window(fixture);
        Device *device = fixture.add(1);
        TableFixture::set(device, u"Baud Rate"_s, 3);
        window.panel.setDevices({device});
        QCOMPARE(window.cell(u"Baud Rate"_s, ColumnKind::Physical).data().toString(), u"1 Mbps"_s);
        const Field &field = *device->table().find(u"Baud Rate");
        const EnumEdit edit(field, effective(field, [](QStringView) { return std::optional<std::int64_t>(); }), 3);
        QCOMPARE(edit.currentText(), u"3  1 Mbps"_s);
    }

    void bothEndsOfARangeAreSeen()
    {
        TableFixture fixture;
        TableWindow window(fixture);
        Device *device = fixture.add(1);
        window.panel.setDevices({device});
        for (const Field &field : device->table().fields()) {
            const QModelIndex range = window.cell(field.name, ColumnKind::Range);
            const QString text = range.data().toString();
            const int room = window.view->visualRect(range).width() - 2 * CellMargin;
            const int needed = QFontMetrics(numberFont(window.view->font())).horizontalAdvance(text);
            if (range.isValid() && room > 0)
                QVERIFY2(needed <= room,
                         qPrintable(u"%1: %2 needs %3 of %4"_s.arg(field.name, text).arg(needed).arg(room)));
        }
    }

    void noChoiceOfUnitsMovesAColumn()
    {
        TableFixture fixture;
        TableWindow window(fixture);
        window.panel.setDevices({fixture.add(1)});
        const QPersistentModelIndex range = window.cell(QStringLiteral("Max Position Limit"), ColumnKind::Range);
        const QRect place = window.view->visualRect(range);
        UnitPreferences raw;
        raw.raw = true;
        for (const auto &[units, text] :
             std::vector<std::pair<UnitPreferences, QString>>{{AngleUnit::Radians, u"0.000 … 6.282 rad"_s},
                                                              {AngleUnit::Pulses, u"0 … 4095 pulse"_s},
                                                              {raw, u"0 … 4095"_s}}) {
            window.panel.setUnits(units);
            QCOMPARE(range.data().toString(), text);
            QCOMPARE(window.view->visualRect(range), place);
        }
    }

    void whatAnswersIsNotOffered()
    {
        TableFixture fixture;
        TableWindow window(fixture);
        window.panel.setDevices({fixture.add(1, 4000)});
        const QModelIndex save = window.cell(QStringLiteral("Hybrid Save"), ColumnKind::Physical);
        const EnumEdit edit(*fieldAt(save), save.data(EffectiveRole).value<EffectiveField>(), std::nullopt);
        QCOMPARE(edit.count(), 2);
        QCOMPARE(edit.findText(QStringLiteral("Saved"), Qt::MatchContains), -1);
    }

    void aLimitThatWasntReadIsSaidSo()
    {
        Field of;
        EffectiveField field;
        field.minimum = 0;
        field.maximumFrom = QStringLiteral("Current Limit");
        QCOMPARE(rangeText(of, field), QStringLiteral("0 … ?"));
        QCOMPARE(rangeSource(field), QStringLiteral("set by Current Limit"));
        field.minimumFrom = QStringLiteral("Current Limit");
        QCOMPARE(rangeSource(field), QStringLiteral("set by Current Limit"));
        field.minimumFrom = QStringLiteral("Min Position Limit");
        QCOMPARE(rangeSource(field), QStringLiteral("set by Min Position Limit and Current Limit"));
        field = {};
        QCOMPARE(rangeText(of, field), QString());
        QCOMPARE(rangeSource(field), QString());
        of.size = 4;
        field.minimum = smallestRaw(of);
        field.maximum = largestRaw(of);
        QCOMPARE(rangeText(of, field), QStringLiteral("any"));
    }

    void anOpenEditorFollows()
    {
        TableFixture fixture;
        TableWindow window(fixture);
        Device *device = fixture.add(1);
        window.panel.setDevices({device});
        window.go(QStringLiteral("Goal Position"));
        QTest::keyClick(window.view, Qt::Key_F2);
        window.edit()->setText(QStringLiteral("3500"));
        QVERIFY(window.edit()->value());
        TableFixture::set(device, QStringLiteral("Max Position Limit"), 3000);
        QTRY_VERIFY(!window.edit()->value());
        QCOMPARE(window.edit()->text(), QStringLiteral("3500"));
        QVERIFY(window.find<QLabel>("valueHint")->text().contains(QStringLiteral("0 to 3000")));
        QTest::keyClick(window.edit(), Qt::Key_Return);
        QVERIFY(window.edit() && window.edit()->isVisible());
        TableFixture::set(device, QStringLiteral("Max Position Limit"), 3600);
        QTRY_VERIFY(window.edit()->value());
        QTest::keyClick(window.edit(), Qt::Key_Return);
        QTRY_COMPARE(fixture.written(), QStringList{QStringLiteral("1 Goal Position=3500")});
    }

    void onlyTheModesOfTheModelAreOffered_data()
    {
        QTest::addColumn<int>("model");
        QTest::addColumn<int>("firmware");
        QTest::addColumn<QList<int>>("modes");
        QTest::newRow("XM430-W350") << 1020 << 45 << QList<int>{0, 1, 3, 4, 5, 16};
        QTest::newRow("XL430-W250") << 1060 << 45 << QList<int>{1, 3, 4, 16};
        QTest::newRow("Y") << 4000 << 11 << QList<int>{0, 1, 3};
        QTest::newRow("gripper") << 35074 << 13 << QList<int>{0, 5};
        QTest::newRow("L42-10-S300-R") << 35072 << 30 << QList<int>{1, 3};
    }

    void onlyTheModesOfTheModelAreOffered()
    {
        QFETCH(int, model);
        QFETCH(int, firmware);
        QFETCH(QList<int>, modes);
        const ControlTablePtr table = TableFixture::catalog().find(model, firmware);
        const Field &field = *table->find(u"Operating Mode");
        const EnumEdit list(field, effective(field, {}), std::nullopt);
        QList<int> offered;
        for (int row = 0; row < list.count(); ++row)
            offered << list.itemData(row).toInt();
        QCOMPARE(offered, modes);
    }

    void onlyTheBitsOfTheFirmwareAreOffered_data()
    {
        QTest::addColumn<int>("firmware");
        QTest::addColumn<bool>("goalTurnsTorqueOn");
        QTest::newRow("before") << 44 << false;
        QTest::newRow("since") << 45 << true;
    }

    void onlyTheBitsOfTheFirmwareAreOffered()
    {
        QFETCH(int, firmware);
        const ControlTablePtr table = TableFixture::catalog().find(1020, firmware);
        BitPopup popup(*table->find(u"Drive Mode"), 0, nullptr);
        bool offered = false;
        for (const QComboBox *list : popup.findChildren<QComboBox *>())
            offered = offered || list->accessibleName() == u"Torque on by goal";
        QTEST(offered, "goalTurnsTorqueOn");
    }
};

DYNASCOPE_UI_TEST(TestTableRanges)
#include "tst_tableranges.moc"
