// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/window/workshop.h"
#include "core/session/backup/backupcommands.h"

#include <QPointer>
#include <QTemporaryDir>

#include <vector>

namespace dynascope {

/// Opens the dialogs that pictures are taken of, each with something to see in it, and writes nothing. GUI thread.
class DialogPictures
{
public:
    explicit DialogPictures(Workshop &workshop);

    struct One {
        const char *name; ///< of the picture's file
        QSize size;
        std::vector<std::function<QDialog *()>> steps; ///< with time between them; each says what is open then
    };
    std::vector<One> all(); ///< goes with this

private:
    QDialog *open(const char *action, const char *dialog);
    void click(const char *button);
    QDialog *openMoves();
    QDialog *agreeToTorqueOff();
    QDialog *openProfile();
    QDialog *writeSomething();
    QDialog *openCompare();
    QDialog *openRestore();
    QDialog *openConsequences();
    Device *joint(std::size_t which) const; ///< in the order of the list
    QString writeProfile() const;

    Workshop &m_workshop;
    BackupCommands m_backups;
    QTemporaryDir m_folder;
    QPointer<QDialog> m_open;
};

} // namespace dynascope
