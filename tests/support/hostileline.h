// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"

#include <deque>
#include <random>

/// Servos whose every register is a clock, behind an adapter that does to their answers what bad ones do: cuts, noise
/// between packets, silence, delays that keep the order, damage. In virtual time, from a seed. What a register holds
/// at a moment is known, so that a value that never stood there is found out.
class HostileLine final : public dynascope::Line
{
public:
    using Bytes = dynascope::Bytes;
    using LineTime = dynascope::LineTime;

    enum class Damage {
        None,
        Seen, ///< what the CRC sees without exception: up to three flipped bits, or one burst of 16
        Wild, ///< anything: bytes replaced, lost, inserted
    };
    struct Manners {
        double silence = 0, delay = 0, cut = 0, noise = 0, damage = 0; ///< probability for each answer
        Damage kind = Damage::None;
        LineTime longestDelay = std::chrono::seconds(1);
    };

    HostileLine(quint64 seed, int baudRate, LineTime allowance, bool echo);

    QString name() const override { return QStringLiteral("hostile"); }
    LineTime now() const override { return m_now; }
    dynascope::Result<void> write(dynascope::ByteView packet) override;
    dynascope::Result<void> read(Bytes &buffer, LineTime deadline) override;
    void discardInput() override;
    int baudRate() const override { return m_baudRate; }
    dynascope::Result<void> setBaudRate(int) override { return {}; }
    LineTime hostAllowance() const override { return m_allowance; }

    void setManners(const Manners &manners) { m_manners = manners; }
    void calm(); ///< goes on to when nothing is under way any more
    void forgetDelivered() { m_delivered.clear(); m_writes.clear(); }
    const Bytes &delivered() const { return m_delivered; } ///< all that the host was handed since

    /// What the register of this many bytes at `address` of device `id` holds at `time`.
    static Bytes valueAt(LineTime time, int id, int address, int length);
    /// Did it hold `value` at some instant between?
    static bool held(const Bytes &value, LineTime from, LineTime to, int id, int address);
    /// Was this written to device `id`, or registered, since forgetDelivered()?
    bool wasWritten(int id, int address) const;
    bool wasActedOn(int id) const { return wasWritten(id, ActionMark); } ///< did it hear an Action?
    void setMute(int id) { m_mute = id; } ///< Status Return Level 1: answers Ping and reads alone

    static constexpr int Servos = 4; ///< IDs 1..4 are there, others not

private:
    static constexpr int ActionMark = -1; ///< in place of an address
    struct Arrival {
        LineTime at{};
        std::uint8_t byte = 0;
    };
    bool chance(double probability) { return probability > 0 && m_unit(m_random) < probability; }
    std::size_t upTo(std::size_t count) { return static_cast<std::size_t>(m_random() % count); }
    void answer(const Bytes &request);
    void answerGroup(const std::vector<std::array<int, 3>> &wanted, bool fast);
    void reply(Bytes packet, LineTime begin);
    void damage(Bytes &packet);
    void deliver(const Bytes &bytes, LineTime begin);
    bool take(Bytes &buffer);

    std::mt19937_64 m_random;
    std::uniform_real_distribution<double> m_unit{0, 1};
    int m_baudRate;
    LineTime m_allowance;
    int m_mute = 0;
    bool m_echo;
    Manners m_manners;
    LineTime m_now{}, m_sentBy{}, m_wireFree{}, m_adapterFree{};
    std::deque<Arrival> m_arrivals;
    Bytes m_delivered;
    std::vector<std::pair<int, int>> m_writes; ///< ID, address
};
