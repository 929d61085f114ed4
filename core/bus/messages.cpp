// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/messages.h"

#include "core/bus/messagetext.h"

#include <QStringList>

namespace dynascope::messages {
namespace {

QString device(std::uint8_t id)
{
    return Messages::tr("device %1").arg(id);
}

QString bytesText(std::size_t count)
{
    return count == 1 ? Messages::tr("1 byte") : Messages::tr("%1 bytes").arg(count);
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
        Messages::tr("%1 did not answer: nothing was received within %2").arg(device(id), durationText(waited))};
}

Error noHeader(std::uint8_t id, std::size_t bytes)
{
    return {ErrorKind::NoHeader,
        Messages::tr("%1 did not answer: %2 came, but no packet began in them (noise, or "
                       "somebody at another baud rate)")
            .arg(device(id), bytesText(bytes))};
}

Error cutOff(std::uint8_t id, std::size_t have, std::size_t want)
{
    if (want == 0) // silent before its length field
        return {ErrorKind::CutOff,
            Messages::tr("the answer of %1 was cut off after %2").arg(device(id), bytesText(have))};
    return {ErrorKind::CutOff,
        Messages::tr("the answer of %1 was cut off after %2 of %3").arg(device(id)).arg(have).arg(bytesText(want))};
}

Error damagedCrc(std::uint8_t id)
{
    return {ErrorKind::DamagedCrc, Messages::tr("the answer of %1 came damaged: its CRC is wrong").arg(device(id))};
}

Error wrongId(std::uint8_t id, const std::vector<std::uint8_t> &others)
{
    QStringList names;
    for (const std::uint8_t other : others)
        names << QString::number(other);
    names.removeDuplicates();
    return {ErrorKind::WrongId,
        Messages::tr("%1 did not answer, but %2 %3 did")
            .arg(device(id), names.size() > 1 ? Messages::tr("devices") : Messages::tr("device"),
                names.join(QStringLiteral(", ")))};
}

Error wrongLength(std::uint8_t id, std::size_t have, std::size_t want)
{
    return {ErrorKind::WrongLength,
        Messages::tr("%1 answered with %2 where %3 were asked for")
            .arg(device(id), bytesText(have), QString::number(want))};
}

Error onlyLate(std::uint8_t id)
{
    return {ErrorKind::LateAnswer,
        Messages::tr("%1 did not answer in time: what came may be its answer to an earlier request").arg(device(id))};
}

Error withOthers(Error error, const std::vector<std::uint8_t> &others)
{
    constexpr std::size_t Named = 8;
    if (others.empty()) {
        error.text = Messages::tr("%1; nothing else on the line has answered lately").arg(error.text);
        return error;
    }
    QStringList names;
    for (std::size_t i = 0; i < std::min(others.size(), Named); ++i)
        names << QString::number(others[i]);
    if (others.size() > Named)
        names << Messages::tr("and %1 more").arg(others.size() - Named);
    error.text = others.size() == 1 ? Messages::tr("%1; device %2 on this line answers").arg(error.text, names.front())
                                    : Messages::tr("%1; devices %2 on this line answer")
                                          .arg(error.text, names.join(QStringLiteral(", ")));
    return error;
}

QString unreadable(std::size_t bytes)
{
    return Messages::tr("somebody is there, but unreadable: %1 came that make no answer (two devices under one ID, "
                        "another baud rate, another controller, or noise)")
        .arg(bytesText(bytes));
}

QString sharedId(std::uint8_t id, Shared sign)
{
    const auto says = [sign] {
        switch (sign) {
        case Shared::Damaged: return Messages::tr("its answers come damaged");
        case Shared::TwoModels: return Messages::tr("it answered as two different models");
        case Shared::MoreThanOne: return Messages::tr("more came than one answer");
        case Shared::Collide: return Messages::tr("their answers collide");
        case Shared::ReadsDamaged: return Messages::tr("it answers a Ping well, but what is read of it comes damaged");
        case Shared::ReadsDiffer: return Messages::tr("what is read of it jumps as no single device's registers do");
        case Shared::BothAnswered: break;
        }
        return Messages::tr("both answered the scan");
    };
    return Messages::tr("two devices seem to share ID %1: %2").arg(id).arg(says());
}

QString onlyTheScan()
{
    return Messages::tr("it answered the scan, but no Ping of its own");
}

QString torqueStillOn(std::uint8_t id)
{
    return Messages::tr("%1 still says that its torque is on").arg(device(id));
}

Error anotherModel(std::uint8_t id, int there, int expected)
{
    return {ErrorKind::NotConfirmed,
        Messages::tr("%1 answers as model number %2, not %3: another servo has its place; scan to find who is there")
            .arg(device(id))
            .arg(there)
            .arg(expected)};
}

Error refused(std::uint8_t id, DeviceError error)
{
    return {ErrorKind::Refused,
        Messages::tr("%1 refused: %2, %3").arg(device(id), deviceErrorName(error), deviceErrorReason(error)),
        static_cast<std::uint8_t>(error)};
}

Error chainBroken(std::uint8_t id, std::uint8_t culprit)
{
    return {ErrorKind::NothingReceived,
        Messages::tr("%1 was not heard: %2, asked before it, did not finish its answer")
            .arg(device(id), device(culprit))};
}

Error notSent(std::uint8_t id)
{
    return {ErrorKind::NotSent,
        Messages::tr("%1 was not asked: it missed an answer before and has not answered since").arg(device(id))};
}

Error asleep(std::uint8_t id)
{
    return {ErrorKind::NothingReceived, Messages::tr("%1 does not answer").arg(device(id))};
}

Error answersOnlyPing(std::uint8_t id)
{
    return {ErrorKind::NothingReceived,
        Messages::tr("%1 answers Ping but no Read: is its Status Return Level 0?").arg(device(id))};
}

Error silentByLevel(std::uint8_t id, int statusReturnLevel)
{
    return {ErrorKind::NothingReceived,
        Messages::tr("%1 did not answer: its Status Return Level %2 lets it answer only %3")
            .arg(device(id))
            .arg(statusReturnLevel)
            .arg(statusReturnLevel == 0 ? Messages::tr("Ping") : Messages::tr("Ping and Read"))};
}

Error stopped()
{
    return {ErrorKind::Stopped, Messages::tr("ended by STOP")};
}

Error cancelled()
{
    return {ErrorKind::Cancelled, Messages::tr("cancelled")};
}

Error closed(const QString &port)
{
    return {ErrorKind::Cancelled, Messages::tr("%1 was closed").arg(port)};
}

Error notConfirmed(std::uint8_t id, ByteView written, ByteView readBack)
{
    return {ErrorKind::NotConfirmed,
        Messages::tr("%1 took the value, but reads back %2 instead of %3")
            .arg(device(id), hexText(readBack), hexText(written))};
}

Error mayBeWritten(Error error)
{
    error.text += Messages::tr("; the write may have been executed");
    return error;
}

Error notWritten(Error error, ByteView written, ByteView readBack)
{
    error.text += Messages::tr("; the register reads back %1 instead of %2").arg(hexText(readBack), hexText(written));
    return error;
}

Error packetTooLong(std::size_t bytes, std::size_t limit)
{
    return {ErrorKind::InvalidArgument,
        Messages::tr("a packet of %1 would be needed; devices take %2 at most").arg(bytesText(bytes)).arg(limit)};
}

Error portNotFound(const QString &port)
{
    return {ErrorKind::PortNotFound,
        Messages::tr("there is no port %1: is the adapter plugged in, and the name right?").arg(port)};
}

Error portEmpty(const QString &port)
{
    return {ErrorKind::PortNotFound, Messages::tr("%1 exists, but there is no device behind it").arg(port)};
}

Error portForbidden(const QString &port)
{
    return {ErrorKind::PortForbidden,
        Messages::tr("you may not use %1: add yourself to the group dialout (sudo usermod "
                       "-aG dialout $USER), then log out and in again")
            .arg(port)};
}

Error portBusy(const QString &port, const QString &holder)
{
    if (!holder.isEmpty())
        return {ErrorKind::PortBusy, Messages::tr("%1 is in use by %2: close that first").arg(port, holder)};
    return {ErrorKind::PortBusy,
        Messages::tr("%1 is in use by another program: close that first (DYNAMIXEL Wizard, a "
                       "robot's controller, a terminal, or this program started twice)")
            .arg(port)};
}

QString portHolder(const QString &program, const QString &process)
{
    return Messages::tr("%1 (process %2)").arg(program.isEmpty() ? Messages::tr("a program") : program, process);
}

QString thisProgram()
{
    return Messages::tr("this program");
}

Error portNotSerial(const QString &port)
{
    return {ErrorKind::PortUnsuitable, Messages::tr("%1 is not a serial port").arg(port)};
}

Error portFailed(const QString &port, const QString &reason)
{
    return {ErrorKind::PortUnsuitable, Messages::tr("%1 could not be opened: %2").arg(port, reason)};
}

Error portLost(const QString &port)
{
    return {ErrorKind::PortLost, Messages::tr("%1 is gone: unplugged, or closed by the other side").arg(port)};
}

Error rateRefused(const QString &port, int wanted, int made)
{
    if (made <= 0)
        return {ErrorKind::PortUnsuitable, Messages::tr("%1 can't do %2 baud").arg(port).arg(wanted)};
    return {ErrorKind::PortUnsuitable,
        Messages::tr("%1 can't do %2 baud: it would send at %3 instead").arg(port).arg(wanted).arg(made)};
}

Error addressMalformed(const QString &port)
{
    return {ErrorKind::PortUnsuitable,
            Messages::tr(
                "%1 is no address: it is written tcp://HOST:PORT, tcp://HOST:PORT?baud=RATE or rfc2217://HOST:PORT, "
                "an IPv6 address in brackets")
                .arg(port)};
}

Error portNumberWrong(const QString &port, const QString &number)
{
    return {ErrorKind::PortUnsuitable,
            Messages::tr("%1: a port is a number from 1 to 65535, not \"%2\"").arg(port, number)};
}

Error hostUnknown(const QString &port, const QString &host)
{
    return {ErrorKind::PortNotFound, Messages::tr("%1: there is no host %2").arg(port, host)};
}

Error nameServerSilent(const QString &port, const QString &host)
{
    return {ErrorKind::PortNotFound,
            Messages::tr("%1: no name server says where the host %2 is: is the network up?").arg(port, host)};
}

Error hostSilent(const QString &port, const QString &host, LineTime waited)
{
    return {ErrorKind::PortNotFound,
            Messages::tr("%1: %2 did not answer within %3: is it on, and no firewall between?")
                .arg(port, host, durationText(waited))};
}

Error hostUnreachable(const QString &port, const QString &host, const QString &reason)
{
    return {ErrorKind::PortNotFound, Messages::tr("%1: %2 can't be reached: %3").arg(port, host, reason)};
}

Error connectionRefused(const QString &port)
{
    return {
        ErrorKind::PortNotFound,
        Messages::tr("%1 refused the connection: nothing listens there. Is the serial server running, and the port "
                       "number right?")
            .arg(port)};
}

Error connectionEnded(const QString &port, const QString &words)
{
    return {ErrorKind::PortBusy,
            Messages::tr("%1 ended the connection at once%2: is its serial port plugged in, and used by nobody else?")
                .arg(port, words.isEmpty() ? QString() : QStringLiteral(" (\"%1\")").arg(words))};
}

Error connectionLost(const QString &port)
{
    return {ErrorKind::PortLost,
            Messages::tr("the connection to %1 is lost: the server ended it, or the network is down").arg(port)};
}

Error notRfc2217(const QString &port)
{
    return {ErrorKind::PortUnsuitable,
            Messages::tr(
                "%1 does not let its port be controlled (RFC 2217). If it passes raw bytes on, open it as tcp://")
                .arg(port)};
}

Error rateNotConfirmed(const QString &port, int wanted)
{
    return {ErrorKind::PortLost,
            Messages::tr("%1 did not confirm %2 baud: the rate is unknown now, so the connection was ended")
                .arg(port)
                .arg(wanted)};
}

Error rateIsTheServers(const QString &port, int wanted)
{
    return {ErrorKind::PortUnsuitable,
            Messages::tr("%1 can't be set to %2 baud: the rate is the server's, changed in its settings, or through "
                           "rfc2217:// where it offers that")
                .arg(port)
                .arg(wanted)};
}

Error deviceRateBound(const QString &port)
{
    return {
        ErrorKind::PortUnsuitable,
        Messages::tr("the rate of %1 is the server's, and a device at another one would not be heard there any more; "
                       "nothing was written")
            .arg(port)};
}

} // namespace dynascope::messages
