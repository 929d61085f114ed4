// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/indirect.h"
#include "tests/support/uitest.h"
#include "tests/ui/plotfixture.h"
#include "tests/ui/tablewindow.h"
#include "ui/table/fielddelegate.h"
#include "ui/table/fieldtablemodel.h"
#include "ui/table/fieldwordsmodel.h"
#include "ui/table/goalbar.h"
#include "ui/window/unitmenu.h"

#include <QAction>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QMenu>
#include <QSettings>
#include <QSignalSpy>
#include <QSlider>

using namespace dynascope;
using namespace Qt::StringLiterals;

namespace {

UnitPreferences choice(AngleUnit angle, bool torque, bool raw = false)
{
    UnitPreferences units(angle);
    units.torque = torque;
    units.raw = raw;
    return units;
}

std::vector<UnitPreferences> choices()
{
    std::vector<UnitPreferences> all;
    for (const AngleUnit angle : {AngleUnit::Degrees, AngleUnit::Radians, AngleUnit::Turns, AngleUnit::Pulses}) {
        all.push_back(choice(angle, false));
        all.push_back(choice(angle, true));
    }
    all.push_back(choice(AngleUnit::Degrees, false, true));
    return all;
}

QString nameOf(const UnitPreferences &units)
{
    return QStringLiteral("angle %1, torque %2, raw %3").arg(int(units.angle)).arg(units.torque).arg(units.raw);
}

/// As it leaves the factory.
RegisterLookup factory(const ControlTable &table)
{
    return [&table](QStringView name) {
        const Field *field = table.find(name);
        return field ? field->initial : std::nullopt;
    };
}

std::set<std::int64_t> samples(const Field &field, const EffectiveField &effective)
{
    const std::int64_t low = std::max(effective.minimum.value_or(smallestRaw(field)), smallestRaw(field));
    const std::int64_t high = std::min(effective.maximum.value_or(largestRaw(field)), largestRaw(field));
    std::set<std::int64_t> raws{
        low, low + 1, high, high - 1, (low + high) / 2, (low + high) / 3, -1, 0, 1, low + (high - low) / 7 * 5};
    if (field.initial)
        raws.insert(*field.initial);
    for (const EnumValue &value : field.values)
        raws.insert(value.value);
    for (const EnumValue &value : field.special)
        raws.insert(value.value);
    std::erase_if(raws, [&](std::int64_t raw) { return !checkRange(field, effective, raw); });
    return raws;
}

} // namespace

class TestTableUnits : public QObject
{
    Q_OBJECT

private slots:
    void init() { QSettings().clear(); }

