// SPDX-License-Identifier: GPL-3.0-or-later
// A robot's profile: saved from the bus, compared with it, applied to it. What that means is in core/session/profile.
#include "app/dxl/commands.h"

#include "app/dxl/arguments.h"
#include "app/dxl/directjob.h"
#include "app/dxl/profilereport.h"
#include "app/dxl/target.h"
#include "app/dxl/terminal.h"
#include "core/session/moves.h"
#include "core/session/profile/profilesave.h"
#include "core/session/settings/settingsjournal.h"

#include <QFileInfo>

#include <algorithm>
#include <set>

namespace dynascope::dxl {
namespace {

constexpr char NothingWritten[] = "; nothing was written";

/// Which of the profile's joints are meant.
Result<std::set<std::size_t>> selected(const Work &work, const Profile &profile)
{
    std::set<std::size_t> joints;
    for (const QString &name : work.options.profile.joints) {
        const auto at = std::ranges::find(profile.joints, name, &ProfileJoint::name);
        if (at == profile.joints.end())
            return wrong(QStringLiteral("%1 has no joint \"%2\"").arg(profile.file, name));
        joints.insert(static_cast<std::size_t>(at - profile.joints.begin()));
    }
    return joints;
}

struct Loaded {
    Profile profile;
    std::set<std::size_t> joints; ///< empty: all
    bool takes(std::size_t joint) const { return joints.empty() || joints.contains(joint); }
};

Result<Loaded> load(const Work &work)
{
    auto profile = loadProfile(work.options.profile.file, work.catalog);
    if (!profile)
        return tl::unexpected(profile.error());
    auto joints = selected(work, *profile);
    if (!joints)
        return tl::unexpected(joints.error());
    return Loaded{std::move(*profile), std::move(*joints)};
}

Result<ProfileComparison> compare(const Work &work, const Profile &profile, bool quick)
{
    ProfileReadOptions options;
    options.looksForOthers = !quick;
    DirectJob job(work.bus);
    const auto reading = readForProfile(job, planProfileReading(profile, work.catalog, options), [&work](double done) {
        work.output.progress(done, QStringLiteral("reading"));
    });
    if (!reading)
        return tl::unexpected(reading.error());
    return compareProfile(profile, *reading, work.catalog);
}

ExitCode check(const Work &work, const Loaded &loaded)
{
    const bool isDiff = work.options.profile.action == ProfileAction::Diff;
    // Of some joints it is not asked who else is there.
    const auto comparison = compare(work, loaded.profile, work.options.profile.quick || !loaded.joints.empty());
    if (!comparison)
        return work.output.fail(comparison.error());
    bool isAsWanted = comparison->others.empty() && comparison->notes.isEmpty();
    for (const JointComparison &joint : comparison->joints) {
        if (!loaded.takes(joint.joint))
            continue;
        const bool isRight = joint.state == JointComparison::State::AsWanted;
        isAsWanted = isAsWanted && isRight;
        if (!isDiff || !isRight)
            showJoint(work.output, loaded.profile, joint, isDiff, !isDiff);
    }
    for (const Found &other : comparison->others)
        showOther(work.output, work.catalog, other);
    for (const QString &note : comparison->notes)
        work.output.note(note);
    return isAsWanted ? ExitCode::Done : ExitCode::Failed;
}

JournalEntry entryFor(const Work &work, const JointApply &joint)
{
    JournalEntry entry;
    entry.by = JournalAuthor::Profile;
    entry.device = journalDevice(joint.found, joint.table->model(), work.options.port);
    return entry;
}

bool mayGoOn(const Work &work, const QString &what)
{
    if (work.options.yes)
        return true;
    if (!isTerminal(stdin)) {
        work.output.refuse({ErrorKind::InvalidArgument,
                            QStringLiteral("%1: say --yes, since nobody can be asked here, or --dry-run to see it; "
                                           "nothing was written")
                                .arg(what)});
        return false;
    }
    if (answersYes(QStringLiteral("%1. Type yes to go on:").arg(what)))
        return true;
    work.output.note(QStringLiteral("nothing was written"));
    return false;
}

/// `dxl profile apply`.
class Apply
{
public:
    Apply(const Work &work, const Loaded &loaded) : m_work(work), m_loaded(loaded)
    {
        m_options.mayTurnTorqueOff = work.options.profile.torqueOff;
        m_options.putTorqueBack = work.options.profile.torqueBack;
        m_options.joints = loaded.joints;
    }

