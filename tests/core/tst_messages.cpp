// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/messages.h"
#include "tests/support/testmain.h"

#include <QTranslator>

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

/// Knows every sentence of this context, and puts it in brackets.
class Brackets final : public QTranslator
{
public:
    bool isEmpty() const override { return false; }
    QString translate(const char *context, const char *text, const char *, int) const override
    {
        return QLatin1String(context) == QLatin1String("Messages") ? u'<' + QString::fromUtf8(text) + u'>' : QString();
    }
};

} // namespace

class TestMessages : public QObject
{
    Q_OBJECT

private slots:
    // Those of an exchange are held where they arise: tst_bus.
    void port_data()
    {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("expected");
        const auto row = [](const char *name, const Error &error, const QString &expected) {
            QTest::newRow(name) << error.text << expected;
        };
        const QString port = QStringLiteral("/dev/ttyUSB0");
        row("not found", messages::portNotFound(port),
            QStringLiteral("there is no port /dev/ttyUSB0: is the adapter plugged in, and the name right?"));
        row("forbidden", messages::portForbidden(port),
            QStringLiteral("you may not use /dev/ttyUSB0: add yourself to the group dialout (sudo usermod -aG dialout "
                           "$USER), then log "
                           "out and in again"));
        row("busy, by whom", messages::portBusy(port, QStringLiteral("screen (process 7)")),
            QStringLiteral("/dev/ttyUSB0 is in use by screen (process 7): close that first"));
        row("busy", messages::portBusy(port, {}),
            QStringLiteral("/dev/ttyUSB0 is in use by another program: close that first (DYNAMIXEL Wizard, a robot's "
                           "controller, a "
                           "terminal, or this program started twice)"));
        row("holder", {ErrorKind::PortBusy, messages::portHolder(QStringLiteral("screen"), QStringLiteral("7"))},
            QStringLiteral("screen (process 7)"));
        row("nameless holder", {ErrorKind::PortBusy, messages::portHolder({}, QStringLiteral("7"))},
            QStringLiteral("a program (process 7)"));
        row("held by itself", {ErrorKind::PortBusy, messages::thisProgram()}, QStringLiteral("this program"));
        row("not serial", messages::portNotSerial(port), QStringLiteral("/dev/ttyUSB0 is not a serial port"));
        row("lost", messages::portLost(port),
            QStringLiteral("/dev/ttyUSB0 is gone: unplugged, or closed by the other side"));
        row("rate refused", messages::rateRefused(port, 4'500'000, 0),
            QStringLiteral("/dev/ttyUSB0 can't do 4500000 baud"));
        row("rate off", messages::rateRefused(port, 4'500'000, 4'000'000),
            QStringLiteral("/dev/ttyUSB0 can't do 4500000 baud: it would send at 4000000 instead"));
        const QString server = QStringLiteral("tcp://pi:4000");
        const QString host = QStringLiteral("pi");
        row("address", messages::addressMalformed(QStringLiteral("tcp://pi")),
            QStringLiteral("tcp://pi is no address: it is written tcp://HOST:PORT, tcp://HOST:PORT?baud=RATE or "
                           "rfc2217://HOST:PORT, an IPv6 address in brackets"));
        row("port number", messages::portNumberWrong(QStringLiteral("tcp://pi:0"), QStringLiteral("0")),
            QStringLiteral("tcp://pi:0: a port is a number from 1 to 65535, not \"0\""));
        row("no host", messages::hostUnknown(server, host), QStringLiteral("tcp://pi:4000: there is no host pi"));
        row("no name server", messages::nameServerSilent(server, host),
            QStringLiteral("tcp://pi:4000: no name server says where the host pi is: is the network up?"));
        row("host silent", messages::hostSilent(server, host, 5s),
            QStringLiteral("tcp://pi:4000: pi did not answer within 5 s: is it on, and no firewall between?"));
        row("unreachable", messages::hostUnreachable(server, host, QStringLiteral("No route to host")),
            QStringLiteral("tcp://pi:4000: pi can't be reached: No route to host"));
        row("connection refused", messages::connectionRefused(server),
            QStringLiteral(
                "tcp://pi:4000 refused the connection: nothing listens there. Is the serial server running, and "
                "the port number right?"));
        row("ended at once", messages::connectionEnded(server, {}),
            QStringLiteral(
                "tcp://pi:4000 ended the connection at once: is its serial port plugged in, and used by nobody "
                "else?"));
        row("ended with words", messages::connectionEnded(server, QStringLiteral("Port already in use")),
            QStringLiteral(
                "tcp://pi:4000 ended the connection at once (\"Port already in use\"): is its serial port plugged "
                "in, and used by nobody else?"));
        row("connection lost", messages::connectionLost(server),
            QStringLiteral("the connection to tcp://pi:4000 is lost: the server ended it, or the network is down"));
        row("no RFC 2217", messages::notRfc2217(server),
            QStringLiteral(
                "tcp://pi:4000 does not let its port be controlled (RFC 2217). If it passes raw bytes on, open it "
                "as tcp://"));
        row("rate not confirmed", messages::rateNotConfirmed(server, 57600),
            QStringLiteral(
                "tcp://pi:4000 did not confirm 57600 baud: the rate is unknown now, so the connection was ended"));
        row("server's rate", messages::rateIsTheServers(server, 57600),
            QStringLiteral(
                "tcp://pi:4000 can't be set to 57600 baud: the rate is the server's, changed in its settings, or "
                "through rfc2217:// where it offers that"));
        row("device at the server's rate", messages::deviceRateBound(server),
            QStringLiteral(
                "the rate of tcp://pi:4000 is the server's, and a device at another one would not be heard there "
                "any more; nothing was written"));
        const Error silent = messages::asleep(3);
        row("late", messages::onlyLate(3),
            QStringLiteral(
                "device 3 did not answer in time: what came may be its answer to an earlier request"));
        row("not sent", messages::notSent(3),
            QStringLiteral("device 3 was not asked: it missed an answer before and has not answered since"));
        row("asleep", silent, QStringLiteral("device 3 does not answer"));
        row("with nobody", messages::withOthers(silent, {}),
            QStringLiteral("device 3 does not answer; nothing else on the line has answered lately"));
        row("with one", messages::withOthers(silent, {7}),
            QStringLiteral("device 3 does not answer; device 7 on this line answers"));
        row("with two", messages::withOthers(silent, {7, 9}),
            QStringLiteral("device 3 does not answer; devices 7, 9 on this line answer"));
        row("with many", messages::withOthers(silent, {1, 2, 4, 5, 6, 7, 8, 9, 10, 11}),
            QStringLiteral("device 3 does not answer; devices 1, 2, 4, 5, 6, 7, 8, 9, and 2 more on this line answer"));
        row("unreadable", {ErrorKind::NoHeader, messages::unreadable(5)},
            QStringLiteral("somebody is there, but unreadable: 5 bytes came that make no answer (two devices under one "
                           "ID, another baud rate, another controller, or noise)"));
        const auto doubt = [&row](const char *name, messages::Shared sign, const QString &says) {
            row(name, {ErrorKind::NoHeader, messages::sharedId(4, sign)},
                QStringLiteral("two devices seem to share ID 4: ") + says);
        };
        doubt("shared, damaged", messages::Shared::Damaged, QStringLiteral("its answers come damaged"));
        doubt("shared, two models", messages::Shared::TwoModels, QStringLiteral("it answered as two different models"));
        doubt("shared, more", messages::Shared::MoreThanOne, QStringLiteral("more came than one answer"));
        doubt("shared, collide", messages::Shared::Collide, QStringLiteral("their answers collide"));
        doubt("shared, reads damaged", messages::Shared::ReadsDamaged,
              QStringLiteral("it answers a Ping well, but what is read of it comes damaged"));
        doubt("shared, reads differ", messages::Shared::ReadsDiffer,
              QStringLiteral("what is read of it jumps as no single device's registers do"));
        doubt("shared, both", messages::Shared::BothAnswered, QStringLiteral("both answered the scan"));
        row("only the scan", {ErrorKind::NoHeader, messages::onlyTheScan()},
            QStringLiteral("it answered the scan, but no Ping of its own"));
        row("torque still on", {ErrorKind::Stopped, messages::torqueStillOn(4)},
            QStringLiteral("device 4 still says that its torque is on"));
        row("another model", messages::anotherModel(4, 1060, 1020),
            QStringLiteral("device 4 answers as model number 1060, not 1020: another servo has its place; scan to find who is "
                           "there"));
        row("level", messages::silentByLevel(3, 0),
            QStringLiteral("device 3 did not answer: its Status Return Level 0 lets it answer only Ping"));
        row("limit", messages::refused(3, DeviceError::DataLimit),
            QStringLiteral("device 3 refused: Data Limit Error, the value is beyond a limit register"));
        row("unlisted", messages::refused(3, static_cast<DeviceError>(42)),
            QStringLiteral("device 3 refused: Error 42, it gave an error number the manual does not list"));
        row("too long", messages::packetTooLong(1040, 1024),
            QStringLiteral("a packet of 1040 bytes would be needed; devices take 1024 at most"));
    }

