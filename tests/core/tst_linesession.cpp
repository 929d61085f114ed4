// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/scanner.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/fakefactory.h"
#include "tests/support/sessionfixture.h"
#include "tests/support/testmain.h"

#include <QSignalSpy>
#include <QThread>

#include <set>

using namespace dynascope;
using namespace std::chrono_literals;

/// What an open line makes of what its bus thread brings, in virtual time.
class TestLineSession : public QObject
{
    Q_OBJECT

private slots:
    void aPlanIsOfOneRate()
    {
        VirtualSession all(m_catalog, QStringLiteral("XM430-W350@57600:1,XM430-W350@1000000:1"));
        all.factory.simulated.servo(1, 57600)->write(u"Profile Velocity", 11);
        all.factory.simulated.servo(1, 1'000'000)->write(u"Profile Velocity", 22);
        all.open(57600);
        Device &device = *all.line->deviceAt(1, 57600);
        std::set<std::uint8_t> seen;
        int batches = 0;
        connect(all.line, &LineSession::batchTaken, this, [&](const Batch &batch) {
            ++batches;
            for (const PollValue &value : batch.values) {
                if (!value.data.empty())
                    seen.insert(value.data.front());
            }
        });
        all.line->setPollPlan(planOf(device, u"Profile Velocity", 0ms));
        QVERIFY(VirtualSession::waitFor([&] { return batches > 0; }));
        all.line->setWorkingBaudRate(1'000'000); // the next plan comes later
        for (int round = 0; round < 3; ++round) {
            std::optional<Result<void>> done;
            all.commands.ping(*all.line->deviceAt(1, 1'000'000), [&](const Result<void> &result) { done = result; });
            QVERIFY(VirtualSession::waitFor([&] { return done.has_value(); }));
            QVERIFY(*done);
        }
        // What was read at the old rate and still waited is taken, with it what came at the new one.
        QSignalSpy changed(all.line, &LineSession::rateChanged);
        QVERIFY(VirtualSession::waitFor([&] { return changed.size() > 0; }));
        QCOMPARE(seen, std::set<std::uint8_t>{11});
        QCOMPARE(device.raw(u"Profile Velocity"), 11);
        all.close();
    }

    void whatStillWaitedIsStale_data()
    {
        using Event = std::function<void(VirtualSession &)>;
        QTest::addColumn<Event>("event");
        QTest::newRow("closed") << Event([](VirtualSession &all) { all.line->bus().close(); });
        QTest::newRow("parked") << Event([](VirtualSession &all) { all.line->setWorkingBaudRate(1'000'000); });
        QTest::newRow("rebooting") << Event([](VirtualSession &all) {
            all.line->devices().front()->setState(Device::State::Rebooting);
        });
    }
    void whatStillWaitedIsStale()
    {
        QFETCH(std::function<void(VirtualSession &)>, event);
        VirtualSession all(m_catalog, QStringLiteral("XM430-W350@57600:1"));
        all.factory.simulated.servo(1, 57600)->write(u"Profile Velocity", 11);
        all.open(57600);
        const Device &device = *all.line->devices().front();
        QSignalSpy ready(&all.line->bus(), &BusThread::batchesReady);
        QSignalSpy taken(all.line, &LineSession::batchTaken);
        all.line->setPollPlan(planOf(device, u"Profile Velocity", 1000ms)); // once: virtual time stands still then
        QVERIFY(VirtualSession::waitFor([&] { return !ready.empty(); }));
        event(all);
        QVERIFY(VirtualSession::waitFor([&] { return !taken.empty(); }));
        QCOMPARE(device.raw(u"Profile Velocity"), 11);
        QCOMPARE(device.value(device.table().indexOf(u"Profile Velocity")).state, FieldState::Stale);
        all.close();
    }

