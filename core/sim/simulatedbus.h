// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"
#include "core/result.h"
#include "core/sim/chance.h"
#include "core/sim/linefaults.h"
#include "core/sim/servospec.h"

#include <array>
#include <memory>
#include <vector>

namespace dynascope::sim {

class Adapter;
class Power;
class ReplySpoiler;
class Servo;
class Wire;
struct HeardByte;
struct Reaction;
struct Transmission;
struct Chain;

/// One entry of the wire's own log: bytes as they stood on the wire.
struct WireEntry {
    LineTime begin{}, end{};
    int baudRate = 57600;
    bool fromController = false;
    Bytes bytes;
};

/// Virtual servos on one virtual half-duplex wire. They hear the controller and each other (the chain rule needs that);
/// those at another baud rate than a sender's hear garbage. No clock of its own: time comes with each call and never
/// goes back. Any one thread.
class SimulatedBus
{
public:
    explicit SimulatedBus(const Catalog &catalog, std::uint64_t seed = 1); ///< `catalog` outlives the bus
    ~SimulatedBus();

    /// Where the clock of the calls stands, before anything is sent. Time starts at 0 otherwise.
    void beginAt(LineTime now);

    Result<Servo *> add(const ServoSpec &spec); ///< of two axes, the first
    const std::vector<std::unique_ptr<Servo>> &servos() const { return m_servos; }
    Servo *servo(int id, int baudRate) const; ///< nullptr where there is none
    Power &power() const { return *m_power; } ///< what feeds them

    /// The controller begins to send `bytes` at `begin`; its last bit leaves bytes × byte time later.
    void send(ByteView bytes, LineTime begin, int baudRate);

    /// Bytes that reach a controller listening at `baudRate` up to and including `now`, each once, appended to `to`.
    void receive(Bytes &to, LineTime now, int baudRate);
    /// When the first and the last of those that the latest receive() brought were due.
    std::pair<LineTime, LineTime> arrived() const;
    /// No byte comes before this moment, which is later than that of the last receive(); nothing where none is on
    /// its way. A later receive() may find that what was to come has been a device's silence.
    std::optional<LineTime> nextArrival() const;
    /// When all bytes under way will have come: whoever hands replies on in pieces waits for this.
    std::optional<LineTime> quietAt() const;
    void discardArrived(LineTime now);

    /// Everything up to `now`, motion included. send() and receive() do it for those who are spoken to.
    void advanceTo(LineTime now);
    LineTime now() const { return m_now; } ///< the latest of all calls

    /// From now on, in place of those before; counts begin anew. What is under way stays as it is.
    void setFaults(LineFaults faults);
    const LineFaults &faults() const { return m_faults; }
    bool isUnplugged() const; ///< the adapter, as of the last call

    void setLogging(bool on);
    const std::vector<WireEntry> &log() const { return m_log; }
    void clearLog() { m_log.clear(); }

private:
    struct Scheduled;
    void runTo(LineTime now);
    void bringToAdapter(LineTime now);
    bool isAmong(const std::vector<int> &ids, const Servo &servo) const;
    void hearController(const Transmission &sent);
    void hearServo(const Transmission &sent);
    void plan(std::vector<std::pair<Servo *, Reaction>> reactions);
    void planPings(std::vector<std::pair<Servo *, Reaction>> pings);
    void joinChain(Servo *servo, Reaction reaction);
    void continueChain(const std::shared_ptr<Chain> &chain, std::size_t index, LineTime from);
    void begin(Scheduled &reply);
    void interrupt(const Servo *servo);
    void shareBaudRates();
    LineTime jitter();

    const Catalog &m_catalog;
    std::uint64_t m_seed;
    std::vector<std::unique_ptr<Servo>> m_servos;
    struct Twins {
        std::array<Servo *, 2> axes{};
        int baudRate = 57600; ///< as both have had it
    };
    std::vector<Twins> m_twins;
    std::unique_ptr<Power> m_power;
    std::unique_ptr<Wire> m_wire;
    std::vector<Scheduled> m_scheduled;
    std::vector<std::shared_ptr<Chain>> m_chains; ///< whose end nobody has heard yet
    LineTime m_now{}, m_controllerFree{};
    LineFaults m_faults;
    Chance m_jitter{1};
    std::unique_ptr<ReplySpoiler> m_spoiler;
    std::unique_ptr<Adapter> m_adapter;
    int m_listening = 57600; ///< the controller's rate
    std::vector<HeardByte> m_heard; ///< on its way from the wire to the adapter
    std::vector<WireEntry> m_log;
    bool m_logging = false;
};

} // namespace dynascope::sim
