// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/profilerun.h"

#include "core/bus/operations.h"
#include "core/session/settings/settingsjournal.h"
#include "core/table/catalog.h"

#include <algorithm>
#include <utility>

namespace dynascope {
namespace {

/// What a joint did not take, or was left; empty: all is as wanted.
QString problemOf(const JointApply &joint, const SettingsOutcome &outcome)
{
    if (outcome.missing != Consent::None)
        return outcome.why;
    if (outcome.ended)
        return outcome.ended->text;
    QStringList texts;
    for (std::size_t i = 0; i < outcome.results.size(); ++i) {
        const SettingResult &result = outcome.results[i];
        const bool isWell = result.state == SettingState::Same || result.state == SettingState::Written;
        if (!isWell)
            texts << joint.settings.steps[i].name + QStringLiteral(": ") + result.why;
    }
    if (!outcome.torqueNote.isEmpty())
        texts << outcome.torqueNote;
    return texts.join(QStringLiteral("; "));
}

bool isLookingInVain(const Error &error)
{
    return error.kind == ErrorKind::Stopped || error.kind == ErrorKind::PortLost;
}

} // namespace

ProfileRun::ProfileRun(Session &session, Commands &commands, const QString &moveFolder, QObject *parent)
    : QObject(parent), m_session(session), m_commands(commands), m_moveFolder(moveFolder)
{
}

void ProfileRun::set(State state, const QString &problem)
{
    m_state = state;
    m_problem = problem;
    emit changed();
}

void ProfileRun::forgetComparison()
{
    m_comparison.reset();
    m_outcome.reset();
    m_joints.clear();
    m_moved = 0;
}

void ProfileRun::setLine(LineSession *line)
{
    if (isBusy() || line == m_line)
        return;
    m_line = line;
    forgetComparison();
    set(State::Idle);
}

bool ProfileRun::load(const QString &path)
{
    if (isBusy())
        return false;
    const auto text = profileText(path);
    const bool isSame = path == m_path && text && *text == m_text && m_profile;
    if (isSame)
        return true;
    m_path = path;
    m_text = text.value_or(QByteArray());
    m_profile.reset();
    m_fault.reset();
    forgetComparison();
    auto profile = text ? profileFromYaml(*text, path, m_session.catalog()) : tl::unexpected(text.error());
    if (profile)
        m_profile = std::move(*profile);
    else
        m_fault = profile.error();
    set(State::Idle);
    return m_profile.has_value();
}

void ProfileRun::compare(bool looksForOthers)
{
    if (isBusy() || m_path.isEmpty() || !load(m_path)) // it may have been edited meanwhile
        return;
    m_outcome.reset();
    m_joints.clear();
    read(looksForOthers, {});
}

void ProfileRun::read(bool looksForOthers, const QString &problem, Then then)
{
    if (!isLineOpen())
        return set(State::Idle, problem.isEmpty() ? tr("The line is not open") : problem);
    m_progress = 0;
    set(State::Comparing, problem);
    m_job = m_line->bus().run<Read>(Priority::Normal, this, readJob(looksForOthers),
                                    [this, problem, then = std::move(then)](const Result<Read> &read) {
                                        m_job = 0;
                                        if (!read)
                                            return set(State::Idle, problem.isEmpty() ? read.error().text : problem);
                                        m_comparison = read->comparison;
                                        m_survey = read->survey;
                                        then ? then() : set(State::Idle, problem);
                                    });
}

std::function<Result<ProfileRun::Read>(JobContext &)> ProfileRun::readJob(bool looksForOthers)
{
    ProfileReadOptions options;
    options.looksForOthers = looksForOthers;
    ProfileComparison known; // where nobody is asked anew who else is there
    if (!looksForOthers && m_comparison)
        known = *m_comparison;
    return [this, plan = planProfileReading(*m_profile, m_session.catalog(), options), known = std::move(known),
            profile = *m_profile, looksForOthers, &catalog = m_session.catalog()](JobContext &context) -> Result<Read> {
        const auto reading = readForProfile(context, plan, [this, &context](double done) {
            context.post([this, done] {
                m_progress = done;
                emit progressed();
            });
        });
        if (!reading)
            return tl::unexpected(reading.error());
        Read read{compareProfile(profile, *reading, catalog), {}};
        if (!looksForOthers) {
            read.comparison.others = known.others;
            read.comparison.notes = known.notes;
        }
        const auto survey = surveyMoves(context, planProfileSurvey(read.comparison, catalog, {}));
        if (!survey && endsAll(survey.error()))
            return tl::unexpected(survey.error());
        if (survey) // without it nobody is moved: planProfileMoves() says why
            read.survey = *survey;
        return read;
    };
}

Result<ProfileRun::Planned> ProfileRun::planFor(const ProfileApplyOptions &options, bool moves) const
{
    if (!m_profile || !m_comparison)
        return failure(ErrorKind::InvalidArgument, tr("Nothing was compared yet"));
    auto writes = planProfileApply(*m_profile, *m_comparison, options);
    if (!writes)
        return tl::unexpected(writes.error());
    Planned planned{std::move(*writes), {}};
    if (!moves)
        return planned;
    auto plan = planProfileMoves(*m_profile, *m_comparison, m_session.catalog(), m_survey, options);
    if (!plan)
        return tl::unexpected(plan.error());
    planned.moves = std::move(*plan);
    if (m_line) {
        const JournalDevice here = journalDevice(Found{}, {}, m_line->name());
        planned.moves.line = here.line;
        planned.moves.adapter = here.adapter;
    }
    return planned;
}

Result<void> ProfileRun::mayWrite() const
{
    if (!isLineOpen())
        return failure(ErrorKind::PortLost, tr("The line is not open"));
    if (m_commands.isStopped())
        return failure(ErrorKind::Stopped, tr("STOP is held: release it before a profile is applied"));
    if (moveFileOf(m_line->name(), m_moveFolder).exists())
        return failure(ErrorKind::InvalidArgument,
                       tr("Moves on this line were left half done: go on with them, or forget them, first"));
    return {};
}

void ProfileRun::apply(const ProfileApplyOptions &options, bool moves)
{
    if (isBusy())
        return;
    if (const auto may = mayWrite(); !may)
        return set(State::Idle, may.error().text);
    auto planned = planFor(options, moves);
    if (!planned)
        return set(State::Idle, planned.error().text);
    m_options = options;
    m_outcome.reset();
    m_moved = 0;
    m_joints.assign(m_profile->joints.size(), {});
    if (!planned->moves.isOver())
        return move(std::move(planned->moves));
    write(std::move(planned->writes));
}

void ProfileRun::move(MovePlan plan)
{
    m_moves = std::make_unique<MoveRun>(m_session, m_commands, *m_line, m_moveFolder);
    m_moves->setAuthor(JournalAuthor::Profile);
    connect(m_moves.get(), &MoveRun::changed, this, &ProfileRun::moveChanged);
    set(State::Moving);
    m_moves->start(std::move(plan));
}

void ProfileRun::moveChanged()
{
    if (!m_moves || m_moves->isBusy()) {
        emit changed();
        return;
    }
    MoveRun *run = m_moves.release();
    run->disconnect(this);
    run->deleteLater(); // it is telling us
    const QString problem = run->problem();
    const MoveRun::State state = run->state();
    if (state == MoveRun::State::Over) {
        m_moved = static_cast<std::size_t>(std::ranges::count_if(run->plan().devices, &MoveDevice::moves));
        return read(false, {}, [this] { writePlanned(); });
    }
    m_joints.clear();
    if (state == MoveRun::State::Halted)
        run->forget(); // a joint is found again at either rate
    if (state != MoveRun::State::Halted || m_commands.isStopped())
        return set(State::Idle, problem);
    read(false, problem);
}

/// Of what was read once everybody was at home.
void ProfileRun::writePlanned()
{
    auto planned = planFor(m_options, false);
    if (!planned)
        return set(State::Idle, planned.error().text);
    if (const auto may = mayWrite(); !may)
        return set(State::Idle, may.error().text);
    write(std::move(planned->writes));
}

void ProfileRun::write(ProfileApplyPlan plan)
{
    m_plan = std::move(plan);
    m_progress = 0;
    std::map<std::size_t, SettingsHooks> notes; // made here, where the journal is
    for (const JointApply &joint : m_plan.joints) {
        notes[joint.joint] = hooksFor(joint);
        m_joints[joint.joint].state = JointProgress::State::Waiting;
    }
    set(State::Applying);
    m_job = m_line->bus().run<ProfileOutcome>(
        Priority::Normal, this,
        [this, plan = m_plan, notes](JobContext &context) -> Result<ProfileOutcome> {
            ProfileApplyHooks hooks;
            hooks.begun = [this, &context](const JointApply &joint) {
                context.post([this, at = joint.joint] { jointBegun(at); });
            };
            hooks.writes = [&context, &notes](const JointApply &joint) {
                return posted(context, notes.at(joint.joint));
            };
            hooks.ended = [this, &context](const JointApply &joint, const Result<SettingsOutcome> &outcome) {
                context.post([this, joint, outcome] { jointEnded(joint, outcome); });
            };
            return applyProfile(context, plan, hooks);
        },
        [this](const Result<ProfileOutcome> &outcome) {
            m_job = 0;
            written(outcome);
        });
}

/// On the GUI thread: the journal, and the values of a device that the session knows, as they come.
SettingsHooks ProfileRun::hooksFor(const JointApply &joint)
{
    JournalEntry as;
    as.by = JournalAuthor::Profile;
    as.device = journalDevice(joint.found, joint.table->model(), m_line->name());
    SettingsHooks shown;
    shown.ended = [this, found = joint.found](const SettingsWrite &, std::span<const PollValue>,
                                              const Result<std::vector<PollValue>> &after) {
        Device *device = m_line ? m_line->deviceAt(found.id, found.baudRate) : nullptr;
        if (!device || device->modelNumber() != found.modelNumber || !after)
            return;
        for (const PollValue &value : *after)
            device->take(value);
    };
    return notedAhead(m_commands.journal(), as, joint.table, shown);
}

JointProgress ProfileRun::jointProgress(std::size_t joint) const
{
    return joint < m_joints.size() ? m_joints[joint] : JointProgress();
}

void ProfileRun::jointBegun(std::size_t joint)
{
    m_joints[joint].state = JointProgress::State::Writing;
    emit jointChanged(joint);
}

void ProfileRun::jointEnded(const JointApply &joint, const Result<SettingsOutcome> &outcome)
{
    JointProgress &progress = m_joints[joint.joint];
    progress.why = outcome ? problemOf(joint, *outcome) : outcome.error().text;
    progress.state = progress.why.isEmpty() ? JointProgress::State::Done : JointProgress::State::Failed;
    if (outcome) {
        progress.written = outcome->count(SettingState::Written);
        progress.torqueStaysOff = outcome->torqueStaysOff();
        showWritten(joint, *outcome);
        follow(joint, *outcome);
    }
    const auto ended = std::ranges::count_if(m_plan.joints, [this](const JointApply &each) {
        const JointProgress::State state = m_joints[each.joint].state;
        return state == JointProgress::State::Done || state == JointProgress::State::Failed;
    });
    m_progress = static_cast<double>(ended) / static_cast<double>(m_plan.joints.size());
    emit jointChanged(joint.joint);
    emit progressed();
}

/// Rows become as wanted by their read-back; all of them are read once more at the end.
void ProfileRun::showWritten(const JointApply &joint, const SettingsOutcome &outcome)
{
    JointComparison &shown = m_comparison->joints[joint.joint];
    for (std::size_t i = 0; i < outcome.results.size(); ++i) {
        const RegisterPlace &where = joint.settings.steps[i].where;
        const Field *field = joint.table->at(where.address);
        const auto row = std::ranges::find(shown.rows, field ? joint.table->indexOf(field) : -1,
                                           &RegisterComparison::field);
        if (row == shown.rows.end() || outcome.results[i].after.empty() || !row->wanted)
            continue;
        if (RegisterImage::numberOf(where, outcome.results[i].after) != row->wanted->raw)
            continue;
        row->held = row->wanted;
        row->heldAs = row->wantedAs;
        row->state = RegisterComparison::State::Same;
    }
    if (shown.state == JointComparison::State::Differs
        && shown.count(RegisterComparison::State::Same) == shown.rows.size())
        shown.state = JointComparison::State::AsWanted;
}

void ProfileRun::follow(const JointApply &joint, const SettingsOutcome &outcome)
{
    Device *device = m_line ? m_line->deviceAt(joint.found.id, joint.found.baudRate) : nullptr;
    if (!device || device->modelNumber() != joint.found.modelNumber)
        return;
    if (!outcome.ended)
        m_line->answered(*device);
    const int torque = device->table().indexOf(Known::TorqueEnable);
    if (torque >= 0 && outcome.torqueTurnedOff && !outcome.ended)
        device->takeReadBack(torque, outcome.torqueIsBack ? 1 : 0);
    else if (torque >= 0 && outcome.torqueTurnedOff)
        device->setUnconfirmed(torque, 0, outcome.ended->text);
    if (outcome.torqueIsBack)
        emit torqueTurnedOn(device->key());
}

void ProfileRun::written(const Result<ProfileOutcome> &outcome)
{
    for (const JointApply &joint : m_plan.joints) {
        JointProgress &progress = m_joints[joint.joint];
        if (progress.state == JointProgress::State::Waiting)
            progress.state = JointProgress::State::None;
    }
    if (!outcome) // it did not begin
        return set(State::Idle, outcome.error().text);
    m_outcome = *outcome;
    if (!outcome->ended)
        return read(false, {});
    const QString where = tr("%1; %2 of %3 joints are done. Apply it again to go on")
                              .arg(outcome->ended->text)
                              .arg(std::ranges::count(m_joints, JointProgress::State::Done, &JointProgress::state))
                              .arg(m_plan.joints.size());
    if (isLookingInVain(*outcome->ended))
        return set(State::Idle, where);
    read(false, where);
}

void ProfileRun::cancel()
{
    if (m_moves)
        m_moves->cancel();
    else if (m_job && m_line)
        m_line->bus().cancel(m_job);
}

} // namespace dynascope