    void aDeviceToldToBeSilentCanBeToldOtherwise()
    {
        VirtualSession all(m_catalog, QStringLiteral("XM430-W350@57600:1"));
        all.open(57600);
        Device &device = *all.line->devices().front();
        const int level = device.table().indexOf(Known::StatusReturnLevel);
        const auto write = [&](int value) {
            std::optional<Result<void>> done;
            all.commands.writeField(device, level, value, [&](const Result<void> &result) { done = result; });
            return VirtualSession::waitFor([&] { return done.has_value(); }) && done->has_value();
        };
        QVERIFY(write(0));
        QCOMPARE(device.raw(Known::StatusReturnLevel), 0);
        QSignalSpy taken(all.line, &LineSession::batchTaken);
        all.line->setPollPlan(planOf(device, u"Present Position", 0ms));
        QVERIFY(VirtualSession::waitFor([&] { return !taken.empty(); }));
        QCOMPARE(device.state(), Device::State::Present);
        const int torque = device.table().indexOf(Known::TorqueEnable);
        PollValue off;
        off.address = device.table().fields()[static_cast<std::size_t>(torque)].address;
        off.data = {0};
        device.take(off);
        QVERIFY(!device.mayHaveTorqueOn());
        std::optional<Result<void>> sent; // it obeys, and nobody can see it
        all.commands.setTorque({&device}, true, [&](const Result<void> &result) { sent = result; });
        QVERIFY(VirtualSession::waitFor([&] { return sent.has_value(); }));
        QVERIFY(!*sent);
        QCOMPARE(device.value(torque).unconfirmed, 1);
        QCOMPARE(device.value(torque).state, FieldState::Failed);
        QVERIFY(device.mayHaveTorqueOn());
        all.line->setPollPlan({});
        device.setState(Device::State::Silent); // even so
        QVERIFY(write(2));
        QCOMPARE(device.raw(Known::StatusReturnLevel), 2);
        QCOMPARE(device.state(), Device::State::Present);
        device.clearFailures();
        device.setAllStale();
        off.data = {1};
        device.take(off);
        QVERIFY(!device.value(torque).unconfirmed);
        QVERIFY(device.isTorqueOn());
        QCOMPARE(all.line->bus().statistics().timeouts, quint64(0)); // not one of them was the wire's fault
        all.close();
        QCOMPARE(int(all.factory.simulated.servo(1, 57600)->value(u"Status Return Level")), 2);
    }

    void whatComesWhileALineClosesIsNotLost()
    {
        std::atomic<int> packets = 0;
        VirtualSession all(m_catalog, QStringLiteral("XM430-W350@57600:1,XM430-W350@57600:2"));
        all.factory.onPacket = [&](int, ByteView) { ++packets; };
        QSignalSpy added(&all.session, &Session::deviceAdded);
        QSignalSpy removed(&all.session, &Session::deviceAboutToBeRemoved);
        all.open(57600);
        const std::vector<DeviceKey> keys{all.line->devices()[0]->key(), all.line->devices()[1]->key()};
        all.line->forget(keys[1]);
        Scanner scanner;
        QSignalSpy finished(&scanner, &Scanner::finished);
        scanner.start(*all.line, {{57600}, 0, 252});
        while (packets < 3) // the broadcast Ping and the two found, none of whom was delivered yet
            QThread::yieldCurrentThread();
        all.close();
        QCOMPARE(finished.size(), 1);
        QCOMPARE(removed.size(), added.size());
        all.open(57600);
        QCOMPARE(all.line->devices()[0]->key(), keys[0]); // traces go on
        QCOMPARE(all.line->devices()[1]->key(), keys[1]);
        all.close();
    }

    void aRateThatThePortRefusesParksNobody()
    {
        FakeFactory factory([](FakeLine &line, FakeServos &) { line.refusedBaud = 57600; });
        Session session(factory, m_catalog);
        LineSession &line = session.open(QStringLiteral("fake"), 1'000'000);
        const Device &here = line.heard({1, 1'000'000, 1020, 45, false, {}});
        const Device &there = line.heard({2, 57600, 1020, 45, false, {}});
        QVERIFY(VirtualSession::waitFor([&] { return line.state() == BusThread::State::Open; }));
        QSignalSpy told(&line, &LineSession::stateChanged);
        line.setWorkingBaudRate(57600);
        QVERIFY(VirtualSession::waitFor([&] { return told.size() == 2; }));
        QCOMPARE(line.baudRate(), 1'000'000);
        QCOMPARE(here.state(), Device::State::Present);
        QCOMPARE(there.state(), Device::State::Parked);
    }

private:
    /// One register, read every so often.
    static PollPlan planOf(const Device &device, QStringView name, std::chrono::milliseconds interval)
    {
        const Field &field = *device.table().find(name);
        PollPlan plan;
        plan.baudRate = device.baudRate();
        plan.spans.push_back({device.key(), {device.id(), field.address, field.size}, interval});
        plan.traits.push_back(device.traits());
        return plan;
    }

    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestLineSession)
#include "tst_linesession.moc"
