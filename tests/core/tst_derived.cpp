// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/derived.h"
#include "tests/support/testmain.h"

#include <cmath>
#include <limits>

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

constexpr std::size_t Plenty = 1'000'000;

Derivation derivation(Derivation::Kind kind, LineTime span = {})
{
    Derivation made;
    made.kind = kind;
    made.span = span;
    return made;
}

/// Uneven times, values that wander.
void wander(History &history, int samples, quint32 state)
{
    LineTime at = history.isEmpty() ? LineTime(0) : history.last().at;
    std::int32_t raw = history.isEmpty() ? 0 : history.last().raw;
    for (int i = 0; i < samples; ++i) {
        state = state * 1664525U + 1013904223U;
        at += 1ms + LineTime(state % 3'000'000);
        raw += static_cast<std::int32_t>(state >> 20U) - 2048;
        history.append(at, raw);
    }
}

DerivedHistory whole(const Derivation &how, const History &source, const History *other = nullptr)
{
    DerivedHistory derived(how);
    std::size_t budget = Plenty;
    derived.advance(&source, other, budget);
    return derived;
}

double valueAt(const DerivedHistory &derived, std::size_t index)
{
    return static_cast<double>(derived.history().at(index).raw) / derived.resolution();
}

} // namespace

class TestDerived : public QObject
{
    Q_OBJECT

private slots:
    void theDifferenceIsExact()
    {
        History goal;
        History present;
        for (int i = 0; i < 1000; ++i) {
            goal.append(10ms * i, 5000 * i);
            present.append(10ms * i, 4999 * i + 3);
        }
        const DerivedHistory derived = whole(derivation(Derivation::Kind::Difference), goal, &present);
        QCOMPARE(derived.history().size(), std::size_t(1000));
        for (std::size_t i = 0; i < 1000; ++i) {
            QCOMPARE(derived.history().at(i).raw, std::int32_t(i) - 3);
            QCOMPARE(derived.history().at(i).at, goal.at(i).at);
        }
    }

    void aSlowerOneHoldsItsValue()
    {
        History fast;
        History slow;
        for (int i = 0; i < 30; ++i)
            fast.append(10ms * i, 100 + i);
        slow.append(50ms, 7);
        slow.append(150ms, 8);
        slow.appendGap(200ms);
        slow.append(250ms, 9);
        const DerivedHistory derived = whole(derivation(Derivation::Kind::Difference), fast, &slow);
        QCOMPARE(derived.history().size(), std::size_t(10 + 5)); // nothing before 50 ms nor from 150 to 250
        QCOMPARE(derived.history().at(0).raw, 105 - 7);
        QCOMPARE(derived.history().at(9).raw, 114 - 7);
        QCOMPARE(derived.history().at(10).raw, 125 - 9);
        QVERIFY(derived.history().gapBefore(10));
    }

