// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/commissioning/commissioning.h"

#include "core/session/commissioning/commissionjournal.h"
#include "core/session/commissioning/identify.h"
#include "core/session/moves.h"

namespace dynascope {

Commissioning::Commissioning(Commands &commands, LineSession &line, const QString &folder, QObject *parent)
    : QObject(parent)
    , m_commands(commands)
    , m_line(&line)
    , m_folder(folder)
{
}

Commissioning::~Commissioning()
{
    for (const JobId job : {m_job, m_light}) {
        if (job && m_line)
            m_line->bus().cancel(job);
    }
}

void Commissioning::start(CommissionList list, const CommissionOptions &options)
{
    edit([this, list, options] {
        m_list = list;
        m_options = options;
        m_memory = {};
        m_problem.clear();
        m_found.reset();
    });
    resume();
}

void Commissioning::resume()
{
    if (m_state == State::Running && !m_stops)
        return;
    if (!m_line || m_line->state() != BusThread::State::Open)
        return end(tr("The line is not open"));
    if (m_commands.isStopped())
        return end(tr("STOP is held: release it before servos are set up"));
    m_stops = false;
    m_state = State::Running;
    m_problem.clear();
    if (!m_job)
        round();
    else
        emit changed();
}

void Commissioning::stop()
{
    if (m_state != State::Running)
        return;
    m_stops = true;
    if (m_job && m_line)
        m_line->bus().cancel(m_job);
}

/// The list belongs to the round while one is under way.
void Commissioning::edit(std::function<void()> change)
{
    if (!m_job) {
        change();
        emit changed();
        return;
    }
    m_edits.push_back(std::move(change));
    if (m_line)
        m_line->bus().cancel(m_job);
}

void Commissioning::skip()
{
    const auto next = m_list.next();
    edit([this, next] {
        if (next && m_list.state(*next) == CommissionState::Waiting)
            m_list.skip(*next);
        m_problem.clear();
    });
    if (!m_job && m_list.isOver())
        end({});
}

void Commissioning::reopen(std::size_t joint)
{
    edit([this, joint] {
        if (joint < m_list.size())
            m_list.reopen(joint);
    });
}

void Commissioning::takePresent()
{
    edit([this] {
        m_memory.bystanders.clear();
        m_options.takesPresent = true;
    });
}

void Commissioning::tryAgain()
{
    edit([this] {
        m_memory.troubles.clear();
        m_problem.clear();
    });
}

CommissionHooks Commissioning::hooks()
{
    CommissionHooks hooks;
    hooks.looking = [this, run = m_run](int baudRate) {
        if (run != m_run)
            return;
        m_lookingAt = baudRate;
        emit changed();
    };
    hooks.found = [this, run = m_run](const Found &found, std::size_t joint) {
        if (run != m_run)
            return;
        m_found = found;
        m_settingUp = joint;
        m_lookingAt = 0;
        emit changed();
    };
    hooks.ended = [this](const CommissionWrite &write, const CommissionWritten &outcome) { follow(write, outcome); };
    return notedAhead(m_commands.journal(), JournalAuthor::Window, m_line->name(), m_line->catalog(), std::move(hooks));
}

/// The session's device goes where the servo went.
void Commissioning::follow(const CommissionWrite &write, const CommissionWritten &outcome)
{
    if (!m_line || !outcome.movedTo)
        return;
    Device *device = m_line->deviceAt(write.who.id, write.who.baudRate);
    if (device && device->modelNumber() == write.who.modelNumber)
        m_line->moveDevice(*device, *outcome.movedTo);
    else
        m_line->heard(*outcome.movedTo);
}

void Commissioning::round()
{
    if (!m_line)
        return end(tr("The line was closed"));
    ++m_run;
    const JournalDevice here = journalDevice(Found{}, {}, m_line->name());
    const CommissionRoundPlan plan{m_line->catalog(), m_list,    m_memory,    m_options,
                                   moveFileOf(m_line->name(), m_folder), here.line, here.adapter};
    m_job = m_line->bus().run<CommissionRound>(
        Priority::Scan, this,
        [plan, hooks = hooks()](JobContext &context) { return commissionRound(context, plan, posted(context, hooks)); },
        [this](const Result<CommissionRound> &ended) { roundEnded(ended); });
    emit changed();
}

void Commissioning::roundEnded(const Result<CommissionRound> &round)
{
    m_job = 0;
    m_lookingAt = 0;
    m_settingUp.reset();
    if (round) {
        m_list = round->list;
        m_memory = round->memory;
        m_problem = round->problem;
        m_found = round->found;
    }
    for (const auto &change : std::exchange(m_edits, {}))
        change();
    // A round that still waited when STOP came ends as one that was edited: cancelled.
    const bool stops = m_stops || m_commands.isStopped();
    if (!round) {
        const bool wasEdited = round.error().kind == ErrorKind::Cancelled && !stops && m_line
                               && m_line->state() == BusThread::State::Open;
        if (!wasEdited)
            return end(stops ? tr("Stopped: nothing more is written") : round.error().text);
    }
    const bool goesOn = !stops && m_state == State::Running && !m_list.isOver();
    for (const std::size_t joint : round ? round->ticked : std::vector<std::size_t>()) {
        const CommissionFacts &facts = m_list.facts(joint);
        Found found;
        found.id = static_cast<std::uint8_t>(facts.place.id);
        found.baudRate = facts.place.baudRate;
        found.modelNumber = static_cast<std::uint16_t>(facts.modelNumber);
        found.firmware = static_cast<std::uint8_t>(facts.firmware);
        m_line->heard(found);
        if (!facts.wasSo)
            identify(joint);
        emit ticked(static_cast<int>(joint));
    }
    if (goesOn)
        this->round();
    else
        end(stops ? tr("Stopped: nothing more is written") : QString());
}

void Commissioning::end(const QString &why)
{
    m_stops = false;
    m_state = State::Ended;
    m_lookingAt = 0;
    m_settingUp.reset();
    if (!why.isEmpty())
        m_problem = why;
    emit changed();
}

void Commissioning::identify(std::size_t joint)
{
    if (!m_line || joint >= m_list.size() || m_list.state(joint) != CommissionState::Done || m_light)
        return;
    const CommissionFacts &facts = m_list.facts(joint);
    const ControlTablePtr table = m_line->catalog().find(facts.modelNumber, facts.firmware);
    if (!table || !hasLed(*table))
        return;
    Found found;
    found.id = static_cast<std::uint8_t>(facts.place.id);
    found.baudRate = facts.place.baudRate;
    found.modelNumber = static_cast<std::uint16_t>(facts.modelNumber);
    found.firmware = static_cast<std::uint8_t>(facts.firmware);
    const CommissionHooks hooks
        = notedAhead(m_commands.journal(), JournalAuthor::Window, m_line->name(), m_line->catalog());
    m_lit = joint;
    m_light = m_line->bus().run<int>(
        Priority::Normal, this,
        [found, table, hooks](JobContext &context) -> Result<int> {
            const auto lit = identifyByLed(context, found, *table, posted(context, hooks));
            return lit ? Result<int>(0) : tl::unexpected(lit.error());
        },
        [this](const Result<int> &lit) {
            m_light = 0;
            m_lit.reset();
            if (!lit && lit.error().kind != ErrorKind::Cancelled && lit.error().kind != ErrorKind::Stopped)
                emit failed(lit.error().text);
            emit changed();
        });
    emit changed();
}

} // namespace dynascope
