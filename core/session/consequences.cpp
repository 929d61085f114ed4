// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/consequences.h"

#include "core/session/journal/journalwrites.h"
#include "core/session/settings/settingsorder.h"
#include "core/session/texts.h"

#include <algorithm>
#include <cmath>

namespace dynascope {
namespace {

constexpr double SmallJump = 3;          ///< degrees that a joint may go without a word
constexpr int PositionMode = 3;          ///< of Operating Mode: one turn
constexpr int ReverseBit = 0;            ///< of Drive Mode
constexpr int OffsetsPerTurn = 4;        ///< in that mode only offsets within a quarter of a turn count
constexpr std::int64_t ThisProtocol = 2; ///< of Protocol Type

/// One look at one write.
class Outlook
{
public:
    Outlook(const ControlTable &table, const RegisterLookup &now, const Field &field, std::int64_t raw,
            const UnitPreferences &units)
        : m_table(table), m_now(now), m_field(field), m_raw(raw), m_units(units)
    {
    }

    std::vector<Consequence> all()
    {
        m_old = now(m_field.name);
        if (m_old == m_raw)
            return {};
        for (const auto look : {&Outlook::needsTorqueOff, &Outlook::resets, &Outlook::movesPosition,
                                &Outlook::goesBeyondLimits, &Outlook::turnsTorqueOn, &Outlook::wakesByGoal,
                                &Outlook::changesPlace, &Outlook::answersLess, &Outlook::bitsOf})
            (this->*look)();
        return std::move(m_all);
    }

private:
    std::optional<std::int64_t> now(QStringView name) const { return m_now ? m_now(name) : std::nullopt; }
    std::optional<std::int64_t> then(QStringView name) const { return name == m_field.name ? m_raw : now(name); }
    bool isField(QStringView name) const { return m_field.name == name; }
    bool isField(Known field) const { return m_table.find(field) == &m_field; }
    bool isTorqueOn() const { return now(nameOf(Known::TorqueEnable)).value_or(0) != 0; }
    bool gainsBit(int bit) const { return ((m_raw >> bit) & 1) != 0 && ((m_old.value_or(0) >> bit) & 1) == 0; }

    EffectiveField effectively(const Field &field) const
    {
        return effective(field, [this](QStringView name) { return now(name); });
    }
    QString said(const Field &field, std::int64_t raw) const
    {
        return valueText(field, effectively(field), m_table.resolution(), raw, m_units);
    }
    void add(ConsequenceKind kind, const QString &text, std::vector<ExpectedChange> registers = {})
    {
        m_all.push_back({kind, text, std::move(registers)});
    }

    void needsTorqueOff()
    {
        if (m_field.needsTorqueOff() && isTorqueOn())
            add(ConsequenceKind::NeedsTorqueOff,
                ConsequenceText::tr(
                    "%1 is locked while torque is on: torque has to go off first, and what the motor carries may fall.")
                    .arg(m_field.name));
    }

    void resets()
    {
        std::vector<ExpectedChange> registers, unknown;
        for (const QString &name : m_field.resets) {
            const Field *other = m_table.find(name);
            if (!other || !other->isWritable())
                continue;
            const ExpectedChange change{other->name, now(other->name), other->initial};
            if (!change.before || !change.after)
                unknown.push_back(change);
            else if (change.before != change.after)
                registers.push_back(change);
        }
        if (registers.empty())
            return;
        registers.insert(registers.end(), unknown.begin(), unknown.end());
        add(ConsequenceKind::Resets,
            ConsequenceText::tr("A change of %1 puts these registers back to the defaults of the new mode.")
                .arg(m_field.name),
            std::move(registers));
    }

    void movesPosition()
    {
        const Field *position = m_table.find(Known::PresentPosition);
        const auto present = position ? now(position->name) : std::nullopt;
        const bool turns = isField(u"Drive Mode") && (((m_raw ^ m_old.value_or(m_raw)) >> ReverseBit) & 1) != 0;
        const bool offsets = isField(u"Homing Offset") && m_old;
        if (!present || (!turns && !offsets))
            return;
        const bool oneTurn = now(nameOf(Known::OperatingMode)) == PositionMode && m_table.resolution() > 0;
        const auto counts = [&](std::int64_t offset) {
            const std::int64_t most = m_table.resolution() / OffsetsPerTurn;
            return oneTurn && std::abs(offset) > most ? 0 : offset;
        };
        std::int64_t after = 0;
        if (turns) {
            const std::int64_t turn = std::max(1, m_table.resolution());
            after = 2 * counts(now(u"Homing Offset").value_or(0)) - *present;
            after = ((after % turn) + turn) % turn; // it counts its turns anew
        } else {
            after = *present + counts(m_raw) - counts(*m_old);
        }
        const QString from = said(*position, *present), to = said(*position, after);
        const QString text =
            turns ? ConsequenceText::tr(
                "Present Position counts the other way round: it will say about %2 where it says %1, and goals "
                "mean the other direction.")
                  : ConsequenceText::tr(
                      "Present Position will say about %2 where it says %1, %3 more, though nothing moves.");
        add(ConsequenceKind::MovesPosition,
            turns ? text.arg(from, to) : text.arg(from, to, said(*position, after - *present)),
            {{position->name, present, after}});
    }

