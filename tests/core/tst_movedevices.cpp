// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/builtincatalog.h"
#include "tests/support/moveworld.h"
#include "tests/support/testmain.h"

#include <QFile>

using namespace dynascope;
using namespace Qt::StringLiterals;
using test::devicesOf, test::Forever, test::MortalLine;

namespace {

MoveHooks savingTo(const QString &path)
{
    MoveHooks hooks;
    hooks.save = [path](const MovePlan &plan) -> Result<void> {
        QFile file(path);
        if (!file.open(QIODevice::WriteOnly) || file.write(toJson(plan)) < 0)
            return failure(ErrorKind::BadFile, file.errorString());
        return {};
    };
    return hooks;
}

Result<MovePlan> loaded(const QString &path)
{
    QFile file(path);
    if (!file.open(QIODevice::ReadOnly))
        return failure(ErrorKind::NotFound, file.errorString());
    return movePlanFromJson(file.readAll());
}

} // namespace

/// Many devices to new IDs and baud rates, killed anywhere, on simulated servos in virtual time.
class TestMoveDevices : public QObject
{
    Q_OBJECT

private slots:
    void killedAtEachWrite_data()
    {
        QTest::addColumn<QString>("servos");
        QTest::addColumn<std::vector<MovePlace>>("goals");
        QTest::addColumn<bool>("lastGoesOut");
        QStringList twelve;
        std::vector<MovePlace> fast, ring;
        for (int id = 1; id <= 12; ++id) {
            twelve << u"XM430-W350@57600:%1"_s.arg(id);
            fast.push_back({4'000'000, id});
            ring.push_back({57600, id % 12 + 1});
        }
        const QString servos = twelve.join(u',');
        for (const bool out : {true, false}) {
            const char *how = out ? "its last packet arrives" : "its last packet is lost";
            QTest::addRow("57 600 to 4 M, %s", how) << servos << fast << out;
            QTest::addRow("renumbering ring, %s", how) << servos << ring << out;
            QTest::addRow("swap and new rate, %s", how)
                << u"XM430-W350@57600:1,XL430-W250@57600:2"_s << std::vector<MovePlace>{{1'000'000, 2}, {1'000'000, 1}}
                << out;
        }
    }
    void killedAtEachWrite()
    {
        QFETCH(QString, servos);
        QFETCH(std::vector<MovePlace>, goals);
        QFETCH(bool, lastGoesOut);
        for (int at = 0; at < 100; ++at) {
            const QTemporaryDir folder;
            const QString path = folder.filePath(u"move.json"_s);
            sim::SimulatedBus bus(m_catalog);
            populate(bus, m_catalog, servos);
            std::vector<sim::Servo *> all;
            for (const auto &servo : bus.servos())
                all.push_back(servo.get());
            bool wasKilled = false;
            {
                MortalLine line(bus, 57600, at);
                line.setLastGoesOut(lastGoesOut);
                Bus program(line);
                DirectContext context(program);
                auto plan = planMoves(devicesOf(bus, goals));
                QVERIFY2(plan, plan ? "" : qPrintable(plan.error().text));
                const auto checked = checkMoves(context, *plan);
                QVERIFY2(checked, checked ? "" : qPrintable(checked.error().text));
                const auto moved = moveDevices(context, *plan, savingTo(path));
                wasKilled = line.isDead();
                QCOMPARE(moved.has_value(), !wasKilled);
            }
            // Everybody is at a place of its own, with all else as it was, whatever happened.
            std::set<std::pair<int, int>> places;
            for (const sim::Servo *servo : all)
                places.insert({servo->baudRate(), servo->id()});
            QCOMPARE(places.size(), all.size());
            if (wasKilled) {
                MortalLine line(bus, 57600, Forever);
                Bus program(line);
                DirectContext context(program);
                auto plan = loaded(path);
                QVERIFY2(plan, plan ? "" : qPrintable(plan.error().text));
                const auto checked = checkMoves(context, *plan);
                QVERIFY2(checked, qPrintable(u"killed at write %1: %2"_s.arg(at).arg(checked ? QString()
                                                                                             : checked.error().text)));
                const auto moved = moveDevices(context, *plan, savingTo(path));
                QVERIFY2(moved,
                         qPrintable(u"killed at write %1: %2"_s.arg(at).arg(moved ? QString() : moved.error().text)));
            }
            const auto end = loaded(path);
            QVERIFY(end);
            QVERIFY(end->isOver());
            for (std::size_t i = 0; i < all.size(); ++i) {
                QCOMPARE(all[i]->id(), goals[i].id);
                QCOMPARE(all[i]->baudRate(), goals[i].baudRate);
                QCOMPARE(all[i]->value(u"Moving Threshold"), 10);
            }
            if (!wasKilled) {
                QVERIFY(at >= static_cast<int>(all.size()));
                return;
            }
        }
        QFAIL("it never came to its end");
    }