    ExitCode run()
    {
        if (moveFileOf(m_work.options).exists() && !m_work.options.profile.dryRun)
            return m_work.output.refuse(
                {ErrorKind::InvalidArgument,
                 QStringLiteral("moves on this line were left half done: dxl move --resume goes "
                                "on with them, --forget leaves it so; nothing was written")});
        if (const auto planned = plan(); !planned)
            return fail(planned.error());
        if (m_work.options.profile.dryRun || m_plan.differences() + m_moves.steps.size() == 0)
            return showPlan();
        if (m_plan.needsTorqueOff() && !m_options.mayTurnTorqueOff)
            return m_work.output.refuse({ErrorKind::InvalidArgument, torqueText() + QLatin1String(NothingWritten)});
        if (!m_work.options.yes)
            showPlan();
        if (!mayGoOn(m_work, QStringLiteral("%1 registers of %2 joints will be written%3")
                                 .arg(m_plan.differences())
                                 .arg(m_plan.joints.size())
                                 .arg(m_moves.isOver() ? QString() : QStringLiteral(", and joints moved"))))
            return ExitCode::Usage;
        if (const auto moved = move(); !moved)
            return fail(moved.error());
        return write();
    }

private:
    ExitCode fail(const Error &error) const
    {
        const bool isWrong = error.kind == ErrorKind::InvalidArgument;
        return isWrong ? m_work.output.refuse(error) : m_work.output.fail(error);
    }

    /// What differs now. `isQuick` as of compare().
    Result<void> planWrites(bool isQuick)
    {
        auto comparison = compare(m_work, m_loaded.profile, isQuick);
        if (!comparison)
            return tl::unexpected(comparison.error());
        m_comparison = std::move(*comparison);
        auto applied = planProfileApply(m_loaded.profile, m_comparison, m_options);
        if (!applied)
            return tl::unexpected(applied.error());
        m_plan = std::move(*applied);
        return {};
    }

    Result<void> plan()
    {
        // Who moves must not meet anybody.
        if (const auto planned = planWrites(!m_work.options.profile.move); !planned || !m_work.options.profile.move)
            return planned;
        DirectJob job(m_work.bus);
        const auto survey = surveyMoves(job, planProfileSurvey(m_comparison, m_work.catalog, m_options));
        if (!survey)
            return tl::unexpected(Error{survey.error().kind, survey.error().text + QLatin1String(NothingWritten)});
        auto moves = planProfileMoves(m_loaded.profile, m_comparison, m_work.catalog, *survey, m_options);
        if (!moves)
            return tl::unexpected(Error{moves.error().kind, moves.error().text + QLatin1String(NothingWritten)});
        m_moves = std::move(*moves);
        if (m_moves.isOver())
            return {};
        return checkMoves(job, m_moves);
    }

    QString torqueText() const
    {
        QStringList names;
        for (const JointApply &joint : m_plan.joints) {
            if (joint.needsTorqueOff)
                names << joint.name;
        }
        return QStringLiteral(
                   "torque of %1 is on and locks what has to be written; --torque-off turns it off, and what "
                   "a joint carries may fall")
            .arg(names.join(QStringLiteral(", ")));
    }

    bool willMove(const JointObstacle &obstacle) const
    {
        return !m_moves.isOver() && m_comparison.joints[obstacle.joint].state == JointComparison::State::AtOtherBaud;
    }

