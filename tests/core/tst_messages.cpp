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
        row("not serial", messages::portNotSerial(port), QStringLiteral("/dev/ttyUSB0 is not a serial port"));
        row("lost", messages::portLost(port),
            QStringLiteral("/dev/ttyUSB0 is gone: unplugged, or closed by the other side"));
        row("rate refused", messages::rateRefused(port, 4'500'000, 0),
            QStringLiteral("/dev/ttyUSB0 can't do 4500000 baud"));
        row("rate off", messages::rateRefused(port, 4'500'000, 4'000'000),
            QStringLiteral("/dev/ttyUSB0 can't do 4500000 baud: it would send at 4000000, more than 3 % off"));
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
            messages::rateRefused(port, 2, 1), messages::rateRefused(port, 2, 0)};
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
