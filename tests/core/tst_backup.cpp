// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/backup/restore.h"
#include "tests/support/backupworld.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/sanitized.h"
#include "tests/support/testmain.h"

#include <random>

using namespace dynascope;
using namespace Qt::StringLiterals;
using test::BackupWorld, test::MortalLine;
using State = RestoreRow::State;

namespace {

const RestoreRow *rowOf(const RestorePlan &plan, QStringView name)
{
    const auto row = std::ranges::find(plan.rows, name, &RestoreRow::name);
    return row == plan.rows.end() ? nullptr : &*row;
}

const ComparedRegister *rowOf(const std::vector<ComparedRegister> &rows, QStringView name)
{
    const auto row = std::ranges::find(rows, name, &ComparedRegister::name);
    return row == rows.end() ? nullptr : &*row;
}

/// Of what may be restored so many sixths, legal values at random; returns how many registers changed.
int disturb(sim::Servo &servo, unsigned seed, unsigned share = 4)
{
    std::mt19937 random(seed);
    int changed = 0;
    for (const Field &field : servo.table().fields()) {
        const BackupUse use = backupUse(servo.table(), field);
        if (!field.isWritable() || (use != BackupUse::Setting && use != BackupUse::Calibration) || random() % 6 >= share
            || field.name == u"Status Return Level" || field.name == u"Secondary ID" || field.name == u"Bus Watchdog")
            continue;
        std::int64_t raw = servo.value(field);
        if (!field.values.empty()) {
            raw = field.values[random() % field.values.size()].value;
        } else {
            const std::int64_t low = field.minimum.number.value_or(smallestRaw(field));
            const std::int64_t high = field.maximum.number.value_or(std::min<std::int64_t>(largestRaw(field), 1000));
            raw = low
                  + static_cast<std::int64_t>(random()
                                              % static_cast<std::uint64_t>(std::max<std::int64_t>(1, high - low + 1)));
        }
        const std::int64_t before = servo.value(field);
        if (servo.write(field.name, raw) == DeviceError::None && servo.value(field) != before)
            ++changed;
    }
    return changed;
}

QStringList unequal(const std::vector<ComparedRegister> &rows)
{
    QStringList names;
    for (const ComparedRegister &row : rows) {
        const bool counts =
            row.use == BackupUse::Setting || row.use == BackupUse::Calibration || row.use == BackupUse::Place;
        if (counts && !row.isSame())
            names << u"%1: %2 and %3"_s.arg(row.name, row.hereText, row.thereText);
    }
    return names;
}

} // namespace

/// Backups compared and restored, on simulated servos in virtual time.
class TestBackup : public QObject
{
    Q_OBJECT

private slots:
    void restoresWhatWasChanged_data()
    {
        QTest::addColumn<QString>("servo");
        for (const char *servo :
             {"XM430-W350@57600:1", "XL330-M288@57600:1", "XL-320@1000000:1", "H54-100-S500-R@57600:1",
              "YM070-210-M001-RH@57600:1", "PH54-200-S500-R@57600:1", "XM430-W350/42@57600:1"})
            QTest::newRow(servo) << QString::fromLatin1(servo);
    }
    void restoresWhatWasChanged()
    {
        QFETCH(QString, servo);
        for (unsigned seed = 1; seed <= 3; ++seed) {
            BackupWorld world(m_catalog, servo);
            disturb(world.servo(), 1000 + seed); // not always what the factory wrote
            const auto file = world.backup();
            QVERIFY(file);
            const int changed = disturb(world.servo(), seed);
            QVERIFY2(changed > 4, qPrintable(QString::number(changed)));
            const auto plan = world.plan(*file);
            QVERIFY2(plan, plan ? "" : qPrintable(plan.error().text));
            QVERIFY(!plan->writesNothing());
            const auto outcome = world.apply(plan->settings);
            QVERIFY2(outcome && outcome->isDone(), qPrintable(test::problemsOf(outcome)));
            QVERIFY(!world.writes().isEmpty());
            QStringList left = unequal(compareBackups(*file, *world.backup()));
            for (const RestoreRow &row : plan->rows) { // a profile beyond a limit that was lowered after it
                if (row.state == State::NotCarried)
                    left.removeIf([&](const QString &text) { return text.startsWith(row.name + u':'); });
            }
            QCOMPARE(left, QStringList());
            const auto again = world.plan(*file);
            QVERIFY(again->writesNothing());
            QVERIFY(world.apply(again->settings)->isDone());
            QCOMPARE(world.writes(), QStringList());
        }
    }

