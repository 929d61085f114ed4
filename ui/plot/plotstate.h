// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/derived.h"
#include "core/session/session.h"

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

    int spanSeconds = 10;
    bool autoscale = true;
    std::vector<std::vector<Trace>> panels;

    QByteArray toBytes() const;
    static std::optional<PlotState> fromBytes(const QByteArray &bytes); ///< nothing where they are damaged
};

} // namespace dynascope
