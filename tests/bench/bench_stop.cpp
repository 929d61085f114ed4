// SPDX-License-Identifier: GPL-3.0-or-later
// STOP: from the press to the first torque-off packet on the wire, by the wire's own log, while the bus is busy in
// three ways. The design allows 5 ms plus the rest of the packet in flight, p99.
#include "core/bus/seriallinefactory.h"
#include "core/session/monitor.h"
#include "core/session/scanner.h"
#include "core/session/stopcontrol.h"
#include "core/sim/ptyserver.h"
#include "core/sim/servo.h"

#include <QCoreApplication>
#include <QElapsedTimer>
#include <QTimer>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <utility>

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

constexpr int Presses = 100;
constexpr int Servos = 6;

LineTime monotonicNow()
{
    return std::chrono::steady_clock::now().time_since_epoch();
}

/// Begin and end of the first torque-off Sync Write after `press`, and how long a packet was still in flight at the
/// press.
struct Seen {
    LineTime afterPress{}, inFlight{};
    bool found = false;
};

Seen firstTorqueOff(sim::PtyServer &server, LineTime press)
{
    Seen seen;
    server.call([&](sim::SimulatedBus &bus, LineTime) {
        for (const sim::WireEntry &entry : bus.log()) {
            if (entry.begin <= press && entry.end > press)
                seen.inFlight = std::max(seen.inFlight, entry.end - press);
            const bool isSyncWrite = entry.fromController && entry.bytes.size() > 9 && entry.bytes[7] == 0x83;
            if (isSyncWrite && entry.begin >= press && !seen.found) {
                seen.afterPress = entry.begin - press;
                seen.found = true;
            }
        }
        bus.clearLog();
    });
    return seen;
}

/// Drives one scenario: press at a pseudo-random moment, wait for the outcome, release, again.
class Driver : public QObject
{
public:
    Driver(sim::PtyServer &server, Session &session, StopControl &stop, std::function<void()> makeBusy)
        : m_server(server)
        , m_session(session)
        , m_stop(stop)
        , m_makeBusy(std::move(makeBusy))
    {
        connect(&m_stop, &StopControl::changed, this, [this] {
            if (!m_stop.isActive() || m_stop.isVerifying() || m_isEnding)
                return;
            if (!m_stop.isConfirmed() && !m_patience.isActive()) { // whose place changed just then is looked for
                m_isLater = true;
                m_patience.start(2000);
            }
            if (m_stop.isConfirmed())
                end();
        });
        m_patience.setSingleShot(true);
        connect(&m_patience, &QTimer::timeout, this, &Driver::end);
        begin();
    }

    int later = 0, unconfirmed = 0;
    std::vector<double> excess; ///< ms from press to packet, less the rest of the packet in flight

private:
    void begin()
    {
        m_makeBusy();
        m_random = m_random * 1103515245U + 12345U;
        QTimer::singleShot(20 + static_cast<int>(m_random >> 16) % 40, this, [this] {
            m_press = monotonicNow();
            m_stop.press();
        });
    }

    void end()
    {
        m_isEnding = true;
        m_patience.stop();
        QTimer::singleShot(0, this, &Driver::finished);
    }

    void finished()
    {
        m_isEnding = false;
        unconfirmed += m_stop.isConfirmed() ? 0 : 1;
        later += std::exchange(m_isLater, false) && m_stop.isConfirmed() ? 1 : 0;
        const Seen seen = firstTorqueOff(m_server, m_press);
        if (seen.found)
            excess.push_back(std::chrono::duration<double, std::milli>(seen.afterPress - seen.inFlight).count());
        m_stop.release();
        if (++m_rounds >= Presses)
            QCoreApplication::quit();
        else
            begin();
    }

    sim::PtyServer &m_server;
    Session &m_session;
    StopControl &m_stop;
    std::function<void()> m_makeBusy;
    LineTime m_press{};
    std::uint32_t m_random = 7;
    int m_rounds = 0;
    bool m_isEnding = false, m_isLater = false;
    QTimer m_patience;
};

void report(const char *what, Driver &driver)
{
    std::vector<double> &excess = driver.excess;
    std::ranges::sort(excess);
    if (excess.empty()) {
        std::printf("STOP %s: no torque-off packet seen\n", what);
        return;
    }
    const auto at = [&](double part) {
        return excess[static_cast<std::size_t>(part * static_cast<double>(excess.size() - 1))];
    };
    std::printf("STOP %-26s %3zu presses: p50 %.2f ms, p99 %.2f ms, max %.2f ms (beyond the packet in flight); %d "
                "confirmed only after another look, %d not at all\n",
                what, excess.size(), at(0.5), at(0.99), excess.back(), driver.later, driver.unconfirmed);
}

} // namespace

int main(int argc, char **argv)
{
    QCoreApplication application(argc, argv);
    const auto catalog = Catalog::builtIn();
    if (!catalog)
        qFatal("%s", qPrintable(catalog.error().text));
    auto bus = std::make_unique<sim::SimulatedBus>(*catalog);
    for (int id = 1; id <= Servos; ++id) {
        const auto specs = sim::parseServoSpecs(QStringLiteral("XM430-W350@1000000:%1").arg(id), *catalog);
        if (!specs || !bus->add(specs->front()))
            qFatal("no servo");
    }
    bus->setLogging(true);
    auto server = sim::PtyServer::start(std::move(bus));
    if (!server)
        qFatal("%s", qPrintable(server.error().text));

    SerialLineFactory factory;
    Session session(factory, *catalog);
    Commands commands(session);
    Monitor monitor(session);
    StopControl stop(session, commands);
    Scanner scanner;
    LineSession &line = session.open((*server)->path(), 1000000);
    QObject::connect(&scanner, &Scanner::finished, &application, &QCoreApplication::quit);
    scanner.start(line, {{1000000}, 0, Servos});
    QCoreApplication::exec();
    QObject::disconnect(&scanner, nullptr, &application, nullptr);

    for (const Device *device : session.devices())
        monitor.watch({device->key(), device->table().indexOf(u"Present Position")});
    {
        Driver driver(**server, session, stop, [] {});
        QCoreApplication::exec();
        report("under full polling", driver);
    }
    {
        Driver driver(**server, session, stop, [&] { scanner.start(line, {{1000000, 57600, 115200}, 0, 252}); });
        QCoreApplication::exec();
        report("during a scan", driver);
    }
    {
        const int there = 1000000;
        Driver driver(**server, session, stop, [&] {
            Device *device = session.devices().front();
            commands.changeBaud(*device, device->baudRate() == there ? 2000000 : there, true);
        });
        QCoreApplication::exec();
        report("during a change of baud", driver);
    }
}
