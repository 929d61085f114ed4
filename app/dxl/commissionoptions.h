// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/result.h"

#include <QStringList>

#include <memory>
#include <vector>

namespace CLI {
class App;
}

namespace dynascope::dxl {

/// What `dxl commission` was told: a model with IDs, or a profile.
struct CommissionWishes {
    QString model;
    std::vector<int> ids;
    QStringList names; ///< one for each ID, or none
    int firmware = 0;  ///< at least
    QString profile;   ///< a file
    QString labels;    ///< a file; empty: none
    bool turnTorqueOff = false;
    bool takesPresent = false; ///< what answers at the start counts as plugged in
    bool lightsLed = true;
};

/// The part of the command line that is `dxl commission`.
class CommissionArguments
{
public:
    CommissionArguments();
    ~CommissionArguments();
    void describe(CLI::App &app);
    Result<CommissionWishes> understand() const; ///< what was parsed

private:
    struct Typed;
    std::unique_ptr<Typed> m_typed;
};

} // namespace dynascope::dxl
