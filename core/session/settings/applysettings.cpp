// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/settings/applysettings.h"

#include "core/session/journal/journalwrites.h"
#include "core/session/procedures/atbaud.h"
#include "core/session/texts.h"

#include <algorithm>

namespace dynascope {
namespace {

constexpr int MostPasses = 8; ///< each brings at least one register further, and hardly ever are there three

/// Does it say something of this register alone? Then the others may still be written.
bool isOfTheRegister(const Error &error)
{
    return error.kind == ErrorKind::Refused || error.kind == ErrorKind::NotConfirmed;
}

/// One run of a plan.
class Applying
{
public:
    Applying(JobContext &context, const SettingsPlan &plan, const SettingsHooks &hooks)
        : m_context(context), m_bus(context.bus()), m_plan(plan), m_hooks(hooks)
    {
    }

    Result<SettingsOutcome> run()
    {
        for (const auto look : {&Applying::checkDevice, &Applying::readEverything, &Applying::compare}) {
            if (const auto fine = (this->*look)(); !fine)
                return tl::unexpected(fine.error());
        }
        if (const auto fine = checkDifferences(m_plan, m_image, m_outcome); !fine)
            return tl::unexpected(fine.error());
        const bool isSame = m_outcome.count(SettingState::Differs) == 0;
        const bool isNothing = isSame && (!m_plan.options.turnTorqueOn || m_torque || !m_plan.torque);
        if (isNothing || m_plan.options.compareOnly || m_outcome.missing != Consent::None)
            return std::move(m_outcome);
        if (const auto go = m_context.checkpoint(); !go)
            return tl::unexpected(go.error());
        const JobContext::Exclusive exclusive(m_context);
        Result<void> all = writeAll();
        if (all && m_plan.torque && !m_torque && comesOn())
            all = putTorqueBack();
        if (!all)
            endWith(all.error());
        return std::move(m_outcome);
    }

private:
    Result<void> checkDevice()
    {
        const auto found = look(m_context, m_plan.place);
        if (!found)
            return tl::unexpected(found.error());
        RegisterImage asFound;
        if (m_plan.modelNumber) {
            Bytes number;
            appendLittleEndian(number, found->modelNumber, m_plan.modelNumber->size);
            asFound.take(m_plan.modelNumber->address, number);
        }
        if (m_plan.firmwareVersion)
            asFound.take(m_plan.firmwareVersion->address, Bytes{found->firmware});
        return checkIdentity(m_plan, asFound);
    }

    Result<void> read(const std::vector<Span> &spans)
    {
        const auto values = readSpans(m_context, {m_plan.place, spans});
        if (!values)
            return tl::unexpected(values.error());
        m_image.take(*values);
        return {};
    }

    Result<void> readEverything()
    {
        if (const auto all = read(m_plan.reads); !all)
            return all;
        return m_plan.options.compareOnly ? Result<void>() : read(m_plan.affectedReads);
    }

    Result<void> compare()
    {
        m_outcome = compareSettings(m_plan, m_image);
        m_torque = m_outcome.hadTorque;
        for (std::size_t i = 0; i < m_plan.steps.size(); ++i) {
            const SettingsStep &step = m_plan.steps[i];
            if (m_outcome.results[i].before.empty())
                return failure(ErrorKind::Refused, SettingsText::tr("%1 lets %2 not be read; nothing was written")
                                                       .arg(m_plan.place.name, step.name));
            m_wanted.push_back(step.isKept ? m_outcome.results[i].before : step.to);
            if (step.isFixed && differs(i))
                setFailed(i, SettingsText::tr("%1 is not changed among other settings").arg(step.name));
        }
        return {};
    }

    bool differs(std::size_t i) const { return m_image.bytes(m_plan.steps[i].where) != m_wanted[i]; }
    bool isOver(std::size_t i) const
    {
        return m_outcome.results[i].state == SettingState::Failed || m_outcome.results[i].state == SettingState::Left;
    }
    void setFailed(std::size_t i, const QString &why)
    {
        m_outcome.results[i].state = SettingState::Failed;
        m_outcome.results[i].why = why;
    }

    /// What a write has reset differs, too.
    void endWith(const Error &error)
    {
        m_outcome.ended = error;
        for (std::size_t i = 0; i < m_plan.steps.size(); ++i) {
            if (!isOver(i) && differs(i))
                m_outcome.results[i].state = SettingState::Differs;
        }
    }

