// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/support/workbenchfixture.h"
#include "ui/common/elidedlabel.h"
#include "ui/connection/baudcombo.h"
#include "ui/connection/connectionbar.h"
#include "ui/connection/connector.h"
#include "ui/connection/portcombo.h"
#include "ui/connection/scanoptions.h"
#include "ui/connection/stopbutton.h"

#include <QCheckBox>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QScopeGuard>
#include <QSemaphore>
#include <QSettings>
#include <QSignalSpy>
#include <QSpinBox>
#include <QToolButton>

using namespace dynascope;

class TestConnectionBar : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        QSettings().clear();
        m_bench = std::make_unique<test::WorkbenchFixture>();
        m_connector = std::make_unique<Connector>(m_bench->workbench());
        connect(
            m_connector.get(), &Connector::posted, this, [this](const Message &message) { m_said << message.text; });
        m_bar = std::make_unique<ConnectionBar>(m_bench->workbench(), *m_connector);
        m_bar->show();
        m_said.clear();
    }
    void cleanup()
    {
        m_bar.reset();
        m_connector.reset();
        m_bench.reset();
    }

    void readsBaudRates_data()
    {
        QTest::addColumn<int>("baud");
        QTest::newRow("57600") << 57600;
        QTest::newRow("57 600 bps") << 57600;
        QTest::newRow("57\u2009600 bps") << 57600;
        QTest::newRow("1M") << 1000000;
        QTest::newRow("1 Mbps") << 1000000;
        QTest::newRow("4.5 Mbps") << 4500000;
        QTest::newRow("115.2k") << 115200;
        QTest::newRow("10.5 mbps") << 10500000;
        QTest::newRow("") << 0;
        QTest::newRow("fast") << 0;
        QTest::newRow("-9600") << 0;
        QTest::newRow("12") << 0;
        QTest::newRow("99 Mbps") << 0;
        QTest::newRow("1e6") << 0;
    }
    void readsBaudRates()
    {
        QFETCH(int, baud);
        QCOMPARE(BaudCombo::parse(QString::fromUtf8(QTest::currentDataTag())), baud);
    }

    void listsThePortsThereAre()
    {
        auto *ports = find<PortCombo>("portCombo");
        QCOMPARE(ports->count(), 2);
        QCOMPARE(ports->itemText(1), QStringLiteral("Simulated bus"));
        ports->setCurrentIndex(1);
        QCOMPARE(ports->port(), QStringLiteral("sim"));
        m_bench->lines.unplug();
        ports->refresh();
        QCOMPARE(ports->count(), 1);
        QCOMPARE(ports->port(), QStringLiteral("sim"));
        ports->setEditText(QStringLiteral("  /dev/pts/7 "));
        QCOMPARE(ports->port(), QStringLiteral("/dev/pts/7"));
        ports->refresh();
        QCOMPARE(ports->port(), QStringLiteral("/dev/pts/7"));
    }

    /// Where no port is listed the simulated bus stands there, at its 1 Mbps.
    void aTypedPortHasItsOwnUsualBaud()
    {
        auto *ports = find<PortCombo>("portCombo");
        auto *bauds = find<BaudCombo>("baudCombo");
        const auto typePort = [ports](const QString &port) {
            ports->lineEdit()->selectAll();
            QTest::keyClicks(ports->lineEdit(), port);
        };
        typePort(QStringLiteral("sim"));
        QCOMPARE(bauds->baudRate(), 1000000);
        typePort(QStringLiteral("/dev/pts/7"));
        QCOMPARE(bauds->baudRate(), 57600);
        bauds->lineEdit()->selectAll();
        QTest::keyClicks(bauds->lineEdit(), QStringLiteral("2M"));
        typePort(QStringLiteral("sim"));
        QCOMPARE(bauds->baudRate(), 2000000); // what the person said
    }

    void connectsScansAndSaysSo()
    {
        auto *button = find<QPushButton>("connectButton");
        auto *scan = find<QPushButton>("scanButton");
        QCOMPARE(button->text(), QStringLiteral("Connect"));
        QVERIFY(!scan->isEnabled());
        m_bar->setPort(QStringLiteral("sim"), 1000000);
        QTest::mouseClick(button, Qt::LeftButton);
        QTRY_COMPARE(m_bench->session.devices().size(), std::size_t(3));
        QTRY_VERIFY(!m_bench->scanner.isRunning());
        QCOMPARE(button->text(), QStringLiteral("Disconnect"));
        QCOMPARE(find<ElidedLabel>("connectionState")->text(), QStringLiteral("Connected at 1 Mbps"));
        QTRY_COMPARE(m_said, QStringList{QStringLiteral("3 devices found")});
        QVERIFY(scan->isEnabled());
        QCOMPARE(Connector::lastPort(), QStringLiteral("sim"));
        QCOMPARE(Connector::lastBaudRate(QStringLiteral("sim")), 1000000);

        QTest::mouseClick(button, Qt::LeftButton);
        QTRY_VERIFY(m_bench->session.lines().empty());
        QTRY_COMPARE(button->text(), QStringLiteral("Connect"));
        QVERIFY(!scan->isEnabled());
    }

    void aPortThatCantBeOpened()
    {
        m_bar->setPort(QStringLiteral("/dev/forbidden"), 57600);
        QTest::mouseClick(find<QPushButton>("connectButton"), Qt::LeftButton);
        QTRY_COMPARE(m_said, QStringList{QStringLiteral("No permission to open /dev/forbidden")});
        QTRY_VERIFY(m_bench->session.lines().empty());
        QVERIFY(Connector::lastPort().isEmpty()); // nothing to come back to
        QTRY_COMPARE(find<QPushButton>("connectButton")->text(), QStringLiteral("Connect")); // it follows in a turn of its own
    }

    void theListFollowsByItself()
    {
        auto *ports = find<PortCombo>("portCombo");
        ports->setEditText(QStringLiteral("/dev/tt"));
        m_bench->lines.plug({port(QStringLiteral("/dev/ttyACM0"), QStringLiteral("C")),
                             port(QStringLiteral("/dev/ttyUSB0"), QStringLiteral("A")),
                             port(QStringLiteral("/dev/ttyUSB1"), QStringLiteral("B"))});
        QTRY_COMPARE(ports->count(), 3);
        QCOMPARE(ports->itemText(0), QStringLiteral("/dev/ttyACM0"));
        QCOMPARE(ports->itemText(2), QStringLiteral("/dev/ttyUSB1"));
        QCOMPARE(ports->currentText(), QStringLiteral("/dev/tt")); // being typed
        ports->setCurrentIndex(1);
        m_bench->lines.plug({port(QStringLiteral("/dev/ttyUSB1"), QStringLiteral("B"))});
        QTRY_COMPARE(ports->count(), 1);
        QCOMPARE(ports->port(), QStringLiteral("/dev/ttyUSB0")); // chosen, though it is out
    }

    void anAdapterThatComesBackElsewhere()
    {
        m_bench->lines.plug({port(QStringLiteral("/dev/ttyUSB0"), QStringLiteral("A"))});
        connectNow();
        m_bench->lines.plug({});
        QTRY_COMPARE(find<QPushButton>("connectButton")->text(), QStringLiteral("Reconnect"));
        m_bench->lines.plug({port(QStringLiteral("/dev/ttyUSB1"), QStringLiteral("A"))});
        QTRY_COMPARE(find<QPushButton>("connectButton")->text(), QStringLiteral("Disconnect"));
        QCOMPARE(find<PortCombo>("portCombo")->port(), QStringLiteral("/dev/ttyUSB1"));
        QVERIFY(m_said.contains(QStringLiteral("The adapter of /dev/ttyUSB0 is at /dev/ttyUSB1 now")));
        QCOMPARE(Connector::lastPort(), QStringLiteral("/dev/ttyUSB1"));
        QCOMPARE(m_bench->session.devices().size(), std::size_t(3));
    }

    void notReopenedWhereNotWanted()
    {
        m_connector->setReopening(false);
        QVERIFY(!Connector::isReopening());
        connectNow();
        m_bench->lines.unplug();
        QTRY_VERIFY(!m_said.isEmpty() && m_said.last().contains(QStringLiteral("is gone")));
        QVERIFY(!m_said.last().contains(QStringLiteral("opened again")));
        m_bench->lines.unplug(false);
        QTest::mouseClick(find<QPushButton>("connectButton"), Qt::LeftButton);
        QTRY_COMPARE(m_bench->session.lines().front()->state(), BusThread::State::Open);
    }

    void anotherAdapterIsLeftAlone()
    {
        m_bench->lines.plug({port(QStringLiteral("/dev/ttyUSB0"), QStringLiteral("A"))});
        connectNow();
        m_bench->lines.plug({});
        QTRY_COMPARE(find<QPushButton>("connectButton")->text(), QStringLiteral("Reconnect"));
        m_bench->lines.plug({port(QStringLiteral("/dev/ttyUSB0"), QStringLiteral("B"))});
        QTest::mouseClick(find<QPushButton>("connectButton"), Qt::LeftButton);
        QVERIFY2(m_said.last().startsWith(QStringLiteral("Another adapter is at /dev/ttyUSB0")),
                 qPrintable(m_said.last()));
        QCOMPARE(m_bench->session.lines().front()->state(), BusThread::State::Lost);
    }

    void aServersRate_data()
    {
        QTest::addColumn<QString>("name");
        QTest::addColumn<bool>("itsOwn");
        QTest::newRow("raw") << QStringLiteral("tcp://host:4000") << true;
        QTest::newRow("RFC 2217") << QStringLiteral("rfc2217://host:2217") << false;
    }
    void aServersRate()
    {
        QFETCH(QString, name);
        QFETCH(bool, itsOwn);
        auto *ports = find<PortCombo>("portCombo");
        ports->setEditText(name);
        QCOMPARE(find<QLabel>("serversRate")->isVisible(), itsOwn);
        QCOMPARE(find<BaudCombo>("baudCombo")->isVisible(), !itsOwn);
        QTest::keyClick(ports->lineEdit(), Qt::Key_Return);
        QTRY_COMPARE(find<QPushButton>("connectButton")->text(), QStringLiteral("Disconnect"));
        QTRY_COMPARE(find<ElidedLabel>("connectionState")->text(),
                     itsOwn ? QStringLiteral("Connected at the server's rate")
                            : QStringLiteral("Connected at 57\u2009600 bps"));
        QTRY_VERIFY(!m_bench->scanner.isRunning());
        auto *options = m_bar->findChild<ScanOptions *>();
        QCOMPARE(options->findChild<QListWidget *>(QStringLiteral("scanBauds"))->isVisibleTo(options), !itsOwn);
        QCOMPARE(options->range(57600).bauds.size() == 1, itsOwn);
        // Remembered: in the list from now on.
        QCOMPARE(Connector::recentPorts().front(), name);
        ports->refresh();
        QCOMPARE(ports->itemText(ports->count() - 1), name);
        ports->setCurrentIndex(0);
        QVERIFY(find<BaudCombo>("baudCombo")->isVisible());
    }

    void aPulledPlug()
    {
        connectNow();
        m_bench->lines.unplug();
        QTRY_VERIFY(!m_said.isEmpty() && m_said.last().contains(QStringLiteral("is gone")));
        QCOMPARE(find<QPushButton>("connectButton")->text(), QStringLiteral("Reconnect"));
        QCOMPARE(m_bench->session.devices().size(), std::size_t(3)); // nothing lost on screen
        const auto said = m_said.size();
        m_bench->lines.unplug(false);
        QTRY_COMPARE(m_bench->session.lines().front()->state(), BusThread::State::Open); // by itself
        QTRY_VERIFY(m_said.size() == said + 1 && m_said.last().contains(QStringLiteral("is back")));
        QCOMPARE(m_bench->session.devices().size(), std::size_t(3));
    }

    void aLineOpenedDuringAScanIsScannedNext()
    {
        m_connector->connectTo(QStringLiteral("/dev/ttyUSB0"), 1000000);
        m_connector->connectTo(QStringLiteral("/dev/ttyUSB1"), 1000000);
        QTRY_COMPARE(m_bench->session.devices().size(), std::size_t(6)); // three on either
        QTRY_COMPARE(m_said.count(QStringLiteral("3 devices found")), 2);
        QVERIFY(!m_connector->scannedLine());
    }

    void aWaitingScanEndsWithItsLineOrAtStop_data()
    {
        QTest::addColumn<bool>("stop");
        QTest::newRow("line closed") << false;
        QTest::newRow("STOP") << true;
    }
    void aWaitingScanEndsWithItsLineOrAtStop()
    {
        QFETCH(bool, stop);
        const QString one = QStringLiteral("/dev/ttyUSB0");
        const QString other = QStringLiteral("/dev/ttyUSB1");
        const auto go = std::make_shared<QSemaphore>(); // until then the first line's scan has not begun
        m_connector->connectTo(one, 1000000);
        m_connector->line(one)->bus().run<int>(
            Priority::Click, nullptr,
            [go](JobContext &) -> Result<int> {
                go->acquire();
                return 0;
            },
            [](const Result<int> &) {});
        const auto letGo = qScopeGuard([go] { go->release(); });
        QTRY_VERIFY(m_bench->scanner.isRunning());
        m_connector->connectTo(other, 1000000);
        QTRY_COMPARE(m_connector->line(other)->state(), BusThread::State::Open);
        QCOMPARE(m_connector->scannedLine(), m_connector->line(one));
        if (stop)
            m_bench->stop.press();
        else
            m_connector->disconnectFrom(*m_connector->line(other));
        go->release();
        QTRY_VERIFY(!m_bench->scanner.isRunning());
        QCoreApplication::processEvents();
        QVERIFY(!m_bench->scanner.isRunning());
        QVERIFY(m_bench->session.devices().size() <= 3);
    }

    void aBrokenLineCanBeGivenUp()
    {
        const QString name = QStringLiteral("/dev/ttyUSB0");
        m_bench->lines.plug({port(name, QStringLiteral("A"))});
        connectNow();
        auto *giveUp = find<QToolButton>("disconnectButton");
        QVERIFY(giveUp->isHidden());
        m_bench->lines.plug({});
        QTRY_COMPARE(m_connector->line(name)->state(), BusThread::State::Lost);
        m_bench->lines.plug({port(name, QStringLiteral("B"))});
        QTest::mouseClick(find<QPushButton>("connectButton"), Qt::LeftButton);
        QVERIFY2(m_said.back().startsWith(QStringLiteral("Another adapter is at")), qPrintable(m_said.back()));
        QVERIFY(!giveUp->isHidden());
        giveUp->click();
        QVERIFY(!m_bar->currentLine());
        QVERIFY(m_bench->session.devices().empty());
        QTRY_VERIFY(giveUp->isHidden());
        connectNow(); // to the other one
    }

    void movesTheLineToAnotherRate()
    {
        connectNow();
        auto *baud = find<BaudCombo>("baudCombo");
        baud->setEditText(QStringLiteral("57600"));
        QTest::keyClick(baud->lineEdit(), Qt::Key_Return);
        QTRY_COMPARE(m_bench->session.lines().front()->baudRate(), 57600);
        QCOMPARE(find<ElidedLabel>("connectionState")->text(), QStringLiteral("Connected at 57\u2009600 bps"));
    }

    void chosenRatesAndIds()
    {
        connectNow();
        for (const auto &line : m_bench->session.lines()) {
            while (!line->devices().empty())
                line->forget(line->devices().front()->key());
        }
        auto *options = m_bar->findChild<ScanOptions *>();
        QTest::mouseClick(find<QToolButton>("scanOptionsButton"), Qt::LeftButton);
        QVERIFY(options->isVisible());
        options->setBauds({1000000});
        options->findChild<QSpinBox *>(QStringLiteral("scanFirstId"))->setValue(2);
        QTest::mouseClick(options->findChild<QPushButton *>(QStringLiteral("scanStart")), Qt::LeftButton);
        QVERIFY(!options->isVisible());
        QTRY_COMPARE(m_bench->session.devices().size(), std::size_t(1));
        QCOMPARE(int(m_bench->session.devices().front()->id()), 4);
    }

    void scanOptionsOrderAndLimits()
    {
        ScanOptions options;
        options.setBauds({9600, 57600, 1000000, 4000000});
        QVERIFY(options.range(1000000).bauds == (std::vector<int>{1000000, 57600, 4000000, 9600}));
        QVERIFY(options.range(250000).bauds.front() == 250000); // the line's own odd rate
        options.findChild<QSpinBox *>(QStringLiteral("scanLastId"))->setValue(30);
        options.findChild<QSpinBox *>(QStringLiteral("scanFirstId"))->setValue(40);
        QVERIFY(options.range(0).firstId <= options.range(0).lastId);
        QVERIFY(!options.range(0).sweep);
        QTest::mouseClick(options.findChild<QCheckBox *>(QStringLiteral("scanSweep")), Qt::LeftButton);
        QVERIFY(options.range(0).sweep);
        options.setBauds({});
        QVERIFY(!options.findChild<QPushButton *>(QStringLiteral("scanStart"))->isEnabled());
    }

    void stopAndRelease()
    {
        connectNow();
        auto *button = find<StopButton>("stopButton");
        QCOMPARE(button->text(), QStringLiteral("STOP"));
        QSignalSpy changed(&m_bench->stop, &StopControl::changed);
        QTest::mousePress(button, Qt::LeftButton);
        QVERIFY(m_bench->stop.isActive()); // when it goes down, not when it comes up
        QTest::mouseRelease(button, Qt::LeftButton);
        QVERIFY(m_bench->stop.isActive());
        QCOMPARE(button->text(), QStringLiteral("Release STOP"));
        QTRY_VERIFY(m_bench->stop.isConfirmed());
        QTest::mouseClick(button, Qt::LeftButton);
        QVERIFY(!m_bench->stop.isActive());
        QCOMPARE(button->text(), QStringLiteral("STOP"));
        button->setFocus();
        QTest::keyClick(button, Qt::Key_Space);
        QVERIFY(m_bench->stop.isActive());
        const int width = button->sizeHint().width();
        QTest::keyClick(button, Qt::Key_Space);
        QVERIFY(!m_bench->stop.isActive());
        QCOMPARE(button->sizeHint().width(), width);
    }

private:
    static PortInfo port(const QString &name, const QString &identity)
    {
        return {name, QStringLiteral("U2D2"), identity, identity};
    }

    template <typename T>
    T *find(const char *name)
    {
        T *child = m_bar->findChild<T *>(QString::fromLatin1(name));
        if (!child)
            qFatal("no %s", name);
        return child;
    }

    void connectNow()
    {
        m_bar->setPort(QStringLiteral("/dev/ttyUSB0"), 1000000);
        QTest::mouseClick(find<QPushButton>("connectButton"), Qt::LeftButton);
        QTRY_COMPARE(m_bench->session.devices().size(), std::size_t(3));
        QTRY_VERIFY(!m_bench->scanner.isRunning());
    }

    std::unique_ptr<test::WorkbenchFixture> m_bench;
    std::unique_ptr<Connector> m_connector;
    std::unique_ptr<ConnectionBar> m_bar;
    QStringList m_said;
};

DYNASCOPE_UI_TEST(TestConnectionBar)
#include "tst_connectionbar.moc"
