// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/commissioning/bringin.h"

#include "core/bus/operations.h"
#include "core/session/deviceplace.h"
#include "core/session/journal/journalwrites.h"
#include "core/session/procedures/atbaud.h"
#include "core/session/procedures/movedevices.h"
#include "core/session/settings/applysettings.h"
#include "core/session/texts.h"
#include "core/session/volatilespan.h"

#include <algorithm>

namespace dynascope {
namespace {

constexpr int LooksByReads = 3; ///< each of two reads at least

tl::unexpected<Error> untouched(ErrorKind kind, const QString &why)
{
    return failure(kind, why.endsWith(CommissioningText::tr("nothing was written"))
                             ? why
                             : CommissioningText::tr("%1; nothing was written").arg(why));
}

tl::unexpected<Error> untouched(const Error &error)
{
    return endsAll(error) ? tl::unexpected(error) : untouched(error.kind, error.text);
}

/// One servo on its way to its place.
class BringingIn
{
public:
    BringingIn(JobContext &context, const BringIn &what)
        : m_context(context), m_what(what), m_joint(what.plan.list.joint(what.joint)),
          m_table(what.plan.catalog.find(what.found.modelNumber, what.found.firmware)), m_now(what.found)
    {
    }

    Result<CommissionFacts> run(bool &hasWritten)
    {
        for (const auto check : {&BringingIn::checkKind, &BringingIn::checkAlone, &BringingIn::planMove,
                                 &BringingIn::checkSettings, &BringingIn::checkTorque}) {
            if (const auto fine = (this->*check)(); !fine)
                return untouched(fine.error());
        }
        for (const auto act : {&BringingIn::turnTorqueOff, &BringingIn::move, &BringingIn::setUp}) {
            const auto done = (this->*act)();
            hasWritten = m_hasWritten;
            if (!done)
                return tl::unexpected(done.error());
        }
        if (const auto same = readBack(); !same)
            return tl::unexpected(same.error());
        return CommissionFacts{m_now.modelNumber, m_now.firmware, {m_what.found.baudRate, m_what.found.id},
                               m_joint.place,     !m_hasWritten,  QDateTime::currentDateTimeUtc()};
    }

    Result<bool> isAsWanted()
    {
        if (const auto fine = checkKind(); !fine)
            return false;
        if (MovePlace{m_now.baudRate, m_now.id} != m_joint.place)
            return false;
        const auto differences = compare();
        if (!differences)
            return endsAll(differences.error()) ? Result<bool>(tl::unexpected(differences.error())) : false;
        return *differences == 0;
    }

private:
    QString name() const { return QStringLiteral("%1 (%2)").arg(m_table->model(), jointText(m_joint)); }
    DevicePlace placeNow() const { return placeOf(m_now, *m_table, name()); }

    Result<void> checkKind()
    {
        const QString unfit = unfitText(m_joint, m_now.modelNumber, m_now.firmware, m_what.plan.catalog);
        if (!unfit.isEmpty())
            return untouched(ErrorKind::InvalidArgument, unfit);
        return m_table ? Result<void>()
                       : untouched(ErrorKind::NotSupported, CommissioningText::tr("its registers are not known"));
    }

    /// Also that its registers can be read at all.
    Result<void> checkAlone()
    {
        const auto doubt = doubtByReads(m_context, m_now, *m_table);
        if (!doubt)
            return tl::unexpected(doubt.error());
        return doubt->isEmpty() ? Result<void>() : untouched(ErrorKind::NotConfirmed, *doubt);
    }

    /// −1: it answers to no other; the error of the bus where nobody knows.
    Result<int> secondaryIdOf(const Found &found, const ControlTable &table)
    {
        const Field *field = table.find(Known::SecondaryId);
        if (!field)
            return -1;
        const auto values = readSpans(m_context, {placeOf(found, table, name()), {{found.id, field->address, 1}}});
        if (!values)
            return tl::unexpected(values.error());
        return !values->empty() && values->front().data.front() <= MaximumId ? values->front().data.front() : -1;
    }

    Result<void> planMove()
    {
        std::vector<MoveDevice> devices{moveDevice(m_now, *m_table, name())};
        devices.front().goal = m_joint.place;
        for (const Found &other : m_what.others) {
            const ControlTablePtr table = m_what.plan.catalog.find(other.modelNumber, other.firmware);
            const QString model = modelName(m_what.plan.catalog, other.modelNumber);
            MoveDevice device;
            if (table)
                device = moveDevice(other, *table, QStringLiteral("%1 (ID %2)").arg(model).arg(other.id));
            device.place.id = other.id;
            device.place.baudRate = other.baudRate;
            device.goal = {other.baudRate, other.id};
            if (table) {
                const auto secondary = secondaryIdOf(other, *table);
                if (!secondary)
                    return tl::unexpected(secondary.error());
                device.secondaryId = *secondary;
            }
            devices.push_back(std::move(device));
        }
        const auto secondary = secondaryIdOf(m_now, *m_table);
        if (!secondary)
            return tl::unexpected(secondary.error());
        devices.front().secondaryId = *secondary;
        auto plan = planMoves(std::move(devices));
        if (!plan)
            return tl::unexpected(plan.error());
        m_moves = std::move(*plan);
        m_moves.line = m_what.plan.line;
        m_moves.adapter = m_what.plan.adapter;
        if (!m_moves.isOver()) { // what others began meanwhile keeps its file
            if (const auto left = leftHalfDone(m_what.plan); !left)
                return tl::unexpected(left.error());
        }
        return checkMoves(m_context, m_moves);
    }