    void stoppedAtEachWrite_data()
    {
        QTest::addColumn<QString>("servo");
        QTest::addColumn<QString>("end");
        for (const char *end : {"killed, its last packet arrives", "killed, its last packet is lost",
                                "power cut before", "power cut behind"})
            QTest::newRow(end) << u"XM430-W350@57600:1"_s << QString::fromLatin1(end);
        QTest::newRow("XL-320") << u"XL-320@1000000:1"_s << u"power cut behind"_s;
    }
    /// Each register is what it was or what it shall be, and the same once more brings it to its end.
    void stoppedAtEachWrite()
    {
        QFETCH(QString, servo);
        QFETCH(QString, end);
        bool wasReached = true;
        int at = 0;
        for (; wasReached && at < 60; ++at) {
            BackupWorld world(m_catalog, servo);
            const auto file = world.backup();
            QVERIFY(disturb(world.servo(), 3, 1) > 2);
            const auto plan = world.plan(*file);
            QVERIFY(plan);
            MortalLine line(world.bus, world.servo().baudRate(), at);
            line.setLastGoesOut(!end.endsWith(u"lost"));
            const auto cutPower = [&] {
                line.advance(std::chrono::milliseconds(1));
                world.bus.advanceTo(line.now());
                world.servo().powerCycle();
            };
            if (end == u"power cut before")
                line.setBefore(cutPower);
            else if (end == u"power cut behind")
                line.setBehind(cutPower);
            (void)world.apply(line, plan->settings);
            wasReached = line.wasReached();
            world.bus.advanceTo(line.now() + std::chrono::seconds(1)); // it boots
            if (end.startsWith(u"killed")) {                           // a power cut takes the RAM with it
                for (const RestoreRow &row : plan->rows) {
                    const std::int64_t now = world.servo().value(row.name);
                    QVERIFY2(row.state != State::Differs || now == row.wanted || now == row.now,
                             qPrintable(u"%1 is %2, stopped at write %3"_s.arg(row.name).arg(now).arg(at)));
                }
            }
            const auto again = world.plan(*file);
            QVERIFY2(again, again ? "" : qPrintable(again.error().text));
            const auto outcome = world.apply(again->settings);
            QVERIFY2(outcome && outcome->isDone(),
                     qPrintable(u"stopped at write %1: %2"_s.arg(at).arg(test::problemsOf(outcome))));
            QCOMPARE(unequal(compareBackups(*file, *world.backup())), QStringList());
        }
        QVERIFY2(!wasReached && at > 3, qPrintable(QString::number(at)));
    }

