// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/ptyserver.h"
#include "core/sim/servo.h"
#include "tests/support/dxlprocess.h"
#include "tests/support/testmain.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>

using namespace Qt::StringLiterals;
using namespace dynascope;
using dynascope::test::Outcome;
using Kind = sim::ReplyFault::Kind;

namespace {

/// So many answers of every hundred, on average.
sim::ReplyFault fault(int id, Kind kind, double share)
{
    sim::ReplyFault one;
    one.id = id;
    one.kind = kind;
    one.share = share;
    one.times = -1;
    one.amount = kind == Kind::Cut ? 9 : 0;
    one.damage.part = sim::PacketPart::Crc;
    one.atAdapter = true;
    return one;
}

QJsonObject object(const Outcome &outcome)
{
    return QJsonDocument::fromJson(outcome.out.toUtf8()).object();
}

QJsonObject device(const QJsonObject &report, int id)
{
    for (const QJsonValue &one : report[u"devices"].toArray()) {
        if (one[u"id"].toInt() == id)
            return one.toObject();
    }
    return {};
}

/// Every bad answer is of one kind.
int faultsOf(const QJsonObject &counts)
{
    int sum = 0;
    for (const QLatin1String kind : {"timeouts"_L1, "cut_off"_L1, "crc"_L1, "length"_L1, "late"_L1})
        sum += counts[kind].toInt(-1000);
    return sum;
}

} // namespace

