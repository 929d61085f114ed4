// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/commands.h"
#include "core/session/moves.h"

namespace dynascope {

/// Carries a plan of moves out on one open line, step by step, each a job of its own: STOP and a person get in between.
/// Each step is in the file that `dxl move` keeps, too, before it begins, and in the journal; the devices of the session
/// follow. GUI thread; owned by who shows it. What ends in its middle stays in the file.
class MoveRun : public QObject
{
    Q_OBJECT

public:
    enum class State {
        Idle,    ///< nothing was written
        Looking, ///< surveys or checks; nothing is written
        Moving,
        Halted, ///< in its middle, or left so by another run: problem() says why, goOn() goes on
        Over,
    };

    /// `session` and `commands` outlive this. `folder`: MoveFile::usualFolder(), or a test's.
    MoveRun(Session &session, Commands &commands, LineSession &line, const QString &folder, QObject *parent = nullptr);

    void setAuthor(JournalAuthor author) { m_author = author; } ///< who moves, for the journal; else Window
    LineSession *line() const { return m_line; } ///< nullptr once it is closed
    State state() const { return m_state; }
    bool isBusy() const { return m_state == State::Looking || m_state == State::Moving; }
    const MovePlan &plan() const { return m_plan; } ///< that of start() or takeLeft(), brought up to date
    const QString &problem() const { return m_problem; }
    void dismissProblem() { m_problem.clear(); }
    const MoveFile &file() const { return m_file; }

    /// Tries the rates of these models on the port, and asks for the Secondary IDs: before the first planFor().
    void survey();
    bool isSurveyed() const { return m_isSurveyed; }
    bool offers(int baudRate) const { return m_rates.contains(baudRate); } ///< the port does, as tried by survey()

    /// The order for these wishes, nothing asked; InvalidArgument or NotSupported with the reason.
    Result<MovePlan> planFor(const std::map<DeviceKey, MovePlace> &wishes) const;
    /// Looks, then moves. Refused where an earlier plan of this line was left in its middle.
    void start(MovePlan plan);

    /// What another run left: State is Halted afterwards. NotFound, BadFile.
    Result<void> takeLeft();
    void look();                      ///< where the devices of what was left are now; moves nobody
    void goOn(bool mayTurnTorqueOff); ///< looks, then moves on
    void cancel();                    ///< before the next step
    void forget();                    ///< leaves everybody where they are, and removes the file

signals:
    void changed();

private:
    void set(State state, const QString &problem = {});
    Result<void> mayBegin() const;
    void check(bool goesOn);
    void checked(const Result<MovePlan> &plan, bool goesOn);
    void step();
    void stepEnded(JournalNote note, const Result<Found> &found);
    void locate(const Error &why, JournalNote note);
    void halt(const Error &why);
    void follow(const MoveStep &step, const Found &found);
    void finish();
    Device *deviceOf(const MoveStep &step) const;
    JournalNote note(const MoveStep &step) const;

    Session &m_session;
    Commands &m_commands;
    QPointer<LineSession> m_line;
    MoveFile m_file;
    JournalAuthor m_author = JournalAuthor::Window;
    State m_state = State::Idle;
    QString m_problem;
    MovePlan m_plan;
    std::set<int> m_rates;
    std::set<DeviceKey> m_moved; ///< to be read anew
    bool m_isSurveyed = false, m_isCancelled = false;
    bool m_hasBegun = false; ///< something was written, or may have been
    bool m_isNoted = false;  ///< that the step `m_plan.next` was done is in the journal, though not counted yet
    JobId m_job = 0;         ///< of State::Looking
};

} // namespace dynascope
