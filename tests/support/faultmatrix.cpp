// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/faultmatrix.h"

#include <QMap>
#include <QStringList>
#include <QTest>

#include <algorithm>

namespace faultmatrix {
namespace {

constexpr int BaudRate = 1'000'000;
constexpr LineTime ByteTime = 10us;

/// What `id` answers to a reading request when nothing is wrong.
Bytes truth(World &world, Kind kind, int id)
{
    if (kind == Kind::Ping || kind == Kind::BroadcastPing) {
        Bytes bytes = dataOf(1020, 2); // XM430-W350
        bytes.push_back(static_cast<std::uint8_t>(world.servo(id).firmware()));
        return bytes;
    }
    const bool isBulk = kind == Kind::BulkRead || kind == Kind::FastBulkRead;
    if (isBulk && id == 2)
        return dataOf(world.servo(id).value(u"Profile Acceleration"), 4);
    if (isBulk && id == 3)
        return dataOf(world.servo(id).value(u"Goal PWM"), 2);
    if (isGroupRead(kind) || kind == Kind::Read)
        return dataOf(world.servo(id).value(u"Profile Velocity"), 4);
    return {};
}

QString errorName(ErrorKind kind)
{
    static const QMap<ErrorKind, QString> names{{ErrorKind::NothingReceived, QStringLiteral("NothingReceived")},
                                                {ErrorKind::NoHeader, QStringLiteral("NoHeader")},
                                                {ErrorKind::CutOff, QStringLiteral("CutOff")},
                                                {ErrorKind::DamagedCrc, QStringLiteral("DamagedCrc")},
                                                {ErrorKind::WrongId, QStringLiteral("WrongId")},
                                                {ErrorKind::WrongLength, QStringLiteral("WrongLength")},
                                                {ErrorKind::Refused, QStringLiteral("Refused")},
                                                {ErrorKind::PortLost, QStringLiteral("PortLost")}};
    return names.value(kind, QStringLiteral("Error%1").arg(static_cast<int>(kind)));
}

QString wordFor(World &world, Kind kind, int id, const Result<Reply> &reply)
{
    if (!reply)
        return errorName(reply.error().kind);
    if (reply->data != truth(world, kind, id))
        return QStringLiteral("LIE");
    const bool isDone = kind != Kind::Write || world.servo(id).value(u"Profile Velocity") == WrittenValue;
    return isDone ? QStringLiteral("=") : QStringLiteral("NOT-DONE");
}

QStringList foundWords(World &world, const ExchangeResult &result)
{
    QStringList words{QStringLiteral("-"), QStringLiteral("-"), QStringLiteral("-")};
    for (const Result<Reply> &reply : result.replies) {
        if (reply && reply->id >= 1 && reply->id <= 3)
            words[reply->id - 1] = wordFor(world, Kind::BroadcastPing, reply->id, reply);
        else
            words << QStringLiteral("+%1").arg(reply ? reply->id : -1);
    }
    return words;
}

LineTime processing(Kind kind) ///< reference "Time": Clear up to seconds, EEPROM tens of milliseconds
{
    switch (kind) {
    case Kind::Write:
    case Kind::RegWrite:
    case Kind::Action: return 50ms;
    case Kind::FactoryReset:
    case Kind::Reboot: return 300ms;
    case Kind::Clear:
    case Kind::Backup: return 3s;
    default: return 100us;
    }
}

/// Reference "Time": by then one sending of it has ended, whatever came.
LineTime longestAttempt(Kind kind, int target, LineTime allowance)
{
    constexpr LineTime Stall = 1500us;
    const LineTime device = 508us + processing(kind) + allowance + Stall + allowance;
    const int devices = isGroupRead(kind) || kind == Kind::BroadcastPing ? 3 : 1;
    const auto bytes = static_cast<int>(requestSize(kind, target) + 2 * allRepliesSize(kind, target)) + 80;
    const LineTime turns = kind == Kind::BroadcastPing ? 253 * 3ms : 0ms;
    return bytes * ByteTime + devices * device + turns;
}

/// Before each further sending the line may be quieted and a Ping may have to prove that nothing is on its way.
LineTime longest(Kind kind, int target, LineTime allowance, int retries)
{
    constexpr LineTime Quieting = 50ms;
    const LineTime again = 2 * Quieting + longestAttempt(Kind::Ping, target, allowance);
    return longestAttempt(kind, target, allowance) + retries * (again + longestAttempt(kind, target, allowance));
}

int sentPackets(const World &world, Instruction instruction)
{
    return static_cast<int>(std::ranges::count_if(world.simulated.log(), [&](const sim::WireEntry &entry) {
        return entry.fromController && entry.bytes.size() > 7
               && entry.bytes[7] == static_cast<std::uint8_t>(instruction);
    }));
}

const Cell *cellFor(const Case &oneCase, Kind kind)
{
    const Cell *found = nullptr;
    for (const Cell &cell : oneCase.cells) {
        if (std::ranges::count(kindsOf(cell.requests), kind) == 0)
            continue;
        if (found)
            qFatal("%s: two cells for %s", qPrintable(oneCase.name), qPrintable(nameOf(kind)));
        found = &cell;
    }
    if (!found && !oneCase.partial)
        qFatal("%s: no cell for %s", qPrintable(oneCase.name), qPrintable(nameOf(kind)));
    return found;
}

/// On a sound line nothing is left of what went before.
void verifyRecovery(World &world, const Case &oneCase, Kind kind)
{
    const bool mayBoot = kind == Kind::FactoryReset || kind == Kind::Reboot
                         || std::ranges::count(oneCase.faults.replies, Fault::Reboot, &sim::ReplyFault::kind) > 0;
    world.line->advance(oneCase.settle + (mayBoot ? 1s : 0s));
    world.simulated.advanceTo(world.line->now());
    world.simulated.setFaults({});
    if (oneCase.faults.unplugAtSent || oneCase.faults.unplugAtAnswered)
        world.connect();
    if (world.simulated.servos().size() > 3) // one that should not be there
        world.simulated.servos()[3]->setPlugged(false);
    for (int id = 1; id <= 3; ++id) {
        (void)world.servo(id).write(u"Status Return Level", 2);
        world.setTraits(id, 2);
    }
    world.setValues(2);
    for (const Kind clean : {Kind::Read, Kind::SyncRead}) {
        const Result<ExchangeResult> result = world.bus->exchange(requestOf(clean, oneCase.target), 0);
        QVERIFY2(result, result ? "" : qPrintable(result.error().text));
        for (const Result<Reply> &reply : result->replies) {
            const int id = reply ? reply->id : 0;
            const QString word = reply ? wordFor(world, clean, id, reply) : reply.error().text;
            QVERIFY2(word == u'=', qPrintable(QStringLiteral("afterwards, %1: %2").arg(nameOf(clean), word)));
        }
    }
}

} // namespace

std::vector<Cell> commandsSeeing(const char *outcome)
{
    return {{"commands", 0, outcome}};
}

World::World(const Catalog &catalog, LineTime hostAllowance) : simulated(catalog), allowance(hostAllowance)
{
    for (int id = 1; id <= 3; ++id) {
        if (!simulated.add({QStringLiteral("XM430-W350"), -1, BaudRate, id}))
            qFatal("no servo");
        setTraits(id, 2);
    }
    setValues(1);
    connect();
    simulated.setLogging(true);
}

void World::connect()
{
    const LineTime now = std::max(simulated.now(), line ? line->now() : LineTime{});
    simulated.advanceTo(now);
    line = std::make_unique<sim::SimulatedLine>(simulated, BaudRate);
    line->setHostAllowance(allowance);
    bus = std::make_unique<Bus>(*line);
    bus->setTraits(traits);
}

void World::setTraits(int id, int statusReturnLevel)
{
    Traits device;
    device.id = static_cast<std::uint8_t>(id);
    device.baudRate = BaudRate;
    device.statusReturnLevel = static_cast<std::uint8_t>(statusReturnLevel);
    device.fastReads = true;
    std::erase_if(traits, [id](const Traits &one) { return one.id == id; });
    traits.push_back(device);
    if (bus)
        bus->setTraits(traits);
}

void World::setValues(int generation)
{
    for (int id = 1; id <= 3; ++id) {
        const bool set = servo(id).write(u"Profile Velocity", 1000 * generation + id) == DeviceError::None
                         && servo(id).write(u"Profile Acceleration", 100 * generation + id) == DeviceError::None
                         && servo(id).write(u"Goal PWM", 10 * generation + id) == DeviceError::None;
        if (!set)
            qFatal("a value was refused");
    }
}

void addRows(const std::vector<Case> &cases)
{
    QTest::addColumn<int>("number");
    QTest::addColumn<int>("request");
    for (std::size_t i = 0; i < cases.size(); ++i) {
        for (int kind = 0; kind < KindCount; ++kind) {
            if (!cellFor(cases[i], static_cast<Kind>(kind)))
                continue;
            const QString name = QStringLiteral("%1: %2").arg(cases[i].name, nameOf(static_cast<Kind>(kind)));
            QTest::newRow(qPrintable(name)) << static_cast<int>(i) << kind;
        }
    }
}

QString outcomeOf(World &world, Kind kind, int target)
{
    const Request request = requestOf(kind, target);
    const LineTime begin = world.line->now();
    const Result<ExchangeResult> result =
        kind == Kind::BroadcastPing ? world.bus->broadcastPing(MaximumId, {}) : world.bus->exchange(request);
    const LineTime lasted = world.line->now() - begin;
    const int retries = result ? result->seen.retries : 0;
    QStringList words;
    if (!result) {
        words << u'!' + errorName(result.error().kind);
    } else if (kind == Kind::BroadcastPing) {
        words = foundWords(world, *result);
    } else {
        for (std::size_t i = 0; i < result->replies.size(); ++i)
            words << wordFor(world, kind, request.replies[i].id, result->replies[i]);
    }
    if (words.isEmpty())
        words << QStringLiteral(".");
    const int sent = sentPackets(world, request.packet.instruction);
    if ((result && sent < 1) || sent > 1 + retries)
        words << QStringLiteral("(sent %1 times)").arg(sent);
    if (lasted > longest(kind, target, world.allowance, retries))
        words << QStringLiteral("(took %1 us)").arg(lasted / 1us);
    return QStringLiteral("%1 retries: %2").arg(retries).arg(words.join(u' '));
}

void run(const Catalog &catalog, const Case &oneCase, Kind kind)
{
    const Cell *cell = cellFor(oneCase, kind);
    World world(catalog, oneCase.allowance);
    if (oneCase.prepare)
        oneCase.prepare(world);
    if (kind == Kind::Action) {
        const auto registered = world.bus->exchange(requestOf(Kind::RegWrite, oneCase.target));
        QVERIFY(registered);
        world.simulated.clearLog();
    }
    world.simulated.setFaults(oneCase.faults);
    const QString outcome = outcomeOf(world, kind, oneCase.target);
    const QString expected =
        QStringLiteral("%1 retries: %2").arg(cell->retries).arg(QString::fromLatin1(cell->outcome));
    QCOMPARE(outcome, expected);
    verifyRecovery(world, oneCase, kind);
}

} // namespace faultmatrix
