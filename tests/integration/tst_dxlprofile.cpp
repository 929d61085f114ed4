// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/journal/journal.h"
#include "core/session/procedures/movefile.h"
#include "tests/support/dxlbus.h"
#include "tests/support/testmain.h"

#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>

using namespace Qt::StringLiterals;
using namespace dynascope;
using dynascope::test::DxlBus;
using dynascope::test::Outcome;
using dynascope::test::RunningDxl;

namespace {

constexpr int Rate = 1'000'000;

QByteArray contents(const QString &path)
{
    QFile file(path);
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

void put(const QString &path, const QByteArray &text)
{
    QFile file(path);
    if (!file.open(QIODevice::WriteOnly) || file.write(text) != text.size())
        qFatal("can't write %s", qPrintable(path));
}

constexpr const char *Robot = R"(# two joints
profile: 1
joints:
  - name: shoulder   # left
    model: XM430-W350
    id: 1
    baud: 1000000
    registers:
      Position P Gain: 800   # soft
      Max Position Limit: 270 deg
      Operating Mode: Position control
  - { name: wrist, model: XL430-W250, id: 2, baud: 1000000, registers: { Profile Velocity: 100 } }
)";

} // namespace

/// `dxl profile`: a robot as one file has it.
class TestDxlProfile : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        QDir(MoveFile::usualFolder()).removeRecursively();
        m_folder = std::make_unique<QTemporaryDir>();
        m_file = m_folder->filePath(u"robot.yaml"_s);
        put(m_file, Robot);
        m_patience = u"400"_s;
        m_bus = std::make_unique<DxlBus>(u"XM430-W350@1000000:1,XL430-W250@1000000:2"_s);
        QVERIFY(!m_bus->path().isEmpty());
    }
    void cleanup() { m_bus.reset(); }

    void fromCheckToApplied()
    {
        const Outcome before = profile(u"check"_s);
        QCOMPARE(before.code, 1);
        QCOMPARE(before.err, QString());
        QCOMPARE(before.out, u"shoulder (XM430-W350, ID 1): 1 of 3 registers not as wanted\n"
                             "wrist (XL430-W250, ID 2): 1 of 1 register not as wanted\n"_s);
        const Outcome diff = profile(u"diff"_s);
        QCOMPARE(diff.code, 1);
        QCOMPARE(diff.out, u"shoulder: Max Position Limit: 4095 (359.91 °) -> 3072 (270.00 °)\n"
                           "wrist: Profile Velocity: 0 (0.0 rev/min) -> 100 (22.9 rev/min)\n"_s);
        m_bus->forget();
        const Outcome dry = profile(u"apply"_s, {u"--dry-run"_s});
        QCOMPARE(dry.code, 0);
        QCOMPARE(dry.out, diff.out);
        const Outcome unasked = profile(u"apply"_s);
        QCOMPARE(unasked.code, 2);
        QVERIFY2(unasked.err.contains(u"2 registers of 2 joints will be written: say --yes"), qPrintable(unasked.err));
        QCOMPARE(writes(), 0);
        const Outcome applied = profile(u"apply"_s, {u"--yes"_s});
        QCOMPARE(applied.err, QString());
        QCOMPARE(applied.code, 0);
        QCOMPARE(applied.out, u"shoulder (ID 1): 1 register written and read back\n"
                              "wrist (ID 2): 1 register written and read back\n"_s);
        QCOMPARE(writes(), 2);
        QCOMPARE(m_bus->value(1, Rate, u"Max Position Limit"), 3072);
        QCOMPARE(Journal(Journal::usualFolder()).entries().back().by, JournalAuthor::Profile);
        m_bus->forget();
        const Outcome again = profile(u"apply"_s, {u"--yes"_s});
        QCOMPARE(again.code, 0);
        QCOMPARE(again.err, u"dxl: everything is as wanted; nothing was written\n"_s);
        QCOMPARE(writes(), 0);
        QCOMPARE(profile(u"check"_s).code, 0);
        const Outcome none = profile(u"diff"_s);
        QCOMPARE(none.code, 0);
        QCOMPARE(none.out, QString());
    }

    void saves()
    {
        const QString fresh = m_folder->filePath(u"new.yaml"_s);
        m_bus->set(1, Rate, u"Operating Mode", 4);
        m_bus->set(1, Rate, u"Homing Offset", 100);
        const Outcome first = m_bus->dxl({u"--baud"_s, u"1000000"_s, u"profile"_s, u"save"_s, fresh});
        QCOMPARE(first.err, QString());
        QCOMPARE(first.code, 0);
        QVERIFY(contents(fresh).contains("      Operating Mode: Extended position control\n"));
        QVERIFY(!contents(fresh).contains("Homing Offset"));
        const QByteArray text = contents(fresh);
        const Outcome second = m_bus->dxl({u"profile"_s, u"save"_s, fresh});
        QCOMPARE(second.out, fresh + u" says so already\n"_s);
        QCOMPARE(contents(fresh), text);
        QCOMPARE(m_bus->dxl({u"profile"_s, u"check"_s, fresh}).code, 0);
        m_bus->set(1, Rate, u"Position P Gain", 640);
        QCOMPARE(profile(u"save"_s, {u"--calibration"_s}).code, 0);
        QByteArray expected = Robot;
        expected.replace("Gain: 800 ", "Gain: 640 ").replace("270 deg", "359.91 deg");
        expected.replace("Position control\n", "Extended position control\n      Homing Offset: 8.79 deg\n");
        expected.replace("Velocity: 100", "Velocity: 0");
        QCOMPARE(QString::fromUtf8(contents(m_file)), QString::fromUtf8(expected));
        QCOMPARE(profile(u"check"_s).code, 0);
    }

    void json()
    {
        const Outcome outcome = m_bus->dxl({u"--json"_s, u"profile"_s, u"check"_s, m_file});
        QCOMPARE(outcome.code, 1);
        const QJsonArray joints = QJsonDocument::fromJson(outcome.out.toUtf8()).array();
        QCOMPARE(joints.size(), 2);
        const QJsonObject shoulder = joints[0].toObject();
        QCOMPARE(shoulder[u"state"].toString(), u"differs"_s);
        QCOMPARE(shoulder[u"registers"].toArray().size(), 3);
        const QJsonObject limit = shoulder[u"registers"].toArray()[1].toObject();
        QCOMPARE(limit[u"field"].toString(), u"Max Position Limit"_s);
        QCOMPARE(limit[u"line"].toInt(), 10);
        QCOMPARE(limit[u"wanted"].toObject()[u"raw"].toInt(), 3072);
        QCOMPARE(limit[u"wanted"].toObject()[u"value"].toDouble(), 270.0);
        QCOMPARE(limit[u"held"].toObject()[u"raw"].toInt(), 4095);
        const Outcome applied = m_bus->dxl({u"--json"_s, u"profile"_s, u"apply"_s, m_file, u"--yes"_s});
        const QJsonObject written = QJsonDocument::fromJson(applied.out.toUtf8()).array()[0].toObject();
        QCOMPARE(written[u"registers"].toArray()[0].toObject()[u"new"].toInt(), 3072);
        QVERIFY(written[u"registers"].toArray()[0].toObject()[u"written"].toBool());
    }

    void torque()
    {
        m_bus->set(1, Rate, u"Torque Enable", 1);
        m_bus->forget();
        const Outcome refused = profile(u"apply"_s, {u"--yes"_s});
        QCOMPARE(refused.code, 2);
        QVERIFY2(refused.err.contains(u"torque of shoulder is on"), qPrintable(refused.err));
        QCOMPARE(writes(), 0);
        const Outcome done = profile(u"apply"_s, {u"--yes"_s, u"--torque-off"_s, u"--torque-back"_s});
        QCOMPARE(done.code, 0);
        QVERIFY2(done.out.contains(u"shoulder (ID 1): 1 register written and read back; torque is on again"),
                 qPrintable(done.out));
        QCOMPARE(m_bus->value(1, Rate, u"Torque Enable"), 1);
    }

    void movesToItsRate()
    {
        m_bus = std::make_unique<DxlBus>(u"XM430-W350@57600:1,XL430-W250@1000000:2"_s);
        m_patience = u"100"_s; // several rates are waited at
        const Outcome away = profile(u"check"_s);
        QVERIFY2(away.out.contains(u"answers at 57600 bps, not at 1000000"), qPrintable(away.out));
        const Outcome partly = profile(u"apply"_s, {u"--yes"_s});
        QCOMPARE(partly.code, 1);
        QVERIFY2(partly.err.contains(u"--move brings it there"), qPrintable(partly.err));
        const Outcome moved = profile(u"apply"_s, {u"--yes"_s, u"--move"_s});
        QCOMPARE(moved.err, QString());
        QCOMPARE(moved.code, 0);
        QCOMPARE(profile(u"check"_s).code, 0);
        QVERIFY(!MoveFile(MoveFile::usualFolder(), m_bus->path(), {}).exists());
    }

    void refusals_data()
    {
        QTest::addColumn<QByteArray>("text");
        QTest::addColumn<QStringList>("arguments");
        QTest::addColumn<QString>("says");
        QTest::newRow("no file") << QByteArray() << QStringList{u"profile"_s, u"check"_s, u"/nowhere/robot.yaml"_s}
                                 << u"/nowhere/robot.yaml"_s;
        const auto row = [](const char *name, const QByteArray &text, const QString &action, const QString &says) {
            QTest::newRow(name) << text << QStringList{u"profile"_s, action, u"FILE"_s} << says;
        };
        QByteArray wrong = Robot;
        row("broken", "profile: [1\n", u"apply"_s, u"robot.yaml:"_s);
        row("unknown register", QByteArray(Robot).replace("Max Position Limit", "Max Limit"), u"apply"_s,
            u"robot.yaml:10:7: XM430-W350 has no register \"Max Limit\""_s);
        row("out of range", wrong.replace("270 deg", "9999 deg"), u"save"_s, u"robot.yaml:10:27: "_s);
        row("same ID twice", QByteArray(Robot).replace("id: 2", "id: 1"), u"check"_s, u"robot.yaml:12:5: ID 1 at"_s);
        row("noise", QByteArray(1'000'000, 'x'), u"apply"_s, u"larger than"_s);
        QTest::newRow("unknown joint") << QByteArray(Robot)
                                       << QStringList{u"profile"_s, u"check"_s, u"FILE"_s, u"--joints"_s, u"knee"_s}
                                       << u"has no joint \"knee\""_s;
        QTest::newRow("options of another action")
            << QByteArray(Robot) << QStringList{u"profile"_s, u"check"_s, u"FILE"_s, u"--dry-run"_s}
            << u"are for apply"_s;
        QTest::newRow("of save") << QByteArray(Robot) << QStringList{u"profile"_s, u"apply"_s, u"FILE"_s, u"--all"_s}
                                 << u"are for save"_s;
        QTest::newRow("back without off")
            << QByteArray(Robot) << QStringList{u"profile"_s, u"apply"_s, u"FILE"_s, u"--torque-back"_s}
            << u"--torque-off"_s;
    }
    void refusals()
    {
        QFETCH(QByteArray, text);
        QFETCH(QStringList, arguments);
        QFETCH(QString, says);
        put(m_file, text);
        m_bus->forget();
        const Outcome outcome = m_bus->dxl(arguments.replaceInStrings(u"FILE"_s, m_file));
        QCOMPARE(outcome.code, 2);
        QVERIFY2(outcome.err.contains(says), qPrintable(outcome.err));
        QCOMPARE(writes(), 0);
        QCOMPARE(contents(m_file), text);
    }

    /// Killed without a word at twenty places: the same once more ends the same.
    void killed()
    {
        QByteArray text = Robot;
        text.replace("    registers:\n", "    registers:\n      Temperature Limit: 70\n      PWM Limit: 800\n"
                                         "      Velocity Limit: 200\n      Shutdown: 0\n      Drive Mode: 1\n"
                                         "      Position D Gain: 30\n      Profile Acceleration: 9\n");
        put(m_file, text.replace("Position control", "Extended position control"));
        for (int place = 0; place < 20; ++place) {
            m_bus->call([](sim::SimulatedBus &bus, LineTime) {
                for (const auto &servo : bus.servos()) {
                    for (const Field &field : servo->table().fields()) {
                        if (field.initial && field.isWritable() && field.area == Area::Eeprom && field.name != u"ID"
                            && field.name != u"Baud Rate" && field.name != u"Return Delay Time")
                            servo->write(field.name, *field.initial);
                    }
                }
            });
            m_bus->forget();
            {
                RunningDxl running(m_bus->with({u"profile"_s, u"apply"_s, m_file, u"--yes"_s}));
                QTRY_VERIFY_WITH_TIMEOUT(static_cast<int>(m_bus->sent().size()) > 2 * place, 10'000);
            } // killed
            const Outcome again = profile(u"apply"_s, {u"--yes"_s});
            QVERIFY2(again.code == 0, qPrintable(u"killed at %1: %2"_s.arg(place).arg(again.err)));
        }
    }

private:
    Outcome profile(const QString &action, const QStringList &more = {}) const
    {
        return test::dxl(
            QStringList{u"--port"_s, m_bus->path(), u"--timeout"_s, m_patience, u"profile"_s, action, m_file} + more);
    }
    /// Packets that write.
    int writes() const
    {
        int count = 0;
        for (const Bytes &packet : m_bus->sent()) {
            const auto instruction = static_cast<Instruction>(packet[7]);
            count += instruction == Instruction::Write || instruction == Instruction::SyncWrite
                     || instruction == Instruction::BulkWrite || instruction == Instruction::RegWrite;
        }
        return count;
    }

    std::unique_ptr<QTemporaryDir> m_folder;
    QString m_file, m_patience;
    std::unique_ptr<DxlBus> m_bus;
};

DYNASCOPE_CORE_TEST(TestDxlProfile)
#include "tst_dxlprofile.moc"
