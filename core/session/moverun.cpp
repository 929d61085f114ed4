// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/moverun.h"

#include "core/table/catalog.h"

#include <QTimer>

#include <algorithm>

namespace dynascope {
namespace {

DevicePlace placeAt(const MoveDevice &device, const MovePlace &place)
{
    DevicePlace there = device.place;
    there.id = static_cast<std::uint8_t>(place.id);
    there.baudRate = place.baudRate;
    return there;
}

} // namespace

MoveRun::MoveRun(Session &session, Commands &commands, LineSession &line, const QString &folder, QObject *parent)
    : QObject(parent)
    , m_session(session)
    , m_commands(commands)
    , m_line(&line)
    , m_file(moveFileOf(line.name(), folder))
    , m_rates{line.baudRate()}
{
}

void MoveRun::set(State state, const QString &problem)
{
    m_state = state;
    m_problem = problem;
    emit changed();
}

Result<void> MoveRun::mayBegin() const
{
    if (!m_line || m_line->state() != BusThread::State::Open)
        return failure(ErrorKind::PortLost, tr("The line is not open"));
    if (m_commands.isStopped())
        return failure(ErrorKind::Stopped, tr("STOP is held: release it before devices are moved"));
    return {};
}

void MoveRun::survey()
{
    if (isBusy() || !m_line || m_line->state() != BusThread::State::Open)
        return;
    MoveSurveyPlan plan;
    std::set<int> rates;
    std::vector<DeviceKey> keys;
    for (const auto &device : m_line->devices()) {
        for (const BaudCode &code : device->table().description().baudCodes)
            rates.insert(code.rate);
        const Field *secondary = device->table().find(Known::SecondaryId);
        if (!secondary || device->state() == Device::State::Silent)
            continue;
        plan.secondaries.push_back({placeOf(*device), secondary->address});
        keys.push_back(device->key());
    }
    plan.rates.assign(rates.begin(), rates.end());
    const State before = m_state;
    set(State::Looking);
    m_job = m_line->bus().run<MoveSurvey>(
        Priority::Click, this, [plan](JobContext &context) { return surveyMoves(context, plan); },
        [this, keys, before](const Result<MoveSurvey> &found) {
            m_job = 0;
            for (std::size_t i = 0; found && i < keys.size(); ++i) {
                Device *device = m_session.device(keys[i]);
                if (device && found->secondaries[i])
                    device->takeReadBack(device->table().indexOf(Known::SecondaryId), *found->secondaries[i]);
            }
            m_isSurveyed = found.has_value();
            if (found)
                m_rates = found->rates;
            set(before, found ? QString() : found.error().text);
        });
}

Result<MovePlan> MoveRun::planFor(const std::map<DeviceKey, MovePlace> &wishes) const
{
    if (!m_line)
        return failure(ErrorKind::PortLost, tr("The line is not open"));
    std::vector<MoveDevice> devices = moveDevicesOf(*m_line);
    for (std::size_t i = 0; i < devices.size(); ++i) {
        const Device &device = *m_line->devices()[i];
        const auto wish = wishes.find(device.key());
        if (wish != wishes.end())
            devices[i].goal = wish->second;
        if (!devices[i].moves())
            continue;
        if (!device.doubt().isEmpty())
            return failure(ErrorKind::InvalidArgument, tr("%1: %2").arg(device.displayName(), device.doubt()));
        if (!device.table().find(Known::Id) || devices[i].rates.empty())
            return failure(ErrorKind::NotSupported, tr("%1: its registers are not known").arg(device.displayName()));
        if (!offers(devices[i].goal.baudRate))
            return failure(ErrorKind::InvalidArgument, tr("The port does not do %1 bps").arg(devices[i].goal.baudRate));
    }
    auto plan = planMoves(std::move(devices));
    if (plan) {
        const JournalDevice here = journalDevice(Found{}, {}, m_line->name());
        plan->line = here.line;
        plan->adapter = here.adapter;
    }
    return plan;
}

void MoveRun::start(MovePlan plan)
{
    if (isBusy())
        return;
    if (m_file.exists())
        return set(m_state, tr("Moves on this line were left half done: go on with them, or forget them, first"));
    if (const auto may = mayBegin(); !may)
        return set(m_state, may.error().text);
    m_plan = std::move(plan);
    m_hasBegun = m_isNoted = false;
    m_isCancelled = false;
    check(true);
}

Result<void> MoveRun::takeLeft()
{
    auto left = m_file.load();
    if (!left)
        return tl::unexpected(left.error());
    if (const auto known = takeTables(*left, m_session.catalog()); !known)
        return known;
    m_plan = std::move(*left);
    m_hasBegun = true;
    m_isNoted = false;
    set(m_plan.isOver() ? State::Over : State::Halted);
    return {};
}

void MoveRun::look()
{
    if (const auto may = mayBegin(); !isBusy() && may)
        check(false);
}

void MoveRun::goOn(bool mayTurnTorqueOff)
{
    if (isBusy() || m_plan.isOver())
        return;
    if (const auto may = mayBegin(); !may)
        return set(m_state, may.error().text);
    m_plan.turnTorqueOff = m_plan.turnTorqueOff || mayTurnTorqueOff;
    m_isCancelled = false;
    check(true);
}

void MoveRun::check(bool goesOn)
{
    set(State::Looking);
    m_job = m_line->bus().run<MovePlan>(
        Priority::Click, this,
        [plan = m_plan](JobContext &context) mutable -> Result<MovePlan> {
            const auto fine = checkMoves(context, plan);
            if (!fine)
                return tl::unexpected(fine.error());
            return plan;
        },
        [this, goesOn](const Result<MovePlan> &plan) {
            m_job = 0;
            checked(plan, goesOn);
        });
}

void MoveRun::checked(const Result<MovePlan> &plan, bool goesOn)
{
    if (!plan)
        return halt(plan.error());
    if (plan->next > m_plan.next) { // the run that began it ended before it knew
        const MoveStep &step = m_plan.steps[m_plan.next];
        if (!m_isNoted)
            note(step).moved(foundAfter(m_plan, step));
        m_isNoted = false;
        follow(step, foundAfter(m_plan, step));
        m_plan.next = plan->next;
        m_hasBegun = true;
        (void)m_file.save(m_plan); // or the next look finds it once more
    }
    if (m_plan.isOver())
        return finish();
    if (goesOn && !m_isCancelled) {
        set(State::Moving);
        return step();
    }
    set(m_hasBegun ? State::Halted : State::Idle);
}

Device *MoveRun::deviceOf(const MoveStep &step) const
{
    const auto modelNumber = m_plan.devices[step.device].place.modelNumber;
    Device *device = m_line ? m_line->deviceAt(static_cast<std::uint8_t>(step.from.id), step.from.baudRate) : nullptr;
    return device && device->modelNumber() == modelNumber ? device : nullptr;
}

JournalNote MoveRun::note(const MoveStep &step) const
{
    const Device *device = deviceOf(step);
    const ControlTablePtr table = m_session.catalog().findOrRaw(m_plan.devices[step.device].place.modelNumber,
                                                                m_plan.devices[step.device].firmware);
    return noteMoveStep(m_commands.journal(), m_author, m_plan, step, table->model(), m_line->name(),
                        device && device->isTorqueOn());
}

void MoveRun::step()
{
    if (!m_line)
        return set(State::Halted, tr("The line was closed"));
    if (m_plan.isOver())
        return finish();
    if (m_isCancelled)
        return halt({ErrorKind::Cancelled, tr("Ended here, as you wanted")});
    if (const auto may = mayBegin(); !may)
        return halt(may.error());
    m_hasBegun = true;
    // The note first, then the job: killed between the two, the journal says that it was begun.
    m_line->bus().run<Found>(
        Priority::Click, this,
        [plan = m_plan, file = m_file](JobContext &context) mutable {
            MoveHooks hooks;
            hooks.save = [&file](const MovePlan &now) { return file.save(now); };
            return moveOne(context, plan, hooks);
        },
        [this, begun = note(m_plan.steps[m_plan.next])](const Result<Found> &found) { stepEnded(begun, found); });
}

void MoveRun::stepEnded(JournalNote note, const Result<Found> &found)
{
    if (!found) {
        note.failed(found.error());
        if (stateAfter(found.error()) == JournalState::Unconfirmed)
            return locate(found.error(), note);
        return halt(found.error());
    }
    note.moved(*found);
    follow(m_plan.steps[m_plan.next], *found);
    ++m_plan.next;
    emit changed();
    // Once polling has followed: what is asked at a place that another device takes next would be that one's answer.
    QTimer::singleShot(0, this, [this] { step(); });
}

/// Nobody knows yet whether the device took it: STOP came, or it was at neither place.
void MoveRun::locate(const Error &why, JournalNote note)
{
    if (!m_line || m_line->state() != BusThread::State::Open)
        return halt(why);
    const MoveStep step = m_plan.steps[m_plan.next];
    const MoveDevice &device = m_plan.devices[step.device];
    m_line->bus().run<Found>(
        Priority::Click, this,
        [from = placeAt(device, step.from), to = placeAt(device, step.to)](JobContext &context) {
            return lookForMoved(context, from, to);
        },
        [this, why, step, note](const Result<Found> &found) mutable {
            const bool pressedAgain =
                !found && (found.error().kind == ErrorKind::Stopped || found.error().kind == ErrorKind::Cancelled);
            if (pressedAgain && m_line && m_line->state() == BusThread::State::Open)
                return locate(why, note);
            if (!found) {
                if (Device *lost = deviceOf(step))
                    lost->setState(Device::State::Silent);
                return halt(found.error().kind == ErrorKind::NotConfirmed ? found.error() : why);
            }
            if (why.kind == ErrorKind::NotConfirmed && MovePlace{found->baudRate, found->id} == step.from)
                return halt(why); // which says so already
            const QString &name = m_plan.devices[step.device].place.name;
            const MovePlace place{found->baudRate, found->id};
            if (place == step.to) {
                note.moved(*found);
                m_isNoted = true;
                follow(step, *found); // the next look counts the step
            }
            const QString cause = why.kind == ErrorKind::Stopped ? tr("STOP ended the moves") : why.text;
            halt({why.kind, tr("%1; %2 is at %3").arg(cause, name, placeText(place))});
        });
}

void MoveRun::halt(const Error &why)
{
    const bool isUntouched = m_plan.next == 0 && stateAfter(why) == JournalState::Failed;
    if (m_hasBegun && isUntouched && !m_plan.steps.empty() && m_moved.empty()) { // the first step was refused
        m_file.remove();
        m_hasBegun = false;
    }
    if (m_hasBegun)
        (void)m_file.save(m_plan); // it is there already, with the step that was begun
    finish();
    set(m_hasBegun ? State::Halted : State::Idle, why.text);
}

void MoveRun::follow(const MoveStep &step, const Found &found)
{
    if (!m_line)
        return;
    if (Device *device = deviceOf(step)) {
        m_moved.insert(device->key());
        m_commands.moved(device->key(), found);
    } else {
        m_moved.insert(m_line->heard(found).key());
    }
}

/// The line goes where its devices went, if nobody is left where it works.
void MoveRun::finish()
{
    const bool isOver = m_plan.isOver();
    if (isOver)
        m_file.remove();
    if (m_line && m_line->state() == BusThread::State::Open) {
        std::map<int, int> there;
        for (const auto &device : m_line->devices())
            ++there[device->baudRate()];
        if (isOver && !there.contains(m_line->baudRate()) && !there.empty()) {
            const auto most = std::ranges::max_element(there, {}, &std::pair<const int, int>::second);
            m_line->setWorkingBaudRate(most->first);
        }
        for (const DeviceKey key : std::exchange(m_moved, {})) {
            if (Device *device = m_session.device(key))
                m_commands.readAll(*device);
        }
    }
    if (isOver)
        set(State::Over);
}

void MoveRun::cancel()
{
    m_isCancelled = true;
    if (m_job && m_line)
        m_line->bus().cancel(m_job);
}

void MoveRun::forget()
{
    if (isBusy())
        return;
    m_file.remove();
    m_plan = {};
    m_hasBegun = false;
    set(State::Idle);
}

} // namespace dynascope