    Result<SettingsPlan> settingsPlan(bool compareOnly) const
    {
        const auto wanted = wantedSettings(m_joint, *m_table);
        if (!wanted)
            return tl::unexpected(wanted.error());
        SettingsOptions options;
        options.mayTurnTorqueOff = m_what.plan.options.mayTurnTorqueOff;
        options.compareOnly = compareOnly;
        for (const Found &other : m_what.others)
            options.otherIds.insert(other.id);
        return planSettings(*m_table, placeNow(), m_now.firmware, *wanted, options);
    }

    /// How many settings differ; also whether they could be written.
    Result<std::size_t> compare()
    {
        if (m_joint.settings.empty())
            return std::size_t(0);
        const auto plan = settingsPlan(true);
        if (!plan)
            return tl::unexpected(plan.error());
        const auto outcome = applySettings(m_context, *plan);
        if (!outcome)
            return tl::unexpected(outcome.error());
        if (outcome->missing != Consent::None)
            return failure(ErrorKind::InvalidArgument, outcome->why);
        return outcome->count(SettingState::Differs);
    }

    Result<void> checkSettings()
    {
        const auto differences = compare();
        return differences ? Result<void>() : tl::unexpected(differences.error());
    }

    Result<void> checkTorque()
    {
        const Field *torque = m_table->find(Known::TorqueEnable);
        if (!torque || m_moves.isOver())
            return {};
        const auto values = readSpans(m_context, {placeNow(), {{m_now.id, torque->address, 1}}});
        if (!values)
            return tl::unexpected(values.error());
        m_torque = !values->empty() && values->front().data.front() != 0;
        if (m_torque && !m_what.plan.options.mayTurnTorqueOff)
            return untouched(ErrorKind::InvalidArgument,
                             CommissioningText::tr("%1 is under torque, which locks its EEPROM").arg(m_table->model()));
        return {};
    }

    Result<void> turnTorqueOff()
    {
        if (!m_torque)
            return {};
        const Field *torque = m_table->find(Known::TorqueEnable);
        const CommissionWrite write{m_now, changeOf(*torque, std::int64_t(0))};
        begin(write);
        const auto written = writeField(m_context, {placeNow(), {m_now.id, torque->address, {0}}, {}});
        const auto after = written ? written->after : tl::unexpected(written.error());
        end(write, after);
        return after ? Result<void>() : tl::unexpected(after.error());
    }

    void begin(const CommissionWrite &write)
    {
        m_hasWritten = true;
        if (m_what.hooks.begun)
            m_what.hooks.begun(write);
    }
    void end(const CommissionWrite &write, const Result<std::vector<PollValue>> &after,
             std::span<const PollValue> before = {})
    {
        if (!m_what.hooks.ended)
            return;
        CommissionWritten outcome;
        if (after)
            outcome.after = *after;
        else
            outcome.error = after.error();
        outcome.before.assign(before.begin(), before.end());
        m_what.hooks.ended(write, outcome);
    }

    CommissionWrite writeOf(const MoveStep &step) const
    {
        const MoveDevice &device = m_moves.devices.front();
        const auto code = [&device](int rate) {
            const auto at = std::ranges::find(device.rates, rate, &std::pair<int, int>::first);
            return static_cast<std::uint8_t>(at == device.rates.end() ? 0 : at->second);
        };
        const auto id = [](const MovePlace &place) { return static_cast<std::uint8_t>(place.id); };
        CommissionWrite write{m_now, {}};
        write.who.id = id(step.from);
        write.who.baudRate = step.from.baudRate;
        write.change.name = nameOf(step.isBaud() ? Known::BaudRate : Known::Id).toString();
        write.change.address = step.isBaud() ? device.baudAddress : device.idAddress;
        write.change.before = {step.isBaud() ? code(step.from.baudRate) : id(step.from)};
        write.change.after = {step.isBaud() ? code(step.to.baudRate) : id(step.to)};
        return write;
    }

    Result<void> move()
    {
        if (m_moves.isOver())
            return {};
        MoveHooks hooks;
        // Until it is ticked off the file stays: where it stops is where the next start looks.
        hooks.save = [this](const MovePlan &plan) {
            return plan.isOver() ? Result<void>() : m_what.plan.file.save(plan);
        };
        hooks.begun = [this](const MoveStep &step) { begin(writeOf(step)); };
        hooks.ended = [this](const MoveStep &step, const Result<Found> &found) {
            CommissionWritten outcome;
            if (found)
                outcome.movedTo = m_now = *found;
            else
                outcome.error = found.error();
            CommissionWrite write = writeOf(step);
            if (m_what.hooks.ended)
                m_what.hooks.ended(write, outcome);
        };
        return moveDevices(m_context, m_moves, hooks);
    }