    /// One write, verified, with all that goes with it.
    Result<void> put(SettingsWrite write, const std::vector<Span> &affected)
    {
        if (const auto go = m_context.checkpoint(); !go)
            return go;
        const std::vector<PollValue> before = valuesNow(write, affected);
        write.around = before;
        if (m_hooks.begun)
            m_hooks.begun(write);
        m_isSent = true;
        const auto written = writeVerified(m_bus, {m_plan.place.id, write.where.address, write.to});
        if (!written) {
            if (m_hooks.ended)
                m_hooks.ended(write, before, tl::unexpected(written.error()));
            return tl::unexpected(written.error());
        }
        m_image.take(write.where.address, *written);
        const Result<void> readOn = read(affected);
        if (m_hooks.ended)
            m_hooks.ended(write, before, valuesNow(write, affected));
        return readOn;
    }

    std::vector<PollValue> valuesNow(const SettingsWrite &write, const std::vector<Span> &affected) const
    {
        std::vector<PollValue> values{valueAt(write.where.address, write.where.size)};
        for (const Span &span : affected)
            values.push_back(valueAt(span.address, span.length));
        std::erase_if(values, [](const PollValue &value) { return value.data.empty(); });
        return values;
    }

    PollValue valueAt(std::uint16_t address, std::uint16_t length) const
    {
        PollValue value;
        value.address = address;
        value.length = length;
        value.data = m_image.bytes(address, length);
        value.at = m_bus.line().now();
        return value;
    }

    Result<void> turnTorqueOff()
    {
        SettingsWrite write{SettingsWrite::Purpose::TorqueOff, *m_plan.torque, nameOf(Known::TorqueEnable).toString(),
                            m_image.bytes(*m_plan.torque), Bytes(m_plan.torque->size)};
        m_isSent = false;
        const auto off = put(write, {});
        m_outcome.torqueTurnedOff = m_isSent; // or it may be, where the answer is lost
        m_torque = !off;
        return off;
    }

    /// What was refused for a limit is tried again as long as other registers change.
    Result<void> writeAll()
    {
        for (int pass = 0; pass < MostPasses; ++pass) {
            m_later.clear();
            m_hasWritten = false;
            for (std::size_t i = 0; i < m_plan.steps.size(); ++i) {
                if (isOver(i) || !differs(i))
                    continue;
                if (const auto written = writeStep(i); !written)
                    return written;
            }
            if (!m_hasWritten)
                break;
        }
        for (const auto &[i, why] : m_later)
            setFailed(i, why);
        return verify();
    }

    Result<void> writeStep(std::size_t i)
    {
        const SettingsStep &step = m_plan.steps[i];
        SettingResult &result = m_outcome.results[i];
        if (step.isLocked && m_torque) {
            if (!m_plan.options.mayTurnTorqueOff) { // it wasn't to be foreseen
                setFailed(i, SettingsText::tr("%1 is locked by torque").arg(step.name));
                return {};
            }
            if (const auto off = turnTorqueOff(); !off)
                return off;
        }
        if (step.isGoal && keepsGoal(i))
            return {};
        const SettingsWrite write{step.isKept ? SettingsWrite::Purpose::PutBack : SettingsWrite::Purpose::Setting,
                                  step.where, step.name, m_image.bytes(step.where), m_wanted[i]};
        const Traits former = m_bus.traits(m_plan.place.id);
        if (step.tells == SettingsStep::Tells::ReturnLevel) // its answer to this write follows it already
            tellBus(step, m_wanted[i]);
        const auto written = put(write, step.affected);
        if (written) {
            result.state = SettingState::Written;
            m_hasWritten = true;
            tellBus(step, m_wanted[i]);
            return {};
        }
        m_bus.addTraits(former);
        if (isBeyondLimit(written.error()))
            m_later[i] = written.error().text;
        else if (isOfTheRegister(written.error()))
            setFailed(i, written.error().text);
        else
            return written;
        return {};
    }

    /// Would a goal that is written now switch torque on, or be replaced anyway?
    bool keepsGoal(std::size_t i)
    {
        const SettingsStep &step = m_plan.steps[i];
        SettingResult &result = m_outcome.results[i];
        if (m_torque)
            return false;
        const RestingGoal *resting = restingGoal();
        if (comesOn() && resting && resting->goal == step.where) {
            result.state = SettingState::Left;
            result.why = SettingsText::tr("%1 is set so that nothing moves when torque comes on").arg(step.name);
            return true;
        }
        if (!goalWakes())
            return false;
        result.state = SettingState::Left;
        result.why = SettingsText::tr("%1 is left as it is, since writing it would turn torque on").arg(step.name);
        return true;
    }

