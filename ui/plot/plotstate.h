// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/derived.h"
#include "core/session/session.h"
#include "core/session/trigger.h"

#include <vector>

namespace dynascope {

/// What is remembered of the plots from one start to the next.
struct PlotState {
    /// A trace by what its device is called on the wire: our own numbers don't outlive the program.
    struct Trace {
        QString line;
        int modelNumber = 0;
        int id = 0;
        QString field;
        int color = 0;
        bool visible = true;
        Derivation derivation = {}; ///< its `other` is named by the following
        QString otherLine = {};
        int otherModel = 0;
        int otherId = 0;
        QString otherField = {};

        /// The trace among these devices; nothing where they aren't all there.
        std::optional<TraceKey> find(const std::vector<Device *> &devices) const;
        static std::optional<Trace> of(const TraceKey &key, const Session &session);
        friend bool operator==(const Trace &, const Trace &) = default;
    };

    /// What a panel looks like besides its traces.
    struct Look {
        struct Axis { ///< by hand
            QString unit;
            double minimum = 0, maximum = 1;
            friend bool operator==(const Axis &, const Axis &) = default;
        };
        bool hasOwnTime = false;
        int spanSeconds = 10; ///< of its own time
        std::vector<Axis> axes;
        friend bool operator==(const Look &, const Look &) = default;
    };
    struct TriggerState {
        std::optional<Trace> trace; ///< nothing: never chosen, or an event
        double level = 0, hysteresis = 0; ///< in the unit shown
        TriggerSettings settings;
        friend bool operator==(const TriggerState &, const TriggerState &) = default;
    };

    static constexpr int Version = 2; ///< 1 had neither looks nor colours nor trigger
    int spanSeconds = 10;
    bool autoscale = true;
    std::vector<std::vector<Trace>> panels;
    std::vector<Look> looks;   ///< one for each panel
    std::vector<Trace> colors; ///< which colour a field had, shown or not
    TriggerState trigger;      ///< never armed by itself

    QByteArray toBytes() const;
    static std::optional<PlotState> fromBytes(const QByteArray &bytes); ///< nothing where they are damaged
};

} // namespace dynascope
