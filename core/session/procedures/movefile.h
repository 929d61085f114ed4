// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/procedures/moveplan.h"

namespace dynascope {

/// The plan of moves of one line on disk, from before its first write until it is over. What a program that was killed
/// leaves there its next start goes on with. Any one thread.
class MoveFile
{
public:
    /// `folder` empty: nowhere; then nothing is ever found.
    MoveFile(const QString &folder, const QString &line, const QString &adapter);
    /// Where all programs of this project keep theirs, in the user's data.
    static QString usualFolder();

    const QString &path() const { return m_path; }
    bool exists() const;
    Result<MovePlan> load() const; ///< NotFound, BadFile
    /// On disk when it returns, whole or as it was; removed where the plan is over. Fails with BadFile.
    Result<void> save(const MovePlan &plan) const;
    void remove() const;

private:
    QString m_path;
};

/// What was half done, and where its device may be; empty where it is over. No capital, no full stop.
QString unfinishedText(const MovePlan &plan);

} // namespace dynascope
