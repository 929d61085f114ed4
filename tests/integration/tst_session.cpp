// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/seriallinefactory.h"
#include "core/session/monitor.h"
#include "core/session/scanner.h"
#include "core/session/stopcontrol.h"
#include "core/sim/ptyserver.h"
#include "core/sim/servo.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/uitest.h"

#include <QSignalSpy>
#include <QTemporaryDir>

using namespace dynascope;

/// Session and its commands over a pty opened by QSerialPort: the whole of core as the window uses it, without the
/// window.
class TestSession : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        QVERIFY(m_directory.isValid());
        m_session = std::make_unique<Session>(m_factory, m_catalog);
        m_commands = std::make_unique<Commands>(*m_session);
        m_monitor = std::make_unique<Monitor>(*m_session);
        m_stop = std::make_unique<StopControl>(*m_session, *m_commands);
        m_scanner = std::make_unique<Scanner>();
    }

    void cleanup()
    {
        m_scanner.reset();
        m_stop.reset();
        m_monitor.reset();
        m_commands.reset();
        m_session.reset();
        m_server.reset();
    }

    void scansEveryBaud()
    {
        serve(QStringLiteral("XM430-W350@57600:1,XL430-W250@57600:9,XL330-M288/52@1000000:7"));
        scan({57600, 1000000});
        QCOMPARE(deviceNames(), QStringList({QStringLiteral("XM430-W350 #1 present"),
                                             QStringLiteral("XL430-W250 #9 present"),
                                             QStringLiteral("XL330-M288 #7 parked")}));
        QCOMPARE(m_session->devices().back()->firmware(), 52);
    }

    void honoursTheIdRange()
    {
        serve(QStringLiteral("XM430-W350@57600:1,XL430-W250@57600:9"));
        scan({57600}, 5, 20);
        QCOMPARE(deviceNames(), QStringList({QStringLiteral("XL430-W250 #9 present")}));
    }

    void readsTheWholeTable()
    {
        Device &device = oneServo();
        QVERIFY(run([&](const Commands::Done &done) { m_commands->readAll(device, done); }));
        for (int i = 0; i < static_cast<int>(device.table().fields().size()); ++i)
            QCOMPARE(device.value(i).state, FieldState::Fresh);
        QCOMPARE(device.raw(u"Model Number"), 1020);
        QCOMPARE(device.raw(u"Return Delay Time"), 250);
    }

    void movesWhenToldTo()
    {
        Device &device = oneServo();
        QVERIFY(run([&](const Commands::Done &done) { m_commands->readAll(device, done); }));
        const Watch position{device.key(), device.table().indexOf(u"Present Position")};
        m_monitor->watch(position);
        QVERIFY(run([&](const Commands::Done &done) { m_commands->setTorque({&device}, true, done); }));
        const std::int64_t goal = *device.raw(u"Present Position") > 2048 ? 1000 : 3000;
        QVERIFY(run([&](const Commands::Done &done) {
            m_commands->writeField(device, device.table().indexOf(u"Goal Position"), goal, done);
        }));
        QCOMPARE(device.raw(u"Goal Position"), goal);
        QTRY_VERIFY_WITH_TIMEOUT(std::abs(*device.raw(u"Present Position") - goal) < 40, 5000);
        const History *history = m_monitor->history(position);
        QVERIFY(history);
        std::int32_t least = 0;
        std::int32_t most = 0;
        QVERIFY(history->range(LineTime::min(), LineTime::max(), least, most));
        QVERIFY2(most - least > 500, qPrintable(QStringLiteral("%1 … %2").arg(least).arg(most)));
    }

    void onlyTheNewestOfManyWritesWaits()
    {
        Device &device = oneServo();
        QVERIFY(run([&](const Commands::Done &done) { m_commands->readAll(device, done); }));
        const int field = device.table().indexOf(u"Profile Velocity");
        int written = 0;
        int replaced = 0;
        for (int value = 1; value <= 50; ++value) {
            m_commands->writeField(device, field, value, [&](const Result<void> &result) {
                ++(result ? written : replaced);
            });
        }
        QCOMPARE(device.value(field).state, FieldState::Pending);
        QTRY_COMPARE(written + replaced, 50);
        QCOMPARE(written, 2); // the first, and the last of those that came meanwhile
        QCOMPARE(device.raw(u"Profile Velocity"), 50);
        QCOMPARE(device.value(field).state, FieldState::Fresh);
    }

    void refusesWhatTheRegisterCannotTake()
    {
        Device &device = oneServo();
        QVERIFY(run([&](const Commands::Done &done) { m_commands->readAll(device, done); }));
        QSignalSpy failures(m_commands.get(), &Commands::failed);
        QVERIFY(!run([&](const Commands::Done &done) {
            m_commands->writeField(device, device.table().indexOf(u"Goal Position"), 5000, done);
        }));
        QVERIFY(!run([&](const Commands::Done &done) {
            m_commands->writeField(device, device.table().indexOf(u"Present Position"), 1, done);
        }));
        QCOMPARE(failures.count(), 2);
    }

    void changesIdAndKeepsTheDevice()
    {
        Device &device = oneServo();
        const DeviceKey key = device.key();
        QVERIFY(run([&](const Commands::Done &done) { m_commands->changeId(device, 42, true, done); }));
        QCOMPARE(m_session->device(key), &device);
        QCOMPARE(device.id(), 42);
        QTRY_COMPARE(device.raw(u"ID"), 42);
        QVERIFY(!run([&](const Commands::Done &done) { m_commands->changeId(device, 253, true, done); }));
        QVERIFY(!run([&](const Commands::Done &done) { m_commands->changeId(device, 42, true, done); }));
    }

    void theLineFollowsALoneDevice()
    {
        Device &device = oneServo();
        QVERIFY(run([&](const Commands::Done &done) { m_commands->changeBaud(device, 1000000, true, done); }));
        QCOMPARE(device.baudRate(), 1000000);
        QTRY_COMPARE(m_line->baudRate(), 1000000);
        QCOMPARE(device.state(), Device::State::Present);
        QTRY_COMPARE(device.raw(u"Baud Rate"), 3);
        QVERIFY(!run([&](const Commands::Done &done) { m_commands->changeBaud(device, 123456, true, done); }));
    }

    void aDeviceAmongOthersIsParked()
    {
        serve(QStringLiteral("XM430-W350@57600:1,XM430-W350@57600:2"));
        scan({57600});
        Device &device = *m_session->devices().front();
        QVERIFY(run([&](const Commands::Done &done) { m_commands->changeBaud(device, 115200, true, done); }));
        QCOMPARE(device.state(), Device::State::Parked);
        QCOMPARE(m_line->baudRate(), 57600);
        // It can still be read: the job switches and returns.
        QVERIFY(run([&](const Commands::Done &done) { m_commands->readAll(device, done); }));
        QVERIFY(run([&](const Commands::Done &done) { m_commands->workAtBaud(*m_line, 115200, done); }));
        QCOMPARE(device.state(), Device::State::Present);
    }

    void aRebootBringsRamBackToDefaults()
    {
        Device &device = oneServo();
        QVERIFY(run([&](const Commands::Done &done) { m_commands->readAll(device, done); }));
        QVERIFY(run([&](const Commands::Done &done) { m_commands->setLed(device, true, done); }));
        QCOMPARE(device.raw(u"LED"), 1);
        QVERIFY(run([&](const Commands::Done &done) { m_commands->reboot(device, done); }));
        QCOMPARE(device.state(), Device::State::Present);
        QCOMPARE(device.raw(u"LED"), 0);
    }

    void findsTheDeviceAfterAFactoryReset()
    {
        serve(QStringLiteral("XM430-W350@1000000:5"));
        scan({1000000}, 0, 252, 1000000);
        Device &device = *m_session->devices().front();
        QVERIFY(run([&](const Commands::Done &done) { m_commands->factoryReset(device, ResetOption::All, done); }));
        QCOMPARE(device.id(), 1);
        QCOMPARE(device.baudRate(), 57600);
    }

    void stopTurnsTorqueOffAndHoldsIt()
    {
        serve(QStringLiteral("XM430-W350@57600:1,XL430-W250@57600:2,XL330-M288@1000000:3"));
        scan({57600, 1000000});
        const std::vector<Device *> devices = m_session->devices();
        QCOMPARE(devices.size(), std::size_t(3));
        QVERIFY(run([&](const Commands::Done &done) { m_commands->setTorque(devices, true, done); }));
        for (const Device *device : devices)
            m_monitor->watch({device->key(), device->table().indexOf(u"Present Position")});
        int queuedEnded = 0;
        m_commands->setTorque(devices, true, [&](const Result<void> &) { ++queuedEnded; });
        m_stop->press();
        QTRY_VERIFY_WITH_TIMEOUT(m_stop->isConfirmed(), 5000);
        QTRY_COMPARE(queuedEnded, 1);
        m_server->call([](sim::SimulatedBus &bus, LineTime) {
            for (const auto &servo : bus.servos())
                QCOMPARE(int(servo->value(u"Torque Enable")), 0);
        });
        QVERIFY(!run([&](const Commands::Done &done) { m_commands->setTorque(devices, true, done); }));
        const int goal = devices.front()->table().indexOf(u"Goal Position");
        QVERIFY(!run([&](const Commands::Done &done) { m_commands->writeField(*devices.front(), goal, 2000, done); }));
        m_stop->release();
        QVERIFY(run([&](const Commands::Done &done) { m_commands->setTorque({devices.front()}, true, done); }));
    }

    void stopOnALostLineConfirmsNothingAndCatchesUp()
    {
        const QString link = m_directory.filePath(QStringLiteral("stopped-bus"));
        oneServo(link);
        m_server.reset();
        QTRY_COMPARE_WITH_TIMEOUT(m_line->state(), BusThread::State::Lost, 5000);
        m_stop->press();
        QTRY_VERIFY(m_stop->report().contains(QStringLiteral("Not confirmed: XM430-W350 #1")));
        QVERIFY(!m_stop->isConfirmed());
        startServer(QStringLiteral("XM430-W350@57600:1"), link);
        m_server->call([](sim::SimulatedBus &bus, LineTime) { bus.servo(1, 57600)->write(u"Torque Enable", 1); });
        m_line->reopen(); // with STOP still held
        QTRY_VERIFY_WITH_TIMEOUT(m_stop->isConfirmed(), 5000);
        std::int64_t torque = 1;
        m_server->call(
            [&](sim::SimulatedBus &bus, LineTime) { torque = bus.servo(1, 57600)->value(u"Torque Enable"); });
        QCOMPARE(torque, 0);
    }

    void aDeviceFoundUnderStopIsTurnedOff()
    {
        serve(QStringLiteral("XM430-W350@57600:1"));
        m_server->call([](sim::SimulatedBus &bus, LineTime) { bus.servo(1, 57600)->write(u"Torque Enable", 1); });
        m_stop->press();
        QTRY_VERIFY(m_stop->isConfirmed());
        scan({57600}, 0, 3);
        QTRY_VERIFY_WITH_TIMEOUT(m_stop->isConfirmed(), 5000);
        std::int64_t torque = 1;
        m_server->call(
            [&](sim::SimulatedBus &bus, LineTime) { torque = bus.servo(1, 57600)->value(u"Torque Enable"); });
        QCOMPARE(torque, 0);
    }

    void anUnpluggedPortIsSaidAndTakenUpAgain()
    {
        const QString link = m_directory.filePath(QStringLiteral("bus"));
        Device &device = oneServo(link);
        m_server.reset();
        QTRY_COMPARE_WITH_TIMEOUT(m_line->state(), BusThread::State::Lost, 5000);
        QVERIFY(!m_line->bus().error().text.isEmpty());
        QVERIFY(!run([&](const Commands::Done &done) { m_commands->ping(device, done); }));
        startServer(QStringLiteral("XM430-W350@57600:1"), link);
        m_monitor->select({&device});
        m_line->reopen();
        QTRY_COMPARE(m_line->state(), BusThread::State::Open);
        const int position = device.table().indexOf(u"Present Position");
        QTRY_COMPARE(device.value(position).state, FieldState::Fresh); // polled again
        QVERIFY(run([&](const Commands::Done &done) { m_commands->ping(device, done); }));
        QCOMPARE(device.state(), Device::State::Present);
    }

    void aSilentDeviceIsNoticedAndReturns()
    {
        serve(QStringLiteral("XM430-W350@57600:1,XM430-W350@57600:2"));
        scan({57600});
        Device &device = *m_session->devices().front();
        m_monitor->watch({device.key(), device.table().indexOf(u"Present Position")});
        m_server->call([](sim::SimulatedBus &bus, LineTime) { bus.servo(1, 57600)->setPlugged(false); });
        QTRY_COMPARE_WITH_TIMEOUT(device.state(), Device::State::Silent, 5000);
        m_server->call([](sim::SimulatedBus &bus, LineTime) { bus.servo(1, 57600)->setPlugged(true); });
        QTRY_COMPARE_WITH_TIMEOUT(device.state(), Device::State::Present, 8000);
    }

    void aMissingPortIsSaid()
    {
        LineSession &line = m_session->open(m_directory.filePath(QStringLiteral("nothing-here")), 57600);
        QTRY_COMPARE(line.state(), BusThread::State::Closed);
        QCOMPARE(line.bus().error().kind, ErrorKind::PortNotFound);
    }

