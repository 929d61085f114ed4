// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/procedures/revert.h"

#include "core/session/journal/journalwrites.h"
#include "core/session/procedures/atbaud.h"
#include "core/session/texts.h"

#include <algorithm>

namespace dynascope {
namespace {

tl::unexpected<Error> refused(const QString &text)
{
    return failure(ErrorKind::InvalidArgument, ProcedureText::tr("%1; nothing was written").arg(text));
}

QString valueText(const Bytes &bytes)
{
    return bytesText(bytes, false);
}

/// One run of a plan.
class Revert
{
public:
    Revert(JobContext &context, const RevertPlan &plan)
        : m_context(context), m_bus(context.bus()), m_plan(plan), m_registers(plan.registers)
    {
        m_registers.insert(m_registers.end(), plan.kept.begin(), plan.kept.end());
    }

    Result<Reverted> run()
    {
        if (const auto same = checkDevice(); !same)
            return tl::unexpected(same.error());
        if (!m_plan.readsNothing) {
            if (const auto read = readAll(m_result.before); !read)
                return tl::unexpected(read.error());
            for (std::size_t i = m_plan.registers.size(); i < m_registers.size(); ++i)
                m_registers[i].from = m_registers[i].to = present(m_registers[i]);
            for (const auto check :
                 {&Revert::resolve, &Revert::checkValues, &Revert::readTorque, &Revert::checkTorque}) {
                if (const auto fine = (this->*check)(); !fine)
                    return tl::unexpected(fine.error());
            }
        }
        if (m_result.missing != Consent::None)
            return std::move(m_result);
        if (const auto go = m_context.checkpoint(); !go)
            return tl::unexpected(go.error());
        const JobContext::Exclusive exclusive(m_context);
        allowLongestDelay();
        if (const auto written = writeAll(); !written)
            return tl::unexpected(written.error());
        return std::move(m_result);
    }

private:
    /// Return Delay Time may be among what is put back: the read-back must not be given up for what it was before.
    void allowLongestDelay()
    {
        Traits traits = m_bus.traits(m_plan.place.id);
        traits.returnDelay = Traits{}.returnDelay;
        traits.returnDelayKnown = false;
        m_bus.addTraits(traits);
    }

    Result<void> checkDevice()
    {
        const auto found = look(m_context, m_plan.place);
        if (!found)
            return tl::unexpected(found.error());
        if (found->modelNumber != m_plan.place.modelNumber) {
            return failure(ErrorKind::NotFound,
                           ProcedureText::tr("Another model answers as ID %1 at %2 bps, not %3; nothing was written")
                               .arg(m_plan.place.id)
                               .arg(m_plan.place.baudRate)
                               .arg(m_plan.place.name));
        }
        if (m_plan.firmware >= 0 && found->firmware != m_plan.firmware) {
            return failure(
                ErrorKind::NotFound,
                ProcedureText::tr(
                    "%1 has firmware %2 and had %3 then: another device, or its registers may mean something "
                    "else; nothing was written")
                    .arg(m_plan.place.name)
                    .arg(found->firmware)
                    .arg(m_plan.firmware));
        }
        return {};
    }

    Result<void> readAll(std::vector<PollValue> &values)
    {
        ReadSpansPlan reads{m_plan.place, {}};
        for (const RevertRegister &each : m_registers) {
            if (!reads.spans.empty()) { // mostly neighbours
                Span &last = reads.spans.back();
                const int end = last.address + last.length, next = each.address + static_cast<int>(each.to.size());
                if (each.address >= end && each.address - end <= 8 && next - last.address <= 128) {
                    last.length = static_cast<std::uint16_t>(next - last.address);
                    continue;
                }
            }
            reads.spans.push_back({m_plan.place.id, each.address, static_cast<std::uint16_t>(each.to.size())});
        }
        auto read = readSpans(m_context, reads);
        if (!read)
            return tl::unexpected(read.error());
        values = std::move(*read);
        for (const RevertRegister &each : m_registers) {
            if (bytesIn(values, each.address, each.to.size()).empty())
                return failure(ErrorKind::Refused,
                               ProcedureText::tr("%1 lets %2 not be read").arg(m_plan.place.name, each.name));
        }
        return {};
    }

