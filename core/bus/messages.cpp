// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/messages.h"

#include <QStringList>

namespace dynascope::messages {
namespace {

QString device(std::uint8_t id)
{
    return QStringLiteral("device %1").arg(id);
}

QString bytesText(std::size_t count)
{
    return count == 1 ? QStringLiteral("1 byte") : QStringLiteral("%1 bytes").arg(count);
}

QString hexText(ByteView bytes)
{
    QStringList parts;
    for (const std::uint8_t byte : bytes)
        parts << QStringLiteral("%1").arg(byte, 2, 16, QLatin1Char('0')).toUpper();
    return parts.join(QLatin1Char(' '));
}

} // namespace

QString durationText(LineTime duration)
{
    const double milliseconds = std::chrono::duration<double, std::milli>(duration).count();
    if (milliseconds >= 1000)
        return QStringLiteral("%1 s").arg(milliseconds / 1000, 0, 'g', 2);
    if (milliseconds >= 9.95)
        return QStringLiteral("%1 ms").arg(qRound(milliseconds));
    return QStringLiteral("%1 ms").arg(milliseconds, 0, 'g', 2);
}

Error nothingReceived(std::uint8_t id, LineTime waited)
{
    return {ErrorKind::NothingReceived,
        QStringLiteral("%1 did not answer: nothing was received within %2").arg(device(id), durationText(waited))};
}

Error noHeader(std::uint8_t id, std::size_t bytes)
{
    return {ErrorKind::NoHeader,
        QStringLiteral("%1 did not answer: %2 came, but no packet began in them (noise, or "
                       "somebody at another baud rate)")
            .arg(device(id), bytesText(bytes))};
}

Error cutOff(std::uint8_t id, std::size_t have, std::size_t want)
{
    if (want == 0) // silent before its length field
        return {ErrorKind::CutOff,
            QStringLiteral("the answer of %1 was cut off after %2").arg(device(id), bytesText(have))};
    return {ErrorKind::CutOff,
        QStringLiteral("the answer of %1 was cut off after %2 of %3").arg(device(id)).arg(have).arg(bytesText(want))};
}

Error damagedCrc(std::uint8_t id)
{
    return {ErrorKind::DamagedCrc, QStringLiteral("the answer of %1 came damaged: its CRC is wrong").arg(device(id))};
}

Error wrongId(std::uint8_t id, const std::vector<std::uint8_t> &others)
{
    QStringList names;
    for (const std::uint8_t other : others)
        names << QString::number(other);
    names.removeDuplicates();
    return {ErrorKind::WrongId,
        QStringLiteral("%1 did not answer, but %2 %3 did")
            .arg(device(id), names.size() > 1 ? QStringLiteral("devices") : QStringLiteral("device"),
                names.join(QStringLiteral(", ")))};
}

Error wrongLength(std::uint8_t id, std::size_t have, std::size_t want)
{
    return {ErrorKind::WrongLength,
        QStringLiteral("%1 answered with %2 where %3 were asked for")
            .arg(device(id), bytesText(have), QString::number(want))};
}

Error refused(std::uint8_t id, DeviceError error)
{
    return {ErrorKind::Refused,
        QStringLiteral("%1 refused: %2, %3").arg(device(id), deviceErrorName(error), deviceErrorReason(error)),
        static_cast<std::uint8_t>(error)};
}

Error chainBroken(std::uint8_t id, std::uint8_t culprit)
{
    return {ErrorKind::NothingReceived,
        QStringLiteral("%1 was not heard: %2, asked before it, did not finish its answer")
            .arg(device(id), device(culprit))};
}

Error silentByLevel(std::uint8_t id, int statusReturnLevel)
{
    return {ErrorKind::NothingReceived,
        QStringLiteral("%1 did not answer: its Status Return Level %2 lets it answer only %3")
            .arg(device(id))
            .arg(statusReturnLevel)
            .arg(statusReturnLevel == 0 ? QStringLiteral("Ping") : QStringLiteral("Ping and Read"))};
}

Error stopped()
{
    return {ErrorKind::Stopped, QStringLiteral("ended by STOP")};
}

Error cancelled()
{
    return {ErrorKind::Cancelled, QStringLiteral("cancelled")};
}

Error closed(const QString &port)
{
    return {ErrorKind::Cancelled, QStringLiteral("%1 was closed").arg(port)};
}

Error notConfirmed(std::uint8_t id, ByteView written, ByteView readBack)
{
    return {ErrorKind::NotConfirmed,
        QStringLiteral("%1 took the value, but reads back %2 instead of %3")
            .arg(device(id), hexText(readBack), hexText(written))};
}

Error mayBeWritten(Error error)
{
    error.text += QStringLiteral("; the write may have been executed");
    return error;
}

Error notWritten(Error error, ByteView written, ByteView readBack)
{
    error.text += QStringLiteral("; the register reads back %1 instead of %2").arg(hexText(readBack), hexText(written));
    return error;
}

Error packetTooLong(std::size_t bytes, std::size_t limit)
{
    return {ErrorKind::InvalidArgument,
        QStringLiteral("a packet of %1 would be needed; devices take %2 at most").arg(bytesText(bytes)).arg(limit)};
}

Error portNotFound(const QString &port)
{
    return {ErrorKind::PortNotFound,
        QStringLiteral("there is no port %1: is the adapter plugged in, and the name right?").arg(port)};
}

Error portEmpty(const QString &port)
{
    return {ErrorKind::PortNotFound, QStringLiteral("%1 exists, but there is no device behind it").arg(port)};
}

Error portForbidden(const QString &port)
{
    return {ErrorKind::PortForbidden,
        QStringLiteral("you may not use %1: add yourself to the group dialout (sudo usermod "
                       "-aG dialout $USER), then log out and in again")
            .arg(port)};
}

Error portBusy(const QString &port, const QString &holder)
{
    if (!holder.isEmpty())
        return {ErrorKind::PortBusy, QStringLiteral("%1 is in use by %2: close that first").arg(port, holder)};
    return {ErrorKind::PortBusy,
        QStringLiteral("%1 is in use by another program: close that first (DYNAMIXEL Wizard, a "
                       "robot's controller, a terminal, or this program started twice)")
            .arg(port)};
}

Error portNotSerial(const QString &port)
{
    return {ErrorKind::PortUnsuitable, QStringLiteral("%1 is not a serial port").arg(port)};
}

Error portFailed(const QString &port, const QString &reason)
{
    return {ErrorKind::PortUnsuitable, QStringLiteral("%1 could not be opened: %2").arg(port, reason)};
}

Error portLost(const QString &port)
{
    return {ErrorKind::PortLost, QStringLiteral("%1 is gone: unplugged, or closed by the other side").arg(port)};
}

Error rateRefused(const QString &port, int wanted, int made)
{
    if (made <= 0)
        return {ErrorKind::PortUnsuitable, QStringLiteral("%1 can't do %2 baud").arg(port).arg(wanted)};
    return {ErrorKind::PortUnsuitable,
        QStringLiteral("%1 can't do %2 baud: it would send at %3, more than 3 % off").arg(port).arg(wanted).arg(made)};
}

Error addressMalformed(const QString &port)
{
    return {ErrorKind::PortUnsuitable,
            QStringLiteral(
                "%1 is no address: it is written tcp://HOST:PORT, tcp://HOST:PORT?baud=RATE or rfc2217://HOST:PORT, "
                "an IPv6 address in brackets")
                .arg(port)};
}

Error portNumberWrong(const QString &port, const QString &number)
{
    return {ErrorKind::PortUnsuitable,
            QStringLiteral("%1: a port is a number from 1 to 65535, not \"%2\"").arg(port, number)};
}

Error hostUnknown(const QString &port, const QString &host)
{
    return {ErrorKind::PortNotFound, QStringLiteral("%1: there is no host %2").arg(port, host)};
}

Error nameServerSilent(const QString &port, const QString &host)
{
    return {ErrorKind::PortNotFound,
            QStringLiteral("%1: no name server says where the host %2 is: is the network up?").arg(port, host)};
}

Error hostSilent(const QString &port, const QString &host, LineTime waited)
{
    return {ErrorKind::PortNotFound,
            QStringLiteral("%1: %2 did not answer within %3: is it on, and no firewall between?")
                .arg(port, host, durationText(waited))};
}

Error hostUnreachable(const QString &port, const QString &host, const QString &reason)
{
    return {ErrorKind::PortNotFound, QStringLiteral("%1: %2 can't be reached: %3").arg(port, host, reason)};
}

Error connectionRefused(const QString &port)
{
    return {
        ErrorKind::PortNotFound,
        QStringLiteral("%1 refused the connection: nothing listens there. Is the serial server running, and the port "
                       "number right?")
            .arg(port)};
}

Error connectionEnded(const QString &port, const QString &words)
{
    return {ErrorKind::PortBusy,
            QStringLiteral("%1 ended the connection at once%2: is its serial port plugged in, and used by nobody else?")
                .arg(port, words.isEmpty() ? QString() : QStringLiteral(" (\"%1\")").arg(words))};
}

Error connectionLost(const QString &port)
{
    return {ErrorKind::PortLost,
            QStringLiteral("the connection to %1 is lost: the server ended it, or the network is down").arg(port)};
}

Error notRfc2217(const QString &port)
{
    return {ErrorKind::PortUnsuitable,
            QStringLiteral(
                "%1 does not let its port be controlled (RFC 2217). If it passes raw bytes on, open it as tcp://")
                .arg(port)};
}

Error rateNotConfirmed(const QString &port, int wanted)
{
    return {ErrorKind::PortLost,
            QStringLiteral("%1 did not confirm %2 baud: the rate is unknown now, so the connection was ended")
                .arg(port)
                .arg(wanted)};
}

Error rateIsTheServers(const QString &port, int wanted)
{
    return {ErrorKind::PortUnsuitable,
            QStringLiteral("%1 can't be set to %2 baud: the rate is the server's, changed in its settings, or through "
                           "rfc2217:// where it offers that")
                .arg(port)
                .arg(wanted)};
}

Error deviceRateBound(const QString &port)
{
    return {
        ErrorKind::PortUnsuitable,
        QStringLiteral("the rate of %1 is the server's, and a device at another one would not be heard there any more; "
                       "nothing was written")
            .arg(port)};
}

} // namespace dynascope::messages
