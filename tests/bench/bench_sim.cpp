// SPDX-License-Identifier: GPL-3.0-or-later
// How true to time a served bus is: pacing error of replies, servos x baud rate at which real time holds, CPU time at rest
// and at full poll. The client is a raw one that only reads and writes.
#include "core/sim/ptyserver.h"
#include "core/sim/servo.h"
#include "core/protocol/requests.h"
#include "core/table/catalog.h"

#include <QFile>

#include <asm/termbits.h>
#include <array>
#include <cstdio>
#include <ctime>
#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

using namespace dynascope;
using namespace dynascope::sim;
using namespace std::chrono_literals;

namespace {

double cpuSeconds()
{
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

double wallSeconds()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::unique_ptr<PtyServer> serve(const Catalog &catalog, int servos, int baud)
{
    auto bus = std::make_unique<SimulatedBus>(catalog);
    for (int id = 1; id <= servos; ++id) {
        const auto servo = bus->add({QStringLiteral("XM430-W350"), -1, baud, id});
        if (!servo)
            qFatal("%s", qPrintable(servo.error().text));
        (*servo)->write(u"Return Delay Time", 0);
        (*servo)->write(u"Torque Enable", 1);
    }
    auto server = PtyServer::start(std::move(bus));
    if (!server)
        qFatal("%s", qPrintable(server.error().text));
    return std::move(*server);
}

int openClient(const QString &path, int baud)
{
    const int client = ::open(QFile::encodeName(path).constData(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    termios2 settings{};
    ioctl(client, TCGETS2, &settings);
    settings.c_iflag = settings.c_oflag = settings.c_lflag = 0;
    settings.c_cflag = CS8 | CREAD | CLOCAL | BOTHER;
    settings.c_ispeed = settings.c_ospeed = static_cast<unsigned>(baud);
    ioctl(client, TCSETS2, &settings);
    return client;
}

/// One exchange; false where the answer isn't whole within a second.
bool exchange(int client, const Bytes &request, std::size_t answer)
{
    if (::write(client, request.data(), request.size()) != static_cast<ssize_t>(request.size()))
        return false;
    std::array<std::uint8_t, 4096> chunk{};
    while (answer > 0) {
        pollfd waited{client, POLLIN, 0};
        if (poll(&waited, 1, 1000) <= 0)
            return false;
        const ssize_t count = ::read(client, chunk.data(), chunk.size());
        if (count <= 0)
            return false;
        answer -= std::min(answer, static_cast<std::size_t>(count));
    }
    return true;
}

struct Kind {
    const char *name;
    bool fast;
};

void poll(const Catalog &catalog, const Kind &kind, int servos, int baud, double seconds)
{
    constexpr std::uint16_t from = 126, length = 10; // Present Current to Present Position
    const auto server = serve(catalog, servos, baud);
    const int client = openClient(server->path(), baud);
    std::vector<std::uint8_t> ids;
    for (int id = 1; id <= servos; ++id)
        ids.push_back(static_cast<std::uint8_t>(id));
    const Bytes request = encode(syncReadRequest(from, length, ids, kind.fast).packet);
    // What the wire takes: request, and in turn processing and reply.
    const auto count = static_cast<double>(servos);
    const std::size_t answer = kind.fast ? 8 + static_cast<std::size_t>(servos) * (length + 4)
                                         : static_cast<std::size_t>(servos) * (length + 11);
    const double wire = (static_cast<double>(request.size() + answer) * 10.0) / baud + (kind.fast ? 1 : count) * 100e-6;
    const double begin = wallSeconds(), cpu = cpuSeconds();
    int cycles = 0, failed = 0;
    while (wallSeconds() - begin < seconds) {
        failed += exchange(client, request, answer) ? 0 : 1;
        ++cycles;
    }
    const double wall = wallSeconds() - begin, used = cpuSeconds() - cpu;
    Pacing::Report report;
    server->call([&](SimulatedBus &, LineTime) { report = server->state().pacing; });
    ::close(client);
    const auto micro = [](LineTime time) { return std::chrono::duration<double, std::micro>(time).count(); };
    std::printf("%-5s %3d servos %8d bps: %6.0f cycles/s, %.2f of the wire's, late %lld of %lld, error p50 %4.0f us, "
                "p99 %5.0f us, worst %6.0f us, CPU %3.0f %% (client and server), failed %d, %s\n",
                kind.name, servos, baud, cycles / wall, cycles * wire / wall, static_cast<long long>(report.late),
                static_cast<long long>(report.replies), micro(report.median), micro(report.percentile99),
                micro(report.worst), 100 * used / wall, failed, report.keepsUp ? "keeps real time" : "BEHIND");
    std::fflush(stdout);
}

void rest(const Catalog &catalog, int servos, bool opened)
{
    const auto server = serve(catalog, servos, 1000000);
    const int client = opened ? openClient(server->path(), 1000000) : -1;
    const double begin = wallSeconds(), cpu = cpuSeconds();
    timespec ten{10, 0};
    nanosleep(&ten, nullptr);
    std::printf("%d idle servos under torque, %s: %.2f %% of a core\n", servos, opened ? "a client open" : "no client",
                100 * (cpuSeconds() - cpu) / (wallSeconds() - begin));
    std::fflush(stdout);
    if (client >= 0)
        ::close(client);
}

} // namespace

int main()
{
    const Catalog catalog = Catalog::builtIn().value();
    rest(catalog, 6, false);
    rest(catalog, 6, true);
    for (const int baud : {57600, 1000000, 4000000}) {
        for (const int servos : {1, 6, 20, 40})
            poll(catalog, {"sync", false}, servos, baud, 3);
    }
    for (const int servos : {1, 20, 40})
        poll(catalog, {"fast", true}, servos, 4000000, 3);
    return 0;
}
