// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/indirectreads.h"
#include "core/session/monitor.h"
#include "core/session/settingscommands.h"
#include "tests/support/uitest.h"
#include "tests/support/workbenchfixture.h"
#include "ui/health/ratepopup.h"
#include "ui/health/rateremedies.h"
#include "ui/health/ratetexts.h"
#include "ui/health/wantedrates.h"

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QMessageBox>
#include <QPushButton>
#include <QSettings>
#include <QSignalSpy>

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

constexpr int Baud = 1'000'000;

RateLimit limit(RateLimit::What what, std::vector<std::uint8_t> devices = {})
{
    return {what, 0.4, true, 900, std::move(devices)};
}

} // namespace

/// How often is read what, why no oftener, and what is done about it.
class TestRatePopup : public QObject
{
    Q_OBJECT

    std::unique_ptr<test::WorkbenchFixture> m_bench;
    std::unique_ptr<SettingsCommands> m_settings;
    std::unique_ptr<QWidget> m_window;
    LineSession *m_line = nullptr;

    Workbench workbench()
    {
        Workbench bench = m_bench->workbench();
        bench.settings = m_settings.get();
        return bench;
    }

private slots:
    void init()
    {
        m_bench = std::make_unique<test::WorkbenchFixture>();
        m_settings = std::make_unique<SettingsCommands>(m_bench->session, m_bench->commands);
        m_window = std::make_unique<QWidget>();
        m_window->resize(900, 600);
        m_window->show();
        m_line = &m_bench->session.open(QStringLiteral("sim"), Baud);
        QTRY_COMPARE(m_line->state(), BusThread::State::Open);
        m_line->heard({1, Baud, 1020, 45, false, {}});
        m_line->heard({4, Baud, 1060, 45, false, {}});
    }
    void cleanup()
    {
        m_window.reset();
        m_settings.reset();
        m_bench.reset();
    }

    void words()
    {
        QCOMPARE(hertzText(812.4), QStringLiteral("812 Hz"));
        QCOMPARE(hertzText(9.81), QStringLiteral("9.8 Hz"));
        QCOMPARE(intervalText(100ms), QStringLiteral("10 Hz"));
        QCOMPARE(intervalText(9000ms), QStringLiteral("each 9 s"));
        QCOMPARE(limitName(limit(RateLimit::What::ReturnDelay, {3}), Baud),
                 QStringLiteral("Return Delay Time of device 3"));
        QCOMPARE(gainText(limit(RateLimit::What::ReturnDelay), 812), QStringLiteral("then 900 Hz"));
        QCOMPARE(remedyText({RateLimit::What::ReturnDelay, 0.4, false, 0, {}}), QString());
    }

    void aFieldIsWantedMoreRarely()
    {
        const Device &device = *m_bench->device(1, Baud);
        const Watch watch{device.key(), device.table().indexOf(u"Present Temperature")};
        m_bench->monitor.watch(watch);
        RatePopup popup(workbench(), *m_line, m_window.get());
        popup.setAttribute(Qt::WA_DeleteOnClose, false);
        popup.open(*m_window);
        auto *list = popup.findChild<QComboBox *>(QStringLiteral("wantedRate0"));
        QVERIFY(list);
        QCOMPARE(list->currentIndex(), 0);
        const int once = list->findData(1.0);
        list->setCurrentIndex(once);
        emit list->activated(once);
        QCOMPARE(m_bench->monitor.rate(watch), 1.0);
        auto *fast = popup.findChild<QCheckBox *>(QStringLiteral("fastReadsBox"));
        QVERIFY(fast->isChecked());
        fast->click();
        QVERIFY(!m_bench->monitor.mayReadFast());
    }

    void whatIsWantedIsRemembered()
    {
        Device &device = *m_bench->device(1, Baud);
        const Watch watch{device.key(), device.table().indexOf(u"Present Current")};
        {
            WantedRates rates(m_bench->session, m_bench->monitor, nullptr);
            m_bench->monitor.watch(watch);
            QCOMPARE(m_bench->monitor.rate(watch), 0.0);
            m_bench->monitor.setRate(watch, 20);
        }
        m_line->forget(device.key()); // as at the next start: the monitor knows nothing of it
        Device &again = m_line->heard({1, Baud, 1020, 45, false, {}});
        const Watch anew{again.key(), watch.field};
        WantedRates rates(m_bench->session, m_bench->monitor, nullptr);
        QCOMPARE(m_bench->monitor.rate(anew), 0.0);
        m_bench->monitor.watch(anew);
        QCOMPARE(m_bench->monitor.rate(anew), 20.0);
        m_bench->monitor.setRate(anew, 0);
        m_bench->monitor.unwatch(anew);
        m_bench->monitor.watch(anew);
        QCOMPARE(m_bench->monitor.rate(anew), 0.0);
        QVERIFY(QSettings().allKeys().filter(QStringLiteral("rates/")).isEmpty());
    }