    void refusedBeforeTheFirstWrite_data()
    {
        QTest::addColumn<QString>("obstacle");
        QTest::addColumn<QString>("says");
        QTest::newRow("nobody") << QString() << QString();
        QTest::newRow("a stranger at the new place") << u"stranger"_s << u"ID 2 at 4000000 bps is taken"_s;
        QTest::newRow("a port that can't do it") << u"port"_s << u"4000000"_s;
        QTest::newRow("a device that is gone") << u"gone"_s << u"XM430-W350 #2 does not answer"_s;
        QTest::newRow("another model in its place") << u"other"_s << u"or another device does"_s;
    }
    void refusedBeforeTheFirstWrite()
    {
        QFETCH(QString, obstacle);
        QFETCH(QString, says);
        sim::SimulatedBus bus(m_catalog);
        const bool other = obstacle == u"other";
        populate(bus, m_catalog,
                 (other ? u"XM430-W350@57600:1,XL430-W250@57600:2"_s : u"XM430-W350@57600:1,XM430-W350@57600:2"_s)
                     + (obstacle == u"stranger" ? u",XL430-W250@4000000:2"_s : QString()));
        std::vector<MoveDevice> devices = devicesOf(bus, {{4'000'000, 1}, {4'000'000, 2}, {4'000'000, 2}});
        devices.resize(2); // nobody knows of the stranger
        devices[1].place.modelNumber = 1020;
        auto plan = planMoves(devices);
        QVERIFY(plan);
        if (obstacle == u"gone")
            bus.servo(2, 57600)->setPlugged(false);
        bus.setLogging(true);
        MortalLine line(bus, 57600, Forever);
        if (obstacle == u"port")
            line.refuse(4'000'000);
        Bus program(line);
        DirectContext context(program);
        const auto checked = checkMoves(context, *plan);
        QCOMPARE(checked.has_value(), says.isEmpty());
        QVERIFY2(checked || checked.error().text.contains(says), checked ? "" : qPrintable(checked.error().text));
        for (const sim::WireEntry &entry : bus.log())
            QVERIFY(!entry.fromController || entry.bytes[7] != static_cast<std::uint8_t>(Instruction::Write));
        QCOMPARE(line.baudRate(), 57600);
    }

    void underTorque()
    {
        for (const bool mayTurnOff : {false, true}) {
            sim::SimulatedBus bus(m_catalog);
            populate(bus, m_catalog, u"XM430-W350@57600:1"_s);
            bus.servo(1, 57600)->write(u"Torque Enable", 1);
            sim::Servo *servo = bus.servos().front().get();
            MortalLine line(bus, 57600, Forever);
            Bus program(line);
            DirectContext context(program);
            auto plan = planMoves(devicesOf(bus, {{57600, 5}}));
            plan->turnTorqueOff = mayTurnOff;
            const auto moved = moveDevices(context, *plan, {});
            QCOMPARE(moved.has_value(), mayTurnOff);
            QCOMPARE(servo->id(), mayTurnOff ? 5 : 1);
            QCOMPARE(servo->value(u"Torque Enable"), mayTurnOff ? 0 : 1);
        }
    }

    /// What it takes in simulated time, against the packets alone.
    void figure()
    {
        sim::SimulatedBus bus(m_catalog);
        QStringList servos;
        std::vector<MovePlace> goals;
        for (int id = 1; id <= 12; ++id) {
            servos << u"XM430-W350@57600:%1"_s.arg(id);
            goals.push_back({4'000'000, id});
        }
        populate(bus, m_catalog, servos.join(u','));
        bus.setLogging(true);
        MortalLine line(bus, 57600, Forever);
        Bus program(line);
        DirectContext context(program);
        auto plan = planMoves(devicesOf(bus, goals));
        const LineTime begin = line.now();
        QVERIFY(checkMoves(context, *plan));
        const LineTime checked = line.now();
        QVERIFY(moveDevices(context, *plan, {}));
        LineTime wire{};
        for (const sim::WireEntry &entry : bus.log())
            wire += entry.end - entry.begin;
        const auto seconds = [](LineTime time) { return std::chrono::duration<double>(time).count(); };
        qInfo("12 servos from 57 600 to 4 M: %.3f s, of which %.3f s looking first; packets alone %.3f s, %zu of them",
              seconds(line.now() - begin), seconds(checked - begin), seconds(wire), bus.log().size());
        QVERIFY(line.now() - begin < std::chrono::seconds(3));
    }

private:
    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestMoveDevices)
#include "tst_movedevices.moc"
