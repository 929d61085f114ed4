// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"
#include "core/result.h"
#include "core/table/catalog.h"

#include <memory>
#include <vector>

namespace dynascope::sim {

class Servo;

/// One servo of a simulated bus: MODEL[/FIRMWARE]@BAUD:ID.
struct ServoSpec {
    QString model;
    int firmware = -1; ///< −1: the newest the catalog knows
    int baudRate = 57600;
    int id = 1;

    friend bool operator==(const ServoSpec &, const ServoSpec &) = default;
};

/// "XM430-W350@57600:1,XL330-M288/52@1000000:7"; the message names the entry that is wrong.
Result<std::vector<ServoSpec>> parseServoSpecs(QStringView text, const Catalog &catalog);

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

    Result<Servo *> add(const ServoSpec &spec);
    const std::vector<std::unique_ptr<Servo>> &servos() const { return m_servos; }
    Servo *servo(int id, int baudRate) const; ///< nullptr where there is none

    /// The controller begins to send `bytes` at `begin`; its last bit leaves bytes × byte time later.
    void send(ByteView bytes, LineTime begin, int baudRate);

    /// Bytes that reach a controller listening at `baudRate` up to and including `now`, each once, appended to `to`.
    void receive(Bytes &to, LineTime now, int baudRate);
    /// When the next byte will have come, if any is on its way.
    std::optional<LineTime> nextArrival() const;
    void discardArrived(LineTime now);

    /// Motion, watchdogs, boot: up to `now`. send() and receive() do it by themselves.
    void advanceTo(LineTime now);

    void setLogging(bool on);
    const std::vector<WireEntry> &log() const { return m_log; }
    void clearLog() { m_log.clear(); }

private:
    const Catalog &m_catalog;
    std::vector<std::unique_ptr<Servo>> m_servos;
    std::vector<WireEntry> m_log;
    // The owner of this file chooses the rest.
};

} // namespace dynascope::sim
