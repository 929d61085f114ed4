// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/operations.h"
#include "tests/support/uitest.h"
#include "tests/support/workbenchfixture.h"
#include "ui/health/healthdelegate.h"
#include "ui/health/healthmodel.h"
#include "ui/health/healthpanel.h"
#include "ui/mainwindow.h"

#include <QAbstractItemModelTester>
#include <QAction>
#include <QClipboard>
#include <QGuiApplication>
#include <QHeaderView>
#include <QLabel>
#include <QScrollBar>
#include <QSettings>
#include <QSignalSpy>
#include <QToolButton>
#include <QTreeView>

using namespace dynascope;
using Kind = sim::ReplyFault::Kind;

namespace {

constexpr int Baud = 1'000'000;

/// Three servos and what is wrong with their line, in virtual time alone: the counts are exact.
class FaultyLine final : public Line
{
public:
    FaultyLine(const Catalog &catalog, const sim::LineFaults &faults)
        : m_bus(catalog)
    {
        for (const int id : {1, 2, 3})
            (void)m_bus.add({QStringLiteral("XM430-W350"), -1, Baud, id});
        m_bus.setFaults(faults);
        m_line = std::make_unique<sim::SimulatedLine>(m_bus, Baud);
        m_line->advance(std::chrono::seconds(2)); // everybody has booted
    }

    QString name() const override { return QStringLiteral("faulty"); }
    LineTime now() const override { return m_line->now(); }
    Result<void> write(ByteView packet) override { return m_line->write(packet); }
    Result<void> read(Bytes &buffer, LineTime deadline) override { return m_line->read(buffer, deadline); }
    void discardInput() override { m_line->discardInput(); }
    int baudRate() const override { return m_line->baudRate(); }
    Result<void> setBaudRate(int bitsPerSecond) override { return m_line->setBaudRate(bitsPerSecond); }
    LineTime hostAllowance() const override { return m_line->hostAllowance(); }

private:
    sim::SimulatedBus m_bus;
    std::unique_ptr<sim::SimulatedLine> m_line;
};

class FaultyFactory final : public LineFactory
{
public:
    explicit FaultyFactory(const Catalog &catalog) : m_catalog(catalog) { }

    bool knows(const QString &) const override { return true; }
    Result<std::unique_ptr<Line>> open(const QString &, int) override
    {
        return std::make_unique<FaultyLine>(m_catalog, faults);
    }

    sim::LineFaults faults; ///< of lines opened from now on

private:
    const Catalog &m_catalog;
};

sim::ReplyFault fault(int id, Kind kind, int times)
{
    sim::ReplyFault one;
    one.kind = kind;
    one.id = id;
    one.times = times;
    one.damage.part = sim::PacketPart::Crc;
    return one;
}

Found found(int id, int baud = Baud)
{
    Found result;
    result.id = static_cast<std::uint8_t>(id);
    result.baudRate = baud;
    result.modelNumber = 1020;
    result.firmware = 45;
    return result;
}

} // namespace

