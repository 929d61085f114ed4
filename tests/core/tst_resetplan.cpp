// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/resetplan.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace Qt::StringLiterals;

namespace {

ResetMove reset(MovePlace from, MovePlace after)
{
    ResetMove move;
    move.place.id = static_cast<std::uint8_t>(from.id);
    move.place.baudRate = from.baudRate;
    move.place.name = u"#%1"_s.arg(from.id);
    move.after = move.place;
    move.after.id = static_cast<std::uint8_t>(after.id);
    move.after.baudRate = after.baudRate;
    return move;
}

constexpr int Slow = 57600, Fast = 1'000'000;

} // namespace

/// Factory Resets of several devices: who first, and who not together.
class TestResetPlan : public QObject
{
    Q_OBJECT

private slots:
    void orders_data()
    {
        QTest::addColumn<std::vector<ResetMove>>("resets");
        QTest::addColumn<std::vector<MovePlace>>("others");
        QTest::addColumn<std::vector<std::size_t>>("order"); // empty: refused
        QTest::addColumn<QString>("says");
        using Resets = std::vector<ResetMove>;
        using Places = std::vector<MovePlace>;
        using Order = std::vector<std::size_t>;
        QTest::newRow("everybody stays") << Resets{reset({Slow, 1}, {Slow, 1}), reset({Slow, 2}, {Slow, 2})} << Places()
                                         << Order{0, 1} << QString();
        QTest::newRow("two to one place") << Resets{reset({Slow, 3}, {Slow, 1}), reset({Slow, 2}, {Slow, 1})}
                                          << Places() << Order() << u"#3 and #2 would both end at ID 1"_s;
        QTest::newRow("who stands there goes first")
            << Resets{reset({Slow, 3}, {Slow, 1}), reset({Slow, 1}, {Fast, 1})} << Places() << Order{1, 0} << QString();
        QTest::newRow("who stands there stays")
            << Resets{reset({Slow, 3}, {Slow, 1})} << Places{{Slow, 1}} << Order() << u"where another device is"_s;
        QTest::newRow("a ring") << Resets{reset({Slow, 3}, {Slow, 1}), reset({Slow, 1}, {Slow, 3})} << Places()
                                << Order() << u"one after the other"_s;
    }
    void orders()
    {
        QFETCH(std::vector<ResetMove>, resets);
        QFETCH(std::vector<MovePlace>, others);
        QFETCH(std::vector<std::size_t>, order);
        QFETCH(QString, says);
        const auto planned = planResets(resets, others);
        QCOMPARE(planned.has_value(), says.isEmpty());
        if (planned)
            QCOMPARE(*planned, order);
        else
            QVERIFY2(planned.error().text.contains(says), qPrintable(planned.error().text));
    }
};

DYNASCOPE_CORE_TEST(TestResetPlan)
#include "tst_resetplan.moc"
