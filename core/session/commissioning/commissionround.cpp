// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/commissioning/commissionround.h"

#include "core/bus/messages.h"
#include "core/bus/operations.h"
#include "core/session/commissioning/bringin.h"
#include "core/session/procedures/atbaud.h"
#include "core/session/texts.h"
#include "core/session/volatilespan.h"

#include <algorithm>
#include <map>

namespace dynascope {
namespace {

constexpr int MostAttempts = 3; ///< at one servo, until a person says so or it was unplugged

using Remembered = CommissionMemory::Device;

MovePlace placeOf(const Found &found)
{
    return {found.baudRate, found.id};
}

Remembered deviceOf(const Found &found)
{
    return {placeOf(found), found.modelNumber};
}

/// Who is there, at every rate.
struct View {
    std::vector<Found> heard;
    QStringList unreadable; ///< whole sentences' worth, one per rate
};

/// Pings and reads; writes nothing.
class Looking
{
public:
    Looking(JobContext &context, const CommissionRoundPlan &plan, const CommissionHooks &hooks)
        : m_context(context), m_plan(plan), m_hooks(hooks), m_rates(plan.list.rates(plan.catalog))
    {
        if (!context.bus().line().canSetBaudRate())
            m_rates = {context.bus().line().baudRate()};
        m_scan.between = [this](double) { return m_context.checkpoint(); };
    }

    /// Every rate after the moment in which the first new one was heard, too: two may have been plugged in meanwhile.
    Result<View> run(const std::function<bool(const Found &)> &isKnown)
    {
        // Those of before may move, and may have been moving when nobody had looked yet.
        m_scan.volatileOf = [this, &isKnown](const Found &found) {
            const ControlTablePtr table = m_plan.catalog.find(found.modelNumber, found.firmware);
            const bool mayMove = !m_plan.memory.hasLooked || isKnown(found);
            return !table ? std::nullopt : mayMove ? volatileSpanOf(*table) : restingSpanOf(*table);
        };
        std::map<int, View> seen;
        std::size_t left = m_rates.size();
        bool isAlone = true;
        for (std::size_t i = 0; left > 0; i = (i + 1) % m_rates.size()) {
            auto view = lookAt(m_rates[i]);
            if (!view)
                return tl::unexpected(view.error());
            --left;
            const bool isNews =
                !view->unreadable.isEmpty()
                || std::ranges::any_of(view->heard, [&](const Found &found) { return !isKnown(found); });
            if (isNews && isAlone)
                left = m_rates.size() - 1;
            isAlone = isAlone && !isNews;
            seen[m_rates[i]] = std::move(*view);
        }
        View all;
        for (const auto &[rate, view] : seen) {
            all.heard.insert(all.heard.end(), view.heard.begin(), view.heard.end());
            all.unreadable += view.unreadable;
        }
        return all;
    }

private:
    Result<View> lookAt(int rate)
    {
        if (const auto go = m_context.checkpoint(); !go)
            return tl::unexpected(go.error());
        if (m_hooks.looking)
            m_hooks.looking(rate);
        const AtBaud there(m_context.bus(), rate);
        if (!there.entered() && there.entered().error().kind == ErrorKind::PortUnsuitable)
            return isWanted(rate) ? Result<View>(tl::unexpected(there.entered().error())) : View();
        if (!there.entered())
            return tl::unexpected(there.entered().error());
        auto scan = scanBaud(m_context.bus(), {}, m_scan);
        if (!scan)
            return tl::unexpected(scan.error());
        View view{std::move(scan->devices), {}};
        if (!scan->unreadable.isEmpty())
            view.unreadable << CommissioningText::tr("%1 at %2 bps").arg(scan->unreadable).arg(rate);
        return view;
    }

    bool isWanted(int rate) const
    {
        for (std::size_t i = 0; i < m_plan.list.size(); ++i) {
            if (m_plan.list.joint(i).place.baudRate == rate)
                return true;
        }
        return false;
    }

    JobContext &m_context;
    const CommissionRoundPlan &m_plan;
    const CommissionHooks &m_hooks;
    std::vector<int> m_rates;
    ScanHooks m_scan;
};

class Round
{
public:
    Round(JobContext &context, const CommissionRoundPlan &plan, const CommissionHooks &hooks)
        : m_context(context), m_plan(plan), m_hooks(hooks)
    {
        m_round.list = plan.list;
        m_round.memory = plan.memory;
    }