    void disturbed_data()
    {
        QTest::addColumn<sim::ReplyFault>("fault");
        using Kind = sim::ReplyFault::Kind;
        for (const int times : {1, 3}) {
            QTest::addRow("lost, %d", times) << sim::ReplyFault{.kind = Kind::Lost, .times = times};
            QTest::addRow("damaged, %d", times) << sim::ReplyFault{.kind = Kind::Damaged, .times = times};
            QTest::addRow("late, %d", times)
                << sim::ReplyFault{.kind = Kind::Late, .times = times, .time = std::chrono::milliseconds(30)};
            QTest::addRow("cut, %d", times) << sim::ReplyFault{.kind = Kind::Cut, .times = times, .amount = 5};
            QTest::addRow("twice, %d", times)
                << sim::ReplyFault{.kind = Kind::Twice, .times = times, .time = std::chrono::milliseconds(1)};
        }
    }
    /// Every other answer, also while the device is read first: restored, or a reason; and the same once more ends well.
    void disturbed()
    {
        QFETCH(sim::ReplyFault, fault);
        int done = 0, most = 1;
        for (int at = 0; at < most; at += test::Sanitized ? 12 : 2) {
            BackupWorld world(m_catalog, u"XM430-W350@57600:1"_s);
            const auto file = world.backup();
            QVERIFY(disturb(world.servo(), 3, 1) > 2);
            const auto good = world.plan(*file);
            most = 2 * static_cast<int>(world.packets() + good->count(State::Differs)); // more than ever come
            fault.skip = at;
            world.bus.setFaults({.replies = {fault}});
            const auto plan = world.plan(*file);
            const auto outcome =
                plan ? world.apply(plan->settings) : Result<SettingsOutcome>(tl::unexpected(plan.error()));
            world.bus.setFaults({});
            world.bus.advanceTo(world.bus.now() + std::chrono::seconds(1));
            const bool isDone = outcome && outcome->isDone() && outcome->results.size() == good->settings.steps.size();
            done += isDone ? 1 : 0;
            QVERIFY2(isDone || !test::problemsOf(outcome).isEmpty(), qPrintable(QString::number(at)));
            if (isDone)
                QCOMPARE(unequal(compareBackups(*file, *world.backup())), QStringList());
            for (const RestoreRow &row : good->rows) {
                const std::int64_t now = world.servo().value(row.name);
                QVERIFY2(now == row.now || now == row.wanted, qPrintable(u"%1 is %2 behind answer %3"_s.arg(row.name)
                                                                             .arg(now).arg(at)));
            }
            const auto again = world.plan(*file);
            const auto restored = world.apply(again->settings);
            QVERIFY2(restored && restored->isDone(), qPrintable(test::problemsOf(restored)));
            QCOMPARE(unequal(compareBackups(*file, *world.backup())), QStringList());
        }
        QVERIFY2(most > 10 && done > 0, qPrintable(u"%1 of %2"_s.arg(done).arg(most)));
    }

    void underTorque()
    {
        BackupWorld world(m_catalog, u"XM430-W350@57600:1"_s);
        const auto file = world.backup();
        world.servo().write(u"Current Limit", 300);
        world.servo().write(u"Torque Enable", 1);
        world.servo().write(u"Goal Position", 1000);
        const auto asking = world.plan(*file);
        QVERIFY(asking);
        QCOMPARE(rowOf(*asking, u"Torque Enable")->state, State::Left);
        QCOMPARE(rowOf(*asking, u"Goal Position")->state, State::Left);
        const auto refused = world.apply(asking->settings);
        QCOMPARE(refused->missing, Consent::TorqueOff);
        QCOMPARE(world.writes(), QStringList());
        RestoreOptions options;
        options.settings.mayTurnTorqueOff = true;
        const auto outcome = world.apply(world.plan(*file, options)->settings);
        QVERIFY(outcome->isDone() && outcome->torqueStaysOff());
        QCOMPARE(world.servo().value(u"Current Limit"), 1193);
        QCOMPARE(world.servo().value(u"Torque Enable"), 0);
    }

    void toAnotherDevice()
    {
        BackupWorld world(m_catalog, u"XM430-W350@57600:1,XM430-W350@57600:2"_s);
        world.servo().write(u"Homing Offset", 500);
        world.servo().write(u"Position P Gain", 700);
        const auto file = world.backup();
        auto plan = world.plan(*file, {}, 1);
        QVERIFY(plan && !plan->isSameDevice);
        QCOMPARE(rowOf(*plan, u"Homing Offset")->state, State::Left);
        QCOMPARE(rowOf(*plan, u"ID")->state, State::Left);
        QCOMPARE(plan->count(State::Differs), 1u);
        QVERIFY(world.apply(plan->settings)->isDone());
        QCOMPARE(world.writes(), QStringList{u"84=700"_s});
        RestoreOptions options;
        options.calibration = true;
        plan = world.plan(*file, options, 1);
        QVERIFY(world.apply(plan->settings)->isDone());
        QCOMPARE(world.servo(1).value(u"Homing Offset"), 500);
        QCOMPARE(world.servo(1).id(), 2);
    }

