// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/moverun.h"
#include "core/session/profile/profileapply.h"

namespace dynascope {

/// How far a joint is while a profile is applied.
struct JointProgress {
    /// None: nothing is written to it. Done: all is as wanted, read back. Failed: `why`; the same once more goes on.
    enum class State { None, Waiting, Writing, Done, Failed };
    State state = State::None;
    QString why;
    std::size_t written = 0; ///< registers
    bool torqueStaysOff = false;
};

/// One profile beside one line, as the window works with it: read, compared, applied. Jobs write and read, values come
/// back; the devices of the session follow, and every write is in the journal. GUI thread; owned by who shows it.
class ProfileRun : public QObject
{
    Q_OBJECT

public:
    enum class State { Idle, Comparing, Moving, Applying };
    /// What apply() would do: the moves first.
    struct Planned {
        ProfileApplyPlan writes;
        MovePlan moves;

        bool isNothing() const { return writes.joints.empty() && moves.isOver(); }
    };

    /// Both outlive this. `moveFolder` as for MoveRun.
    ProfileRun(Session &session, Commands &commands, const QString &moveFolder, QObject *parent = nullptr);

    /// What was compared on another line is forgotten. Nothing while it is busy.
    void setLine(LineSession *line);
    LineSession *line() const { return m_line; } ///< nullptr: none, or it is closed

    State state() const { return m_state; }
    bool isBusy() const { return m_state != State::Idle; }
    double progress() const { return m_progress; } ///< 0 to 1, of State::Comparing and Applying
    const QString &problem() const { return m_problem; } ///< why it came to its end, or was refused; empty: it is well

    /// Reads the file. What was known of another one is forgotten. Errors are in fault().
    bool load(const QString &path);
    const QString &path() const { return m_path; }
    const std::optional<Profile> &profile() const { return m_profile; } ///< nothing: no file, or it has faults
    const std::optional<Error> &fault() const { return m_fault; }       ///< BadFile: a line for each, "name:line:column: …"

    /// Reads the file anew, then the bus. `looksForOthers` costs up to 0.8 s for each of the profile's baud rates.
    void compare(bool looksForOthers = true);
    const std::optional<ProfileComparison> &comparison() const { return m_comparison; }

    /// The errors of planProfileApply() and planProfileMoves(). With `moves` joints at another baud rate come to theirs.
    Result<Planned> planFor(const ProfileApplyOptions &options, bool moves) const;
    /// Carries out what planFor() says, and compares again. Refused while STOP holds, and where moves on this line were
    /// left half done.
    void apply(const ProfileApplyOptions &options, bool moves);
    JointProgress jointProgress(std::size_t joint) const;
    /// Of the last apply(), as far as it came; nothing before the first since load().
    const std::optional<ProfileOutcome> &outcome() const { return m_outcome; }
    std::size_t moved() const { return m_moved; } ///< joints that the last apply() brought to their baud rate
    /// Before the next exchange, while it is applied before the next joint.
    void cancel();

signals:
    void changed();
    void progressed();                                ///< progress()
    void jointChanged(std::size_t joint);             ///< its progress, or its rows of the comparison
    void torqueTurnedOn(dynascope::DeviceKey device); ///< back after it had been turned off

private:
    void set(State state, const QString &problem = {});
    Result<void> mayWrite() const;
    bool isLineOpen() const { return m_line && m_line->state() == BusThread::State::Open; }
    void forgetComparison();
    using Then = std::function<void()>;
    struct Read {
        ProfileComparison comparison;
        MoveSurvey survey; ///< for planProfileMoves()
    };
    void read(bool looksForOthers, const QString &problem, Then then = {});
    std::function<Result<Read>(JobContext &)> readJob(bool looksForOthers);
    void move(MovePlan plan);
    void moveChanged();
    void writePlanned();
    void write(ProfileApplyPlan plan);
    SettingsHooks hooksFor(const JointApply &joint);
    void jointBegun(std::size_t joint);
    void jointEnded(const JointApply &joint, const Result<SettingsOutcome> &outcome);
    void showWritten(const JointApply &joint, const SettingsOutcome &outcome);
    void follow(const JointApply &joint, const SettingsOutcome &outcome);
    void written(const Result<ProfileOutcome> &outcome);

    Session &m_session;
    Commands &m_commands;
    QString m_moveFolder;
    QPointer<LineSession> m_line;
    State m_state = State::Idle;
    double m_progress = 0;
    QString m_problem, m_path;
    QByteArray m_text; ///< of the file, as it was read
    std::optional<Profile> m_profile;
    std::optional<Error> m_fault;
    std::optional<ProfileComparison> m_comparison;
    MoveSurvey m_survey;
    std::optional<ProfileOutcome> m_outcome;
    ProfileApplyOptions m_options; ///< of apply()
    ProfileApplyPlan m_plan;
    std::vector<JointProgress> m_joints;
    std::unique_ptr<MoveRun> m_moves;
    std::size_t m_moved = 0;
    JobId m_job = 0;
};

} // namespace dynascope