/// The Bus health view, over a simulated line with faults in virtual time.
class TestHealth : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        QSettings().clear();
        m_session = std::make_unique<Session>(m_factory, m_catalog);
    }
    void cleanup()
    {
        m_panel.reset();
        m_tester.reset();
        m_model.reset();
        m_session.reset();
    }

    void theWorstStandsOnTop_data()
    {
        QTest::addColumn<int>("worst");
        QTest::addColumn<Kind>("kind");
        QTest::addColumn<HealthColumn>("column"); ///< where it is counted
        QTest::newRow("timeouts") << 3 << Kind::Lost << HealthColumn::Missing;
        QTest::newRow("CRC") << 2 << Kind::Damaged << HealthColumn::Damaged;
        QTest::newRow("cut off") << 1 << Kind::Cut << HealthColumn::CutOff;
    }

    void theWorstStandsOnTop()
    {
        QFETCH(int, worst);
        QFETCH(Kind, kind);
        QFETCH(HealthColumn, column);
        sim::LineFaults faults;
        faults.replies = {fault(worst, kind, 20), fault(worst == 1 ? 2 : 1, Kind::Lost, 1)};
        faults.replies.front().amount = kind == Kind::Cut ? 9 : 0;
        open(faults);
        QCOMPARE(ids(), QStringLiteral("1 2 3 line"));
        poll();
        QTRY_COMPARE(at(0, HealthColumn::Bad), QStringLiteral("20.00 %"));
        QCOMPARE(at(0, HealthColumn::Id), QString::number(worst));
        QCOMPARE(at(0, column), QStringLiteral("20"));
        QCOMPARE(verdict(0), Verdict::Bad);
        QCOMPARE(at(1, HealthColumn::Id), worst == 1 ? QStringLiteral("2") : QStringLiteral("1"));
        QCOMPARE(at(1, HealthColumn::Bad), QStringLiteral("1.00 %"));
        QCOMPARE(verdict(1), Verdict::Poor);
        QCOMPARE(at(2, HealthColumn::Bad), QStringLiteral("0.00 %"));
        QCOMPARE(verdict(2), Verdict::Good);
        QCOMPARE(at(3, HealthColumn::Good), QStringLiteral("279"));
        QCOMPARE(at(3, HealthColumn::Bad), QStringLiteral("7.00 %"));
        QVERIFY(at(0, HealthColumn::Median).toDouble() > 0);
    }

    void rowsKeepTheirDeviceWhenTheOrderChanges()
    {
        sim::LineFaults faults;
        faults.replies = {fault(3, Kind::Lost, 5)};
        open(faults);
        const QPersistentModelIndex third = m_model->index(2, static_cast<int>(HealthColumn::Good));
        const QPersistentModelIndex whole = m_model->index(3, 0);
        poll();
        QTRY_COMPARE(ids(), QStringLiteral("3 1 2 line"));
        QCOMPARE(third.row(), 0);
        QCOMPARE(third.column(), static_cast<int>(HealthColumn::Good));
        QCOMPARE(whole.row(), 3);
    }

    void followsTheDevices()
    {
        open({});
        m_line->heard(found(9));
        QCOMPARE(ids(), QStringLiteral("1 2 3 9 line"));
        m_line->heard(found(8, 57600)); // parked: nobody asks it
        QCOMPARE(ids(), QStringLiteral("1 2 3 9 line"));
        m_line->deviceAt(2, Baud)->setNickname(QStringLiteral("Elbow"));
        QCOMPARE(at(1, HealthColumn::Name), QStringLiteral("Elbow · XM430-W350"));
        m_line->forget(m_line->deviceAt(1, Baud)->key());
        QCOMPARE(ids(), QStringLiteral("2 3 9 line"));
        m_line->setWorkingBaudRate(57600);
        QTRY_COMPARE(ids(), QStringLiteral("8 line"));
        m_session->close(*m_line);
        QCOMPARE(m_model->rowCount(), 0);
    }

    void aDeviceThatMovesLeavesItsPastBehind()
    {
        sim::LineFaults faults;
        faults.replies = {fault(2, Kind::Lost, 30)};
        open(faults);
        poll();
        QTRY_COMPARE(at(0, HealthColumn::Missing), QStringLiteral("30"));
        m_line->moveDevice(*m_line->deviceAt(1, Baud), found(2)); // and the entry of the old 2 goes
        QCOMPARE(ids(), QStringLiteral("3 2 line")); // not asked since
        QCOMPARE(at(1, HealthColumn::Missing), QStringLiteral("0"));
    }

    void countsAnewAndCopies()
    {
        sim::LineFaults faults;
        faults.replies = {fault(2, Kind::Lost, 30)};
        openPanel(faults);
        poll();
        auto *view = m_panel->findChild<QTreeView *>(QStringLiteral("healthView"));
        const auto cell = [view](int row, HealthColumn column) {
            return view->model()->index(row, static_cast<int>(column)).data().toString();
        };
        QTRY_COMPARE(cell(0, HealthColumn::Missing), QStringLiteral("30"));
        QTest::mouseClick(m_panel->findChild<QToolButton *>(QStringLiteral("healthCopyButton")), Qt::LeftButton);
        const QStringList lines = QGuiApplication::clipboard()->text().split(u'\n');
        QCOMPARE(lines.size(), 6); // headings, three devices, the line, and the end
        QVERIFY(lines[0].startsWith(QStringLiteral("Device\tID\tBad answers\tGood\tTimeouts")));
        QVERIFY(lines[1].startsWith(QStringLiteral("XM430-W350\t2\t30.00 %\t70\t30\t0\t")));
        view->setFocus();
        QGuiApplication::clipboard()->clear();
        QTest::keyClick(view, Qt::Key_C, Qt::ControlModifier);
        QCOMPARE(QGuiApplication::clipboard()->text(), lines.join(u'\n'));

        QTest::mouseClick(m_panel->findChild<QToolButton *>(QStringLiteral("healthAnewButton")), Qt::LeftButton);
        QCOMPARE(cell(0, HealthColumn::Id), QStringLiteral("1"));
        QCOMPARE(cell(0, HealthColumn::Good), QStringLiteral("0"));
        QCOMPARE(cell(0, HealthColumn::Bad), QStringLiteral("–"));
    }

    void saysWhatItUsuallyIs()
    {
        sim::LineFaults faults;
        faults.replies = {fault(2, Kind::Damaged, 30)};
        openPanel(faults);
        poll();
        auto *view = m_panel->findChild<QTreeView *>(QStringLiteral("healthView"));
        const auto said = [this] { return m_panel->findChild<QLabel *>(QStringLiteral("healthExplanation"))->text(); };
        // Without being asked, of the worst one.
        QTRY_VERIFY2(said().contains(QStringLiteral("ID 2: 30 of 100 answers were bad")), qPrintable(said()));
        QVERIFY2(said().contains(usualCauses(AnswerFault::Damaged)), qPrintable(said()));
        for (int column = 0; column < HealthColumns; ++column) {
            const auto fault = faultOf(static_cast<HealthColumn>(column));
            view->setCurrentIndex(view->model()->index(1, column));
            QVERIFY(!said().isEmpty());
            QVERIFY(!fault || said().contains(usualCauses(*fault)));
            QTest::mouseMove(view->header()->viewport(),
                QPoint(view->columnViewportPosition(column) + 5, view->header()->height() / 2));
            QTRY_VERIFY(!fault || said().startsWith(faultName(*fault) + u':'));
        }
    }

    void figuresStandStill()
    {
        openPanel({});
        m_panel->resize(960, 300);
        auto *view = m_panel->findChild<QTreeView *>(QStringLiteral("healthView"));
        QTRY_COMPARE(view->model()->rowCount(), 4);
        QCOMPARE(view->horizontalScrollBar()->maximum(), 0); // all columns fit into a small window
        QVERIFY(view->columnWidth(0) > 100);
        for (int column = 1; column < HealthColumns; ++column) {
            const auto alignment = view->model()->index(0, column).data(Qt::TextAlignmentRole).toInt();
            QVERIFY(alignment & Qt::AlignRight);
        }
        QList<int> before;
        for (int column = 0; column < HealthColumns; ++column)
            before << view->columnWidth(column);
        poll();
        QTRY_VERIFY(view->model()->index(0, static_cast<int>(HealthColumn::Good)).data().toString()
                    == QStringLiteral("100"));
        for (int column = 0; column < HealthColumns; ++column)
            QCOMPARE(view->columnWidth(column), before[column]);
    }

    void theBarGrowsByDecades()
    {
        QCOMPARE(HealthDelegate::barPart(0), 0.0);
        QCOMPARE(HealthDelegate::barPart(0.001), 0.25);
        QCOMPARE(HealthDelegate::barPart(0.01), 0.5);
        QCOMPARE(HealthDelegate::barPart(1), 1.0);
    }

    void theWindowShowsAndRemembersIt()
    {
        test::WorkbenchFixture bench;
        auto window = std::make_unique<MainWindow>(bench.workbench());
        window->resize(1400, 900);
        window->show();
        window->connectTo(QStringLiteral("sim"), Baud);
        auto *panel = window->findChild<HealthPanel *>();
        auto *action = window->findChild<QAction *>(QStringLiteral("busHealthAction"));
        QTRY_COMPARE(bench.session.devices().size(), std::size_t(3));
        QVERIFY(!panel->isVisible());
        QTest::keyClick(window.get(), Qt::Key_H, Qt::ControlModifier);
        QVERIFY(action->isChecked());
        QTRY_VERIFY(panel->isVisible());
        QTRY_COMPARE(panel->findChild<QTreeView *>()->model()->rowCount(), 3);
        QVERIFY(panel->height() > 150 && panel->height() < window->height() / 2);
        window->close();

        window = std::make_unique<MainWindow>(bench.workbench());
        window->show();
        window->connectTo(QStringLiteral("sim"), Baud);
        panel = window->findChild<HealthPanel *>();
        QTRY_VERIFY(panel->isVisible());
        QTest::mouseClick(panel->findChild<QToolButton *>(QStringLiteral("healthCloseButton")), Qt::LeftButton);
        QVERIFY(!panel->isVisible());
        QVERIFY(!window->findChild<QAction *>(QStringLiteral("busHealthAction"))->isChecked());
        window->resize(900, 600); // in the smallest window, too
        window->findChild<QAction *>(QStringLiteral("busHealthAction"))->trigger();
        QTRY_VERIFY(panel->isVisible());
        QCOMPARE(window->size(), QSize(900, 600));
        QVERIFY(panel->geometry().bottom() <= panel->parentWidget()->height());
        window->findChild<QAction *>(QStringLiteral("resetLayoutAction"))->trigger();
        QVERIFY(!panel->isVisible());
    }

    void sayWhatBelongsThere()
    {
        m_panel = std::make_unique<HealthPanel>();
        m_panel->resize(900, 300);
        m_panel->show();
        const auto *empty = m_panel->findChild<QLabel *>(QStringLiteral("healthEmpty"));
        QVERIFY(empty->isVisible());
        QVERIFY(empty->text().contains(QStringLiteral("once one is open")));
        QVERIFY(!m_panel->findChild<QToolButton *>(QStringLiteral("healthCopyButton"))->isEnabled());
        m_panel->setLine(&m_session->open(QStringLiteral("faulty"), Baud));
        QVERIFY(empty->text().contains(QStringLiteral("found on the line")));
    }

    void aDeviceThatAnswersOnlyPingIsNoBadCable()
    {
        HealthRow row;
        row.key = 1;
        row.name = QStringLiteral("XM430-W350");
        row.quality.id = 3;
        row.quality.timeouts = 6;
        const auto help = [&](HealthColumn column) { return healthHelp(row, column); };
        QVERIFY(help(HealthColumn::Bad).contains(QStringLiteral("no power")));
        QVERIFY(help(HealthColumn::Missing).contains(QStringLiteral("no power")));
        row.onlyPing = true;
        for (const HealthColumn column : {HealthColumn::Name, HealthColumn::Bad, HealthColumn::Missing}) {
            QVERIFY(!help(column).contains(QStringLiteral("no power")));
            QVERIFY(help(column).contains(QStringLiteral("answers Ping but no Read")));
        }
    }