    /// Manual: "Indirect Address". Through it torque and goals are reached, too.
    Result<void> resolve()
    {
        for (RevertRegister &each : m_registers) {
            if (!each.indirectAddress)
                continue;
            const auto pointer = read(m_bus, {m_plan.place.id, *each.indirectAddress, 2});
            if (!pointer)
                return tl::unexpected(pointer.error());
            const auto target = static_cast<int>(littleEndian(pointer->data, 2));
            each.isTorque = m_plan.torqueAddress && target == *m_plan.torqueAddress;
            each.isGoal = std::ranges::any_of(m_plan.goals, [target](const Span &goal) {
                return target >= goal.address && target < goal.address + goal.length;
            });
        }
        return {};
    }

    Bytes present(const RevertRegister &each) const { return bytesIn(m_result.before, each.address, each.to.size()); }
    bool mustWrite(const RevertRegister &each) const { return m_plan.readsNothing || present(each) != each.to; }

    /// Goals follow torque, mode and offset: that a side effect on them is no more what it was says nothing.
    Result<void> checkValues()
    {
        for (const RevertRegister &each : m_registers) {
            const bool isMain = &each == &m_registers.front();
            const Bytes now = present(each);
            const bool isWaiting = m_plan.unchecked.contains(each.address);
            if (isMain && !isWaiting && now == each.to && now != each.from && m_plan.changedSince > 0) {
                return refused(ProcedureText::tr("%1 of %2 is %3 by entry %4, which came later")
                                   .arg(each.name, m_plan.place.name, valueText(now))
                                   .arg(m_plan.changedSince));
            }
            if (now == each.from || each.from.empty() || now == each.to || (!isMain && each.isGoal)
                || m_plan.unchecked.contains(each.address))
                continue;
            return refused(ProcedureText::tr("%1 of %2 has changed meanwhile: it is %3, not %4")
                               .arg(each.name, m_plan.place.name, valueText(now), valueText(each.from)));
        }
        return {};
    }

    Result<void> readTorque()
    {
        if (!m_plan.torqueAddress)
            return {};
        const auto torque = read(m_bus, {m_plan.place.id, *m_plan.torqueAddress, 1});
        if (!torque)
            return tl::unexpected(torque.error());
        m_torque = torque->data.front() != 0;
        return readDriveMode();
    }

    Result<void> readDriveMode()
    {
        if (!m_plan.driveModeAddress)
            return {};
        const auto mode = read(m_bus, {m_plan.place.id, *m_plan.driveModeAddress, 1});
        if (!mode)
            return tl::unexpected(mode.error());
        m_goalWakes = ((mode->data.front() >> TorqueOnByGoalBit) & 1) != 0;
        return {};
    }

    /// Also where it stands among others, written by its address.
    bool endsTorque(const RevertRegister &each) const
    {
        if (each.isTorque)
            return each.to.front() == 0;
        const int at = m_plan.torqueAddress ? *m_plan.torqueAddress - each.address : -1;
        return at >= 0 && at < static_cast<int>(each.to.size()) && each.to[static_cast<std::size_t>(at)] == 0;
    }

    Result<void> checkTorque()
    {
        const RevertRegister &main = m_registers.front();
        if (main.isTorque && main.to.front() != 0 && !m_torque)
            return refused(ProcedureText::tr("%1 would come under torque, which is only ever switched on by hand")
                               .arg(m_plan.place.name));
        const auto hides = [&](const RevertRegister &each) {
            return each.isTorque && each.to.front() != 0 && !m_torque;
        };
        if (main.isGoal && !main.isTorque && std::ranges::any_of(m_registers, hides)) {
            return refused(ProcedureText::tr("Putting %1 of %2 back would switch its torque on")
                               .arg(main.name, m_plan.place.name));
        }
        bool locked = false, moves = false;
        for (const RevertRegister &each : m_registers) {
            locked = locked || (each.isLocked && mustWrite(each));
            moves = moves || (each.isGoal && !each.isTorque && mustWrite(each));
            if (each.isGoal && !each.mayWait && mustWrite(each) && !m_torque && m_goalWakes)
                return refused(ProcedureText::tr("Putting %1 of %2 back would switch its torque on")
                                   .arg(each.name, m_plan.place.name));
            m_endsTorque = m_endsTorque || (m_torque && mustWrite(each) && endsTorque(each));
        }
        if (!m_plan.torqueAddress && moves && !m_plan.mayMove)
            needs(Consent::Motion, ProcedureText::tr("Nobody knows whether %1 would move").arg(m_plan.place.name));
        if (!m_torque)
            return {};
        if ((locked || m_endsTorque) && !m_plan.mayTurnTorqueOff) {
            needs(Consent::TorqueOff,
                  m_endsTorque
                      ? ProcedureText::tr("The torque of %1 would go off").arg(m_plan.place.name)
                      : ProcedureText::tr("%1 is under torque, which locks its EEPROM").arg(m_plan.place.name));
        } else if (moves && !m_plan.mayMove && !locked && !m_endsTorque) {
            needs(Consent::Motion, ProcedureText::tr("%1 is under torque and would move").arg(m_plan.place.name));
        }
        m_result.torqueTurnedOff = locked && !m_endsTorque;
        return {};
    }