    void onlyAndExcept()
    {
        BackupWorld world(m_catalog, u"XM430-W350@57600:1"_s);
        const auto file = world.backup();
        world.servo().write(u"LED", 1);
        world.servo().write(u"Position P Gain", 700);
        RestoreOptions options;
        options.only = {u"position_p_gain"_s};
        QCOMPARE(world.plan(*file, options)->count(State::Differs), 1u);
        options = {};
        options.except = {u"Position P Gain"_s};
        QCOMPARE(rowOf(*world.plan(*file, options), u"LED")->state, State::Differs);
        QCOMPARE(rowOf(*world.plan(*file, options), u"Position P Gain")->state, State::Left);
        options.except = {u"Position Q Gain"_s};
        const auto refused = world.plan(*file, options);
        QVERIFY(!refused && refused.error().text.contains(u"no register \"Position Q Gain\""));
    }

    void toAnotherFirmware_data()
    {
        QTest::addColumn<QString>("from");
        QTest::addColumn<QString>("to");
        QTest::addColumn<QStringList>("notCarried");
        QTest::newRow("X430, 45 to 42") << u"XM430-W350/45@57600:1"_s << u"XM430-W350/42@57600:1"_s
                                        << QStringList{u"Drive Mode"_s, u"Startup Configuration"_s};
        QTest::newRow("X430, 42 to 45") << u"XM430-W350/42@57600:1"_s << u"XM430-W350/45@57600:1"_s << QStringList();
        QTest::newRow("XL330, 51 to 53") << u"XL330-M288/51@57600:1"_s << u"XL330-M288/53@57600:1"_s << QStringList();
    }
    void toAnotherFirmware()
    {
        QFETCH(QString, from);
        QFETCH(QString, to);
        QFETCH(QStringList, notCarried);
        BackupWorld source(m_catalog, from), target(m_catalog, to);
        source.servo().write(u"Drive Mode", 9);
        source.servo().write(u"Position P Gain", 777);
        source.servo().write(u"Indirect Address 1", 132);
        const auto file = source.backup();
        const auto plan = target.plan(*file);
        QVERIFY2(plan, plan ? "" : qPrintable(plan.error().text));
        QStringList names;
        for (const RestoreRow &row : plan->rows) {
            if (row.state == State::NotCarried)
                names << row.name;
            QVERIFY(row.state != State::NotCarried || !row.why.isEmpty());
        }
        QCOMPARE(names, notCarried);
        QVERIFY(target.apply(plan->settings)->isDone());
        QCOMPARE(target.servo().value(u"Position P Gain"), 777);
        QCOMPARE(target.servo().value(u"Indirect Address 1"), 132); // by name, wherever it is
        const auto rows = compareBackups(*file, *target.backup());
        if (notCarried.contains(u"Drive Mode"_s))
            QCOMPARE(rowOf(rows, u"Drive Mode")->state, ComparedRegister::State::OtherMeaning);
        if (notCarried.contains(u"Startup Configuration"_s))
            QCOMPARE(rowOf(rows, u"Startup Configuration")->state, ComparedRegister::State::OnlyHere);
        QCOMPARE(rowOf(rows, u"Indirect Address 1")->state, ComparedRegister::State::Same);
    }