private:
    void startServer(const QString &servos, const QString &link = {})
    {
        auto bus = std::make_unique<sim::SimulatedBus>(m_catalog);
        const auto specs = sim::parseServoSpecs(servos, m_catalog);
        QVERIFY2(specs, specs ? "" : qPrintable(specs.error().text));
        for (const sim::ServoSpec &spec : *specs)
            QVERIFY(bus->add(spec));
        auto server = sim::PtyServer::start(std::move(bus), link);
        QVERIFY2(server, server ? "" : qPrintable(server.error().text));
        m_server = std::move(*server);
    }

    void serve(const QString &servos, const QString &link = {}, int baud = 57600)
    {
        startServer(servos, link);
        m_line = &m_session->open(link.isEmpty() ? m_server->path() : link, baud);
        QTRY_COMPARE(m_line->state(), BusThread::State::Open);
    }

    void scan(const std::vector<int> &bauds, int first = 0, int last = 252, int workingBaud = 0)
    {
        if (workingBaud)
            m_line->setWorkingBaudRate(workingBaud);
        QSignalSpy finished(m_scanner.get(), &Scanner::finished);
        m_scanner->start(*m_line, {bauds, first, last});
        QTRY_COMPARE_WITH_TIMEOUT(finished.count(), 1, 10000);
        QCOMPARE(finished.constFirst().at(1).toString(), QString());
    }

    Device &oneServo(const QString &link = {})
    {
        serve(QStringLiteral("XM430-W350@57600:1"), link);
        scan({57600}, 0, 3);
        return *m_session->devices().front();
    }

    bool run(const std::function<void(Commands::Done)> &command)
    {
        std::optional<Result<void>> outcome;
        command([&](const Result<void> &result) { outcome = result; });
        if (!QTest::qWaitFor([&] { return outcome.has_value(); }, 10000)) {
            qWarning("the command did not end");
            return false;
        }
        if (!*outcome)
            qInfo("%s", qPrintable(outcome->error().text)); // what the failure behind this is about
        return outcome->has_value();
    }

    QStringList deviceNames() const
    {
        QStringList names;
        for (const Device *device : m_session->devices()) {
            names << device->displayName()
                         + (device->state() == Device::State::Parked ? QStringLiteral(" parked")
                                                                     : QStringLiteral(" present"));
        }
        return names;
    }

    QTemporaryDir m_directory;
    const Catalog m_catalog = test::builtInCatalog();
    SerialLineFactory m_factory;
    std::unique_ptr<sim::PtyServer> m_server;
    std::unique_ptr<Session> m_session;
    std::unique_ptr<Commands> m_commands;
    std::unique_ptr<Monitor> m_monitor;
    std::unique_ptr<StopControl> m_stop;
    std::unique_ptr<Scanner> m_scanner;
    LineSession *m_line = nullptr;
};

DYNASCOPE_UI_TEST(TestSession)
#include "tst_session.moc"
