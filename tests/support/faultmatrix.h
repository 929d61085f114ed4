// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/bus.h"
#include "core/sim/servo.h"
#include "core/sim/simulatedline.h"

#include <functional>

/// Fault by request: what one exchange on a faulty line comes to, for three servos with ID 1, 2 and 3 at 1 Mbps. Rows
/// say what must be, from reference "What real buses do to a client"; none says two things.
namespace faultmatrix {

using namespace dynascope;
using namespace std::chrono_literals;
using Fault = sim::ReplyFault::Kind;

enum class Kind {
    Ping,
    BroadcastPing,
    Read,
    Write,
    RegWrite,
    Action,
    FactoryReset,
    Reboot,
    Clear,
    Backup,
    SyncRead,
    BulkRead,
    FastSyncRead,
    FastBulkRead,
    SyncWrite,
    BulkWrite,
};
constexpr int KindCount = 16;

QString nameOf(Kind kind);
/// "Read, Write" and groups: "idempotent" (Ping, Read, Write), "commands" (Reg Write to Backup), "unicast" (both),
/// "chained" (Sync and Bulk Read), "fast" (the fast ones), "unanswered" (Sync and Bulk Write), "all".
std::vector<Kind> kindsOf(const char *requests);

bool isGroupRead(Kind kind);
constexpr int WrittenValue = 77;
/// Profile Velocity (112, 4 bytes) of the target or of all; "Bulk": something else of each device, see bulkSpan().
Request requestOf(Kind kind, int target);
Span bulkSpan(int id);
Bytes dataOf(std::int64_t value, int size);

/// What an exchange comes to.
struct Cell {
    const char *requests;
    int retries;
    /// One word for each expected reply: "=" it is right; the name of an ErrorKind. Of a broadcast Ping one for each of
    /// the three: "=" found, "-" not; and "+9" for another that was found. "." where nobody answers. "!" before an
    /// ErrorKind: the exchange failed as a whole.
    const char *outcome;
};

/// The cells of "commands".
std::vector<Cell> commandsSeeing(const char *outcome);

struct World;

struct Case {
    QString name;
    sim::LineFaults faults;
    std::vector<Cell> cells; ///< of all kinds, each once, unless `partial`
    int target = 2;          ///< whom unicast requests are for
    LineTime allowance{};    ///< the line's for its host and adapter
    LineTime settle{};       ///< so long after the exchange the line is sound again
    std::function<void(World &)> prepare{};
    bool partial = false;
};

/// A bus of its own for each exchange.
struct World {
    explicit World(const Catalog &catalog, LineTime allowance);
    void connect(); ///< another line and Bus: the adapter was plugged in again
    sim::Servo &servo(int id) { return *simulated.servos()[static_cast<std::size_t>(id - 1)]; }
    void setValues(int generation); ///< of what is read: different for each device and generation
    void setTraits(int id, int statusReturnLevel);

    sim::SimulatedBus simulated;
    LineTime allowance;
    std::unique_ptr<sim::SimulatedLine> line;
    std::unique_ptr<Bus> bus;
    std::vector<Traits> traits;
};

/// The answer of `target` to it, in bytes; of a group read the target's part.
std::size_t replySize(Kind kind, int target);
std::size_t requestSize(Kind kind, int target);
/// Of all three, or of the target.
std::size_t allRepliesSize(Kind kind, int target);

/// Rows "case: request" for a data-driven test with the columns case (int) and request (int).
void addRows(const std::vector<Case> &cases);
/// Carries one of them out: the exchange, its end by the deadline, no more packets than allowed; then on a sound line,
/// with other values in the registers, a Read of the target and a Sync Read of all without a retry.
void run(const Catalog &catalog, const Case &oneCase, Kind kind);
/// "2 retries: = CutOff ="; what else is wrong stands behind. Carries out the exchange alone.
QString outcomeOf(World &world, Kind kind, int target);

} // namespace faultmatrix
