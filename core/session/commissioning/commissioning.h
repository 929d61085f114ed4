// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/commands.h"
#include "core/session/commissioning/commissionround.h"

namespace dynascope {

/// Commissioning on one open line: round after round, each a job that gives way to a person's clicks. Every write is in
/// the journal, and the session's devices follow. GUI thread; owned by who shows it.
class Commissioning : public QObject
{
    Q_OBJECT

public:
    enum class State {
        Idle,    ///< nothing was begun
        Running, ///< looks, and writes where it may
        Ended,   ///< all are done or skipped, or it was stopped: problem() says why; go on by resume()
    };

    /// `commands` outlives this. `folder`: MoveFile::usualFolder(), or a test's.
    Commissioning(Commands &commands, LineSession &line, const QString &folder, QObject *parent = nullptr);
    ~Commissioning() override;

    LineSession *line() const { return m_line; } ///< nullptr once it is closed
    State state() const { return m_state; }
    const CommissionList &list() const { return m_list; }
    const CommissionMemory &memory() const { return m_memory; }
    const QString &problem() const { return m_problem; } ///< of the last round, a sentence; empty: none
    int lookingAt() const { return m_lookingAt; }        ///< bits per second; 0: not looking
    /// The joint whose servo is being set up now.
    std::optional<std::size_t> settingUp() const { return m_settingUp; }
    const std::optional<Found> &found() const { return m_found; } ///< the new one of the last round
    std::optional<std::size_t> lit() const { return m_lit; }      ///< the joint whose LED is lit

    /// @name A person's orders; those of the list take effect at once, between two writes
    /// @{
    void start(CommissionList list, const CommissionOptions &options);
    void stop();   ///< as soon as no change of place is in its middle
    void resume(); ///< where it was stopped
    void skip();   ///< the joint that is wanted now
    void reopen(std::size_t joint); ///< one that was done or skipped is wanted again
    void takePresent();             ///< one that was there before is the new one
    void tryAgain();                ///< what failed and was given up
    void identify(std::size_t joint); ///< lights its LED for a moment
    /// @}

signals:
    void changed();
    void ticked(int joint);
    void failed(const QString &why); ///< an LED could not be lit

private:
    void edit(std::function<void()> change);
    void round();
    void roundEnded(const Result<CommissionRound> &round);
    void end(const QString &why);
    void follow(const CommissionWrite &write, const CommissionWritten &outcome);
    CommissionHooks hooks();

    Commands &m_commands;
    QPointer<LineSession> m_line;
    QString m_folder;
    State m_state = State::Idle;
    CommissionList m_list;
    CommissionMemory m_memory;
    CommissionOptions m_options;
    QString m_problem;
    std::optional<Found> m_found;
    std::optional<std::size_t> m_settingUp, m_lit;
    int m_lookingAt = 0;
    JobId m_job = 0;   ///< the round
    JobId m_light = 0; ///< the LED
    int m_run = 0;     ///< notes of an earlier round are dropped by this
    std::vector<std::function<void()>> m_edits; ///< for when the round has ended
    bool m_stops = false;
};

} // namespace dynascope
