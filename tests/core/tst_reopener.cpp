// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/reopener.h"
#include "tests/support/testmain.h"
#include "tests/support/workbenchfixture.h"

#include <QSignalSpy>

using namespace dynascope;
using namespace Qt::StringLiterals;

namespace {

const QString First = u"/dev/ttyUSB0"_s;
const QString Second = u"/dev/ttyUSB1"_s;

PortInfo port(const QString &name, const QString &identity)
{
    return {name, u"U2D2"_s, identity, identity};
}

} // namespace

/// Ports that come and go, in a list of the test's own.
class TestReopener : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        m_bench = std::make_unique<test::WorkbenchFixture>();
        m_bench->lines.plug({port(First, u"A"_s)});
        m_reopener = std::make_unique<Reopener>(m_bench->session, m_bench->lines);
    }
    void cleanup()
    {
        m_reopener.reset();
        m_bench.reset();
    }

    void theListFollows()
    {
        QSignalSpy changed(m_reopener.get(), &Reopener::portsChanged);
        m_reopener->look();
        QCOMPARE(changed.size(), 0);
        m_bench->lines.plug({port(First, u"A"_s), port(Second, u"B"_s)});
        m_reopener->look();
        QCOMPARE(changed.size(), 1);
        QCOMPARE(m_reopener->ports().size(), std::size_t(2));
        m_bench->lines.plug({});
        QTRY_COMPARE(changed.size(), 2); // by itself
        QVERIFY(m_reopener->ports().empty());
    }

    void sameAdapterElsewhere()
    {
        LineSession &line = openAndScan();
        QSignalSpy back(m_reopener.get(), &Reopener::lineBack);
        Device *device = line.devices().front().get();
        m_bench->lines.plug({});
        QTRY_COMPARE(line.state(), BusThread::State::Lost);
        m_reopener->look();
        QCOMPARE(line.state(), BusThread::State::Lost);
        QCOMPARE(m_reopener->whereIs(line).error().kind, ErrorKind::PortNotFound);
        m_bench->lines.plug({port(Second, u"A"_s)});
        m_reopener->look();
        QTRY_COMPARE(line.state(), BusThread::State::Open);
        QCOMPARE(line.name(), Second);
        QTRY_COMPARE(back.size(), 1);
        QCOMPARE(back.front().at(1).toString(), First);
        QCOMPARE(line.devices().size(), std::size_t(2));
        QCOMPARE(line.devices().front().get(), device); // the same device, on screen all the time
        QVERIFY(answers(line));
    }

    void anotherAdapterUnderTheOldName()
    {
        LineSession &line = openAndScan();
        m_bench->lines.plug({});
        QTRY_COMPARE(line.state(), BusThread::State::Lost);
        m_bench->lines.plug({port(First, u"B"_s)});
        m_reopener->look();
        QCOMPARE(line.state(), BusThread::State::Lost);
        const Result<void> asked = m_reopener->reopen(line);
        QCOMPARE(asked.error().kind, ErrorKind::PortUnsuitable);
        QVERIFY2(asked.error().text.startsWith(u"Another adapter is at /dev/ttyUSB0"), qPrintable(asked.error().text));
        m_bench->lines.plug({port(First, u"B"_s), port(Second, u"A"_s)}); // they have changed places
        m_reopener->look();
        QTRY_COMPARE(line.state(), BusThread::State::Open);
        QCOMPARE(line.name(), Second);
    }

    void withoutASerialNumber()
    {
        m_bench->lines.plug({port(First, {})});
        LineSession &line = openAndScan();
        m_bench->lines.plug({port(Second, {})});
        QTRY_COMPARE(line.state(), BusThread::State::Lost);
        m_reopener->look();
        QCOMPARE(line.state(), BusThread::State::Lost); // it may be anybody
        m_bench->lines.plug({port(First, {})});
        m_reopener->look();
        QTRY_COMPARE(line.state(), BusThread::State::Open);
        QCOMPARE(line.name(), First);
    }

    void anotherKindWithoutASerialNumber()
    {
        m_bench->lines.plug({port(First, {})});
        LineSession &line = openAndScan();
        m_bench->lines.plug({});
        QTRY_COMPARE(line.state(), BusThread::State::Lost);
        m_bench->lines.plug({{First, u"USB modem"_s, {}, {}}});
        m_reopener->look();
        QCOMPARE(line.state(), BusThread::State::Lost);
        QCOMPARE(m_reopener->whereIs(line).error().kind, ErrorKind::PortUnsuitable);
        m_bench->lines.plug({{First, {}, {}, {}}}); // the system doesn't say what it is
        m_reopener->look();
        QTRY_COMPARE(line.state(), BusThread::State::Open);
    }

    void aServerIsAskedEverLessOften()
    {
        const QString server = u"tcp://pi:4000"_s;
        m_bench->lines.plug({port(server, {})});
        LineSession &line = m_bench->session.open(server, 1000000);
        QTRY_COMPARE(line.state(), BusThread::State::Open);
        m_bench->lines.plug({});
        QTRY_COMPARE(line.state(), BusThread::State::Lost);
        int tries = 0;
        for (int second = 0; second <= 61; ++second) {
            m_reopener->look();
            tries += line.state() == BusThread::State::Opening;
            QTRY_VERIFY(line.state() == BusThread::State::Closed || line.state() == BusThread::State::Lost);
        }
        // At 0, 1, 3, 7, 15, 31, 61; the reopener's own timer may look once or twice meanwhile.
        QVERIFY2(tries >= 6 && tries <= 8, qPrintable(QString::number(tries)));
        m_bench->lines.plug({port(server, {})});
        QVERIFY(m_reopener->reopen(line)); // by hand at once
        QTRY_COMPARE(line.state(), BusThread::State::Open);
    }

    void twoOfTheSameNumber()
    {
        LineSession &line = openAndScan();
        m_bench->lines.plug({port(Second, u"A"_s), port(u"/dev/ttyUSB2"_s, u"A"_s)});
        QTRY_COMPARE(line.state(), BusThread::State::Lost);
        m_reopener->look();
        QCOMPARE(line.state(), BusThread::State::Lost); // not guessed
        m_bench->lines.plug({port(First, u"A"_s), port(u"/dev/ttyUSB2"_s, u"A"_s)});
        m_reopener->look();
        QTRY_COMPARE(line.state(), BusThread::State::Open);
        QCOMPARE(line.name(), First);
    }

    void whereTheOtherIsOpenAlready()
    {
        LineSession &line = openAndScan();
        m_bench->lines.plug({port(Second, u"A"_s)});
        QTRY_COMPARE(line.state(), BusThread::State::Lost);
        m_bench->session.open(Second, 1000000); // by hand
        QTRY_COMPARE(m_bench->session.lines().back()->state(), BusThread::State::Open);
        m_reopener->look();
        QCOMPARE(line.state(), BusThread::State::Lost);
    }

    void saysOnceThatItIsRefused()
    {
        LineSession &line = openAndScan();
        QSignalSpy refused(m_reopener.get(), &Reopener::lineRefused);
        m_bench->lines.plug({port(u"/dev/forbidden"_s, u"A"_s)});
        QTRY_COMPARE(line.state(), BusThread::State::Lost);
        m_reopener->look();
        QTRY_COMPARE(line.state(), BusThread::State::Closed);
        QCOMPARE(refused.size(), 0); // rights may still be on their way
        for (int attempt = 0; attempt < 8; ++attempt) {
            m_reopener->look();
            QTRY_COMPARE(line.state(), BusThread::State::Closed);
        }
        QCOMPARE(refused.size(), 1);
        QCOMPARE(refused.front().at(1).value<Error>().kind, ErrorKind::PortForbidden);
    }

    void onlyWhenWanted()
    {
        LineSession &line = openAndScan();
        m_reopener->setAutomatic(false);
        m_bench->lines.plug({port(Second, u"A"_s)});
        QTRY_COMPARE(line.state(), BusThread::State::Lost);
        m_reopener->look();
        QCOMPARE(line.state(), BusThread::State::Lost);
        QVERIFY(m_reopener->reopen(line));
        QTRY_COMPARE(line.state(), BusThread::State::Open);
        QCOMPARE(line.name(), Second);
    }

    void stopStaysAsItIs()
    {
        LineSession &line = openAndScan();
        m_bench->stop.press();
        QTRY_VERIFY(m_bench->stop.isConfirmed());
        m_bench->lines.plug({});
        QTRY_COMPARE(line.state(), BusThread::State::Lost);
        m_bench->lines.plug({port(Second, u"A"_s)});
        m_reopener->look();
        QTRY_COMPARE(line.state(), BusThread::State::Open);
        QVERIFY(m_bench->stop.isActive());
        QTRY_VERIFY(line.bus().isStopped());
        QTRY_VERIFY(m_bench->stop.isConfirmed()); // asked anew: nobody knows what went on meanwhile
        bool refused = false;
        m_bench->commands.setTorque({line.devices().front().get()}, true, [&refused](const Result<void> &result) {
            refused = !result && result.error().kind == ErrorKind::Stopped;
        });
        QTRY_VERIFY(refused);
    }

    void oneFailingHurtsNoOther()
    {
        m_bench->lines.plug({port(First, u"A"_s), port(Second, u"B"_s)});
        LineSession &line = openAndScan();
        LineSession &other = m_bench->session.open(Second, 1000000);
        QTRY_COMPARE(other.state(), BusThread::State::Open);
        m_bench->scanner.start(other, {{1000000}, 0, 5});
        QTRY_COMPARE(other.devices().size(), std::size_t(2));
        LineSession &missing = m_bench->session.open(u"/dev/ttyUSB9"_s, 1000000);
        QTRY_COMPARE(missing.state(), BusThread::State::Closed);
        m_bench->lines.plug({port(Second, u"B"_s)});
        QTRY_COMPARE(line.state(), BusThread::State::Lost);
        QCOMPARE(other.state(), BusThread::State::Open);
        QVERIFY(answers(other));
        m_bench->stop.press(); // of the lost one's devices it says that they are not confirmed
        QTRY_VERIFY2(m_bench->stop.report().startsWith(u"Torque is off on 2 devices. Not confirmed:"),
                     qPrintable(m_bench->stop.report()));
        QVERIFY(!m_bench->stop.isConfirmed());
        m_bench->lines.plug({port(First, u"A"_s), port(Second, u"B"_s)});
        m_reopener->look();
        QTRY_VERIFY(m_bench->stop.isConfirmed()); // it is back, and off as well
        QCOMPARE(other.state(), BusThread::State::Open);
    }

private:
    LineSession &openAndScan()
    {
        LineSession &line = m_bench->session.open(First, 1000000);
        [&] {
            QTRY_COMPARE(line.state(), BusThread::State::Open);
            m_bench->scanner.start(line, {{1000000}, 0, 5});
            QTRY_COMPARE(line.devices().size(), std::size_t(2));
            QTRY_VERIFY(!m_bench->scanner.isRunning());
        }();
        return line;
    }

    bool answers(LineSession &line)
    {
        std::optional<Result<void>> outcome;
        m_bench->commands.readAll(*line.devices().front(),
                                  [&outcome](const Result<void> &result) { outcome = result; });
        return QTest::qWaitFor([&outcome] { return outcome.has_value(); }) && outcome->has_value();
    }

    std::unique_ptr<test::WorkbenchFixture> m_bench;
    std::unique_ptr<Reopener> m_reopener;
};

Q_DECLARE_METATYPE(dynascope::Error)
DYNASCOPE_CORE_TEST(TestReopener)
#include "tst_reopener.moc"