    /// What lies within its range now and beyond it then.
    void goesBeyondLimits()
    {
        std::vector<ExpectedChange> beyond;
        const auto lookAt = [&](const Field &value, const Field &limited) {
            const auto raw = now(value.name);
            if (!raw || &value == &m_field || m_field.resets.contains(value.name))
                return;
            const EffectiveField before = effectively(limited);
            const EffectiveField after = effective(limited, [this](QStringView name) { return then(name); });
            const auto isIn = [&](const EffectiveField &range) {
                return (!range.minimum || *raw >= *range.minimum) && (!range.maximum || *raw <= *range.maximum);
            };
            if (isIn(before) && !isIn(after))
                beyond.push_back({value.name, raw, raw});
        };
        for (const Field &other : m_table.fields()) {
            if (!other.isWritable() || !limitingRegisters(other).contains(m_field.name))
                continue;
            lookAt(other, other);
            if (const Field *present = m_table.find(Known::PresentPosition);
                present && isNamed(other, u"Goal Position"))
                lookAt(*present, other);
        }
        if (beyond.empty())
            return;
        QStringList names;
        for (const ExpectedChange &one : beyond)
            names << ConsequenceText::tr("%1 (%2)").arg(one.name, said(*m_table.find(one.name), *one.before));
        add(ConsequenceKind::BeyondLimits,
            ConsequenceText::tr("Beyond what will be allowed then: %1.").arg(names.join(QStringLiteral(", "))),
            std::move(beyond));
    }
    static bool isNamed(const Field &field, QStringView name) { return field.name == name; }

    void turnsTorqueOn()
    {
        const bool byGoal = isGoal(m_field) && wakesNow();
        if (isTorqueOn() || !((isField(Known::TorqueEnable) && m_raw != 0) || byGoal))
            return;
        const Field *mode = modeRegister(m_table);
        const std::vector<RestingGoal> goals = restingGoalsOf(m_table);
        const RestingGoal *resting = restingGoalIn(goals, mode ? now(mode->name) : std::nullopt);
        const Field *goal = resting ? m_table.find(resting->name) : nullptr;
        const auto wanted = goal ? then(goal->name) : std::nullopt;
        if (!wanted)
            return;
        if (!resting->present) {
            const EffectiveField effect = effectively(*goal);
            if (signedFromRaw(effect, *wanted) != 0)
                add(ConsequenceKind::Turns,
                    ConsequenceText::tr("%1 is %2: the motor runs as soon as torque is on.")
                        .arg(goal->name, said(*goal, *wanted)),
                    {{goal->name, now(goal->name), wanted}});
            return;
        }
        const Field *position = m_table.find(Known::PresentPosition);
        const auto present = now(position->name);
        if (!present)
            return;
        const double degrees =
            physical(effectively(*position), m_table.resolution(), *wanted - *present, AngleUnit::Degrees).value;
        if (std::abs(degrees) < SmallJump)
            return;
        add(ConsequenceKind::Jumps,
            ConsequenceText::tr("The joint may jump by %1 as soon as torque is on: it is at %2, and its goal is %3.")
                .arg(said(*position, *wanted - *present), said(*position, *present), said(*goal, *wanted)),
            {{position->name, present, wanted}});
    }

    bool wakesNow() const
    {
        const Field *mode = m_table.find(u"Drive Mode");
        const bool hasBit =
            mode && std::ranges::find(mode->bits, TorqueOnByGoalBit, &BitField::first) != mode->bits.end();
        return hasBit && ((now(mode->name).value_or(0) >> TorqueOnByGoalBit) & 1) != 0;
    }

    void wakesByGoal()
    {
        if (isGoal(m_field) && wakesNow() && !isTorqueOn())
            add(ConsequenceKind::TorqueByGoal,
                ConsequenceText::tr("Writing %1 turns torque on, by bit 3 of Drive Mode.").arg(m_field.name),
                {{nameOf(Known::TorqueEnable).toString(), 0, 1}});
        const bool hasBit = std::ranges::find(m_field.bits, TorqueOnByGoalBit, &BitField::first) != m_field.bits.end();
        if (isField(u"Drive Mode") && hasBit && gainsBit(TorqueOnByGoalBit))
            add(ConsequenceKind::TorqueByGoal,
                ConsequenceText::tr("From then on any goal that is written turns torque on."));
    }

