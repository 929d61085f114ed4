// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/jobcontext.h"
#include "core/session/commissioning/commissionlist.h"
#include "core/session/journal/journalentry.h"
#include "core/session/procedures/movefile.h"

namespace dynascope {

/// What is remembered from one round to the next. A value.
struct CommissionMemory {
    struct Device {
        MovePlace place;
        int modelNumber = 0;

        friend bool operator==(const Device &, const Device &) = default;
    };
    struct Trouble {
        Device device; ///< where it was found last
        int attempts = 0;
        QString why;
    };
    /// Of a program that was ended: where its servo is, one of the first two, and where it was to go.
    struct HalfDone {
        MovePlace from, to, goal;
        int modelNumber = 0;
    };
    bool hasLooked = false;         ///< once, with nothing in doubt
    std::vector<Device> bystanders; ///< answered before anything was plugged in: left alone
    std::vector<Device> theirs;     ///< answered then at a joint's own place: they need settings at most
    std::vector<Trouble> troubles;  ///< what failed after something may have been written, until it is gone or tried anew
    std::optional<HalfDone> halfDone;
};

struct CommissionOptions {
    bool mayTurnTorqueOff = false; ///< where it locks the EEPROM
    bool takesPresent = false;     ///< what answers at the start counts as just plugged in
};

/// One write, for the journal.
struct CommissionWrite {
    Found who; ///< where it stands before the write
    RegisterChange change;
    QString ahead = {}; ///< its key, where it was noted on the bus thread
};
struct CommissionWritten {
    std::optional<Error> error;
    std::optional<Found> movedTo; ///< after a change of ID or baud rate
    std::vector<PollValue> before, after;
};

/// Told on the bus thread; each may be empty.
struct CommissionHooks {
    std::function<void(int baudRate)> looking;
    std::function<void(const Found &found, std::size_t joint)> found; ///< this one becomes that joint
    std::function<QString(const CommissionWrite &write)> ahead; ///< called by posted(), before begun
    std::function<void(const CommissionWrite &write)> begun;
    std::function<void(const CommissionWrite &write, const CommissionWritten &outcome)> ended;
};

struct CommissionRoundPlan {
    const Catalog &catalog; ///< outlives the round
    CommissionList list;
    CommissionMemory memory;
    CommissionOptions options;
    MoveFile file; ///< what a program that is killed leaves for the next one
    QString line, adapter;
};

/// What one round came to.
struct CommissionRound {
    CommissionList list;
    CommissionMemory memory;
    std::vector<std::size_t> ticked; ///< joints, in this round
    std::vector<Found> heard;
    std::optional<Found> found; ///< the new one, where it is one alone
    QString problem;            ///< a sentence; empty: nothing is wrong
    bool hasWritten = false;
};

/// Looks who is there at every rate. Where exactly one servo is new and nothing is in doubt, it is checked, brought to
/// the place of its joint, set up, read back and ticked off. What stands as a joint shall be is ticked off as it is.
/// A doubt, a second new one, a wrong one: said in `problem`, and nothing is written.
///
/// Errors end commissioning: Stopped, Cancelled, PortLost; PortUnsuitable: the line can't do a wanted rate;
/// InvalidArgument: other moves of this line were left half done.
Result<CommissionRound> commissionRound(
    JobContext &context, const CommissionRoundPlan &plan, const CommissionHooks &hooks = {});

} // namespace dynascope
