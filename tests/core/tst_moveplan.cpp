// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/procedures/moveplan.h"
#include "tests/support/testmain.h"

#include <random>
#include <set>

using namespace dynascope;
using namespace Qt::StringLiterals;

namespace {

MoveDevice device(int id, int baudRate, const MovePlace &goal, int secondaryId = -1)
{
    MoveDevice one;
    one.place.id = static_cast<std::uint8_t>(id);
    one.place.baudRate = baudRate;
    one.place.modelNumber = 1020;
    one.place.name = u"XM430-W350 #%1"_s.arg(id);
    one.firmware = 45;
    one.secondaryId = secondaryId;
    one.goal = goal;
    one.rates = {{9600, 0}, {57600, 1}, {1'000'000, 3}, {4'000'000, 6}};
    return one;
}

QString text(const Result<MovePlan> &plan)
{
    if (!plan)
        return plan.error().text;
    QStringList steps;
    for (const MoveStep &step : plan->steps)
        steps << u"%1@%2>%3@%4%5"_s.arg(step.from.id)
                     .arg(step.from.baudRate)
                     .arg(step.to.id)
                     .arg(step.to.baudRate)
                     .arg(step.isDetour ? u"*" : u"");
    return steps.join(u' ');
}

/// Plays the steps: never two at a place, also by their Secondary ID; everybody ends where it shall.
QString play(const MovePlan &plan)
{
    std::vector<MovePlace> places;
    for (const MoveDevice &each : plan.devices)
        places.push_back({each.place.baudRate, each.place.id});
    for (const MoveStep &step : plan.steps) {
        if (places[step.device] != step.from)
            return u"a step begins where its device is not"_s;
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (i == step.device || places[i].baudRate != step.to.baudRate)
                continue;
            if (places[i] == step.to || plan.devices[i].secondaryId == step.to.id)
                return u"%1 is taken"_s.arg(placeText(step.to));
        }
        places[step.device] = step.to;
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (places[i] != plan.devices[i].goal)
            return u"one does not arrive"_s;
    }
    return {};
}

} // namespace

/// Which order many changes of ID and baud rate have.
class TestMovePlan : public QObject
{
    Q_OBJECT

private slots:
    void orders_data()
    {
        QTest::addColumn<std::vector<MoveDevice>>("devices");
        QTest::addColumn<QString>("steps");
        constexpr int Slow = 57600, Fast = 1'000'000;
        const auto row = [](const char *name, const std::vector<MoveDevice> &devices, const char16_t *steps) {
            QTest::newRow(name) << devices << QString::fromUtf16(steps);
        };
        row("nothing", {device(1, Slow, {Slow, 1})}, u"");
        row("an ID", {device(1, Slow, {Slow, 5})}, u"1@57600>5@57600");
        row("both", {device(1, Slow, {Fast, 5})}, u"1@57600>5@57600 5@57600>5@1000000");
        row("both, its new ID being taken at the old rate", {device(1, Slow, {Fast, 5}), device(5, Slow, {Slow, 5})},
            u"1@57600>1@1000000 1@1000000>5@1000000");
        row("shift by one", {device(1, Slow, {Slow, 2}), device(2, Slow, {Slow, 3}), device(3, Slow, {Slow, 4})},
            u"3@57600>4@57600 2@57600>3@57600 1@57600>2@57600");
        row("swap", {device(1, Slow, {Slow, 2}), device(2, Slow, {Slow, 1})},
            u"1@57600>252@57600* 2@57600>1@57600 252@57600>2@57600");
        row("ring of three", {device(1, Slow, {Slow, 2}), device(2, Slow, {Slow, 3}), device(3, Slow, {Slow, 1})},
            u"1@57600>252@57600* 3@57600>1@57600 2@57600>3@57600 252@57600>2@57600");
        row("the free ID is a Secondary ID",
            {device(1, Slow, {Slow, 2}), device(2, Slow, {Slow, 1}), device(9, Slow, {Slow, 9}, 252)},
            u"1@57600>251@57600* 2@57600>1@57600 251@57600>2@57600");
        row("taken", {device(1, Slow, {Slow, 2}), device(2, Slow, {Slow, 2})},
            u"XM430-W350 #1 and XM430-W350 #2 would both have ID 2 at 57600 bps");
        row("taken as a Secondary ID", {device(1, Slow, {Slow, 7}), device(2, Slow, {Slow, 2}, 7)},
            u"XM430-W350 #1 would have ID 7 at 57600 bps, which is the Secondary ID of XM430-W350 #2");
        row("taken at the new rate", {device(1, Slow, {Fast, 1}), device(1, Fast, {Fast, 1})},
            u"XM430-W350 #1 and XM430-W350 #1 would both have ID 1 at 1000000 bps");
        row("a rate that the model lacks", {device(1, Slow, {2'000'000, 1})},
            u"XM430-W350 #1 does not offer 2000000 bps");
        row("no ID", {device(1, Slow, {Slow, 253})}, u"XM430-W350 #1: an ID is 0 to 252, not 253");
        row("two at one place", {device(1, Slow, {Slow, 2}), device(1, Slow, {Slow, 3})},
            u"Two devices have ID 1 at 57600 bps: give one of them another ID alone first");
    }
    void orders()
    {
        QFETCH(std::vector<MoveDevice>, devices);
        QFETCH(QString, steps);
        const auto plan = planMoves(devices);
        QCOMPARE(text(plan), steps);
        if (plan)
            QCOMPARE(play(*plan), QString());
    }