    bool goalWakes() const
    {
        if (!m_plan.driveModeAddress)
            return false;
        const Bytes mode = m_image.bytes(*m_plan.driveModeAddress, 1);
        return mode.empty() || ((mode.front() >> TorqueOnByGoalBit) & 1) != 0;
    }

    /// Or the next deadlines would be those of before.
    void tellBus(const SettingsStep &step, const Bytes &value)
    {
        if (step.tells == SettingsStep::Tells::Nothing)
            return;
        Traits traits = m_bus.traits(m_plan.place.id);
        traits.baudRate = m_plan.place.baudRate;
        if (step.tells == SettingsStep::Tells::ReturnLevel) {
            traits.statusReturnLevel = value.front();
        } else {
            traits.returnDelay = std::chrono::microseconds(value.front() * 2 + 8);
            traits.returnDelayKnown = true;
        }
        m_bus.addTraits(traits);
    }

    Result<void> verify()
    {
        if (const auto all = read(m_plan.reads); !all)
            return all;
        for (std::size_t i = 0; i < m_plan.steps.size(); ++i) {
            SettingResult &result = m_outcome.results[i];
            result.after = m_image.bytes(m_plan.steps[i].where);
            if (!isOver(i) && differs(i))
                setFailed(i, SettingsText::tr("%1 did not stay at what was written").arg(m_plan.steps[i].name));
            else if (!isOver(i) && result.state == SettingState::Differs) // another write has brought it there
                result.state = SettingState::Written;
        }
        return {};
    }

    bool comesOn() const
    {
        return m_plan.options.turnTorqueOn || (m_outcome.torqueTurnedOff && m_plan.options.putTorqueBack);
    }

    const RestingGoal *restingGoal() const
    {
        return restingGoalIn(m_plan.restingGoals, m_plan.mode ? m_image.number(*m_plan.mode) : std::nullopt);
    }

    Result<void> staysOff(const QString &why)
    {
        m_outcome.torqueNote = SettingsText::tr("Torque stays off: %1").arg(why);
        return {};
    }

    Result<void> putTorqueBack()
    {
        if (m_outcome.count(SettingState::Failed) > 0)
            return staysOff(SettingsText::tr("not everything could be written"));
        const RestingGoal *resting = restingGoal();
        if (!resting)
            return staysOff(SettingsText::tr("nobody knows which goal would let it rest in this mode"));
        Bytes goal(resting->goal.size);
        if (resting->present) {
            const auto present = dynascope::read(
                m_bus, {m_plan.place.id, resting->present->address, resting->present->size});
            if (!present)
                return tl::unexpected(present.error());
            goal = present->data;
        }
        if (const auto now = read({{m_plan.place.id, resting->goal.address, resting->goal.size}}); !now)
            return now;
        const auto rests = putUnlessSame({SettingsWrite::Purpose::RestingGoal, resting->goal, resting->name,
                                          m_image.bytes(resting->goal), goal});
        if (!rests && isOfTheRegister(rests.error()))
            return staysOff(rests.error().text);
        if (!rests)
            return rests;
        return turnTorqueOn();
    }

    Result<void> putUnlessSame(const SettingsWrite &write)
    {
        return write.before == write.to ? Result<void>() : put(write, {});
    }

    Result<void> turnTorqueOn()
    {
        const RegisterPlace &torque = *m_plan.torque;
        if (const auto now = read({{m_plan.place.id, torque.address, torque.size}}); !now)
            return now;
        Bytes on(torque.size);
        on.front() = 1;
        const auto turned = putUnlessSame({SettingsWrite::Purpose::TorqueOn, torque,
                                           nameOf(Known::TorqueEnable).toString(), m_image.bytes(torque), on});
        if (!turned && isOfTheRegister(turned.error()))
            return staysOff(turned.error().text);
        m_outcome.torqueIsBack = turned.has_value();
        return turned;
    }

    JobContext &m_context;
    Bus &m_bus;
    const SettingsPlan &m_plan;
    const SettingsHooks &m_hooks;
    RegisterImage m_image;
    SettingsOutcome m_outcome;
    std::vector<Bytes> m_wanted; ///< of each step
    std::map<std::size_t, QString> m_later; ///< refused in this pass, and why
    bool m_torque = false, m_hasWritten = false, m_isSent = false;
};

} // namespace

Result<SettingsOutcome> applySettings(JobContext &context, const SettingsPlan &plan, const SettingsHooks &hooks)
{
    const AtBaud there(context.bus(), plan.place.baudRate);
    if (!there.entered())
        return tl::unexpected(there.entered().error());
    return Applying(context, plan, hooks).run();
}

} // namespace dynascope
