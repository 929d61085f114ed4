// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"
#include "core/protocol/protocol_values.h"

#include <vector>

/// The one place where errors of the wire are put into words: each says what was seen, never just "no answer".
namespace dynascope::messages {

Error nothingReceived(std::uint8_t id, LineTime waited);
Error noHeader(std::uint8_t id, std::size_t bytes);
Error cutOff(std::uint8_t id, std::size_t have, std::size_t want);
Error damagedCrc(std::uint8_t id);
Error wrongId(std::uint8_t id, const std::vector<std::uint8_t> &others);
Error wrongLength(std::uint8_t id, std::size_t have, std::size_t want);
Error onlyLate(std::uint8_t id);
Error notSent(std::uint8_t id); ///< an answer to something earlier may still come, and no Ping proved that it won't
/// What was seen of one device, and who else on the line is alive.
Error withOthers(Error error, const std::vector<std::uint8_t> &others);
QString unreadable(std::size_t bytes); ///< of a scan: bytes that belong to no device it found
/// What tells that two devices have one ID.
enum class Shared { Damaged, TwoModels, MoreThanOne, Collide, BothAnswered, ReadsDamaged, ReadsDiffer };
QString sharedId(std::uint8_t id, Shared sign);
QString onlyTheScan(); ///< a device answered the broadcast Ping and no other
QString torqueStillOn(std::uint8_t id); ///< STOP read it back
Error anotherModel(std::uint8_t id, int there, int expected);
Error refused(std::uint8_t id, DeviceError error);
/// In a group read every device waits to hear the one listed before it.
Error chainBroken(std::uint8_t id, std::uint8_t culprit);
Error asleep(std::uint8_t id); ///< was silent for a while, and is asked rarely
Error answersOnlyPing(std::uint8_t id); ///< as asleep(), but its Pings are answered
Error silentByLevel(std::uint8_t id, int statusReturnLevel);

Error stopped();
Error cancelled();
Error closed(const QString &port);
Error notConfirmed(std::uint8_t id, ByteView written, ByteView readBack);
/// `error`: why neither an answer nor the value read back tells what became of a write that was sent.
Error mayBeWritten(Error error);
/// `error`: why there was no answer to a write; the register was read back since.
Error notWritten(Error error, ByteView written, ByteView readBack);
Error packetTooLong(std::size_t bytes, std::size_t limit);

Error portNotFound(const QString &port);
Error portEmpty(const QString &port); ///< the name exists, the hardware doesn't
Error portForbidden(const QString &port);
Error portBusy(const QString &port, const QString &holder); ///< `holder`: who has it, as far as known
/// Who has a port, as portBusy() takes it. `program` empty: its name can't be read.
QString portHolder(const QString &program, const QString &process);
QString thisProgram();
Error portNotSerial(const QString &port);
Error portFailed(const QString &port, const QString &reason); ///< opening failed otherwise
Error portLost(const QString &port);
Error rateRefused(const QString &port, int wanted, int made); ///< `made` 0: the port refused it

/// @name Serial servers on the network; `port` is the whole name, "tcp://host:4000"
/// @{
Error addressMalformed(const QString &port);
Error portNumberWrong(const QString &port, const QString &number);
Error hostUnknown(const QString &port, const QString &host);
Error nameServerSilent(const QString &port, const QString &host);
Error hostSilent(const QString &port, const QString &host, LineTime waited);
Error hostUnreachable(const QString &port, const QString &host, const QString &reason);
Error connectionRefused(const QString &port);
Error connectionEnded(const QString &port,
                      const QString &words); ///< at once; `words`: what the server said, or nothing
Error connectionLost(const QString &port);
Error notRfc2217(const QString &port);
Error rateNotConfirmed(const QString &port, int wanted);
Error rateIsTheServers(const QString &port, int wanted);
Error deviceRateBound(const QString &port); ///< a device may not be moved away from the server's rate
/// @}

QString durationText(LineTime duration); ///< "0.8 ms", "16 ms", "1.2 s"
/// @name Line::lowerLatency()
/// @{
Error noLatencyTimer(const QString &line);
Error latencyRefused(const QString &line, const QString &path, std::chrono::nanoseconds timer);
/// @}

} // namespace dynascope::messages