    void scatteredRegistersArePackedOnWish()
    {
        IndirectReads reads(m_bench->session, m_bench->monitor, *m_settings, {});
        m_bench->monitor.setPaused(false);
        Device &device = *m_bench->device(1, Baud);
        for (const auto name : {u"Position P Gain", u"Goal PWM", u"Present Temperature"})
            m_bench->monitor.watch({device.key(), device.table().indexOf(name)});
        Workbench bench = workbench();
        bench.indirect = &reads;
        RatePopup popup(bench, *m_line, m_window.get());
        popup.setAttribute(Qt::WA_DeleteOnClose, false);
        popup.open(*m_window);
        auto *pack = popup.findChild<QCheckBox *>(QStringLiteral("packBox"));
        QVERIFY(pack && pack->isEnabled() && !pack->isChecked());
        auto *gain = popup.findChild<QLabel *>(QStringLiteral("packGain"));
        QTRY_VERIFY2(gain->text().contains(QStringLiteral("with it")), qPrintable(gain->text()));
        QTest::mouseClick(pack, Qt::LeftButton, {}, QPoint(8, pack->height() / 2));
        QTRY_COMPARE(reads.packedDevices(*m_line), 1);
        QVERIFY2(gain->text().contains(QStringLiteral("One device")), qPrintable(gain->text()));
        QTest::mouseClick(pack, Qt::LeftButton, {}, QPoint(8, pack->height() / 2));
        QTRY_VERIFY(!reads.isBusy(*m_line));
        QCOMPARE(reads.packedDevices(*m_line), 0);
        m_bench->monitor.setPaused(true);
    }

    /// Only after it was asked for, and then in the servos.
    void theReturnDelayIsSet()
    {
        RateRemedies remedies(workbench(), m_window.get());
        QSignalSpy posted(&remedies, &RateRemedies::posted);
        remedies.apply(*m_line, limit(RateLimit::What::ReturnDelay, {1, 4, 77}));
        auto *box = m_window->findChild<QMessageBox *>(QStringLiteral("returnDelayBox"));
        QVERIFY(box);
        QVERIFY(!box->checkBox()); // no torque is on
        QVERIFY(box->informativeText().contains(QStringLiteral("EEPROM")));
        QCOMPARE(posted.count(), 0);
        QTest::mouseClick(box->findChild<QPushButton *>(QStringLiteral("setReturnDelayButton")), Qt::LeftButton);
        QTRY_COMPARE(posted.count(), 1);
        QVERIFY2(posted.front().at(1).toString() == QStringLiteral("Return Delay Time is 0 in 2 devices"),
                 qPrintable(posted.front().at(1).toString()));
        QCOMPARE(m_bench->device(1, Baud)->raw(Known::ReturnDelayTime), std::optional<std::int64_t>(0));
        QCOMPARE(m_bench->device(4, Baud)->raw(Known::ReturnDelayTime), std::optional<std::int64_t>(0));
    }

    /// Torque locks it, and is left alone where nobody lets it go.
    void torqueIsLeftOn()
    {
        Device &device = *m_bench->device(1, Baud);
        m_bench->commands.setTorque({&device}, true);
        QTRY_VERIFY(device.isTorqueOn());
        RateRemedies remedies(workbench(), m_window.get());
        QSignalSpy posted(&remedies, &RateRemedies::posted);
        remedies.apply(*m_line, limit(RateLimit::What::ReturnDelay, {1}));
        auto *box = m_window->findChild<QMessageBox *>(QStringLiteral("returnDelayBox"));
        QVERIFY(box && box->checkBox() && !box->checkBox()->isChecked());
        QTest::mouseClick(box->findChild<QPushButton *>(QStringLiteral("setReturnDelayButton")), Qt::LeftButton);
        QTRY_COMPARE(posted.count(), 1);
        QVERIFY(posted.front().at(1).toString().contains(QStringLiteral("stays as it was in one device")));
        QVERIFY(device.isTorqueOn());
    }

    void aLineWithoutALatencyTimerSaysSo()
    {
        RateRemedies remedies(workbench(), m_window.get());
        QSignalSpy posted(&remedies, &RateRemedies::posted);
        remedies.apply(*m_line, limit(RateLimit::What::LatencyTimer));
        QTRY_COMPARE(posted.count(), 1);
        QVERIFY(posted.front().at(1).toString().contains(QStringLiteral("no latency timer")));
    }

    void fastReadsComeBack()
    {
        m_bench->monitor.setMayReadFast(false);
        RateRemedies remedies(workbench(), m_window.get());
        remedies.apply(*m_line, limit(RateLimit::What::PlainReads));
        QVERIFY(m_bench->monitor.mayReadFast());
    }
};

DYNASCOPE_UI_TEST(TestRatePopup)
#include "tst_ratepopup.moc"
