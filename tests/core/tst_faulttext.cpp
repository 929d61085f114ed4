// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/faulttext.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace dynascope::sim;
using namespace std::chrono_literals;

Q_DECLARE_METATYPE(LineFaults)

/// The faults of a line as people write them.
class TestFaultText : public QObject
{
    Q_OBJECT

private slots:
    void good_data()
    {
        using Kind = ReplyFault::Kind;
        QTest::addColumn<QString>("text");
        QTest::addColumn<LineFaults>("faults");
        const auto row = [](const char *text, const LineFaults &faults) {
            QTest::newRow(text) << QString::fromLatin1(text) << faults;
        };
        row("", {});
        row("echo", {.echo = {.on = true}});
        row("echo=2ms", {.echo = {.on = true, .delay = 2ms}});
        row("  echo   latency=16ms ", {.echo = {.on = true}, .latencyTimer = 16ms});
        row("latency=1ms latency=0.25s", {.latencyTimer = 250ms});
        row("jitter=20us", {.replyJitter = 20us});
        row("noise=0.5", {.noisePerSecond = 0.5});
        row("noise=20/s", {.noisePerSecond = 20});
        row("silent=4,6-8", {.silent = {4, 6, 7, 8}});
        row("dead-segment=4,5", {.deaf = {4, 5}});
        row("unplugged", {.unplugged = true});
        row("unplug-sent=12 unplug-answered=0", {.unplugAtSent = 12, .unplugAtAnswered = 0});
        row("strict-gaps", {.bridgedGap = 1500us});
        row("drop", {.replies = {{.kind = Kind::Lost, .times = -1}}});
        row("drop:3=0.02", {.replies = {{.kind = Kind::Lost, .id = 3, .times = -1, .share = 0.02}}});
        row("drop=50%*3", {.replies = {{.kind = Kind::Lost, .times = 3, .share = 0.5}}});
        row("damage:1-2", {.replies = {{.kind = Kind::Damaged, .id = 1, .times = -1},
                                       {.kind = Kind::Damaged, .id = 2, .times = -1}}});
        row("cut", {.replies = {{.kind = Kind::Cut, .times = -1, .amount = -1}}});
        row("cut=5@10%", {.replies = {{.kind = Kind::Cut, .times = -1, .amount = 5, .share = 0.1}}});
        row("late:3=20ms@0.5", {.replies = {{.kind = Kind::Late, .id = 3, .times = -1, .time = 20ms, .share = 0.5}}});
        row("twice=1ms*1", {.replies = {{.kind = Kind::Twice, .times = 1, .time = 1ms}}});
        row("reboot:2*1", {.replies = {{.kind = Kind::Reboot, .id = 2, .times = 1}}});
        row("wrong-id=9", {.replies = {{.kind = Kind::WrongId, .times = -1, .amount = 9}}});
        row("wrong-length=-2", {.replies = {{.kind = Kind::WrongLength, .times = -1, .amount = -2}}});
        row("stray=9", {.replies = {{.kind = Kind::StrayBefore, .times = -1, .amount = 9}}});
        row("garbage=3", {.replies = {{.kind = Kind::NoiseBefore, .times = -1, .amount = 3}}});
    }

    void good()
    {
        QFETCH(QString, text);
        const auto read = parseFaults(text);
        QVERIFY2(read, qPrintable(read ? QString() : read.error().text));
        QFETCH(LineFaults, faults);
        QVERIFY(*read == faults);
    }

    void bad_data()
    {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("says");
        const auto row = [](const char *text, const char *says) {
            QTest::newRow(text) << QString::fromLatin1(text) << QString::fromLatin1(says);
        };
        row("frobnicate", "no fault is called frobnicate; there are echo, latency, jitter,");
        row("latency=16", "it is written latency=TIME, with 250us, 16ms or 1.5s as TIME");
        row("late:3=16", "it is written late[:IDS]=TIME, with 250us, 16ms or 1.5s as TIME");
        row("=3", "no fault is called");
        row("echo nonsense=1", "\"nonsense=1\"");
        row("latency", "latency=TIME");
        row("latency=16", "latency=TIME");
        row("latency=-1ms", "latency=TIME");
        row("latency=nanms", "latency=TIME");
        row("latency=1e300s", "latency=TIME");
        row("latency:3=1ms", "latency=TIME");
        row("noise=-1", "noise=N");
        row("noise=inf", "noise=N");
        row("drop=1.5", "drop[:IDS][=SHARE]");
        row("drop:253", "0 to 252");
        row("drop:5-3", "IDs are written");
        row("drop:", "IDs are written");
        row("drop@2", "share");
        row("drop*0", "behind *");
        row("late", "late[:IDS]=TIME");
        row("wrong-id=300", "wrong-id[:IDS]=ID");
        row("unplugged=1", "unplugged");
        row("drop:0-252 drop:0-252", "more than 256");
    }

    void bad()
    {
        QFETCH(QString, text);
        QFETCH(QString, says);
        const auto read = parseFaults(text);
        QVERIFY(!read);
        QVERIFY2(read.error().text.contains(says), qPrintable(read.error().text));
    }

    void addsToWhatIsThere()
    {
        const auto read = parseFaults(u"drop:1", {.latencyTimer = 5ms, .silent = {3}});
        QVERIFY(read);
        QCOMPARE(read->latencyTimer, LineTime(5ms));
        QCOMPARE(read->silent.size(), std::size_t(1));
        QCOMPARE(read->replies.size(), std::size_t(1));
    }

    void tooLong() { QVERIFY(!parseFaults(QString(5000, u'x'))); }

    void everyWordOfTheHelpIsKnown()
    {
        for (const QString &line : faultHelp().first(faultHelp().size() - 1)) {
            const QString name = line.section(u' ', 0, 0).section(u'[', 0, 0).section(u'=', 0, 0);
            const auto read = parseFaults(name + QStringLiteral(":x"));
            QVERIFY(!read && !read.error().text.contains(QStringLiteral("no fault is called")));
        }
    }
};

DYNASCOPE_CORE_TEST(TestFaultText)
#include "tst_faulttext.moc"