    Result<CommissionRound> run()
    {
        if (const auto able = checkLine(); !able)
            return tl::unexpected(able.error());
        Looking looking(m_context, m_plan, m_hooks);
        auto view = looking.run([this](const Found &found) { return isKnown(found); });
        if (!view)
            return tl::unexpected(view.error());
        m_round.heard = view->heard;
        forgetWhoIsGone();
        m_round.problem = doubt(*view);
        if (m_round.problem.isEmpty()) {
            if (const auto done = judge(); !done)
                return tl::unexpected(done.error());
        }
        return std::move(m_round);
    }

private:
    CommissionMemory &memory() { return m_round.memory; }

    /// Before the first look, what can't end well.
    Result<void> checkLine()
    {
        Line &line = m_context.bus().line();
        for (std::size_t i = 0; i < m_plan.list.size() && !line.canSetBaudRate(); ++i) {
            if (m_plan.list.joint(i).place.baudRate != line.baudRate())
                return tl::unexpected(messages::deviceRateBound(line.name()));
        }
        if (memory().hasLooked)
            return {};
        const auto left = leftHalfDone(m_plan);
        if (!left)
            return tl::unexpected(left.error());
        memory().halfDone = *left;
        return {};
    }

    static bool isAmong(const std::vector<Remembered> &devices, const Found &found)
    {
        return std::ranges::find(devices, deviceOf(found)) != devices.end();
    }
    bool isHalfDone(const Found &found)
    {
        const auto &half = memory().halfDone;
        return half && half->modelNumber == found.modelNumber
               && (half->from == placeOf(found) || half->to == placeOf(found));
    }
    bool isTicked(const Found &found) const
    {
        return m_round.list.at(placeOf(found), found.modelNumber, CommissionState::Done).has_value();
    }
    bool isKnown(const Found &found)
    {
        return found.doubt.isEmpty() && (isTicked(found) || isAmong(memory().bystanders, found));
    }

    void forgetWhoIsGone()
    {
        const auto isGone = [this](const Remembered &device) {
            return std::ranges::none_of(m_round.heard, [&](const Found &found) { return deviceOf(found) == device; });
        };
        std::erase_if(memory().bystanders, isGone);
        std::erase_if(memory().theirs, isGone);
        std::erase_if(memory().troubles,
                      [&](const CommissionMemory::Trouble &trouble) { return isGone(trouble.device); });
    }

    QString doubt(const View &view) const
    {
        for (const Found &found : view.heard) {
            if (!found.doubt.isEmpty())
                return CommissioningText::tr(
                           "There seem to be two servos at once at %1 bps: %2. Unplug one of them; nothing was written")
                    .arg(found.baudRate)
                    .arg(found.doubt);
        }
        if (!view.unreadable.isEmpty())
            return CommissioningText::tr(
                       "Something answers that can't be read, as two servos at once do: %1. Unplug one; nothing was "
                       "written")
                .arg(view.unreadable.join(QStringLiteral("; ")));
        return {};
    }

    Result<void> judge()
    {
        std::vector<Found> fresh;
        for (const Found &found : m_round.heard) {
            const auto handled = isTicked(found) ? Result<bool>(true) : tickAsItIs(found);
            if (!handled)
                return tl::unexpected(handled.error());
            if (!*handled && !standsAside(found))
                fresh.push_back(found);
        }
        memory().hasLooked = true;
        // The ones at a joint's own place, of a list that is gone through once more, are no riddle: one a round.
        if (fresh.empty()) {
            for (const Found &found : m_round.heard) {
                if (isAmong(memory().theirs, found) && !isTicked(found))
                    return bring(found);
            }
            return {};
        }
        if (fresh.size() == 1)
            return bring(fresh.front());
        QStringList who;
        for (const Found &found : fresh)
            who << CommissioningText::tr("%1 at %2")
                       .arg(modelName(m_plan.catalog, found.modelNumber), placeText(placeOf(found)));
        m_round.problem = CommissioningText::tr(
                              "There are %1 new servos at once: %2. Plug in one after the other; nothing was written")
                              .arg(fresh.size())
                              .arg(who.join(CommissioningText::tr(" and ")));
        return {};
    }