private:
    /// A line with these faults and three devices at its rate.
    void connectTo(const sim::LineFaults &faults)
    {
        m_factory.faults = faults;
        m_line = &m_session->open(QStringLiteral("faulty"), Baud);
        for (const int id : {1, 2, 3})
            m_line->heard(found(id));
        QTRY_COMPARE(m_line->state(), BusThread::State::Open);
    }

    void open(const sim::LineFaults &faults)
    {
        connectTo(faults);
        m_model = std::make_unique<HealthModel>();
        m_tester = std::make_unique<QAbstractItemModelTester>(
            m_model.get(), QAbstractItemModelTester::FailureReportingMode::QtTest);
        m_model->setLine(m_line);
    }

    void openPanel(const sim::LineFaults &faults)
    {
        connectTo(faults);
        m_panel = std::make_unique<HealthPanel>();
        m_panel->resize(1300, 300);
        m_panel->setLine(m_line);
        m_panel->show();
        QVERIFY(QTest::qWaitForWindowExposed(m_panel.get()));
    }

    /// A hundred reads of each device, none of them repeated.
    void poll()
    {
        bool done = false;
        m_line->bus().run<int>(
            Priority::Normal, this,
            [](JobContext &context) -> Result<int> {
                for (int i = 0; i < 100; ++i) {
                    for (const std::uint8_t id : {1, 2, 3})
                        (void)context.bus().exchange(readRequest({id, 132, 4}), 0);
                }
                return 0;
            },
            [&](const Result<int> &) { done = true; });
        QTRY_VERIFY(done);
    }

    QString at(int row, HealthColumn column) const
    {
        return m_model->index(row, static_cast<int>(column)).data().toString();
    }
    Verdict verdict(int row) const
    {
        return static_cast<Verdict>(m_model->index(row, 0).data(HealthModel::VerdictRole).toInt());
    }
    QString ids() const
    {
        QStringList all;
        for (int row = 0; row < m_model->rowCount(); ++row) {
            const HealthRow &one = *m_model->row(row);
            all << (one.isLine() ? QStringLiteral("line") : QString::number(one.quality.id));
        }
        return all.join(u' ');
    }

    Catalog m_catalog = Catalog::builtIn().value();
    FaultyFactory m_factory{m_catalog};
    std::unique_ptr<Session> m_session;
    std::unique_ptr<HealthModel> m_model;
    std::unique_ptr<QAbstractItemModelTester> m_tester;
    std::unique_ptr<HealthPanel> m_panel;
    LineSession *m_line = nullptr;
};

DYNASCOPE_UI_TEST(TestHealth)
#include "tst_health.moc"
