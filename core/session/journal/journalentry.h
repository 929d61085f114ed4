// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bytes.h"
#include "core/result.h"

#include <QByteArray>
#include <QDateTime>
#include <QString>

#include <optional>
#include <vector>

/// One line of the journal: what was written, to whom, by whom, and what it replaced. Values; any thread.
namespace dynascope {

/// A stretch of registers before and after, as bytes in the order of their addresses; mostly one register.
struct RegisterChange {
    QString name; ///< the manufacturer's; empty where the table knows no single register there
    std::uint16_t address = 0;
    bool isSigned = false; ///< how a person reads it
    Bytes before;          ///< empty: not known
    Bytes after;           ///< what was written; of a side effect what was read afterwards, empty: not known (yet)
    Bytes shown;           ///< read back; empty: it could not be read

    friend bool operator==(const RegisterChange &, const RegisterChange &) = default;
};

std::size_t lengthOf(const RegisterChange &change); ///< bytes
/// "Goal Position", or "116:4" where it has no name.
QString registerText(const RegisterChange &change);
/// The raw number, or hexadecimal pairs of what is longer than 4 bytes; "?" of no bytes.
QString bytesText(const Bytes &bytes, bool isSigned);

/// Who was written to, and where it stood then.
struct JournalDevice {
    QString line;    ///< the port's name as given
    QString adapter; ///< PortInfo::identity; empty where the adapter can't be told from another
    QString model;
    int modelNumber = 0;
    int firmware = 0;
    int id = 0;
    int baudRate = 0; ///< bits per second

    friend bool operator==(const JournalDevice &, const JournalDevice &) = default;
};

/// "XM430-W350 #3"
QString deviceText(const JournalDevice &device);

enum class JournalKind { Write, Reboot, FactoryReset, Clear, Backup, Restore, Packet };
enum class JournalAuthor { Window, CommandLine, Profile, Undo, Stop, Packing };
enum class JournalState {
    Begun,       ///< it was about to be written; what became of it was never noted
    Done,        ///< and read back, where it could be
    Unconfirmed, ///< sent, and not known whether it arrived
    Failed,      ///< nothing was changed; `note` says why
};

struct JournalPlace {
    int id = 0;
    int baudRate = 0;

    friend bool operator==(const JournalPlace &, const JournalPlace &) = default;
};

struct JournalEntry {
    qint64 number = 0; ///< from 1 on, over all files; given by the journal
    QString run;       ///< which run of a program wrote it
    QDateTime at;      ///< UTC, milliseconds
    JournalKind kind = JournalKind::Write;
    JournalAuthor by = JournalAuthor::Window;
    JournalState state = JournalState::Begun;
    JournalDevice device;
    std::vector<RegisterChange> changes; ///< of a write: first what was asked for, then what it changed besides
    std::optional<JournalPlace> movedTo; ///< where the device stands afterwards, where that is elsewhere
    QString note;                        ///< why it failed, which reset it was, a packet's bytes
    qint64 undoes = 0, redoes = 0;       ///< the entry that it takes back or carries out again; 0: none
    QString ahead;                       ///< its key in JournalAhead; empty: it is in none

    friend bool operator==(const JournalEntry &, const JournalEntry &) = default;
};

constexpr qsizetype LongestJournalLine = 32 * 1024;
constexpr qint64 LargestJournalNumber = 1'000'000'000;

/// One JSON object without a line break.
QByteArray toJson(const JournalEntry &entry);
/// Reads with distrust: BadFile where it isn't such an object, or anything in it is out of bounds.
Result<JournalEntry> journalEntryFromJson(const QByteArray &line);

/// @name Words of the file, and for people
/// @{
QString wordOf(JournalKind kind);
QString wordOf(JournalAuthor author);
QString wordOf(JournalState state);
/// @}

} // namespace dynascope
