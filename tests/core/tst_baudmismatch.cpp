// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/baudmismatch.h"
#include "tests/support/simclient.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace dynascope::sim;
using namespace simclient;

class TestBaudMismatch : public QObject
{
    Q_OBJECT

private slots:
    void tolerance_data()
    {
        QTest::addColumn<int>("one");
        QTest::addColumn<int>("other");
        QTest::addColumn<bool>("understood");
        QTest::newRow("equal") << 57600 << 57600 << true;
        QTest::newRow("an FTDI's 4.5 M") << 4571428 << 4500000 << true;
        QTest::newRow("5 %") << 60500 << 57600 << false;
        QTest::newRow("neighbours") << 57600 << 115200 << false;
    }

    void tolerance()
    {
        QFETCH(int, one);
        QFETCH(int, other);
        QFETCH(bool, understood);
        QCOMPARE(understandEachOther(one, other), understood);
    }

    /// A UART's view, worked out by hand on the bits.
    void heard_data()
    {
        QTest::addColumn<QString>("sent");
        QTest::addColumn<int>("from");
        QTest::addColumn<int>("to");
        QTest::addColumn<QString>("heard");
        QTest::newRow("the same rate changes nothing") << "FF 00 A5 5A FD" << 57600 << 57600 << "FF 00 A5 5A FD";
        // FF: one low bit. Twice as fast a listener takes it for start and a low first bit.
        QTest::newRow("FF at twice the rate") << "FF" << 57600 << 115200 << "FE";
        // Half as fast it sees the start bit's second half gone by: all ones.
        QTest::newRow("FF at half the rate") << "FF" << 115200 << 57600 << "FF";
        // 00: nine low bits, no stop bit for a fast listener: a break, lost.
        QTest::newRow("00 at ten times the rate") << "00" << 100000 << 1000000 << "";
        // 55: ten bits low and high in turn, each seen twice: 66 without a stop bit, lost; then from the seventh on.
        QTest::newRow("55 at twice the rate") << "55" << 57600 << 115200 << "E6";
    }

    void heard()
    {
        QFETCH(QString, sent);
        QFETCH(int, from);
        QFETCH(int, to);
        QFETCH(QString, heard);
        QCOMPARE(hex(heardAtOtherBaud(hex(sent), from, to)), hex(hex(heard)));
    }

    void aPacketIsNoPacketAtAnotherRate()
    {
        const Bytes ping = instruction(QStringLiteral("01 01"));
        const int rates[] = {9600, 57600, 115200, 1000000, 2000000, 3000000, 4000000, 4500000};
        for (const int from : rates) {
            for (const int to : rates) {
                if (from != to)
                    QVERIFY(heardAtOtherBaud(ping, from, to) != ping);
            }
        }
    }
};

DYNASCOPE_CORE_TEST(TestBaudMismatch)
#include "tst_baudmismatch.moc"
