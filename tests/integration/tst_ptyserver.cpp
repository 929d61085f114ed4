// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/ptyserver.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/ptyclient.h"
#include "tests/support/simclient.h"
#include "tests/support/testmain.h"

#include <QFile>
#include <QTemporaryDir>

using namespace dynascope;
using namespace dynascope::sim;
using namespace simclient;

/// A raw client on the simulator's terminal, without any code of ours between.
class TestPtyServer : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        m_ping = instruction(QStringLiteral("01 01"));
        m_answer = status(QStringLiteral("01 00 FC 03 2D"));
    }

    void init()
    {
        auto started = PtyServer::start(makeBus());
        QVERIFY2(started, qPrintable(started ? QString() : started.error().text));
        m_server = std::move(*started);
    }

    void cleanup() { m_server.reset(); }

    void answersAtTheClientsRate_data()
    {
        QTest::addColumn<int>("baud");
        QTest::addColumn<bool>("answered");
        QTest::newRow("its own") << 57600 << true;
        QTest::newRow("another") << 115200 << false;
        QTest::newRow("an odd one near its own") << 57000 << true;
        QTest::newRow("10.5 M") << 10500000 << false;
    }

    void answersAtTheClientsRate()
    {
        QFETCH(int, baud);
        QFETCH(bool, answered);
        PtyClient client(m_server->path(), baud);
        QVERIFY(client.isOpen());
        client.write(m_ping);
        QCOMPARE(hex(client.readAtLeast(answered ? m_answer.size() : 1, answered ? 5000 : 50)),
                 answered ? hex(m_answer) : QString());
    }

    void piecesOfAPacketAreOnePacket()
    {
        PtyClient client(m_server->path(), 57600);
        for (const std::uint8_t byte : m_ping)
            client.write({byte});
        QCOMPARE(hex(client.readAtLeast(m_answer.size(), 5000)), hex(m_answer));
    }

    void isPacedByTheWire()
    {
        PtyClient client(m_server->path(), 57600);
        m_server->call([](SimulatedBus &bus, LineTime) { bus.setLogging(true); });
        client.write(m_ping);
        client.readAtLeast(m_answer.size(), 5000);
        std::vector<WireEntry> log;
        LineTime now{};
        m_server->call([&](SimulatedBus &bus, LineTime at) {
            log = bus.log();
            now = at;
        });
        QCOMPARE(log.size(), std::size_t(2));
        const LineTime byte(10'000'000'000LL / 57600);
        QCOMPARE(log[1].end - log[0].begin, static_cast<int>(m_ping.size() + m_answer.size()) * byte + 600us);
        QVERIFY(now >= log[1].end); // the answer did not come before its time
    }

    void servesTheNextClientAfterOneThatWasKilled()
    {
        for (int i = 0; i < 3; ++i) {
            PtyClient client(m_server->path(), 57600);
            QVERIFY(client.isOpen());
            client.makeExclusive(); // and never gives it back, as one that is killed
            client.write(m_ping);
            QCOMPARE(hex(client.readAtLeast(m_answer.size(), 5000)), hex(m_answer));
            client.close();
            QTRY_VERIFY(!PtyClient::isExclusive(m_server->path()));
        }
    }

    void lastWordsAreObeyed()
    {
        m_server->call([](SimulatedBus &bus, LineTime) { bus.setLogging(true); });
        {
            PtyClient client(m_server->path(), 57600);
            client.write(instruction(QStringLiteral("01 03 41 00 01")));
        }
        // Who speaks into an answer isn't heard, as on any wire: the one that nobody reads has to be over, too.
        const auto isDone = [this] {
            bool done = false;
            m_server->call([&](SimulatedBus &bus, LineTime now) {
                done = bus.servos()[0]->value(u"LED") == 1 && bus.log().size() == 2 && bus.log().back().end <= now;
            });
            return done;
        };
        QTRY_VERIFY(isDone());
        PtyClient next(m_server->path(), 57600); // hears nothing of the answer that nobody read
        next.write(instruction(QStringLiteral("01 02 41 00 01 00")));
        const Bytes expected = status(QStringLiteral("01 00 01"));
        QCOMPARE(hex(next.readAtLeast(expected.size(), 5000)), hex(expected));
    }

    void theEndIsSeen()
    {
        PtyClient client(m_server->path(), 57600);
        m_server.reset();
        QVERIFY(client.seesTheEnd(5000));
    }

    void link()
    {
        QTemporaryDir folder;
        const QString link = folder.filePath(QStringLiteral("dxl"));
        QVERIFY(QFile::link(QStringLiteral("/dev/pts/99999"), link)); // left behind by a simulator that was killed
        {
            auto server = PtyServer::start(makeBus(), link);
            QVERIFY(server);
            QCOMPARE(QFile::symLinkTarget(link), (*server)->path());
        }
        QVERIFY(!QFile::symLinkTarget(link).startsWith(QStringLiteral("/dev")));
        QFile file(link);
        QVERIFY(file.open(QIODevice::WriteOnly));
        file.close();
        auto refused = PtyServer::start(makeBus(), link);
        QVERIFY(!refused);
        QVERIFY2(refused.error().text.contains(link), qPrintable(refused.error().text));
        QVERIFY(QFile::exists(link));
        const QString foreign = folder.filePath(QStringLiteral("foreign"));
        QVERIFY(QFile::link(QStringLiteral("/nowhere"), foreign));
        QVERIFY(!PtyServer::start(makeBus(), foreign));
        QCOMPARE(QFile::symLinkTarget(foreign), QStringLiteral("/nowhere"));
    }

    void ticks()
    {
        std::atomic<int> count = 0;
        auto server = PtyServer::start(makeBus(), {}, [&](SimulatedBus &, LineTime) { ++count; });
        QVERIFY(server);
        QTRY_VERIFY(count > 3);
    }

private:
    std::unique_ptr<SimulatedBus> makeBus()
    {
        auto bus = std::make_unique<SimulatedBus>(m_catalog);
        if (!bus->add({QStringLiteral("XM430-W350"), -1, 57600, 1}))
            bus.reset();
        return bus;
    }

    const Catalog m_catalog = test::builtInCatalog();
    Bytes m_ping, m_answer;
    std::unique_ptr<PtyServer> m_server;
};

DYNASCOPE_CORE_TEST(TestPtyServer)
#include "tst_ptyserver.moc"