    void needs(Consent consent, const QString &why)
    {
        m_result.missing = consent;
        m_result.why = ProcedureText::tr("%1; nothing was written").arg(why);
    }

    Result<void> writeAll()
    {
        if (m_torque && (m_result.torqueTurnedOff || m_endsTorque)) {
            const auto off = writeVerified(m_bus, {m_plan.place.id, *m_plan.torqueAddress, {0}});
            if (!off)
                return tl::unexpected(off.error());
            m_torque = false;
        }
        bool first = true;
        for (const RevertRegister &each : m_registers) {
            if (const auto written = writeOne(each, first); !written)
                return written;
            first = false;
        }
        return verify();
    }

    /// What the first one resets must be looked at after it: mode, then gains.
    Result<void> writeOne(const RevertRegister &each, bool isMain)
    {
        if (each.isTorque && !m_plan.readsNothing) {
            m_result.torqueStaysOff = m_result.torqueStaysOff || (each.to.front() != 0 && !m_torque);
            return {}; // off it is already
        }
        if (isMain && !mustWrite(each))
            return {};
        if (!isMain) {
            const auto now = read(m_bus, {m_plan.place.id, each.address, static_cast<std::uint16_t>(each.to.size())});
            if (!now)
                return tl::unexpected(now.error());
            if (now->data == each.to)
                return {};
        }
        if (each.isGoal && !m_torque) { // an earlier one of the plan may have written it
            if (const auto mode = readDriveMode(); !mode)
                return mode;
        }
        if (each.isGoal && !m_torque && m_goalWakes) {
            m_result.left.push_back(
                {each, ProcedureText::tr("%1 of %2 is left as it is, since writing it would turn torque on")
                           .arg(each.name, m_plan.place.name)});
            return {};
        }
        const auto written = writeVerified(m_bus, {m_plan.place.id, each.address, each.to});
        if (written)
            return {};
        if (!isBeyondLimit(written.error()) || !each.mayWait)
            return tl::unexpected(written.error());
        m_result.left.push_back({each, ProcedureText::tr("%1 of %2 is left as it is: %3")
                                           .arg(each.name, m_plan.place.name, written.error().text)});
        return {};
    }

    Result<void> verify()
    {
        if (const auto read = readAll(m_result.after); !read)
            return read;
        for (const RevertRegister &each : m_registers) {
            const bool isLeft = std::ranges::any_of(
                m_result.left, [&](const LeftRegister &left) { return left.what.address == each.address; });
            const bool staysOff = each.isTorque && each.to.front() != 0;
            const Bytes shown = bytesIn(m_result.after, each.address, each.to.size());
            if (isLeft || staysOff || shown == each.to)
                continue;
            return failure(ErrorKind::NotConfirmed,
                           ProcedureText::tr("%1 of %2 was to be %3 and is %4")
                               .arg(each.name, m_plan.place.name, valueText(each.to), valueText(shown)));
        }
        return {};
    }

    JobContext &m_context;
    Bus &m_bus;
    const RevertPlan &m_plan;
    Reverted m_result;
    std::vector<RevertRegister> m_registers; ///< those put back, then those kept
    bool m_torque = false, m_goalWakes = false, m_endsTorque = false;
};

} // namespace

Result<Reverted> revert(JobContext &context, const RevertPlan &plan)
{
    const AtBaud there(context.bus(), plan.place.baudRate);
    if (!there.entered())
        return tl::unexpected(there.entered().error());
    return Revert(context, plan).run();
}

} // namespace dynascope
