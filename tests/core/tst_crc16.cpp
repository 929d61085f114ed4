// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/protocol/crc16.h"
#include "tests/support/oracle.h"
#include "tests/support/testmain.h"

using namespace dynascope;

class TestCrc16 : public QObject
{
    Q_OBJECT

private slots:
    void agreesWithLongDivision()
    {
        Bytes bytes;
        for (int i = 0; i < 512; ++i) {
            QCOMPARE(crc16(bytes), oracle::crc(bytes));
            bytes.push_back(static_cast<std::uint8_t>(i * 37 + (i >> 3)));
        }
    }

    void continuesFromASeed()
    {
        const Bytes whole{0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x03, 0x00, 0x01};
        const ByteView view(whole);
        QCOMPARE(crc16(view), std::uint16_t(0x4E19));
        QCOMPARE(crc16(view.subspan(3), crc16(view.first(3))), crc16(view));
    }
};

DYNASCOPE_CORE_TEST(TestCrc16)
#include "tst_crc16.moc"
