// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/profile/profilesave.h"
#include "core/session/session.h"

namespace dynascope {

/// Saves what is on a line into a profile's file: looks who is there, reads them, writes the file. Nothing is written to
/// a device, and nothing to the file unless all of it could be read. GUI thread; owned by who offers it.
class ProfileSaver : public QObject
{
    Q_OBJECT

public:
    using Done = std::function<void(const Result<SavedProfile> &)>;

    explicit ProfileSaver(Session &session, QObject *parent = nullptr) : QObject(parent), m_session(session) {}

    bool isBusy() const { return m_job != 0; }
    double progress() const { return m_progress; } ///< 0 to 1

    /// A new file, which replaces one of that name: everybody at the line's baud rate, and where the session knows of
    /// somebody. Its robot is called as options.name says, else as the file.
    void saveNew(const QString &path, LineSession &line, ProfileSaveOptions options, Done done);
    /// Into a file that is there: what it says elsewhere stays, byte for byte. Everybody at its baud rates.
    void saveInto(const QString &path, LineSession &line, const ProfileSaveOptions &options, Done done);
    void cancel();

signals:
    void changed(); ///< busy, progress

private:
    struct Read {
        std::vector<SavedDevice> devices;
        QStringList notes;
    };
    struct Target {
        QString path;
        QByteArray before; ///< of the file; empty: a new one
        ProfileSaveOptions options;
    };
    void save(const Target &target, LineSession &line, const std::vector<int> &rates, const Done &done);
    Result<SavedProfile> write(const Target &target, const Result<Read> &read);
    static Result<std::vector<Found>> findAll(JobContext &context, const std::vector<int> &rates, QStringList &notes);
    static Result<Read> readAll(JobContext &context, const std::vector<int> &rates, const Catalog &catalog,
                                const std::function<void(double)> &progress);

    Session &m_session;
    QPointer<LineSession> m_line;
    double m_progress = 0;
    JobId m_job = 0;
};

} // namespace dynascope
