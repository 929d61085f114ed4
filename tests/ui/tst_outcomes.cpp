// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/support/workbenchfixture.h"
#include "ui/common/messagebar.h"
#include "ui/window/outcomes.h"

using namespace dynascope;

/// How long a message is true, and whom it names.
class TestOutcomes : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        m_bench = std::make_unique<test::WorkbenchFixture>();
        m_messages = std::make_unique<MessageBar>();
        m_stopBar = std::make_unique<MessageBar>();
        new Outcomes(m_bench->workbench(), *m_messages, *m_stopBar, [](const Device &) { return false; });
    }
    void cleanup()
    {
        m_messages.reset();
        m_stopBar.reset();
        m_bench.reset();
    }

    void thatStopIsHeldIsOverWithItsRelease()
    {
        Device &device = open().heard({1, 1'000'000, 1020, 45, false, {}});
        m_bench->stop.press();
        m_bench->commands.setTorque({&device}, true);
        QTRY_VERIFY2(m_messages->text().contains(QStringLiteral("STOP is held")), qPrintable(m_messages->text()));
        m_bench->stop.release();
        QVERIFY2(m_messages->text().isEmpty(), qPrintable(m_messages->text()));
    }

    void troubleIsOverWhenTheDeviceAnswersAgain()
    {
        Device &device = open().heard({1, 1'000'000, 1020, 45, false, {}});
        device.setState(Device::State::Silent);
        emit device.line()->deviceChanged(&device);
        fail(device);
        QVERIFY(!m_messages->text().isEmpty());
        device.line()->answered(device);
        QCOMPARE(device.state(), Device::State::Present);
        QVERIFY2(m_messages->text().isEmpty(), qPrintable(m_messages->text()));
    }

    void troubleGoesWithTheDevice()
    {
        Device &device = open().heard({1, 1'000'000, 1020, 45, false, {}});
        fail(device);
        device.line()->forget(device.key());
        QVERIFY2(m_messages->text().isEmpty(), qPrintable(m_messages->text()));
    }

    void aDeviceIsNamedSoThatItIsNoOther()
    {
        LineSession &line = open();
        Device &device = line.heard({1, 1'000'000, 1020, 45, false, {}});
        fail(device);
        QCOMPARE(m_messages->text(), QStringLiteral("XM430-W350, ID 1: it did not answer"));
        line.heard({1, 57600, 1190, 45, false, {}});
        fail(device);
        QCOMPARE(m_messages->text(), QStringLiteral("XM430-W350, ID 1 at 1 Mbps: it did not answer"));
        device.setNickname(QStringLiteral("elbow"));
        LineSession &other = m_bench->session.open(QStringLiteral("/dev/ttyUSB0"), 1'000'000);
        other.heard({1, 1'000'000, 1020, 45, false, {}});
        fail(device);
        QCOMPARE(m_messages->text(), QStringLiteral("elbow, ID 1 at 1 Mbps on Simulated bus: it did not answer"));
    }

    void stopWithoutALineSaysSo()
    {
        m_bench->stop.press();
        QVERIFY2(m_stopBar->text().contains(QStringLiteral("No line is open")), qPrintable(m_stopBar->text()));
    }

private:
    LineSession &open()
    {
        LineSession &line = m_bench->session.open(QStringLiteral("sim"), 1'000'000);
        [&line] { QTRY_COMPARE(line.state(), BusThread::State::Open); }();
        return line;
    }

    void fail(Device &device)
    {
        emit m_bench->commands.failed(&device, {ErrorKind::NothingReceived, QStringLiteral("it did not answer"), 0});
    }

    std::unique_ptr<test::WorkbenchFixture> m_bench;
    std::unique_ptr<MessageBar> m_messages;
    std::unique_ptr<MessageBar> m_stopBar;
};

DYNASCOPE_UI_TEST(TestOutcomes)
#include "tst_outcomes.moc"
