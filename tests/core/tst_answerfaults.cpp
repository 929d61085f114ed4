// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/answerfaults.h"
#include "tests/support/testmain.h"

#include <QSet>

using namespace dynascope;

namespace {

DeviceQuality quality(quint64 good, quint64 timeouts, quint64 cutOff = 0, quint64 crc = 0, quint64 length = 0,
                      quint64 late = 0)
{
    DeviceQuality result;
    result.good = good;
    result.timeouts = timeouts;
    result.cutOff = cutOff;
    result.crcErrors = crc;
    result.lengthErrors = length;
    result.lateAnswers = late;
    return result;
}

} // namespace

class TestAnswerFaults : public QObject
{
    Q_OBJECT

private slots:
    /// Every bad answer is exactly one of them.
    void theyAddUp()
    {
        const DeviceQuality some = quality(100, 7, 3, 5, 2, 1);
        QCOMPARE(countOf(some, AnswerFault::Missing), quint64(4));
        QCOMPARE(countOf(some, AnswerFault::CutOff), quint64(3));
        QCOMPARE(countOf(some, AnswerFault::Damaged), quint64(5));
        QCOMPARE(countOf(some, AnswerFault::WrongLength), quint64(2));
        QCOMPARE(countOf(some, AnswerFault::Late), quint64(1));
        quint64 all = 0;
        for (const AnswerFault fault : AllAnswerFaults)
            all += countOf(some, fault);
        QCOMPARE(all, some.bad());
    }

    void theMainOne()
    {
        QVERIFY(!mainFault(quality(100, 0)));
        QVERIFY(mainFault(quality(100, 7, 3, 5)) == AnswerFault::Damaged);
        QVERIFY(mainFault(quality(100, 7, 7, 5)) == AnswerFault::CutOff);
        QVERIFY(mainFault(quality(0, 0, 0, 0, 0, 1)) == AnswerFault::Late);
        QVERIFY(mainFault(quality(0, 1, 0, 0, 1)) == AnswerFault::Missing); // as many: the first
    }

    void theVerdict_data()
    {
        QTest::addColumn<quint64>("good");
        QTest::addColumn<quint64>("bad");
        QTest::addColumn<int>("verdict");
        const auto row = [](const char *name, quint64 good, quint64 bad, Verdict verdict) {
            QTest::newRow(name) << good << bad << static_cast<int>(verdict);
        };
        row("not asked", 0, 0, Verdict::Unknown);
        row("all good", 10, 0, Verdict::Good);
        row("less than one in a thousand", 1000, 1, Verdict::Good);
        row("one in a thousand", 999, 1, Verdict::Poor);
        row("nearly one in a hundred", 1000, 9, Verdict::Poor);
        row("one in a hundred", 990, 10, Verdict::Bad);
        row("two of three may be an accident", 1, 2, Verdict::Poor);
        row("three are none", 1, 3, Verdict::Bad);
        row("never an answer", 0, 50, Verdict::Bad);
    }

    void theVerdict()
    {
        QFETCH(quint64, good);
        QFETCH(quint64, bad);
        QTEST(static_cast<int>(verdictOn(quality(good, bad))), "verdict");
    }

    void sortedByVerdictThenByShare()
    {
        QVERIFY(badness(quality(19, 1)) < badness(quality(900, 10))); // one of twenty, behind a bad cable
        QVERIFY(badness(quality(900, 10)) < badness(quality(900, 20)));
        QVERIFY(badness(quality(0, 0)) < badness(quality(10, 0)));
        QCOMPARE(badness(quality(1'000'000, 1)), badness(quality(1'000'000, 2))); // looks alike
    }

    void eachIsPutIntoWords()
    {
        QSet<QString> words;
        for (const AnswerFault fault : AllAnswerFaults) {
            for (const QString &text : {faultName(fault), faultMeaning(fault), usualCauses(fault)}) {
                QVERIFY(!text.isEmpty());
                QVERIFY2(!words.contains(text), qPrintable(text));
                words.insert(text);
            }
            QVERIFY(faultMeaning(fault).endsWith(u'.') && usualCauses(fault).endsWith(u'.'));
        }
    }
};

DYNASCOPE_CORE_TEST(TestAnswerFaults)
#include "tst_answerfaults.moc"