    void changesPlace()
    {
        if (isField(Known::Id))
            add(ConsequenceKind::ChangesPlace, ConsequenceText::tr("The device answers as ID %1 from then on, and no "
                                                                   "longer as its old one. If another device has that "
                                                                   "ID, both answer at once.")
                                                   .arg(m_raw));
        if (isField(Known::BaudRate)) {
            const auto rate = m_table.baudRate(static_cast<int>(m_raw));
            add(ConsequenceKind::ChangesPlace,
                rate ? ConsequenceText::tr(
                           "The device answers at %1 bps only from then on: a port that can't do that rate will not "
                           "find it.")
                           .arg(*rate)
                     : ConsequenceText::tr("Nobody knows which baud rate that is: the device may not be found again."));
        }
        if (isField(u"Protocol Type") && m_raw != ThisProtocol)
            add(ConsequenceKind::ChangesProtocol,
                ConsequenceText::tr(
                    "The device speaks another protocol from then on: this program will not find it again."));
    }

    void answersLess()
    {
        if (!isField(Known::StatusReturnLevel))
            return;
        if (m_raw == 0)
            add(ConsequenceKind::AnswersLess,
                ConsequenceText::tr("The device answers Ping alone from then on: none of its registers can be read."));
        else if (m_raw == 1)
            add(ConsequenceKind::AnswersLess,
                ConsequenceText::tr(
                    "The device no longer answers writes: that one was refused shows only when it is read back."));
    }

    void bitsOf()
    {
        QStringList lost, gained;
        for (const BitField &bit : m_field.bits) {
            const bool was = (m_old.value_or(0) & bit.mask()) != 0, will = (m_raw & bit.mask()) != 0;
            if (was && !will)
                lost << bit.name;
            if (!was && will)
                gained << bit.name;
        }
        if (isField(u"Shutdown") && !lost.empty())
            add(ConsequenceKind::LosesProtection,
                ConsequenceText::tr(
                    "These errors no longer turn torque off, and the motor is unprotected against them: %1.")
                    .arg(lost.join(QStringLiteral(", "))));
        if (isField(u"Startup Configuration") && !gained.empty())
            add(ConsequenceKind::StartsByItself,
                ConsequenceText::tr("By itself, as soon as power comes and before any program runs: %1.")
                    .arg(gained.join(QStringLiteral(", "))));
    }

    const ControlTable &m_table;
    const RegisterLookup &m_now;
    const Field &m_field;
    const std::int64_t m_raw;
    const UnitPreferences &m_units;
    std::optional<std::int64_t> m_old;
    std::vector<Consequence> m_all;
};

} // namespace

bool Consequence::isSerious() const
{
    switch (kind) {
    case ConsequenceKind::NeedsTorqueOff:
    case ConsequenceKind::Resets:
    case ConsequenceKind::Jumps:
    case ConsequenceKind::Turns:
    case ConsequenceKind::ChangesProtocol: return true;
    case ConsequenceKind::MovesPosition:
    case ConsequenceKind::BeyondLimits:
    case ConsequenceKind::TorqueByGoal:
    case ConsequenceKind::StartsByItself:
    case ConsequenceKind::ChangesPlace:
    case ConsequenceKind::AnswersLess:
    case ConsequenceKind::LosesProtection: break;
    }
    return false;
}

bool areSerious(const std::vector<Consequence> &consequences)
{
    return std::ranges::any_of(consequences, &Consequence::isSerious);
}

std::vector<Consequence> consequencesOf(const ControlTable &table, const RegisterLookup &now, const Field &field,
                                        std::int64_t raw, const UnitPreferences &units)
{
    return Outlook(table, now, field, raw, units).all();
}

QString changeText(const ControlTable &table, const RegisterLookup &now, const ExpectedChange &change,
                   const UnitPreferences &units)
{
    const Field *field = table.find(change.name);
    const auto text = [&](const std::optional<std::int64_t> &raw, const QString &unknown) {
        return raw && field ? valueText(*field, effective(*field, now), table.resolution(), *raw, units) : unknown;
    };
    return ConsequenceText::tr("%1: %2 → %3")
        .arg(change.name, text(change.before, ConsequenceText::tr("not read")),
             text(change.after, ConsequenceText::tr("its default")));
}

} // namespace dynascope
