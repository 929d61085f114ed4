// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/ptyserver.h"
#include "core/table/catalog.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/ptyclient.h"
#include "tests/support/simclient.h"
#include "tests/support/testmain.h"

#include <QFile>

using namespace dynascope;
using namespace dynascope::sim;
using namespace simclient;

/// The faults of a simulated line reach a program behind the pseudo-terminal.
class TestLineFaultsPty : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        auto bus = std::make_unique<SimulatedBus>(m_catalog);
        QVERIFY(bus->add({QStringLiteral("XM430-W350"), -1, 57600, 1}));
        m_link = m_folder.filePath(QStringLiteral("dxl"));
        auto started = PtyServer::start(std::move(bus), m_link);
        QVERIFY(started);
        m_server = std::move(*started);
    }

    void switchedWhileItRuns()
    {
        PtyClient client(m_link, 57600);
        set({.echo = {.on = true}, .latencyTimer = 16ms});
        client.write(m_ping);
        Bytes both = m_ping;
        both.insert(both.end(), m_answer.begin(), m_answer.end());
        QCOMPARE(hex(client.readAtLeast(both.size(), 5000)), hex(both));
        set({.replies = {{.kind = ReplyFault::Kind::Cut, .amount = 5}}});
        client.write(m_ping);
        QCOMPARE(client.readAtLeast(5, 5000).size(), std::size_t(5));
        client.write(m_ping);
        QCOMPARE(hex(client.readAtLeast(m_answer.size(), 5000)), hex(m_answer));
    }

    void unpluggedAndPlugged()
    {
        PtyClient client(m_link, 57600);
        set({.unplugAtAnswered = 5});
        client.write(m_ping);
        (void)client.readAtLeast(m_answer.size(), 5000); // what was handed on may be lost with the terminal
        QVERIFY(client.seesTheEnd(5000));
        QVERIFY(!QFile::exists(m_link));
        QTRY_VERIFY(isQuiet()); // the servo goes on answering, and a Ping would collide with that
        set({});
        QTRY_VERIFY(QFile::exists(m_link));
        PtyClient next(m_link, 57600);
        next.write(m_ping);
        QCOMPARE(hex(next.readAtLeast(m_answer.size(), 5000)), hex(m_answer));
    }

private:
    void set(const LineFaults &faults)
    {
        m_server->call([&](SimulatedBus &bus, LineTime) { bus.setFaults(faults); });
    }

    bool isQuiet()
    {
        bool quiet = false;
        m_server->call([&](SimulatedBus &bus, LineTime) { quiet = !bus.quietAt(); });
        return quiet;
    }

    const Bytes m_ping = instruction(QStringLiteral("01 01"));
    const Bytes m_answer = status(QStringLiteral("01 00 FC 03 2D"));
    QTemporaryDir m_folder;
    QString m_link;
    const Catalog m_catalog = test::builtInCatalog();
    std::unique_ptr<PtyServer> m_server;
};

DYNASCOPE_CORE_TEST(TestLineFaultsPty)
#include "tst_linefaults_pty.moc"