    void port()
    {
        QFETCH(QString, text);
        QFETCH(QString, expected);
        QCOMPARE(text, expected);
    }

    void canBeTranslated()
    {
        Brackets brackets;
        QCoreApplication::installTranslator(&brackets);
        const QString port = QStringLiteral("p");
        const std::vector<Error> all{messages::nothingReceived(1, 1ms), messages::noHeader(1, 2),
            messages::cutOff(1, 2, 0), messages::cutOff(1, 2, 3), messages::damagedCrc(1), messages::wrongId(1, {2, 3}),
            messages::wrongLength(1, 2, 3), messages::refused(1, DeviceError::Access), messages::chainBroken(1, 2),
            messages::silentByLevel(1, 1), messages::mayBeWritten(messages::damagedCrc(1)),
            messages::notWritten(messages::damagedCrc(1), {}, {}), messages::stopped(), messages::cancelled(),
            messages::closed(port), messages::notConfirmed(1, {}, {}), messages::packetTooLong(2, 1),
            messages::portNotFound(port), messages::portEmpty(port),
            messages::portForbidden(port), messages::portBusy(port, port), messages::portBusy(port, {}),
            messages::portNotSerial(port), messages::portFailed(port, port), messages::portLost(port),
            messages::answersOnlyPing(1), messages::rateRefused(port, 2, 1), messages::rateRefused(port, 2, 0),
            messages::addressMalformed(port), messages::portNumberWrong(port, port), messages::hostUnknown(port, port),
            messages::nameServerSilent(port, port), messages::hostSilent(port, port, 5s),
            messages::hostUnreachable(port, port, port), messages::connectionRefused(port),
            messages::connectionEnded(port, {}), messages::connectionLost(port), messages::notRfc2217(port),
            messages::rateNotConfirmed(port, 1), messages::rateIsTheServers(port, 1), messages::deviceRateBound(port),
            messages::onlyLate(1), messages::asleep(1), messages::withOthers(messages::asleep(1), {}),
            messages::withOthers(messages::asleep(1), {2}), messages::withOthers(messages::asleep(1), {2, 3}),
            {ErrorKind::NoHeader, messages::unreadable(2)},
            {ErrorKind::NoHeader, messages::sharedId(1, messages::Shared::Collide)},
            {ErrorKind::PortBusy, messages::portHolder(port, port)},
            {ErrorKind::PortBusy, messages::portHolder({}, port)},
            {ErrorKind::PortBusy, messages::thisProgram()}, {ErrorKind::NoHeader, messages::onlyTheScan()},
            {ErrorKind::Stopped, messages::torqueStillOn(1)}};
        QCoreApplication::removeTranslator(&brackets);
        for (const Error &error : all)
            QVERIFY2(error.text.startsWith(u'<') && error.text.endsWith(u'>'), qPrintable(error.text));
        QCOMPARE(messages::wrongId(1, {2}).text, QStringLiteral("device 1 did not answer, but device 2 did"));
    }

    void saysDurationsShortly()
    {
        QCOMPARE(messages::durationText(632us), QStringLiteral("0.63 ms"));
        QCOMPARE(messages::durationText(4ms), QStringLiteral("4 ms"));
        QCOMPARE(messages::durationText(4649us), QStringLiteral("4.6 ms"));
        QCOMPARE(messages::durationText(16'200us), QStringLiteral("16 ms"));
        QCOMPARE(messages::durationText(150ms), QStringLiteral("150 ms"));
        QCOMPARE(messages::durationText(3160ms), QStringLiteral("3.2 s"));
    }
};

DYNASCOPE_CORE_TEST(TestMessages)
#include "tst_messages.moc"
