// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/networklinefactory.h"
#include "core/session/reopener.h"
#include "core/session/scanner.h"
#include "core/session/stopcontrol.h"
#include "core/sim/ptyserver.h"
#include "core/sim/servo.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/loopbackserver.h"
#include "tests/support/ser2net.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace std::chrono_literals;
using test::Ser2net;

namespace {

constexpr int Patience = 20'000; ///< ms

class NoPorts final : public PortList
{
public:
    std::vector<PortInfo> ports() const override { return {}; }
};

NetworkOptions patient()
{
    NetworkOptions options;
    options.hostAllowance = 200ms;
    return options;
}

} // namespace

/// A session on lines through ser2net, in front of the simulated bus: lost, found again, and two of them side by side.
class TestSer2net : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        m_server = serve(QStringLiteral("XM430-W350@57600:1,XL430-W250@57600:2,XL330-M288/52@1000000:7"));
        QVERIFY(m_server);
        m_session = std::make_unique<Session>(m_factory, m_catalog);
        m_commands = std::make_unique<Commands>(*m_session);
        m_stop = std::make_unique<StopControl>(*m_session, *m_commands);
        m_scanner = std::make_unique<Scanner>();
        m_reopener = std::make_unique<Reopener>(*m_session, m_ports);
    }
    void cleanup()
    {
        m_reopener.reset();
        m_scanner.reset();
        m_stop.reset();
        m_commands.reset();
        m_session.reset();
        m_server.reset();
    }

    void scansTheServersRateAlone()
    {
        const Ser2net net(m_server->path(), Ser2net::Kind::Raw);
        LineSession &line = openAndScan(net.address());
        QCOMPARE(line.devices().size(), std::size_t(2));
        QCOMPARE(m_trouble, QString());
        QCOMPARE(line.baudRate(), 57600);
    }

    void scansEveryRateThroughRfc2217()
    {
        const Ser2net net(m_server->path(), Ser2net::Kind::Rfc2217);
        LineSession &line = openAndScan(net.address());
        QCOMPARE(line.devices().size(), std::size_t(3));
        QCOMPARE(m_trouble, QString());
    }

    void refusesBeforeAnyWrite()
    {
        const Ser2net net(m_server->path(), Ser2net::Kind::Raw);
        LineSession &line = openAndScan(net.address());
        const auto refusal = [](std::optional<Result<void>> &outcome) {
            return [&outcome](const Result<void> &result) { outcome = result; };
        };
        std::optional<Result<void>> change, move, reset;
        m_commands->changeBaud(*line.devices().front(), 1000000, true, refusal(change));
        m_commands->workAtBaud(line, 1000000, refusal(move));
        m_commands->factoryReset(*line.devices().front(), ResetOption::AllButId, refusal(reset));
        QTRY_VERIFY_WITH_TIMEOUT(change && move && reset, Patience);
        for (const auto &outcome : {change, move, reset}) {
            QVERIFY(!*outcome);
            QCOMPARE(outcome->error().kind, ErrorKind::PortUnsuitable);
            QVERIFY2(outcome->error().text.contains(QStringLiteral("the server's")), qPrintable(outcome->error().text));
        }
        QCOMPARE(truth(u"Baud Rate"), 1);
        QCOMPARE(line.baudRate(), 57600);
    }

    void lostAndFoundAgain_data()
    {
        QTest::addColumn<int>("kind");
        QTest::newRow("tcp") << static_cast<int>(Ser2net::Kind::Raw);
        QTest::newRow("rfc2217") << static_cast<int>(Ser2net::Kind::Rfc2217);
    }
    void lostAndFoundAgain()
    {
        QFETCH(int, kind);
        Ser2net net(m_server->path(), static_cast<Ser2net::Kind>(kind));
        LineSession &line = openAndScan(net.address());
        const std::size_t devices = line.devices().size();
        bool on = false;
        m_commands->setTorque({line.devices().front().get()}, true,
                              [&on](const Result<void> &r) { on = r.has_value(); });
        QTRY_VERIFY_WITH_TIMEOUT(on, Patience);
        m_stop->press();
        QTRY_VERIFY_WITH_TIMEOUT(m_stop->isConfirmed(), Patience);
        QCOMPARE(truth(u"Torque Enable"), 0);
        const QString &why = whenLost(line);
        net.kill();
        QTRY_VERIFY_WITH_TIMEOUT(!why.isEmpty(), Patience);
        QVERIFY2(why.startsWith(QStringLiteral("the connection to ") + net.address()), qPrintable(why));
        m_reopener->look(); // nobody listens: it goes on trying
        QTRY_COMPARE_WITH_TIMEOUT(line.state(), BusThread::State::Closed, Patience);
        net.start();
        QTRY_COMPARE_WITH_TIMEOUT(line.state(), BusThread::State::Open, Patience); // by itself
        QCOMPARE(line.devices().size(), devices);
        QVERIFY(m_stop->isActive());
        QTRY_VERIFY_WITH_TIMEOUT(m_stop->isConfirmed(), Patience);
    }

    void anUnpluggedAdapterBehindTheServer()
    {
        Ser2net net(m_server->path(), Ser2net::Kind::Raw);
        LineSession &line = openAndScan(net.address());
        const QString &why = whenLost(line);
        m_server.reset();
        QTRY_VERIFY_WITH_TIMEOUT(!why.isEmpty(), Patience);
    }

    void oneLostHurtsNoOther()
    {
        Ser2net first(m_server->path(), Ser2net::Kind::Raw);
        const auto otherBus = serve(QStringLiteral("XM430-W350@57600:5"));
        const Ser2net second(otherBus->path(), Ser2net::Kind::Rfc2217);
        LineSession &line = openAndScan(first.address());
        LineSession &other = openAndScan(second.address());
        QCOMPARE(other.devices().size(), std::size_t(1));
        const QString &why = whenLost(line);
        first.kill();
        QTRY_VERIFY_WITH_TIMEOUT(!why.isEmpty(), Patience);
        std::optional<Result<void>> read;
        m_commands->readAll(*other.devices().front(), [&read](const Result<void> &result) { read = result; });
        QTRY_VERIFY_WITH_TIMEOUT(read, Patience);
        QVERIFY2(*read, *read ? "" : qPrintable(read->error().text));
        QCOMPARE(other.state(), BusThread::State::Open);
    }

    void closesWhileConnecting()
    {
        LoopbackServer silent; // takes the connection and never says a word
        LineSession &line = m_session->open(silent.address(QStringLiteral("rfc2217")), 57600);
        QCOMPARE(line.state(), BusThread::State::Opening);
        m_session->close(line); // returns: the test's own time-out would tell
        QVERIFY(m_session->lines().empty());
    }

