// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/journal/journal.h"
#include "core/session/procedures/movefile.h"
#include "tests/support/dxlbus.h"
#include "tests/support/testmain.h"

#include <QDir>

using namespace Qt::StringLiterals;
using namespace dynascope;
using dynascope::test::DxlBus;
using dynascope::test::Outcome;

/// `dxl move`: new IDs and a new baud rate for many.
class TestDxlMove : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        QDir(MoveFile::usualFolder()).removeRecursively();
        m_bus = std::make_unique<DxlBus>(u"XM430-W350@57600:1,XL430-W250@57600:2,XM430-W350@57600:3"_s);
        QVERIFY(!m_bus->path().isEmpty());
    }
    void cleanup() { m_bus.reset(); }

    void aRingAndANewRate()
    {
        const Outcome dry = m_bus->dxl(u"move 1=2 2=3 3=1 --to-baud 1000000 --dry-run");
        QCOMPARE(dry.err, QString());
        QCOMPARE(dry.code, 0);
        QVERIFY(dry.out.count(u'\n') >= 6);
        QCOMPARE(model(2, 57600), u"XL430-W250"_s);
        const Outcome outcome = m_bus->dxl(u"move 1=2 2=3 3=1 --to-baud 1000000");
        QCOMPARE(outcome.err, QString());
        QCOMPARE(outcome.code, 0);
        QCOMPARE(outcome.out, dry.out);
        QCOMPARE(model(3, 1'000'000), u"XL430-W250"_s);
        QCOMPARE(model(1, 1'000'000), u"XM430-W350"_s);
        QVERIFY(!MoveFile(MoveFile::usualFolder(), m_bus->path(), {}).exists());
        const Outcome again = m_bus->dxl(u"--baud 1000000 move --to-baud 1000000");
        QCOMPARE(again.err, u"dxl: everybody is where they shall be; nothing was written\n"_s);
        QCOMPARE(Journal(Journal::usualFolder()).entries().back().movedTo->baudRate, 1'000'000);
    }

    void refusals_data()
    {
        QTest::addColumn<QString>("arguments");
        QTest::addColumn<int>("code");
        QTest::addColumn<QString>("says");
        QTest::newRow("taken") << u"move 1=2"_s << 2 << u"would both have ID 2 at 57600 bps; nothing was written"_s;
        QTest::newRow("a rate that XL430 lacks") << u"move --to-baud 10500000"_s << 2 << u"does not offer"_s;
        QTest::newRow("nobody there") << u"move 9=10"_s << 1 << u"device 9 did not answer"_s;
        QTest::newRow("nothing said") << u"move"_s << 2 << u"say new IDs"_s;
        QTest::newRow("no IDs") << u"move 1=2-3"_s << 2 << u"is no change of IDs"_s;
        QTest::newRow("twice") << u"move 1=2 1=3"_s << 2 << u"for the second time"_s;
        QTest::newRow("nothing left") << u"move --resume"_s << 2 << u"No moves were left half done"_s;
    }
    void refusals()
    {
        QFETCH(QString, arguments);
        QFETCH(int, code);
        QFETCH(QString, says);
        const Outcome outcome = m_bus->dxl(arguments.split(u' '));
        QCOMPARE(outcome.code, code);
        QVERIFY2(outcome.err.contains(says), qPrintable(outcome.err));
        QCOMPARE(model(1, 57600), u"XM430-W350"_s);
        QCOMPARE(model(2, 57600), u"XL430-W250"_s);
    }

    void aKilledMoveIsSaidAndGoesOn()
    {
        m_bus->set(3, 57600, u"Torque Enable", 1); // the last one refuses
        const Outcome stopped = m_bus->dxl(u"move --to-baud 1000000");
        QCOMPARE(stopped.code, 1);
        QVERIFY2(stopped.err.contains(u"dxl move --resume goes on"_s), qPrintable(stopped.err));
        QCOMPARE(model(1, 1'000'000), u"XM430-W350"_s);
        QVERIFY(m_bus->dxl(u"scan").err.contains(u"was interrupted"_s)); // whatever is started next
        QCOMPARE(m_bus->dxl(u"move 3=4").code, 2);
        QCOMPARE(m_bus->dxl(u"move --resume --torque-off").code, 0);
        QCOMPARE(model(3, 1'000'000), u"XM430-W350"_s);
        QVERIFY(!m_bus->dxl(u"--baud 1000000 scan").err.contains(u"was interrupted"_s));
    }

private:
    /// Empty: nobody is there.
    QString model(int id, int baudRate)
    {
        QString found;
        m_bus->call([&](sim::SimulatedBus &bus, LineTime) {
            if (const sim::Servo *servo = bus.servo(id, baudRate))
                found = servo->model();
        });
        return found;
    }

    std::unique_ptr<DxlBus> m_bus;
};

DYNASCOPE_CORE_TEST(TestDxlMove)
#include "tst_dxlmove.moc"
