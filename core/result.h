// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

#include <tl/expected.hpp>

#include <cstdint>

namespace dynascope {

/// What went wrong, for the program. Error::text says it to the person.
enum class ErrorKind {
    // An exchange (protocol, sections "status packet" and "error")
    NothingReceived, ///< not one byte came before the deadline
    NoHeader,        ///< bytes came, but no packet began in them
    CutOff,          ///< a packet began and fell silent
    DamagedCrc,      ///< a whole packet came, its CRC is wrong
    WrongId,         ///< only other devices answered
    WrongLength,     ///< a valid answer of another length than asked
    LateAnswer,      ///< only an answer that may be an earlier request's
    NotSent,         ///< nothing went out: the device did not answer the Ping that must come first
    Refused,         ///< the device answered with an error number, Error::number
    // The port
    PortNotFound,
    PortForbidden,
    PortBusy,
    PortUnsuitable,  ///< not a serial port, or a rate it can't do
    PortLost,        ///< unplugged, or closed by the other side
    // The program
    Cancelled,
    Stopped,         ///< ended by STOP
    InvalidArgument,
    NotFound,        ///< no such device, model, field
    NotSupported,
    NotConfirmed,    ///< sent, but reading back doesn't show it
    BadFile,
};

struct Error {
    ErrorKind kind = ErrorKind::InvalidArgument;
    QString text;             ///< one sentence without the final stop, in the user's words
    std::uint8_t number = 0;  ///< with Refused: the device's error number, 1..127

    friend bool operator==(const Error &, const Error &) = default;
};

/// A value, or why there is none.
template <typename T>
using Result = tl::expected<T, Error>;

inline tl::unexpected<Error> failure(ErrorKind kind, QString text, std::uint8_t number = 0)
{
    return tl::unexpected<Error>(Error{kind, std::move(text), number});
}

} // namespace dynascope