/// `dxl stats` against a simulated bus with faults, over a pseudo-terminal.
class TestDxlStats : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        auto catalog = Catalog::builtIn();
        QVERIFY2(catalog, catalog ? "" : qPrintable(catalog.error().text));
        m_catalog = std::make_unique<Catalog>(std::move(*catalog));
    }

    void init()
    {
        auto bus = std::make_unique<sim::SimulatedBus>(*m_catalog);
        for (const int id : {1, 2, 3})
            QVERIFY(bus->add({u"XM430-W350"_s, -1, 1'000'000, id}));
        auto server = sim::PtyServer::start(std::move(bus));
        QVERIFY2(server, server ? "" : qPrintable(server.error().text));
        m_server = std::move(*server);
    }
    void cleanup() { m_server.reset(); }

    void reportsInJson()
    {
        setFaults({fault(2, Kind::Damaged, 0.2), fault(3, Kind::Cut, 0.05)});
        const Outcome outcome = stats({u"--seconds"_s, u"1"_s, u"--json"_s});
        QCOMPARE(outcome.code, 0);
        QCOMPARE(outcome.err, QString());
        const QJsonObject report = object(outcome);
        QCOMPARE(report[u"port"].toString(), m_server->path());
        QCOMPARE(report[u"baud"].toInt(), 1'000'000);
        QVERIFY(report[u"seconds"].toDouble() >= 1);
        QVERIFY(report[u"cycles"].toInt() > 10);
        QCOMPARE(report[u"devices"].toArray().size(), 3);
        int good = 0;
        for (const int id : {1, 2, 3}) {
            const QJsonObject one = device(report, id);
            QCOMPARE(one[u"model"].toString(), u"XM430-W350"_s);
            QCOMPARE(one[u"watched"].toArray(), QJsonArray{u"Present Position"_s});
            QCOMPARE(faultsOf(one), one[u"bad"].toInt());
            QVERIFY(one[u"p99_ms"].toDouble() >= one[u"p50_ms"].toDouble() && one[u"p50_ms"].toDouble() > 0);
            QVERIFY(one[u"bytes_per_second"].toDouble() > 0);
            good += one[u"good"].toInt();
        }
        const QJsonObject line = report[u"line"].toObject();
        QCOMPARE(line[u"good"].toInt(), good);
        QVERIFY(line[u"load"].toDouble() > 0.01 && line[u"load"].toDouble() <= 1.01);
        QVERIFY(device(report, 2)[u"crc"].toInt() > 0);
        QVERIFY(!device(report, 2)[u"first_error"].toString().isEmpty());
        QVERIFY(device(report, 3)[u"cut_off"].toInt() > 0);
        const auto share = [&](int id) { return device(report, id)[u"bad_share"].toDouble(); };
        QVERIFY(share(2) > share(3) && share(2) > share(1));
    }

    void theWorstStandsOnTopOfTheTable()
    {
        setFaults({fault(3, Kind::Damaged, 0.3)});
        const Outcome outcome = stats({u"--seconds"_s, u"0.5"_s});
        QCOMPARE(outcome.code, 0);
        const QStringList lines = outcome.out.split(u'\n', Qt::SkipEmptyParts);
        QVERIFY2(lines.size() >= 7, qPrintable(outcome.out)); // title, headings, three devices, the line, a cause
        QVERIFY(lines[0].startsWith(m_server->path() + u" at 1000000 bps, 0.5 s: "_s));
        QCOMPARE(lines[1].simplified(),
            u"ID Model Good Bad % Timeouts Cut off CRC Length Late Retries p50 ms p99 ms Bytes/s"_s);
        QVERIFY2(lines[2].simplified().startsWith(u"3 XM430-W350 "), qPrintable(outcome.out));
        QVERIFY2(lines[2].contains(u" !! "), qPrintable(outcome.out));
        QVERIFY(lines[5].startsWith(u"line "));
        QCOMPARE(lines[1].size(), lines[2].size()); // columns stand under each other
        QCOMPARE(lines[2].size(), lines[5].size());
        const QString causes = lines.mid(6).join(u'\n');
        QVERIFY2(causes.contains(u"CRC: ") && causes.contains(u"noise"), qPrintable(outcome.out));
    }

    void readsWhatIsAskedFor()
    {
        const Outcome outcome =
            stats({u"--seconds"_s, u"0.2"_s, u"--json"_s, u"--watch"_s, u"present_velocity"_s, u"146:1"_s});
        QCOMPARE(outcome.code, 0);
        QCOMPARE(device(object(outcome), 1)[u"watched"].toArray(), (QJsonArray{u"Present Velocity"_s, u"146:1"_s}));

        const Outcome unknown = stats({u"--watch"_s, u"torqe_enable"_s});
        QCOMPARE(unknown.code, 2);
        QCOMPARE(unknown.out, QString());
        QCOMPARE(unknown.err, u"dxl: none of the devices has a field \"torqe_enable\"\n"_s);
    }

    void whoNeverAnswersIsAFailure()
    {
        const Outcome outcome = stats({u"--seconds"_s, u"0.5"_s, u"--json"_s, u"--ids"_s, u"9,1-2"_s});
        QCOMPARE(outcome.code, 1);
        QCOMPARE(outcome.err, u"dxl: ID 9 never answered at 1000000 bps; devices 1, 2 on this line answer\n"_s);
        const QJsonObject report = object(outcome);
        QCOMPARE(report[u"devices"].toArray().size(), 3); // 3 was not asked for
        QCOMPARE(device(report, 9)[u"good"].toInt(), 0);
        QVERIFY(device(report, 9)[u"timeouts"].toInt() > 0);
        QVERIFY(device(report, 1)[u"good"].toInt() > 0);

        const Outcome nobody = test::dxl({u"--port"_s, m_server->path(), u"stats"_s});
        QCOMPARE(nobody.code, 1);
        QVERIFY(nobody.err.contains(u"nobody answered at 57600 bps"));
    }

    void refusesNonsense_data()
    {
        QTest::addColumn<QStringList>("arguments");
        QTest::newRow("no time") << QStringList{u"--seconds"_s, u"0"_s};
        QTest::newRow("IDs") << QStringList{u"--ids"_s, u"1,253"_s};
        QTest::newRow("order of IDs") << QStringList{u"--ids"_s, u"7-1"_s};
        QTest::newRow("register") << QStringList{u"--watch"_s, u"132:0"_s};
    }

    void refusesNonsense()
    {
        QFETCH(QStringList, arguments);
        const Outcome outcome = stats(arguments);
        QCOMPARE(outcome.code, 2);
        QCOMPARE(outcome.out, QString());
    }

    void anInterruptEndsItWithTheReport()
    {
        test::RunningDxl running({u"--port"_s, m_server->path(), u"--baud"_s, u"1000000"_s, u"--json"_s, u"stats"_s,
            u"--seconds"_s, u"600"_s, u"--ids"_s, u"1-3"_s});
        // It is polling: more was said than who is there.
        QTRY_VERIFY(answers() > 100);
        const Outcome outcome = running.interrupt();
        QCOMPARE(outcome.code, 0);
        QVERIFY(device(object(outcome), 1)[u"good"].toInt() > 10);
    }

    void aLostPortIsAFailureWithTheReport()
    {
        test::RunningDxl running({u"--port"_s, m_server->path(), u"--baud"_s, u"1000000"_s, u"--json"_s, u"stats"_s,
            u"--seconds"_s, u"600"_s, u"--ids"_s, u"1-3"_s});
        QTRY_VERIFY(answers() > 100);
        m_server.reset();
        const Outcome outcome = running.finish();
        QCOMPARE(outcome.code, 1);
        QVERIFY2(outcome.err.contains(u"is gone"), qPrintable(outcome.err));
        QVERIFY(device(object(outcome), 1)[u"good"].toInt() > 10);
    }

private:
    void setFaults(std::vector<sim::ReplyFault> replies)
    {
        sim::LineFaults faults;
        faults.replies = std::move(replies);
        m_server->call([&](sim::SimulatedBus &bus, LineTime) { bus.setFaults(faults); });
    }

    Outcome stats(const QStringList &arguments) const
    {
        return test::dxl(QStringList{u"--port"_s, m_server->path(), u"--baud"_s, u"1000000"_s, u"stats"_s} + arguments);
    }

    /// How often a servo has spoken.
    qsizetype answers()
    {
        qsizetype count = 0;
        m_server->call([&](sim::SimulatedBus &bus, LineTime) {
            bus.setLogging(true);
            count = std::ranges::count(bus.log(), false, &sim::WireEntry::fromController);
        });
        return count;
    }

    std::unique_ptr<Catalog> m_catalog;
    std::unique_ptr<sim::PtyServer> m_server;
};

DYNASCOPE_CORE_TEST(TestDxlStats)
#include "tst_dxlstats.moc"
