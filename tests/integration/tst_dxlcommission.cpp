// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/journal/journal.h"
#include "core/session/procedures/movefile.h"
#include "tests/support/dxlbus.h"
#include "tests/support/testmain.h"

#include <QDir>
#include <QJsonDocument>
#include <QJsonObject>

using namespace Qt::StringLiterals;
using namespace dynascope;
using dynascope::test::DxlBus;
using dynascope::test::Outcome;
using dynascope::test::RunningDxl;

/// `dxl commission`: new servos, plugged in one after the other.
class TestDxlCommission : public QObject
{
    Q_OBJECT

private slots:
    void init() { QDir(MoveFile::usualFolder()).removeRecursively(); }

    void theOneThatIsThere()
    {
        DxlBus bus(u"XM430-W350@57600:1"_s);
        const QTemporaryDir folder;
        const QString labels = folder.filePath(u"labels.csv"_s);
        const Outcome outcome
            = bus.dxl({u"--baud"_s, u"1000000"_s, u"--json"_s, u"commission"_s, u"--model"_s, u"XM430-W350"_s, u"--ids"_s,
                       u"11"_s, u"--names"_s, u"shoulder"_s, u"--present"_s, u"--no-led"_s, u"--labels"_s, labels});
        QCOMPARE(outcome.err, QString());
        QCOMPARE(outcome.code, 0);
        QCOMPARE(outcome.out.count(u'\n'), 1);
        const QJsonObject said = QJsonDocument::fromJson(outcome.out.toUtf8()).object();
        QCOMPARE(said.value(u"joint"_s).toString(), u"shoulder"_s);
        QCOMPARE(said.value(u"id"_s).toInt(), 11);
        QCOMPARE(said.value(u"baud"_s).toInt(), 1'000'000);
        QCOMPARE(said.value(u"was_id"_s).toInt(), 1);
        QCOMPARE(said.value(u"was_baud"_s).toInt(), 57600);
        QVERIFY(said.value(u"written"_s).toBool());
        QCOMPARE(bus.value(11, 1'000'000, u"Baud Rate"), 3);
        QFile file(labels);
        QVERIFY(file.open(QIODevice::ReadOnly));
        QVERIFY(file.readAll().contains("\nshoulder,11,1000000,XM430-W350,1020,"));
        const Journal journal(Journal::usualFolder());
        QCOMPARE(journal.entries().back().changes.front().name, u"Baud Rate"_s);
        QCOMPARE(journal.entries().back().movedTo->baudRate, 1'000'000);

        // The same once more: it stands so already, and nothing is written.
        bus.forget();
        const Outcome again = bus.dxl({u"--baud"_s, u"1000000"_s, u"commission"_s, u"--model"_s, u"XM430-W350"_s,
                                       u"--ids"_s, u"11"_s});
        QCOMPARE(again.code, 0);
        QVERIFY2(again.out.startsWith(u"ID 11: XM430-W350, firmware "), qPrintable(again.out));
        QVERIFY2(again.out.endsWith(u"ID 11 at 1000000 bps (stood so already)\n"), qPrintable(again.out));
        for (const Bytes &packet : bus.sent())
            QVERIFY(packet[7] == static_cast<std::uint8_t>(Instruction::Ping)
                    || packet[7] == static_cast<std::uint8_t>(Instruction::Read));
    }

    void interrupted()
    {
        DxlBus bus(u"XL430-W250@57600:1"_s);
        RunningDxl running(bus.with({u"commission"_s, u"--model"_s, u"XM430-W350"_s, u"--ids"_s, u"11-12"_s}));
        QTRY_VERIFY_WITH_TIMEOUT(!bus.sent().empty(), 30'000);
        const Outcome outcome = running.interrupt();
        QCOMPARE(outcome.code, 130);
        QVERIFY2(outcome.err.contains(u"0 of 2 are ticked off; the same command goes on"), qPrintable(outcome.err));
        QCOMPARE(bus.value(1, 57600, u"ID"), 1);
    }

    void refusals_data()
    {
        QTest::addColumn<QString>("arguments");
        QTest::addColumn<QString>("says");
        QTest::newRow("nothing said") << u"commission"_s << u"say which servos"_s;
        QTest::newRow("no IDs") << u"commission --model XM430-W350"_s << u"say which servos"_s;
        QTest::newRow("both") << u"commission --model XM430-W350 --ids 1 --profile x.yaml"_s << u"say which servos"_s;
        QTest::newRow("no such model") << u"commission --model XM999 --ids 1"_s << u"no model XM999"_s;
        QTest::newRow("no such rate")
            << u"--baud 10500000 commission --model XM430-W350 --ids 1"_s << u"does not offer 10500000 bps"_s;
        QTest::newRow("names") << u"commission --model XM430-W350 --ids 1-3 --names a,b"_s << u"2 names for 3 IDs"_s;
        QTest::newRow("no such file") << u"commission --profile /nowhere.yaml"_s << u"/nowhere.yaml"_s;
    }
    void refusals()
    {
        QFETCH(QString, arguments);
        QFETCH(QString, says);
        DxlBus bus(u"XM430-W350@57600:1"_s);
        const Outcome outcome = bus.dxl(arguments.split(u' '));
        QCOMPARE(outcome.code, 2);
        QCOMPARE(outcome.out, QString());
        QVERIFY2(outcome.err.contains(says), qPrintable(outcome.err));
        QVERIFY(bus.sent().empty());
    }
};

DYNASCOPE_CORE_TEST(TestDxlCommission)
#include "tst_dxlcommission.moc"