    void anEditorsTextIsTheValueItStandsFor()
    {
        const Catalog &catalog = TableFixture::catalog();
        int checked = 0;
        using Bounds = std::optional<std::int64_t>;
        std::set<std::tuple<QString, int, bool, Unit, double, Bounds, Bounds, Bounds, double, double, int, std::size_t,
                            std::size_t>>
            seen; // most models share most of their registers
        for (const Catalog::ModelInfo &info : catalog.models()) {
            for (const int firmware : catalog.firmwareSteps(info.modelNumber)) {
                const ControlTablePtr table = catalog.find(info.modelNumber, firmware);
                for (const Field &field : table->fields()) {
                    const int run = indirectAddressNumber(field) + indirectDataNumber(field);
                    if (!isEditable(field) || run > 2) // the others are alike
                        continue;
                    const EffectiveField now = effective(field, factory(*table));
                    const bool isNew =
                        seen.emplace(field.name, field.size, field.isSigned, now.unit, now.scale, now.minimum,
                                     now.maximum, field.initial, now.turns, now.torqueConstant, table->resolution(),
                                     field.values.size(), field.bits.size())
                            .second;
                    if (!isNew)
                        continue;
                    checked += checkField(*table, table, field);
                    if (QTest::currentTestFailed())
                        return;
                }
            }
        }
        QVERIFY(checked > 100'000);
    }

    void anUntouchedEditorWritesNothing_data()
    {
        QTest::addColumn<int>("model");
        for (const int model : {1020, 350, 1190, 4000, 54024, 35074, 2020})
            QTest::addRow("%d", model) << model;
    }

    void anUntouchedEditorWritesNothing()
    {
        QFETCH(int, model);
        TableFixture fixture;
        Device *device = fixture.add(1, model);
        FieldTableModel table(fixture.actions());
        FieldWordsModel words;
        words.setSourceModel(&table);
        table.setDevices({device});
        FieldDelegate delegate;
        QWidget parent;
        int editors = 0;
        for (const UnitPreferences &units : choices()) {
            words.setUnits(units);
            delegate.setUnits(units);
            for (int field = 0; field < static_cast<int>(device->table().fields().size()); ++field) {
                for (const ColumnKind kind : {ColumnKind::Value, ColumnKind::Physical}) {
                    const QModelIndex cell = words.mapFromSource(table.indexOf(field, table.columnOf(kind)));
                    if (!(cell.flags() & Qt::ItemIsEditable))
                        continue;
                    const std::unique_ptr<QWidget> editor(delegate.createEditor(&parent, {}, cell));
                    QVERIFY(editor);
                    delegate.setModelData(editor.get(), &words, cell);
                    ++editors;
                }
            }
        }
        QVERIFY(editors > 100);
        QCOMPARE(fixture.written(), QStringList());
    }

    void saysValuesInTheChosenUnit_data()
    {
        QTest::addColumn<int>("model");
        QTest::addColumn<QString>("field");
        QTest::addColumn<int>("raw");
        QTest::addColumn<QStringList>("texts"); // degrees, radians, turns, pulses, torque, raw
        QTest::newRow("position") << 1020 << "Present Position" << 1024
                                  << QStringList{u"90.00 °"_s,    u"1.571 rad"_s, u"0.2500 turn"_s,
                                                 u"1024 pulse"_s, u"90.00 °"_s,   u""_s};
        QTest::newRow("a current whose torque is known")
            << 1110 << "Present Current" << 100
            << QStringList{u"269 mA"_s, u"269 mA"_s, u"269 mA"_s, u"269 mA"_s, u""_s, u""_s};
        QTest::newRow("a current whose torque isn't")
            << 1020 << "Present Current" << 10
            << QStringList{u"27 mA"_s, u"27 mA"_s, u"27 mA"_s, u"27 mA"_s, u"27 mA"_s, u""_s};
        QTest::newRow("degrees of XL-320")
            << 350 << "Present Position" << 100
            << QStringList{u"29.0 °"_s, u"0.506 rad"_s, u"0.0806 turn"_s, u"100 pulse"_s, u"29.0 °"_s, u""_s};
        QTest::newRow("a name is a name")
            << 1020 << "Operating Mode" << 4
            << QStringList{u"Extended position control"_s, u"Extended position control"_s,
                           u"Extended position control"_s, u"Extended position control"_s,
                           u"Extended position control"_s, u"Extended position control"_s};
    }

    void saysValuesInTheChosenUnit()
    {
        QFETCH(int, model);
        QFETCH(QString, field);
        QFETCH(int, raw);
        QFETCH(QStringList, texts);
        TableFixture fixture;
        Device *device = fixture.add(1, model);
        TableFixture::set(device, field, raw);
        FieldTableModel table(fixture.actions());
        FieldWordsModel words;
        words.setSourceModel(&table);
        table.setDevices({device});
        const int index = TableFixture::field(device, field);
        const auto said = [&](const UnitPreferences &units) {
            words.setUnits(units);
            return words.mapFromSource(table.indexOf(index, table.columnOf(ColumnKind::Physical))).data().toString();
        };
        QStringList all;
        for (const AngleUnit angle : {AngleUnit::Degrees, AngleUnit::Radians, AngleUnit::Turns, AngleUnit::Pulses})
            all << said(choice(angle, false));
        all << said(choice(AngleUnit::Degrees, true)) << said(choice(AngleUnit::Degrees, false, true));
        const bool hasTorque = device->table().fields()[std::size_t(index)].torqueConstant > 0;
        if (hasTorque) {
            QVERIFY2(all[4].endsWith(QStringLiteral(" Nm")), qPrintable(all[4]));
            all[4].clear();
        }
        QCOMPARE(all, texts);
    }

    void whatIsTypedMeansWhatIsShown_data()
    {
        QTest::addColumn<int>("angle");
        QTest::addColumn<bool>("raw");
        QTest::addColumn<QString>("text");
        QTest::addColumn<int>("result");
        const auto row = [](const char *name, AngleUnit angle, bool raw, const char *text, int result) {
            QTest::newRow(name) << static_cast<int>(angle) << raw << QString::fromUtf8(text) << result;
        };
        row("degrees", AngleUnit::Degrees, false, "90", 1024);
        row("radians", AngleUnit::Radians, false, "1.5708", 1024);
        row("turns", AngleUnit::Turns, false, "0.25", 1024);
        row("pulses", AngleUnit::Pulses, false, "1024", 1024);
        row("raw", AngleUnit::Degrees, true, "1024", 1024);
        row("another unit is said with the number", AngleUnit::Radians, false, "90deg", 1024);
        row("a unit where raw stands", AngleUnit::Degrees, true, "0.25 turn", 1024);
        row("pulses where degrees stand", AngleUnit::Degrees, false, "1024 pulse", 1024);
        row("the minus that the cells show", AngleUnit::Degrees, false, "−90", -1024);
        row("hexadecimal is always raw", AngleUnit::Radians, false, "0x400", 1024);
    }

    void whatIsTypedMeansWhatIsShown()
    {
        QFETCH(int, angle);
        QFETCH(bool, raw);
        QFETCH(QString, text);
        TableFixture fixture;
        Device *device = fixture.add(1);
        TableFixture::set(device, QStringLiteral("Operating Mode"), 4);
        const int field = TableFixture::field(device, u"Goal Position");
        const UnitPreferences units = choice(static_cast<AngleUnit>(angle), false, raw);
        const ValueMeaning meaning{device->table().fields()[std::size_t(field)], device->effective(field), 4096, units,
                                   !raw};
        const auto value = meaning.value(text);
        QVERIFY2(value, value ? "" : qPrintable(value.error().text));
        QTEST(static_cast<int>(*value), "result");
    }

    void aKeyMovesTheSliderAsFarInEveryUnit()
    {
        for (const UnitPreferences &units : choices()) {
            TableFixture fixture;
            Device *device = fixture.add(1);
            TableFixture::set(device, QStringLiteral("Torque Enable"), 1);
            TableFixture::set(device, QStringLiteral("Goal Position"), 2048);
            GoalBar bar(fixture.actions().write);
            bar.setDevices({device});
            bar.setUnits(units);
            QTest::keyClick(bar.findChild<QSlider *>(QStringLiteral("goalSlider")), Qt::Key_Right);
            QCOMPARE(fixture.written(), QStringList{QStringLiteral("1 Goal Position=2059")}); // about a degree
            auto *spin = bar.findChild<QDoubleSpinBox *>(QStringLiteral("goalSpin"));
            spin->stepDown();
            QTRY_COMPARE(fixture.written().back(), QStringLiteral("1 Goal Position=2048"));
        }
    }

    void aDirectionBitIsASign()
    {
        TableFixture fixture;
        Device *device = fixture.add(1, 350); // XL-320 as a wheel
        TableFixture::set(device, QStringLiteral("Control Mode"), 1);
        TableFixture::set(device, QStringLiteral("Torque Enable"), 1);
        TableFixture::set(device, QStringLiteral("Moving Speed"), 1024 + 300);
        GoalBar bar(fixture.actions().write);
        bar.setDevices({device});
        auto *slider = bar.findChild<QSlider *>(QStringLiteral("goalSlider"));
        QCOMPARE(slider->accessibleName(), QStringLiteral("Moving Speed"));
        QCOMPARE(slider->minimum(), -1023);
        QCOMPARE(slider->maximum(), 1023);
        QCOMPARE(slider->value(), -300);
        auto *spin = bar.findChild<QDoubleSpinBox *>(QStringLiteral("goalSpin"));
        QCOMPARE(spin->text(), QStringLiteral("-30.0 %"));
        slider->setValue(-301);
        QCOMPARE(fixture.written(), QStringList{QStringLiteral("1 Moving Speed=1325")});
        spin->setValue(50);
        QTRY_COMPARE(fixture.written().back(), QStringLiteral("1 Moving Speed=500"));
        spin->setValue(-50);
        QTRY_COMPARE(fixture.written().back(), QStringLiteral("1 Moving Speed=1524"));
    }

    void plotsFollow()
    {
        PlotBench bench;
        const Watch position = bench.watch(bench.first, "Present Position");
        bench.area.addTrace(position);
        bench.sample(position, std::chrono::seconds(1), 1024);
        const auto said = [&](const UnitPreferences &units) {
            bench.area.setUnits(units);
            const QModelIndex row = bench.model().index(0);
            return row.data(TraceModel::ValueRole).toString() + u' ' + row.data(TraceModel::UnitRole).toString();
        };
        QCOMPARE(said(choice(AngleUnit::Radians, false)), QStringLiteral("1.571 rad"));
        QCOMPARE(said(choice(AngleUnit::Turns, false)), QStringLiteral("0.2500 turn"));
        QCOMPARE(said(choice(AngleUnit::Degrees, false, true)), QStringLiteral("1024 "));
        QCOMPARE(said(choice(AngleUnit::Degrees, false)), QStringLiteral("90.00 °"));
        bench.area.setUnits(choice(AngleUnit::Radians, false));
        QCOMPARE(bench.model().drawn(bench.area.palette()).front().unit, QStringLiteral("rad")); // axis and CSV
        // A panel that comes later has them, too, and a trace whose device has gone.
        bench.area.addPanel();
        bench.area.addTrace(bench.watch(bench.second, "Present Position"));
        QCOMPARE(bench.model(1).index(0).data(TraceModel::UnitRole).toString(), QStringLiteral("rad"));
        bench.line.forget(bench.first.key());
        bench.area.setUnits(choice(AngleUnit::Degrees, false));
        QCOMPARE(bench.model().index(0).data(TraceModel::UnitRole).toString(), QStringLiteral("°"));
    }

    void aChoiceIsRemembered()
    {
        QMenu menu;
        {
            UnitMenu units(menu);
            QSignalSpy chosen(&units, &UnitMenu::chosen);
            const auto action = [&](const char *name) { return menu.findChild<QAction *>(QString::fromLatin1(name)); };
            QVERIFY(action("unit-degrees")->isChecked());
            action("unit-radians")->trigger();
            action("unit-torque")->trigger();
            QCOMPARE(chosen.count(), 2);
            QVERIFY(chosen.back().front().value<UnitPreferences>() == choice(AngleUnit::Radians, true));
            action("unit-raw")->trigger();
            QVERIFY(!action("unit-torque")->isEnabled()); // there is nothing for it to say
            action("unit-turns")->trigger();
        }
        QVERIFY(savedUnits() == choice(AngleUnit::Turns, true));
        QSettings().setValue(QStringLiteral("window/angleUnit"), QStringLiteral("furlongs"));
        QVERIFY(savedUnits() == choice(AngleUnit::Degrees, true));
    }

    void aChoiceKeepsThePlace()
    {
        TableFixture fixture;
        TableWindow window(fixture);
        window.panel.setDevices({fixture.add(1)});
        window.go(QStringLiteral("Goal Position"));
        window.panel.setUnits(choice(AngleUnit::Radians, false));
        QCOMPARE(window.view->currentIndex().siblingAtColumn(0).data().toString(), QStringLiteral("Goal Position"));
        QVERIFY(window.find<QLabel>("helpText")->text().contains(QStringLiteral("rad")));
        QTest::keyClick(window.view, Qt::Key_Return);
        QVERIFY(window.edit());
    }

private:
    /// How many values were looked at.
    static int checkField(const ControlTable &table, const ControlTablePtr &shared, const Field &field)
    {
        const EffectiveField effective = dynascope::effective(field, factory(table));
        int checked = 0;
        for (const UnitPreferences &units : choices()) {
            for (const bool physical : {false, true}) {
                ValueMeaning meaning{field, effective, table.resolution(), units, physical};
                if (indirectAddressNumber(field) > 0)
                    meaning.pointsInto = shared;
                for (const std::int64_t raw : samples(field, effective)) {
                    const QString text = meaning.text(raw);
                    const auto value = meaning.value(text);
                    const QString where = QStringLiteral("%1, %2, %3: \"%4\" of %5: %6")
                                              .arg(table.model(), field.name, nameOf(units), text)
                                              .arg(raw)
                                              .arg(value ? QString::number(*value) : value.error().text);
                    if (!value || *value != raw)
                        QTest::qFail(qPrintable(where), __FILE__, __LINE__);
                    ++checked;
                }
            }
        }
        return checked;
    }
};

DYNASCOPE_UI_TEST(TestTableUnits)
#include "tst_tableunits.moc"
