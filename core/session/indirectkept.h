// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/indirectfile.h"
#include "core/session/session.h"

namespace dynascope {

/// What the Indirect Addresses of each line's devices held before they were set, here and on disk, until it is back.
/// GUI thread.
class IndirectKept
{
public:
    IndirectKept(Session &session, const QString &folder) : m_session(session), m_folder(folder) { }

    Result<void> load(const LineSession &line);   ///< what a program that was ended has left
    void leave(const LineSession *line) { m_lines.erase(line); } ///< what is not back stays on disk

    /// NotWritable and the like: it isn't kept then, and may not be set.
    Result<void> keep(const Device &device, std::vector<SetEntries::Entry> entries);
    const SetEntries *find(const Device &device) const; ///< nullptr: all is as it was
    void drop(const Device &device);                    ///< it is back
    /// Of all devices of this line, here or not, but those.
    void dropAllBut(const LineSession &line, const std::function<bool(DeviceKey)> &stays);
    Result<void> save(const LineSession &line); ///< as its devices are called now

private:
    struct Kept {
        SetEntries set;
        DeviceKey device = 0; ///< of this run; 0: left by another
    };
    static bool isOf(const Kept &kept, const Device &device);

    Session &m_session;
    QString m_folder;
    std::map<const LineSession *, std::vector<Kept>> m_lines;
};

} // namespace dynascope
