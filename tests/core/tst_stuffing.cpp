// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/protocol/stuffing.h"
#include "tests/support/hex.h"
#include "tests/support/oracle.h"
#include "tests/support/testmain.h"

using namespace dynascope;

namespace {

/// Every body over {FF, FD, 00} of that length, by number.
Bytes bodyOf(int number, int length)
{
    constexpr std::uint8_t Alphabet[] = {0xFF, 0xFD, 0x00};
    Bytes body;
    for (int i = 0; i < length; ++i) {
        body.push_back(Alphabet[number % 3]);
        number /= 3;
    }
    return body;
}

int power(int base, int exponent)
{
    int result = 1;
    while (exponent-- > 0)
        result *= base;
    return result;
}

Bytes stuffed(const Bytes &body)
{
    Bytes result;
    appendStuffed(result, body);
    return result;
}

} // namespace

class TestStuffing : public QObject
{
    Q_OBJECT

private slots:
    void agreesWithTheOracle()
    {
        for (int length = 0; length <= 8; ++length) {
            for (int number = 0; number < power(3, length); ++number) {
                const Bytes body = bodyOf(number, length);
                const Bytes expected = oracle::stuff(body);
                if (stuffed(body) != expected)
                    QCOMPARE(hex::text(stuffed(body)), hex::text(expected));
                const Unstuffed back = unstuff(expected);
                if (back.body != body || back.forgotten)
                    QCOMPARE(hex::text(back.body), hex::text(body));
            }
        }
    }

    void oracleFindsNoOtherBody()
    {
        for (int number = 0; number < power(3, 7); ++number) {
            const Bytes wire = bodyOf(number, 7);
            bool found = false;
            const Bytes body = oracle::unstuff(wire, &found);
            if (!found)
                continue;
            const Unstuffed ours = unstuff(wire);
            if (ours.body != body || ours.forgotten)
                QCOMPARE(hex::text(ours.body), hex::text(body));
        }
    }

    void keepsAndFlagsWhatWasNotStuffed()
    {
        const Unstuffed bare = unstuff(hex::bytes("55 00 FF FF FD 12"));
        QVERIFY(bare.forgotten);
        QCOMPARE(hex::text(bare.body), QStringLiteral("55 00 FF FF FD 12"));
        const Unstuffed atEnd = unstuff(hex::bytes("55 00 FF FF FD"));
        QVERIFY(atEnd.forgotten);
        QCOMPARE(hex::text(atEnd.body), QStringLiteral("55 00 FF FF FD"));
    }

    void growsByAThirdAtMost()
    {
        for (int length = 0; length <= 8; ++length) {
            for (int number = 0; number < power(3, length); ++number) {
                const Bytes body = bodyOf(number, length);
                QVERIFY(stuffed(body).size() <= body.size() + body.size() / 3);
            }
        }
    }
};

DYNASCOPE_CORE_TEST(TestStuffing)
#include "tst_stuffing.moc"
