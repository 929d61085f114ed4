// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/replyspoiler.h"

#include "core/sim/damage.h"
#include "core/sim/groupreply.h"

#include <algorithm>

namespace dynascope::sim {
namespace {

using Fault = ReplyFault::Kind;

PacketForm formOf(const Transmission &sent)
{
    if (!sent.chain || !sent.chain->group.fast)
        return PacketForm::Status;
    return sent.index == 0 ? PacketForm::FirstFastPiece : PacketForm::FastPiece;
}

} // namespace

/// A reply on its way through the faults.
struct ReplySpoiler::Spoiling {
    Transmission sent;
    StatusPacket status;
    Bytes heard;                     ///< by the controller; as long as what is sent
    std::optional<LineTime> again{}; ///< how long after its end it comes again
    bool reboots = false;

    void encodeAgain()
    {
        sent.bytes = sent.chain ? chainBytes(*sent.chain, sent.index, status) : encode(status);
        heard = sent.bytes;
    }
    void put(const Bytes &before)
    {
        sent.bytes.insert(sent.bytes.begin(), before.begin(), before.end());
        heard.insert(heard.begin(), before.begin(), before.end());
        if (sent.lostFrom != Transmission::NothingLost)
            sent.lostFrom += before.size();
    }
    void cut(std::size_t kept, bool atAdapter)
    {
        if (kept >= sent.bytes.size())
            return;
        if (atAdapter) {
            sent.lostFrom = std::min(sent.lostFrom, kept);
            return;
        }
        sent.bytes.resize(kept);
        heard.resize(kept);
        sent.damaged = true;
    }
};

void ReplySpoiler::setFaults(const LineFaults &faults)
{
    m_chance = Chance(faults.seed);
    m_faults.clear();
    for (const ReplyFault &fault : faults.replies)
        m_faults.push_back({fault, 0});
    std::ranges::stable_sort(m_faults, {}, [](const Counted &counted) { return counted.fault.kind; });
}

bool ReplySpoiler::befalls(Counted &counted, int id)
{
    const ReplyFault &fault = counted.fault;
    if (fault.id >= 0 && fault.id != id)
        return false;
    const int number = counted.seen++;
    if (number < fault.skip || (fault.times >= 0 && number - fault.skip >= fault.times))
        return false;
    return fault.share >= 1 || m_chance.fraction() < fault.share;
}

ReplySpoiler::Spoiled ReplySpoiler::spoil(Transmission reply, const StatusPacket &status)
{
    if (m_faults.empty())
        return {{std::move(reply)}, false};
    Spoiling spoiling{std::move(reply), status, {}};
    spoiling.heard = spoiling.sent.bytes;
    for (Counted &counted : m_faults) {
        if (befalls(counted, status.id))
            apply(counted.fault, spoiling);
    }
    Spoiled result;
    result.reboots = spoiling.reboots;
    Transmission &sent = spoiling.sent;
    if (sent.bytes.empty())
        return result;
    if (spoiling.heard != sent.bytes)
        sent.atAdapter = std::move(spoiling.heard);
    result.sent.push_back(std::move(sent));
    if (spoiling.again) {
        Transmission copy = result.sent.front();
        copy.begin = copy.end() + *spoiling.again;
        copy.chain.reset(); // who waits for it has heard the first
        result.sent.push_back(std::move(copy));
    }
    return result;
}

void ReplySpoiler::apply(const ReplyFault &fault, Spoiling &reply)
{
    const PacketForm form = formOf(reply.sent);
    const auto amount = static_cast<std::size_t>(std::max(fault.amount, 0));
    if (reply.sent.bytes.empty() && fault.kind < Fault::StrayBefore)
        return; // lost already
    Bytes before;
    switch (fault.kind) {
    case Fault::Reboot:
        reply.reboots = true;
        reply.cut(0, false);
        break;
    case Fault::Lost: reply.cut(0, fault.atAdapter); break;
    case Fault::WrongId:
        reply.status.id = static_cast<std::uint8_t>(fault.amount);
        reply.encodeAgain();
        reply.sent.damaged = true; // not the one that the next in a group read waits for
        break;
    case Fault::WrongLength:
        reply.status.parameters.resize(
            static_cast<std::size_t>(std::max(0, static_cast<int>(reply.status.parameters.size()) + fault.amount)));
        reply.encodeAgain();
        reply.sent.damaged =
            reply.sent.damaged || form != PacketForm::Status; // the next doesn't find the place of its block
        break;
    case Fault::Damaged:
        if (damagePacket(reply.heard, form, fault.damage, m_chance) && !fault.atAdapter) {
            reply.sent.bytes = reply.heard;
            reply.sent.damaged = true;
        }
        break;
    case Fault::Cut:
        reply.cut(fault.amount < 0 ? m_chance.below(reply.sent.bytes.size()) : amount, fault.atAdapter);
        break;
    case Fault::StrayBefore: {
        StatusPacket stray = reply.status;
        stray.id = static_cast<std::uint8_t>(fault.amount);
        for (std::uint8_t &byte : stray.parameters)
            byte = static_cast<std::uint8_t>(~byte);
        reply.put(encode(stray));
        break;
    }
    case Fault::NoiseBefore:
        before = fault.noise;
        while (fault.noise.empty() && before.size() < amount)
            before.push_back(m_chance.byte());
        reply.put(before);
        break;
    case Fault::Late: reply.sent.lateness = std::max(reply.sent.lateness, fault.time); break;
    case Fault::Twice: reply.again = fault.time; break;
    }
}

} // namespace dynascope::sim
