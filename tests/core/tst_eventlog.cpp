// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/eventlog.h"
#include "core/session/journal/journal.h"
#include "core/table/catalog.h"
#include "tests/support/testmain.h"

#include <QSignalSpy>

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

class NoLines : public LineFactory
{
public:
    bool knows(const QString &) const override { return true; }
    Result<std::unique_ptr<Line>> open(const QString &name, int) override
    {
        return failure(ErrorKind::PortNotFound, name);
    }
};

struct EventBench {
    NoLines factory;
    Catalog catalog = Catalog::builtIn().value();
    Session session{factory, catalog};
    Journal journal;
    LineSession &line = session.open(QStringLiteral("test"), 1'000'000);
    EventLog log{session, &journal, nullptr};
    Device &device = line.heard({1, 1'000'000, 1020, 45, false, {}});

    EventBench()
    {
        session.setClock({[] { return LineTime(100s); }, [] { return QDateTime::currentDateTime(); }});
    }
    void torque(std::uint8_t value, LineTime at)
    {
        PollValue read;
        read.device = device.key();
        read.address = 64;
        read.length = 1;
        read.data = {value};
        read.at = at;
        device.take(read);
    }
    JournalEntry goal(std::uint8_t before, std::uint8_t after) const
    {
        JournalEntry entry;
        entry.device = {QStringLiteral("test"), {}, QStringLiteral("XM430-W350"), 1020, 45, 1, 1'000'000};
        entry.changes = {{QStringLiteral("Profile Velocity"), 112, false, {before, 0, 0, 0}, {after, 0, 0, 0}, {}}};
        return entry;
    }
};

} // namespace

class TestEventLog : public QObject
{
    Q_OBJECT

private slots:
    void torqueHasTheLinesTime()
    {
        EventBench bench;
        QSignalSpy added(&bench.log, &EventLog::added);
        bench.torque(0, 1s); // how it is, no event
        bench.torque(0, 2s);
        QCOMPARE(added.count(), 0);
        bench.torque(1, 3s);
        bench.torque(1, 4s);
        bench.torque(0, 5s);
        QCOMPARE(added.count(), 2);
        QVERIFY(bench.log.events()[0]
            == (LoggedEvent{3s, LoggedEvent::Kind::TorqueOn, bench.device.key(), QStringLiteral("XM430-W350 #1"),
                QStringLiteral("Torque on")}));
        QCOMPARE(bench.log.events()[1].kind, LoggedEvent::Kind::TorqueOff);
        QCOMPARE(bench.log.indexAt(4s), std::size_t(1));
        QCOMPARE(bench.log.indexAt(6s), std::size_t(2));
    }

    void alertAndRebootAreNotedOnce()
    {
        EventBench bench;
        bench.session.setClock({[] { return LineTime(9'000'000s); }, [] { return QDateTime::currentDateTime(); }});
        bench.device.setAlert(true);
        bench.device.setAlert(true);
        bench.device.setState(Device::State::Rebooting);
        bench.device.setNickname(QStringLiteral("elbow"));
        bench.device.setState(Device::State::Present);
        QCOMPARE(bench.log.events().size(), std::size_t(2));
        bench.device.setAlert(false);
        bench.device.setAlert(true);
        QCOMPARE(bench.log.events().size(), std::size_t(3));
        QCOMPARE(bench.log.events().back().at, LineTime(9'000'000s)); // the reboot's; alerts were heard before
        QCOMPARE(bench.log.events().back().kind, LoggedEvent::Kind::Restart);
    }

    void writesComeFromTheJournal()
    {
        EventBench bench;
        bench.journal.setClock([] { return QDateTime::currentDateTimeUtc().addSecs(-20); });
        const qint64 number = bench.journal.begin(bench.goal(5, 9));
        QVERIFY(bench.log.events().empty());
        JournalEntry outcome = bench.goal(5, 9);
        outcome.state = JournalState::Done;
        bench.journal.finish(number, outcome);
        QCOMPARE(bench.log.events().size(), std::size_t(1));
        const LoggedEvent &event = bench.log.events().front();
        QCOMPARE(event.text, QStringLiteral("Profile Velocity: 5 → 9"));
        QVERIFY(event.at <= 80s && event.at > 70s); // when it was begun
        outcome.state = JournalState::Failed;
        bench.journal.finish(bench.journal.begin(bench.goal(9, 7)), outcome);
        QCOMPARE(bench.log.events().size(), std::size_t(1));
        JournalEntry stranger = bench.goal(1, 2);
        stranger.device.id = 77;
        stranger.state = JournalState::Done;
        bench.journal.finish(bench.journal.begin(stranger), stranger);
        QCOMPARE(bench.log.events().size(), std::size_t(1));
    }

    void itIsBounded()
    {
        EventBench bench;
        bench.torque(0, 0s);
        for (std::size_t i = 1; i <= EventLog::Most + 10; ++i)
            bench.torque(i % 2, 1s * static_cast<int>(i));
        QCOMPARE(bench.log.events().size(), EventLog::Most);
        QCOMPARE(bench.log.events().front().at, LineTime(11s));
        bench.line.forget(bench.device.key());
        bench.log.clear();
        QVERIFY(bench.log.events().empty());
    }
};

DYNASCOPE_CORE_TEST(TestEventLog)
#include "tst_eventlog.moc"
