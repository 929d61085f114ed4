// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/watchplan.h"
#include "core/table/catalog.h"
#include "tests/support/testmain.h"

#include <QSignalSpy>

#include <cmath>

using namespace dynascope;

namespace {

QStringList asText(const PollPlan &plan)
{
    QStringList lines;
    for (const PollSpan &span : plan.spans) {
        lines << QStringLiteral("#%1 %2+%3 every %4 ms")
                     .arg(span.span.id)
                     .arg(span.span.address)
                     .arg(span.span.length)
                     .arg(span.interval.count());
    }
    return lines;
}

} // namespace

class TestWatchPlan : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        auto catalog = Catalog::builtIn();
        QVERIFY2(catalog, catalog ? "" : qPrintable(catalog.error().text));
        m_table = catalog->find(1020, 45);
        QVERIFY(m_table);
    }

    void everyDeviceIsLookedAtOnceASecond()
    {
        Device device(1, nullptr, m_table, {1, 57600, 1020, 45, false, {}});
        const QStringList always{QStringLiteral("#1 64+7 every 1000 ms"), QStringLiteral("#1 144+3 every 1000 ms")};
        const QString delay = QStringLiteral("#1 9+1 every 1000 ms"); // Return Delay Time, until it is known
        QCOMPARE(asText(planWatches({{&device, {}, false}}, 57600)), QStringList(delay) + always);
        QSignalSpy changes(&device, &Device::attributesChanged);
        device.takeReadBack(m_table->indexOf(u"Return Delay Time"), 0);
        device.takeReadBack(m_table->indexOf(u"Status Return Level"), 2);
        QCOMPARE(changes.count(), 1); // the level was taken for 2
        QCOMPARE(asText(planWatches({{&device, {}, false}}, 57600)), always);
        QVERIFY(planWatches({{&device, {}, false}}, 57600).traits.front().returnDelayKnown);
    }

    void signsOfARestartAreReadInTime()
    {
        Device device(1, nullptr, m_table, {1, 57600, 1020, 45, false, {}});
        device.takeReadBack(m_table->indexOf(u"Return Delay Time"), 0);
        device.takeReadBack(m_table->indexOf(u"Status Return Level"), 2);
        const int tick = m_table->indexOf(u"Realtime Tick");
        const int torque = m_table->indexOf(u"Torque Enable");
        const QStringList state{QStringLiteral("#1 64+7 every 1000 ms"), QStringLiteral("#1 144+3 every 1000 ms")};
        const QString sign = QStringLiteral("#1 120+2 every 9000 ms");
        QCOMPARE(asText(planWatches({{&device, {}, false, {}, {tick, torque}}}, 57600)), state + QStringList(sign));
        QVERIFY(!asText(planWatches({{&device, {}, true, {}, {tick, torque}}}, 57600)).contains(sign)); // on screen
        QVERIFY(!asText(planWatches({{&device, {tick}, false, {}, {tick, torque}}}, 57600)).contains(sign)); // watched
    }

    void neighboursAreReadTogether()
    {
        const Device device(1, nullptr, m_table, {1, 57600, 1020, 45, false, {}});
        const int position = m_table->indexOf(u"Present Position");
        const int velocity = m_table->indexOf(u"Present Velocity");
        const int temperature = m_table->indexOf(u"Present Temperature");
        const QStringList plan = asText(planWatches({{&device, {position, velocity, temperature}, false}}, 57600));
        // 128..135 and 146: ten bytes between them are dearer than a second span.
        QCOMPARE(plan.mid(0, 2),
                 QStringList({QStringLiteral("#1 128+8 every 0 ms"), QStringLiteral("#1 146+1 every 0 ms")}));
    }

    void eachFieldAsOftenAsItIsWanted()
    {
        const Device device(1, nullptr, m_table, {1, 57600, 1020, 45, false, {}});
        const int position = m_table->indexOf(u"Present Position");
        const int velocity = m_table->indexOf(u"Present Velocity");
        const int temperature = m_table->indexOf(u"Present Temperature");
        DeviceWatches watches{&device, {position, velocity, temperature}, false};
        watches.rates = {{velocity, 50.0}, {temperature, 1.0}};
        const QStringList plan = asText(planWatches({watches}, 57600));
        QCOMPARE(plan.mid(0, 3),
                 QStringList({QStringLiteral("#1 132+4 every 0 ms"), QStringLiteral("#1 128+4 every 20 ms"),
                              QStringLiteral("#1 146+1 every 1000 ms")}));
        using namespace std::chrono_literals;
        QCOMPARE(intervalOf(0), 0ms);
        QCOMPARE(intervalOf(-1), 0ms);
        QCOMPARE(intervalOf(std::nan("")), 0ms);
        QCOMPARE(intervalOf(5000), 0ms);
        QCOMPARE(intervalOf(1e-9), 100s);
    }

    void theSelectedDeviceShowsItsRam()
    {
        const Device device(2, nullptr, m_table, {2, 57600, 1020, 45, false, {}});
        const QStringList plan = asText(planWatches({{&device, {}, true}}, 57600));
        QCOMPARE(plan, QStringList({QStringLiteral("#2 64+84 every 100 ms"), QStringLiteral("#2 9+1 every 1000 ms")}));
    }

    void whatIsGlancedAtIsReadBesides()
    {
        Device device(1, nullptr, m_table, {1, 57600, 1020, 45, false, {}});
        device.takeReadBack(m_table->indexOf(u"Return Delay Time"), 0);
        const int position = m_table->indexOf(u"Present Position");
        const int current = m_table->indexOf(u"Present Current");
        const int limit = m_table->indexOf(u"Temperature Limit");
        DeviceWatches watches{&device, {}, false};
        watches.glance = {position, current};
        watches.once = {limit};
        const QString once = QStringLiteral("#1 31+1 every 1000 ms");
        QStringList plan = asText(planWatches({watches}, 57600));
        const QString both = QStringLiteral("#1 126+10 every 200 ms"); // velocity is between them
        QVERIFY2(plan.contains(both), qPrintable(plan.join(u'\n')));
        QVERIFY(plan.contains(once));
        device.takeReadBack(limit, 80); // known: not read again
        QVERIFY(!asText(planWatches({watches}, 57600)).contains(once));
        watches.fields = {position}; // at full rate anyway
        plan = asText(planWatches({watches}, 57600));
        QVERIFY(!plan.contains(both));
        QVERIFY(plan.contains(QStringLiteral("#1 126+2 every 200 ms")));
        watches.rates[position] = 1; // more rarely than a glance needs
        QVERIFY(asText(planWatches({watches}, 57600)).contains(both));
        watches.isSelected = true; // at 10 Hz anyway
        plan = asText(planWatches({watches}, 57600));
        QVERIFY(plan.filter(QStringLiteral("every 200 ms")).isEmpty());
    }

    void longRunsArePolledOnlyWhereTheyAreUnfolded()
    {
        const Device device(2, nullptr, m_table, {2, 57600, 1020, 45, false, {}});
        const int data = m_table->indexOf(u"Indirect Data 1");
        QCOMPARE(m_table->at(224), &m_table->fields()[std::size_t(data)]);
        const QStringList plan = asText(planWatches({{&device, {}, true, {data, data + 1}}}, 57600));
        QCOMPARE(plan, QStringList({QStringLiteral("#2 64+84 every 100 ms"), QStringLiteral("#2 224+2 every 100 ms"),
                                    QStringLiteral("#2 9+1 every 1000 ms")}));
        // Of a device that isn't on screen there is nothing unfolded.
        QVERIFY(!asText(planWatches({{&device, {}, false, {data}}}, 57600)).contains(
            QStringLiteral("#2 224+1 every 100 ms")));
    }

    void aParkedDeviceIsLeftAlone()
    {
        Device device(1, nullptr, m_table, {1, 57600, 1020, 45, false, {}});
        const PollPlan plan = planWatches({{&device, {0}, true}}, 1'000'000);
        QVERIFY(plan.spans.empty());
        QCOMPARE(plan.baudRate, 1'000'000);
        QCOMPARE(plan.others, std::vector<Traits>{device.traits()}); // for jobs
        device.setState(Device::State::Silent);
        QVERIFY(planWatches({{&device, {0}, true}}, 1'000'000).spans.empty());
        // The poller probes it now and then.
        QVERIFY(!planWatches({{&device, {0}, true}}, 57600).spans.empty());
    }

private:
    ControlTablePtr m_table;
};

DYNASCOPE_CORE_TEST(TestWatchPlan)
#include "tst_watchplan.moc"