    void noIdIsFree()
    {
        std::vector<MoveDevice> devices;
        for (int id = 0; id <= MaximumId; ++id)
            devices.push_back(device(id, 57600, {57600, id == 0 ? 1 : id == 1 ? 0 : id}));
        QCOMPARE(text(planMoves(devices)), u"There is no way to these places: no ID is free to step aside to"_s);
    }

    void randomPermutations()
    {
        std::mt19937 random(1);
        for (int round = 0; round < 300; ++round) {
            const int count = 2 + static_cast<int>(random() % 20);
            std::vector<MovePlace> goals;
            std::set<MovePlace> starts;
            std::vector<MoveDevice> devices;
            for (int i = 0; i < count; ++i)
                goals.push_back({random() % 2 ? 57600 : 1'000'000, i + static_cast<int>(random() % 3) * 30});
            std::vector<MovePlace> from = goals;
            std::shuffle(from.begin(), from.end(), random);
            for (int i = 0; i < count; ++i)
                devices.push_back(device(from[static_cast<std::size_t>(i)].id,
                                         from[static_cast<std::size_t>(i)].baudRate,
                                         goals[static_cast<std::size_t>(i)]));
            const auto plan = planMoves(devices);
            QVERIFY2(plan, plan ? "" : qPrintable(plan.error().text));
            QCOMPARE(play(*plan), QString());
            const auto again = movePlanFromJson(toJson(*plan));
            QVERIFY(again);
            QCOMPARE(toJson(*again), toJson(*plan));
        }
    }

    void badFiles_data()
    {
        QTest::addColumn<QByteArray>("json");
        auto plan = planMoves({device(1, 57600, {57600, 2}), device(2, 57600, {57600, 1})});
        const QByteArray good = toJson(*plan);
        QVERIFY(movePlanFromJson(good));
        QTest::newRow("nothing") << QByteArray();
        QTest::newRow("noise") << QByteArray(2'000'000, '[');
        QTest::newRow("cut off") << good.left(good.size() - 20);
        const auto changed = [&good](const char *from, const char *to) { return QByteArray(good).replace(from, to); };
        QTest::newRow("another format") << changed("\"moves\": 1", "\"moves\": 2");
        QTest::newRow("a step beyond all") << changed("\"next\": 0", "\"next\": 99");
        QTest::newRow("a device that isn't there") << changed("\"device\": 1", "\"device\": 7");
        QTest::newRow("an ID beyond all") << changed("252", "300");
        QTest::newRow("steps that don't follow") << changed("252", "251").replace(good.indexOf("252"), 3, "250");
        QTest::newRow("no model") << changed("\"model\": 1020", "\"model\": \"x\"");
    }
    void badFiles()
    {
        QFETCH(QByteArray, json);
        const auto plan = movePlanFromJson(json);
        QVERIFY(!plan);
        QCOMPARE(plan.error().kind, ErrorKind::BadFile);
    }
};

DYNASCOPE_CORE_TEST(TestMovePlan)
#include "tst_moveplan.moc"