    Result<void> setUp()
    {
        if (m_joint.settings.empty())
            return {};
        const auto plan = settingsPlan(false);
        if (!plan)
            return tl::unexpected(plan.error());
        const auto writeOfSetting = [this](const SettingsWrite &write) {
            return CommissionWrite{
                m_now, {write.name, write.where.address, write.where.isSigned, write.before, write.to, {}}};
        };
        SettingsHooks hooks;
        hooks.begun = [&](const SettingsWrite &write) { begin(writeOfSetting(write)); };
        hooks.ended = [&](const SettingsWrite &write, std::span<const PollValue> before,
                          const Result<std::vector<PollValue>> &after) { end(writeOfSetting(write), after, before); };
        const auto outcome = applySettings(m_context, *plan, hooks);
        const Result<void> done = outcome ? problemOf(*outcome) : tl::unexpected(outcome.error());
        if (done || endsAll(done.error()))
            return done;
        return failure(done.error().kind, CommissioningText::tr("It stands at its place (%1), but is not set up: %2")
                                              .arg(placeText(m_joint.place), done.error().text));
    }

    static Result<void> problemOf(const SettingsOutcome &outcome)
    {
        if (outcome.isDone())
            return {};
        if (outcome.ended)
            return tl::unexpected(*outcome.ended);
        for (const SettingResult &result : outcome.results) {
            if (result.state == SettingState::Failed)
                return failure(ErrorKind::NotConfirmed, result.why);
        }
        return failure(ErrorKind::InvalidArgument, outcome.why);
    }

    /// Who answers at the place now, what it says of itself, and that it still is one.
    Result<void> readBack()
    {
        const auto there = look(m_context, placeNow());
        if (!there)
            return tl::unexpected(there.error());
        const Field *id = m_table->find(Known::Id);
        const Field *baud = m_table->find(Known::BaudRate);
        const auto values = readSpans(
            m_context, {placeNow(), {{m_now.id, id->address, 1}, {m_now.id, baud ? baud->address : id->address, 1}}});
        if (!values)
            return tl::unexpected(values.error());
        const bool isSame = there->modelNumber == m_now.modelNumber && there->firmware == m_now.firmware
                            && values->size() == 2 && values->front().data.front() == m_joint.place.id
                            && (!baud || m_table->baudRate(values->back().data.front()) == m_joint.place.baudRate);
        if (!isSame)
            return failure(ErrorKind::NotConfirmed, CommissioningText::tr("What answers at %1 does not read back as %2")
                                                        .arg(placeText(m_joint.place), name()));
        const auto doubt = doubtByReads(m_context, m_now, *m_table);
        if (!doubt)
            return tl::unexpected(doubt.error());
        return doubt->isEmpty() ? Result<void>() : failure(ErrorKind::NotConfirmed, *doubt);
    }

    JobContext &m_context;
    const BringIn &m_what;
    const CommissionJoint &m_joint;
    ControlTablePtr m_table;
    Found m_now;
    MovePlan m_moves;
    bool m_torque = false, m_hasWritten = false;
};

} // namespace

Result<QString> doubtByReads(JobContext &context, const Found &found, const ControlTable &table)
{
    const auto span = restingSpanOf(table);
    if (!span)
        return QString();
    const AtBaud there(context.bus(), found.baudRate);
    if (!there.entered())
        return tl::unexpected(there.entered().error());
    for (int i = 0; i < LooksByReads; ++i) {
        auto doubt = compareReads(context.bus(), found, *span, [&context] { return context.checkpoint(); });
        if (!doubt || !doubt->isEmpty())
            return doubt;
    }
    return QString();
}

Result<bool> isAsWanted(JobContext &context, const BringIn &what)
{
    return BringingIn(context, what).isAsWanted();
}

Result<CommissionFacts> bringIn(JobContext &context, const BringIn &what, bool &hasWritten)
{
    return BringingIn(context, what).run(hasWritten);
}

Result<std::optional<CommissionMemory::HalfDone>> leftHalfDone(const CommissionRoundPlan &plan)
{
    if (!plan.file.exists())
        return std::optional<CommissionMemory::HalfDone>();
    const auto left = plan.file.load();
    if (!left)
        return tl::unexpected(left.error());
    const auto isOther = [&left](const MoveStep &step) { return step.device != left->steps.front().device; };
    const bool isOne = !left->steps.empty() && std::ranges::none_of(left->steps, isOther);
    const MoveDevice *device = isOne ? &left->devices[left->steps.front().device] : nullptr;
    if (!device || !plan.list.at(device->goal, device->place.modelNumber, CommissionState::Waiting)) {
        return failure(ErrorKind::InvalidArgument,
                       CommissioningText::tr(
                           "On this line %1; that has to be ended first: dxl move --resume goes on with them, --forget "
                           "leaves them so")
                           .arg(unfinishedText(*left)));
    }
    const MoveStep &step = left->steps[std::min(left->next, left->steps.size() - 1)];
    return std::optional(CommissionMemory::HalfDone{step.from, step.to, device->goal, device->place.modelNumber});
}

} // namespace dynascope