    ExitCode showObstacles() const
    {
        ExitCode code = ExitCode::Done;
        for (const JointObstacle &obstacle : m_plan.obstacles) {
            if (willMove(obstacle))
                continue;
            const bool isAway = m_comparison.joints[obstacle.joint].state == JointComparison::State::AtOtherBaud;
            code = m_work.output.fail(
                {ErrorKind::NotFound, QStringLiteral("%1: %2%3")
                                          .arg(obstacle.name, obstacle.why,
                                               isAway ? QStringLiteral("; --move brings it there") : QString())});
        }
        return code;
    }

    ExitCode showPlan() const
    {
        for (const MoveStep &step : m_moves.steps)
            showStep(step);
        for (const JointApply &joint : m_plan.joints)
            showPlanned(m_work.output, joint, m_comparison.joints[joint.joint]);
        const ExitCode code = showObstacles();
        if (m_plan.differences() + m_moves.steps.size() == 0 && code == ExitCode::Done)
            m_work.output.note(QStringLiteral("everything is as wanted; nothing was written"));
        return code;
    }

    void showStep(const MoveStep &step) const
    {
        Document document;
        document.add("joint", m_moves.devices[step.device].place.name)
            .add("id", qint64(step.from.id))
            .add("baud", qint64(step.from.baudRate))
            .add("now_id", qint64(step.to.id))
            .add("now_baud", qint64(step.to.baudRate));
        m_work.output.result(
            QStringLiteral("%1: %2 -> %3")
                .arg(m_moves.devices[step.device].place.name, placeText(step.from), placeText(step.to)),
            document);
    }

    /// Nothing of it has to be kept: a joint is found again at either rate.
    Result<void> move()
    {
        if (m_moves.isOver())
            return {};
        JournalNote note;
        MoveHooks hooks;
        hooks.save = [](const MovePlan &) { return Result<void>(); };
        hooks.begun = [&](const MoveStep &step) {
            const QString model = modelName(m_work.catalog, m_moves.devices[step.device].place.modelNumber);
            note = noteMoveStep(&m_work.journal, JournalAuthor::Profile, m_moves, step, model, m_work.options.port);
        };
        hooks.ended = [&](const MoveStep &step, const Result<Found> &found) {
            if (!found)
                return note.failed(found.error());
            note.moved(*found);
            if (m_work.options.yes)
                showStep(step);
        };
        DirectJob job(m_work.bus);
        if (const auto moved = moveDevices(job, m_moves, hooks); !moved)
            return moved;
        m_moves = {};
        return planWrites(true);
    }

    ExitCode write() const
    {
        ProfileApplyHooks hooks;
        hooks.writes = [this](const JointApply &joint) {
            return noted(&m_work.journal, entryFor(m_work, joint), joint.table);
        };
        hooks.ended = [this](const JointApply &joint, const Result<SettingsOutcome> &outcome) {
            showApplied(m_work.output, joint, outcome);
        };
        DirectJob job(m_work.bus);
        const ProfileOutcome outcome = applyProfile(job, m_plan, hooks);
        const ExitCode obstacles = showObstacles();
        if (outcome.isDone(m_plan))
            return obstacles;
        if (outcome.ended && outcome.joints.size() < m_plan.joints.size())
            m_work.output.note(QStringLiteral("%1 of %2 joints are done; the same once more goes on")
                                   .arg(outcome.joints.empty() ? 0 : outcome.joints.size() - 1)
                                   .arg(m_plan.joints.size()));
        return ExitCode::Failed;
    }

    const Work &m_work;
    const Loaded &m_loaded;
    ProfileApplyOptions m_options;
    ProfileComparison m_comparison;
    ProfileApplyPlan m_plan;
    MovePlan m_moves;
};

} // namespace

ExitCode profileCommand(const Work &work)
{
    work.output.expectMany();
    if (work.options.profile.action == ProfileAction::Save)
        return profileSaveCommand(work);
    const auto loaded = load(work);
    if (!loaded)
        return work.output.refuse(loaded.error());
    return work.options.profile.action == ProfileAction::Apply ? Apply(work, *loaded).run() : check(work, *loaded);
}

} // namespace dynascope::dxl
