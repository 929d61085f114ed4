// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/result.h"

#include <vector>

namespace dynascope {

/// Indirect Addresses of one device that were set to read by, and what they held before.
struct SetEntries {
    struct Entry {
        int address = 0; ///< of the Indirect Address
        int before = 0, to = 0;

        friend bool operator==(const Entry &, const Entry &) = default;
    };
    int modelNumber = 0, id = 0, baudRate = 0;
    std::vector<Entry> entries;

    friend bool operator==(const SetEntries &, const SetEntries &) = default;
};

/// Those of one line on disk, from before the first write until they are put back: what a program that was killed
/// leaves there its next start offers to put back. Any one thread.
class IndirectFile
{
public:
    /// `line` as a person named it; an adapter keeps its file wherever it is plugged in. Nowhere where `folder` is
    /// empty, and for the simulated bus, which ends with the program.
    IndirectFile(const QString &folder, const QString &line);
    /// In the user's data.
    static QString usualFolder();

    const QString &path() const { return m_path; }
    /// Empty where there is none. BadFile: damaged, or beyond all bounds.
    Result<std::vector<SetEntries>> load() const;
    /// On disk when it returns, whole or as it was; none of it: removed. Fails with BadFile.
    Result<void> save(const std::vector<SetEntries> &devices) const;

private:
    QString m_path;
};

} // namespace dynascope