    void refuses()
    {
        BackupWorld world(m_catalog, u"XM430-W350@57600:1,XL430-W250@57600:2"_s);
        const auto other = world.plan(*world.backup(1));
        QVERIFY(!other);
        QCOMPARE(other.error().kind, ErrorKind::InvalidArgument);
        QVERIFY2(other.error().text.contains(u"is the backup of a XL430-W250, and XM430-W350 (ID 1) is none"),
                 qPrintable(other.error().text));
        const QByteArray yaml = "backup: 1\nmodel: XM430-W350\nmodel-number: 1020\nfirmware: 47\nid: 1\nbaud: 57600\n"
                                "date: 2026-11-28T20:30:00Z\nregisters:\n  LED: 1\n  ";
        for (const auto &[line, says] :
             std::vector<std::pair<QByteArray, QString>>{{"Position P Gain: 20000", u"f:10:20: "_s},
                                                         {"Operating Mode: 2", u"f:10:19: "_s},
                                                         {"Temperature Limit: 255", u"f:10:22: "_s}}) {
            const auto file = backupFromYaml(yaml + line + '\n', u"f"_s, m_catalog);
            QVERIFY2(file, file ? "" : qPrintable(file.error().text));
            const auto plan = world.plan(*file);
            QVERIFY2(!plan, line.constData());
            QVERIFY2(plan.error().text.startsWith(says) && plan.error().text.endsWith(u"nothing was written"_s),
                     qPrintable(plan.error().text));
            QCOMPARE(world.writes(), QStringList());
        }
    }

    void compares()
    {
        BackupWorld world(m_catalog, u"XM430-W350@57600:1,XL430-W250@57600:2"_s);
        const auto first = world.backup();
        QVERIFY(std::ranges::all_of(compareBackups(*first, *first), &ComparedRegister::isSame));
        world.servo().write(u"Position P Gain", 700);
        world.servo().write(u"Homing Offset", 7);
        const auto rows = compareBackups(*first, *world.backup());
        QCOMPARE(countOf(rows, ComparedRegister::State::Differs), 3u); // the goal moves with the offset
        QCOMPARE(rowOf(rows, u"Homing Offset")->use, BackupUse::Calibration);
        QCOMPARE(rowOf(rows, u"ID")->use, BackupUse::Place);
        QCOMPARE(rowOf(rows, u"Goal Position")->use, BackupUse::Motion);
        QCOMPARE(rowOf(rows, u"Realtime Tick")->use, BackupUse::Reading);
        QCOMPARE(rowOf(rows, u"Model Number")->use, BackupUse::Identity);
        const ComparedRegister *gain = rowOf(rows, u"Position P Gain");
        QCOMPARE(gain->here, 800);
        QCOMPARE(gain->there, 700);
        const auto models = compareBackups(*first, *world.backup(1));
        QCOMPARE(rowOf(models, u"Current Limit")->state, ComparedRegister::State::OnlyHere);
        QCOMPARE(rowOf(models, u"Model Number")->state, ComparedRegister::State::Differs);
        QVERIFY(rowOf(models, u"Present Load")->state == ComparedRegister::State::OnlyThere);
    }

    void aSilentDeviceIsNoBackup()
    {
        BackupWorld world(m_catalog, u"XM430-W350@57600:1"_s);
        world.servo().setPlugged(false);
        const auto backup = world.backup();
        QVERIFY(!backup);
        QCOMPARE(backup.error().kind, ErrorKind::NothingReceived);
    }

    void inTheServo()
    {
        const ControlTablePtr has = m_catalog.find(1020, 45), hasNot = m_catalog.find(1020, 42),
                              never = m_catalog.find(350, 255); // XL-320
        QCOMPARE(inServoProblem(*has, 45, false, 0, 0), QString());
        QVERIFY(inServoProblem(*has, 45, true, 0, 0).contains(u"Backup Ready is 0"));
        QCOMPARE(inServoProblem(*has, 45, true, 0, 1), QString());
        QCOMPARE(inServoProblem(*has, 45, true, 0, std::nullopt), QString());
        QVERIFY(inServoProblem(*has, 45, false, 1, 0).contains(u"torque is on"));
        QVERIFY(inServoProblem(*hasNot, 42, false, 0, {}).contains(u"came with firmware 45"));
        QVERIFY(inServoProblem(*never, 255, false, 0, {}).contains(u"this model has no backup of its own"));
    }

private:
    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestBackup)
#include "tst_backup.moc"
