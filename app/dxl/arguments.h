// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bytes.h"
#include "core/protocol/protocol_values.h"
#include "core/result.h"

#include <vector>

/// The small languages of the command line. Pure; errors are InvalidArgument and quote what was given.
namespace dynascope::dxl {

/// What was typed can't be: InvalidArgument.
tl::unexpected<Error> wrong(const QString &text);

/// Bits per second. Devices begin at 9600; whoever types less means the register's index of a rate, and would wait long.
constexpr int LowestBaudRate = 1200;

/// FIELD, ADDRESS:LENGTH, or either with =VALUE.
struct RegisterArgument {
    QString field;   ///< as typed; empty where an address was given
    int address = 0;
    int length = 0;  ///< bytes, 0 where a field was given
    QString value;   ///< as typed

    bool isByAddress() const { return length > 0; }
    QString text() const; ///< how messages call it: "132:4" or the field
};

Result<RegisterArgument> parseRegister(const QString &text);
Result<RegisterArgument> parseAssignment(const QString &text); ///< with =VALUE

/// The bytes of a value for ADDRESS:LENGTH, low byte first: 1 to 4 bytes as a number (decimal, 0x, negative), more as
/// that many pairs of hexadecimal digits in the order of the addresses.
Result<Bytes> parseRawValue(const RegisterArgument &argument);

/// "57600,1000000", or "all", which is what `all` holds.
Result<std::vector<int>> parseBauds(const QString &text, const std::vector<int> &all);

struct IdRange {
    int first = 0;
    int last = 0;
};
Result<IdRange> parseIds(const QString &text); ///< "0-252" or "7"
Result<std::vector<std::uint8_t>> parseIdList(const QString &text); ///< "1,4-7": ascending, each once

} // namespace dynascope::dxl
