// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/wire.h"
#include "tests/support/simclient.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace dynascope::sim;
using namespace simclient;

namespace {

constexpr int Baud = 1'000'000; // a bit is a microsecond

/// The wire never looks into a servo: who it is is enough.
const Servo *speaker(int number)
{
    static const std::array<int, 4> someone{};
    return reinterpret_cast<const Servo *>(&someone[static_cast<std::size_t>(number)]);
}

Transmission spoken(const Servo *sender, const QString &bytes, int atMicroseconds)
{
    Transmission one;
    one.begin = std::chrono::microseconds(atMicroseconds);
    one.baudRate = Baud;
    one.sender = sender;
    one.bytes = hex(bytes);
    return one;
}

Bytes heard(Wire &wire)
{
    std::vector<HeardByte> all;
    wire.hear(all, 10ms, Baud);
    Bytes bytes;
    for (const HeardByte &one : all)
        bytes.push_back(one.byte);
    return bytes;
}

} // namespace

/// What is heard when two speak at the same time: the wire is low when either pulls it low.
class TestWire : public QObject
{
    Q_OBJECT

private slots:
    void twoAnswers_data()
    {
        QTest::addColumn<QString>("first");
        QTest::addColumn<QString>("second");
        QTest::addColumn<int>("after"); // µs, which are bits
        QTest::addColumn<QString>("heard");
        QTest::addColumn<bool>("damaged");
        QTest::newRow("alike, at once: as one") << "FF FD 55" << "FF FD 55" << 0 << "FF FD 55" << false;
        QTest::newRow("unlike, at once: byte AND byte") << "F0 3C" << "55 FF" << 0 << "50 3C" << true;
        QTest::newRow("the longer one's end") << "F0" << "FF 12 34" << 0 << "F0 12 34" << false;
        // Nine low bits from the fourth on: three bits of the first byte stay, two of the next are pulled low.
        QTest::newRow("half a byte later") << "FF FF" << "00" << 4 << "07 FC" << true;
        // The second's start bit is all that pulls: bit 3 of the first.
        QTest::newRow("one start bit") << "FF" << "FF" << 4 << "F7" << true;
        QTest::newRow("one after the other") << "55" << "AA" << 10 << "55 AA" << false;
        QTest::newRow("a whole byte behind the mix") << "FF" << "FF 5A" << 5 << "EF 5A" << true;
    }

    void twoAnswers()
    {
        QFETCH(QString, first);
        QFETCH(QString, second);
        QFETCH(int, after);
        QFETCH(bool, damaged);
        Wire wire;
        wire.begin(spoken(speaker(0), first, 0));
        wire.begin(spoken(speaker(1), second, after));
        QTEST(hex(heard(wire)), "heard");
        QCOMPARE(wire.takeEnded().damaged, damaged);
    }

    void theTailIsTakenForBytes()
    {
        Wire wire;
        wire.begin(spoken(speaker(0), QStringLiteral("FF"), 0));
        wire.begin(spoken(speaker(1), QStringLiteral("FF 00 FF FF"), 5)); // its 00 is half over when the first has ended
        // From bit 10 on the wire is 1 1 1 1 1, then 00 with its start bit: heard as it is.
        QCOMPARE(hex(heard(wire)), QStringLiteral("EF 00 FF FF"));

        Wire other;
        other.begin(spoken(speaker(0), QStringLiteral("FF FF"), 0));
        other.begin(spoken(speaker(1), QStringLiteral("FF 0F FF FF"), 5)); // from bit 20 on: 0 0 0 0 and a stop bit
        const Bytes bytes = heard(other);
        QCOMPARE(bytes.front(), std::uint8_t(0xEF));
        QVERIFY(hex(bytes) != QStringLiteral("EF FF 0F FF FF"));
        QVERIFY(bytes.size() <= 4); // what looks like a byte swallows the ones behind it
    }

    void theAdapterDoesNotListenWhileItSends()
    {
        for (const bool echo : {false, true}) {
            Wire wire;
            wire.setEcho(echo);
            wire.begin(spoken(speaker(0), QStringLiteral("11 22 33 44"), 0));
            wire.begin(spoken(nullptr, QStringLiteral("FF"), 10)); // falls on the second byte
            QCOMPARE(hex(heard(wire)), echo ? QStringLiteral("11 22 33 44") : QStringLiteral("11 33 44"));
        }
    }

    void threeAtOnce()
    {
        Wire wire;
        wire.begin(spoken(speaker(0), QStringLiteral("FC"), 0));
        wire.begin(spoken(speaker(1), QStringLiteral("F3"), 0));
        wire.begin(spoken(speaker(2), QStringLiteral("CF"), 0));
        QCOMPARE(hex(heard(wire)), QStringLiteral("C0"));
    }
};

DYNASCOPE_CORE_TEST(TestWire)
#include "tst_wire.moc"