private:
    /// What will be said once the line is lost. It is tried again at once: whoever looks later may see another state.
    const QString &whenLost(LineSession &line)
    {
        m_whyLost.clear();
        connect(&line, &LineSession::stateChanged, this, [this, &line] {
            if (line.state() == BusThread::State::Lost)
                m_whyLost = line.bus().error().text;
        });
        return m_whyLost;
    }

    std::unique_ptr<sim::PtyServer> serve(const QString &servos)
    {
        auto bus = std::make_unique<sim::SimulatedBus>(m_catalog);
        const auto specs = sim::parseServoSpecs(servos, m_catalog);
        for (const sim::ServoSpec &spec : specs.value()) {
            if (const auto added = bus->add(spec); !added)
                qFatal("%s", qPrintable(added.error().text));
        }
        auto server = sim::PtyServer::start(std::move(bus));
        return server ? std::move(*server) : nullptr;
    }

    LineSession &openAndScan(const QString &name)
    {
        LineSession &line = m_session->open(name, 57600);
        [&] {
            QTRY_COMPARE_WITH_TIMEOUT(line.state(), BusThread::State::Open, Patience);
            bool done = false;
            const auto connection =
                connect(m_scanner.get(), &Scanner::finished, this, [this, &done](int, const QString &trouble) {
                    m_trouble = trouble;
                    done = true;
                });
            m_scanner->start(line, {{57600, 115200, 1000000}, 0, 9});
            QTRY_VERIFY_WITH_TIMEOUT(done, Patience);
            disconnect(connection);
        }();
        return line;
    }

    std::int64_t truth(QStringView field) const
    {
        std::int64_t value = -1;
        m_server->call([&](sim::SimulatedBus &bus, LineTime) { value = bus.servos().front()->value(field); });
        return value;
    }

    QString m_whyLost;
    const Catalog m_catalog = test::builtInCatalog();
    NetworkLineFactory m_factory{patient()};
    NoPorts m_ports;
    std::unique_ptr<sim::PtyServer> m_server;
    std::unique_ptr<Session> m_session;
    std::unique_ptr<Commands> m_commands;
    std::unique_ptr<StopControl> m_stop;
    std::unique_ptr<Scanner> m_scanner;
    std::unique_ptr<Reopener> m_reopener;
    QString m_trouble;
};

DYNASCOPE_CORE_TEST(TestSer2net)
#include "tst_ser2net.moc"