    /// Of which it already has the place, unless every new one has that.
    std::optional<std::size_t> ownJoint(const Found &found) const
    {
        const auto joint = m_round.list.at(placeOf(found), found.modelNumber, CommissionState::Waiting);
        const bool isAnybodys = joint && m_round.list.isWhereNewOnesAnswer(*joint) && m_round.list.next() != joint;
        return isAnybodys ? std::nullopt : joint;
    }

    Result<bool> tickAsItIs(const Found &found)
    {
        const auto joint = ownJoint(found);
        if (!joint)
            return false;
        const BringIn what{m_plan, m_hooks, *joint, found, {}};
        const auto same = isAsWanted(m_context, what);
        if (!same || !*same)
            return same;
        tick(*joint, {found.modelNumber, found.firmware, placeOf(found), placeOf(found), true,
                      QDateTime::currentDateTimeUtc()});
        return true;
    }

    void tick(std::size_t joint, const CommissionFacts &facts)
    {
        m_round.list.tick(joint, facts);
        m_round.ticked.push_back(joint);
        if (const auto left = m_plan.file.load(); left && isOnlyOf(*left, facts)) // else another one's
            m_plan.file.remove();
        if (const auto &half = memory().halfDone; half && half->goal == facts.place)
            memory().halfDone.reset();
    }

    static bool isOnlyOf(const MovePlan &plan, const CommissionFacts &facts)
    {
        return std::ranges::all_of(plan.steps, [&](const MoveStep &step) {
            const MoveDevice &device = plan.devices[step.device];
            return device.goal == facts.place && device.place.modelNumber == facts.modelNumber;
        });
    }

    /// Was it there before anything was plugged in? Then it isn't new, whatever it is.
    bool standsAside(const Found &found)
    {
        if (isHalfDone(found))
            return false;
        if (!memory().hasLooked && !m_plan.options.takesPresent) {
            (ownJoint(found) ? memory().theirs : memory().bystanders).push_back(deviceOf(found));
            return true;
        }
        return isAmong(memory().bystanders, found) || isAmong(memory().theirs, found);
    }

    std::optional<std::size_t> jointFor(const Found &found)
    {
        if (isAmong(memory().theirs, found))
            return m_round.list.at(placeOf(found), found.modelNumber, CommissionState::Waiting);
        if (isHalfDone(found)) {
            const auto its = m_round.list.at(memory().halfDone->goal, found.modelNumber, CommissionState::Waiting);
            if (its)
                return its;
        }
        return m_round.list.next();
    }

    Result<void> bring(const Found &found)
    {
        m_round.found = found;
        const auto joint = jointFor(found);
        if (!joint)
            return {};
        const auto trouble = std::ranges::find(memory().troubles, deviceOf(found), &CommissionMemory::Trouble::device);
        const int attempts = trouble == memory().troubles.end() ? 0 : trouble->attempts;
        if (attempts >= MostAttempts) {
            m_round.problem = trouble->why;
            return {};
        }
        if (m_hooks.found)
            m_hooks.found(found, *joint);
        BringIn what{m_plan, m_hooks, *joint, found, m_round.heard};
        std::erase(what.others, found);
        const auto facts = bringIn(m_context, what, m_round.hasWritten);
        if (facts) {
            tick(*joint, *facts);
            return {};
        }
        if (endsAll(facts.error()))
            return tl::unexpected(facts.error());
        m_round.problem = facts.error().text;
        if (m_round.hasWritten)
            remember(found, m_plan.list.joint(*joint), attempts + 1);
        return {};
    }

    /// It may stand at its old place, at the new one, or half way; whichever it is, it is the one of before.
    void remember(const Found &found, const CommissionJoint &joint, int attempts)
    {
        std::erase_if(memory().troubles, [&](const CommissionMemory::Trouble &trouble) {
            return trouble.device == deviceOf(found);
        });
        for (const MovePlace &place : {placeOf(found), joint.place, MovePlace{found.baudRate, joint.place.id},
                                       MovePlace{joint.place.baudRate, found.id}})
            memory().troubles.push_back({{place, found.modelNumber}, attempts, m_round.problem});
    }

    JobContext &m_context;
    const CommissionRoundPlan &m_plan;
    const CommissionHooks &m_hooks;
    CommissionRound m_round;
};

} // namespace

Result<CommissionRound> commissionRound(JobContext &context, const CommissionRoundPlan &plan,
                                        const CommissionHooks &hooks)
{
    return Round(context, plan, hooks).run();
}

} // namespace dynascope