    void anotherScaleIsCountedAsTheSource()
    {
        History one;
        History other;
        one.append(1s, 1000);
        other.append(1s, 100'000);
        DerivedHistory derived(derivation(Derivation::Kind::Difference));
        derived.setRelation(4096.0 / 501'923, 10);
        std::size_t budget = Plenty;
        derived.advance(&one, &other, budget);
        QVERIFY(std::abs(valueAt(derived, 0) - (1000 - (100'000 * 4096.0 / 501'923 + 10))) <= 0.5 / 16);
    }

    void theDerivativeIsADifferenceQuotient()
    {
        History source;
        wander(source, 2000, 5);
        const DerivedHistory plain = whole(derivation(Derivation::Kind::Derivative), source);
        QCOMPARE(plain.history().size(), source.size() - 1);
        for (std::size_t i = 0; i < plain.history().size(); ++i) {
            const double seconds = std::chrono::duration<double>(source.at(i + 1).at - source.at(i).at).count();
            QVERIFY(std::abs(valueAt(plain, i) - (source.at(i + 1).raw - source.at(i).raw) / seconds) <= 0.5 / 16 + 1e-9);
        }
        const DerivedHistory over = whole(derivation(Derivation::Kind::Derivative, 20ms), source);
        std::size_t made = 0;
        for (std::size_t i = 0; i < source.size(); ++i) {
            std::size_t from = source.indexAt(source.at(i).at - 20ms + LineTime(1));
            if (from == 0)
                continue;
            --from; // the newest that is old enough
            const double seconds = std::chrono::duration<double>(source.at(i).at - source.at(from).at).count();
            QVERIFY(std::abs(valueAt(over, made++) - (source.at(i).raw - source.at(from).raw) / seconds)
                <= 0.5 / 16 + 1e-9);
        }
        QCOMPARE(made, over.history().size());
    }

    void theAverageIsAMean()
    {
        History source;
        wander(source, 2000, 9);
        const DerivedHistory derived = whole(derivation(Derivation::Kind::Average, 15ms), source);
        QCOMPARE(derived.history().size(), source.size());
        for (std::size_t i = 0; i < source.size(); ++i) {
            double sum = 0;
            int count = 0;
            for (std::size_t k = source.indexAt(source.at(i).at - 15ms); k <= i; ++k, ++count)
                sum += source.at(k).raw;
            QVERIFY(std::abs(valueAt(derived, i) - sum / count) <= 0.5 / 16 + 1e-9);
        }
    }

    void nothingIsDerivedAcrossAGap()
    {
        History source;
        source.append(0ms, 10);
        source.append(10ms, 20);
        source.appendGap(15ms);
        source.append(1s, 1000);
        source.append(1s + 10ms, 1010);
        const DerivedHistory slope = whole(derivation(Derivation::Kind::Derivative), source);
        QCOMPARE(slope.history().size(), std::size_t(2));
        QCOMPARE(valueAt(slope, 0), 1000.0);
        QCOMPARE(valueAt(slope, 1), 1000.0);
        QVERIFY(slope.history().gapBefore(1));
        const DerivedHistory mean = whole(derivation(Derivation::Kind::Average, 10s), source);
        QCOMPARE(valueAt(mean, 2), 1000.0);
        QVERIFY(mean.history().gapBefore(2));
    }

    void whatIsTooLargeIsAGap()
    {
        History source;
        source.append(1s, 5);
        source.append(2s, std::numeric_limits<std::int32_t>::max());
        source.append(3s, 6);
        const DerivedHistory mean = whole(derivation(Derivation::Kind::Average, 0ms), source);
        QCOMPARE(mean.history().size(), std::size_t(2));
        QVERIFY(mean.history().gapBefore(1));
    }

    void bitByBitIsTheSame()
    {
        for (const auto kind : {Derivation::Kind::Derivative, Derivation::Kind::Average}) {
            History source;
            DerivedHistory slowly(derivation(kind, 12ms));
            for (int i = 0; i < 50; ++i) {
                wander(source, 40, static_cast<quint32>(i));
                for (int calls = 0; calls < 3; ++calls) {
                    std::size_t budget = 17;
                    slowly.advance(&source, nullptr, budget);
                }
            }
            std::size_t budget = Plenty;
            QVERIFY(slowly.advance(&source, nullptr, budget).has_value() || budget == Plenty);
            const DerivedHistory at_once = whole(derivation(kind, 12ms), source);
            QCOMPARE(slowly.history().size(), at_once.history().size());
            for (std::size_t i = 0; i < at_once.history().size(); ++i)
                QVERIFY(slowly.history().at(i) == at_once.history().at(i));
        }
    }

    void whatWasClearedIsBegunAnew()
    {
        History source;
        wander(source, 100, 3);
        DerivedHistory derived(derivation(Derivation::Kind::Average, 10ms));
        std::size_t budget = Plenty;
        QVERIFY(derived.advance(&source, nullptr, budget) == source.at(0).at);
        source = History();
        QVERIFY(!derived.advance(&source, nullptr, budget));
        QVERIFY(derived.history().isEmpty());
        wander(source, 300, 4);
        derived.advance(&source, nullptr, budget);
        QCOMPARE(derived.history().size(), std::size_t(300));
        QVERIFY(!derived.advance(nullptr, nullptr, budget)); // its device went
    }
};

DYNASCOPE_CORE_TEST(TestDerived)
#include "tst_derived.moc"
