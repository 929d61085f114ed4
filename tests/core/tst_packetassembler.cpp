// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/packetassembler.h"
#include "tests/support/simclient.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace dynascope::sim;
using namespace simclient;

class TestPacketAssembler : public QObject
{
    Q_OBJECT

private slots:
    void pieces_data()
    {
        QTest::addColumn<QString>("stream");
        QTest::addColumn<QStringList>("packets"); // the last of them is compared
        const QString ping = hex(instruction(QStringLiteral("01 01")));
        const QString read = hex(instruction(QStringLiteral("02 02 84 00 04 00")));
        QTest::newRow("one") << ping << QStringList{ping};
        QTest::newRow("two") << ping + u' ' + read << QStringList{ping, read};
        QTest::newRow("noise before") << QStringLiteral("01 02 FF ") + ping << QStringList{ping};
        const QString beginning = QStringLiteral("FF FF FD 00 01");
        QTest::newRow("the beginning alone") << beginning << QStringList{beginning};
        const QString tooLong = QStringLiteral("FF FF FD 00 01 FF FF 01 02");
        QTest::newRow("a length that can't be") << tooLong << QStringList{tooLong};
    }

    void pieces()
    {
        QFETCH(QString, stream);
        QFETCH(QStringList, packets);
        const Bytes bytes = hex(stream);
        for (std::size_t piece = 1; piece <= bytes.size(); ++piece) {
            PacketAssembler assembler;
            Bytes all;
            QStringList got;
            for (std::size_t at = 0; at < bytes.size(); at += piece) {
                assembler.feed(ByteView(bytes).subspan(at, std::min(piece, bytes.size() - at)), 0ms);
                while (const auto packet = assembler.next(1ms))
                    got.append(hex(*packet));
            }
            while (const auto packet = assembler.next(1s))
                got.append(hex(*packet));
            QCOMPARE(got.join(u' '), stream);
            if (piece == bytes.size())
                QCOMPARE(got.last(), packets.last());
        }
    }

    void waitsForTheRest()
    {
        PacketAssembler assembler;
        const Bytes ping = instruction(QStringLiteral("01 01"));
        assembler.feed(ByteView(ping).first(6), 100ms);
        QVERIFY(!assembler.next(110ms));
        QVERIFY(assembler.deadline());
        assembler.feed(ByteView(ping).subspan(6), 115ms);
        QCOMPARE(hex(*assembler.next(115ms)), hex(ping));
        QVERIFY(!assembler.deadline());
    }
};

DYNASCOPE_CORE_TEST(TestPacketAssembler)
#include "tst_packetassembler.moc"
