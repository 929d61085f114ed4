// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/journal/journal.h"
#include "core/session/monitor.h"
#include "core/session/scanner.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/profilefiles.h"
#include "tests/support/uitest.h"
#include "tests/support/windowdriver.h"
#include "ui/mainwindow.h"
#include "ui/profile/profilefilter.h"
#include "ui/profile/profilemodel.h"
#include "ui/profile/profileview.h"

#include <QAbstractItemModelTester>
#include <QAction>
#include <QCheckBox>
#include <QDir>
#include <QFileDialog>
#include <QLabel>
#include <QMenu>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QSettings>
#include <QTreeView>
#include <QTreeWidget>

#include <atomic>

using namespace dynascope;
using namespace dynascope::test;
using namespace Qt::StringLiterals;

namespace {

const QString Port = u"/dev/ttyVirtual"_s;

struct OnePort final : PortList {
    std::vector<PortInfo> ports() const override { return {{Port, u"U2D2"_s, {}}}; }
};

/// The window over a simulated bus that outlives it. Nothing is polled: virtual time would run without end.
struct World {
    World(VirtualFactory &factory, const Catalog &catalog)
        : session(factory, catalog), commands(session, &journal), monitor(session), stop(session, commands),
          window((monitor.setPaused(true), Workbench{session, commands, monitor, scanner, stop, ports}))
    {
        window.show();
        window.activateWindow();
    }
    bool connectTo(std::size_t devices)
    {
        window.connectTo(Port, ProfileRate);
        return QTest::qWaitFor([&] { return session.devices().size() == devices && !scanner.isRunning(); });
    }
    ProfileView *view() const
    {
        auto *found = window.findChild<ProfileView *>();
        return found && found->isVisible() ? found : nullptr;
    }
    /// By its key.
    bool open() const
    {
        QTest::keyClick(window.windowHandle(), Qt::Key_P, Qt::ControlModifier | Qt::ShiftModifier);
        return QTest::qWaitFor([&] { return view(); }) && QTest::qWaitForWindowActive(view());
    }
    template <typename Widget>
    Widget *part(const char *name) const
    {
        return view()->findChild<Widget *>(QLatin1String(name));
    }
    QString note() const { return part<QLabel>("profileNote")->text(); }
    bool click(const char *name) const
    {
        auto *button = part<QPushButton>(name);
        if (!button || !button->isVisible() || !button->isEnabled())
            return false;
        WindowDriver::click(button);
        return true;
    }
    bool rest() const
    {
        return QTest::qWaitFor([&] { return !view()->isBusy(); }, 20000);
    }
    /// The file, by the dialog and its keys.
    bool load(const QString &path) const
    {
        if (!click("openProfileButton"))
            return false;
        QFileDialog *dialog = nullptr;
        if (!QTest::qWaitFor([&] { return (dialog = view()->findChild<QFileDialog *>(u"openDialog"_s)) != nullptr; })
            || !QTest::qWaitForWindowActive(dialog))
            return false;
        WindowDriver::type(path);
        WindowDriver::key(Qt::Key_Return);
        view()->activateWindow(); // there is no window manager here that does
        return QTest::qWaitFor([&] { return view()->run().path() == path; }) && QTest::qWaitForWindowActive(view());
    }
    bool compare(const QString &path) const
    {
        return load(path) && click("compareButton") && rest();
    }
    /// "j1: 1 difference", "  Position P Gain: 900 / 640: Differs" of what is shown.
    QStringList rows() const
    {
        QStringList list;
        const QAbstractItemModel &model = *part<QTreeView>("profileTree")->model();
        const auto cell = [&](const QModelIndex &parent, int row, int column) {
            return model.index(row, column, parent).data().toString();
        };
        for (int row = 0; row < model.rowCount(); ++row) {
            list << cell({}, row, ProfileModel::Name) + u": "_s + cell({}, row, ProfileModel::State);
            const QModelIndex joint = model.index(row, 0);
            for (int i = 0; i < model.rowCount(joint); ++i)
                list << u"  %1: %2 / %3: %4"_s.arg(cell(joint, i, ProfileModel::Name),
                                                   cell(joint, i, ProfileModel::Wanted),
                                                   cell(joint, i, ProfileModel::Held),
                                                   cell(joint, i, ProfileModel::State));
        }
        return list;
    }

    OnePort ports;
    Journal journal;
    Session session;
    Commands commands;
    Monitor monitor;
    Scanner scanner;
    StopControl stop;
    MainWindow window;
};

std::vector<Deviation> fourDeviations()
{
    return {{1, u"Position P Gain"_s, 640}, {2, u"Return Delay Time"_s, 250}, {2, u"Shutdown"_s, 0},
            {4, u"PWM Limit"_s, 800}};
}

} // namespace

/// A robot's profile at the window, by clicks and keys.
class TestProfileView : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        QSettings().clear();
        QDir(MoveFile::usualFolder()).removeRecursively();
        m_folder = std::make_unique<QTemporaryDir>();
        m_path = writeFile(m_folder->path(), u"arm.yaml"_s, profileOf(4));
        use(servosOf(4));
    }
    void cleanup()
    {
        m_world.reset();
        m_factory.reset();
    }

    void aFileWithFaults()
    {
        QVERIFY(m_world->connectTo(4));
        QVERIFY(m_world->open());
        QVERIFY(m_world->part<QPushButton>("openProfileButton")->isVisible());
        writeFile(m_folder->path(), u"arm.yaml"_s,
                  profileOf(4).replace("885", "a lot").replace("name: j2, model: XM430-W350", "name: j2, model: XM999"));
        QVERIFY(m_world->load(m_path));
        auto *faults = m_world->part<QPlainTextEdit>("profileFaults");
        QTRY_VERIFY(faults->isVisible());
        QVERIFY2(faults->toPlainText().contains(u"Line 9, column 16: "_s), qPrintable(faults->toPlainText()));
        QVERIFY2(faults->toPlainText().contains(u"XM999"_s), qPrintable(faults->toPlainText()));
        QVERIFY(faults->textInteractionFlags() & Qt::TextSelectableByKeyboard);
        QVERIFY(!m_world->part<QPushButton>("applyButton")->isEnabled());
        // Mended on disk, it is read again.
        writeFile(m_folder->path(), u"arm.yaml"_s, profileOf(4));
        QVERIFY(m_world->click("compareButton"));
        QVERIFY(m_world->rest());
        QVERIFY(!faults->isVisible());
        QCOMPARE(m_world->rows().first(), u"j1: 1 difference"_s);
        QCOMPARE(m_writes, 0);
    }

    void comparedAppliedGreen()
    {
        QVERIFY(m_world->connectTo(4));
        QVERIFY(m_world->open());
        QVERIFY(m_world->compare(m_path));
        QCOMPARE(m_world->rows(),
                 QStringList({u"j1: 1 difference"_s, u"  Position P Gain: 900 / 640: Differs"_s, u"j2: 2 differences"_s,
                              u"  Return Delay Time: 0 µs (0) / 500 µs (250): Differs"_s,
                              shutdownRow(u"Differs"_s, true), u"j3: As wanted"_s, u"j4: 1 difference"_s,
                              u"  PWM Limit: 100.0 % (885) / 90.4 % (800): Differs"_s}));
        QCOMPARE(m_writes, 0);
        QVERIFY(m_world->click("applyButton"));
        const auto *steps = m_world->part<QTreeWidget>("profileSteps");
        QTRY_VERIFY(steps->isVisible());
        QCOMPARE(steps->topLevelItemCount(), 3);
        QCOMPARE(steps->topLevelItem(1)->childCount(), 2);
        QCOMPARE(m_world->part<QPushButton>("writeButton")->text().remove(u'&'), u"Write 4 Registers"_s);
        QCOMPARE(m_writes, 0);
        WindowDriver::key(Qt::Key_Return); // its default
        QVERIFY(m_world->rest());
        QTRY_COMPARE(m_writes, 4);
        QCOMPARE(m_world->rows(),
                 QStringList({u"j1: As wanted, 1 written"_s, u"  Position P Gain: 900 / 900: Written, read back"_s,
                              u"j2: As wanted, 2 written"_s,
                              u"  Return Delay Time: 0 µs (0) / 0 µs (0): Written, read back"_s,
                              shutdownRow(u"Written, read back"_s, false), u"j3: As wanted"_s,
                              u"j4: As wanted, 1 written"_s,
                              u"  PWM Limit: 100.0 % (885) / 100.0 % (885): Written, read back"_s}));
        QVERIFY2(m_world->note().startsWith(u"4 registers of 3 joints written and read back."_s),
                 qPrintable(m_world->note()));
        const auto *apply = m_world->part<QPushButton>("applyButton");
        QVERIFY(!apply->isEnabled()); // a second time writes nothing
        QVERIFY(apply->toolTip().contains(u"as wanted already"_s));
        for (const JournalEntry &entry : m_world->journal.entries())
            QCOMPARE(entry.by, JournalAuthor::Profile);
        QVERIFY(m_world->click("compareButton"));
        QVERIFY(m_world->rest());
        QCOMPARE(m_world->rows(),
                 QStringList({u"j1: As wanted"_s, u"j2: As wanted"_s, u"j3: As wanted"_s, u"j4: As wanted"_s}));
        QCOMPARE(m_writes, 4);
    }

    void jointsAreChosenByTheirBoxes()
    {
        QVERIFY(m_world->connectTo(4));
        QVERIFY(m_world->open());
        QVERIFY(m_world->compare(m_path));
        auto *tree = m_world->part<QTreeView>("profileTree");
        for (const int row : {0, 1}) {
            tree->setCurrentIndex(tree->model()->index(row, 0));
            tree->setFocus();
            WindowDriver::key(Qt::Key_Space);
        }
        QVERIFY(m_world->click("applyButton"));
        QCOMPARE(m_world->part<QPushButton>("writeButton")->text().remove(u'&'), u"Write 1 Register"_s);
        QVERIFY(m_world->click("backButton"));
        QVERIFY(m_world->click("applyButton"));
        QVERIFY(m_world->click("writeButton"));
        QVERIFY(m_world->rest());
        QCOMPARE(m_writes, 1);
    }

    void torqueIsAskedFor()
    {
        QVERIFY(m_world->connectTo(4));
        Device *second = m_world->session.lines().front()->deviceAt(2, ProfileRate);
        m_world->commands.setTorque({second}, true);
        QTRY_VERIFY(second->isTorqueOn());
        m_writes = 0;
        QVERIFY(m_world->open());
        QVERIFY(m_world->compare(m_path));
        QVERIFY(m_world->click("applyButton"));
        QVERIFY(!m_world->part<QPushButton>("writeButton")->isEnabled());
        QVERIFY2(m_world->note().startsWith(u"Torque of j2 is on"_s), qPrintable(m_world->note()));
        auto *off = m_world->part<QCheckBox>("turnTorqueOff"), *back = m_world->part<QCheckBox>("putTorqueBack");
        QVERIFY(off->isVisible() && !back->isEnabled() && !back->isChecked());
        WindowDriver::click(off, QPoint(8, off->height() / 2));
        QVERIFY(back->isEnabled());
        WindowDriver::click(back, QPoint(8, back->height() / 2));
        QVERIFY(m_world->click("writeButton"));
        QVERIFY(m_world->rest());
        QTRY_VERIFY(second->isTorqueOn());
        QVERIFY(m_world->view()->run().comparison()->isAsWanted());
    }

    void endedInItsMiddle_data()
    {
        QTest::addColumn<bool>("byStop");
        QTest::newRow("End Here") << false;
        QTest::newRow("STOP") << true;
    }
    void endedInItsMiddle()
    {
        QFETCH(bool, byStop);
        QVERIFY(m_world->connectTo(4));
        QVERIFY(m_world->open());
        QVERIFY(m_world->compare(m_path));
        QVERIFY(m_world->click("applyButton"));
        const auto press = connect(&m_world->view()->run(), &ProfileRun::jointChanged, this, [&](std::size_t joint) {
            if (joint != 0)
                return;
            if (byStop)
                WindowDriver::key(Qt::Key_Escape);
            else
                m_world->click("cancelButton");
        });
        QVERIFY(m_world->click("writeButton"));
        QVERIFY(m_world->rest());
        disconnect(press);
        QVERIFY(m_world->view()); // it says where it is
        QCOMPARE(m_world->stop.isActive(), byStop);
        if (byStop) {
            QTRY_VERIFY(!m_world->stop.isVerifying());
            if (m_world->click("applyButton")) {
                QVERIFY(!m_world->part<QPushButton>("writeButton")->isEnabled());
                QVERIFY2(m_world->note().startsWith(u"STOP is held"_s), qPrintable(m_world->note()));
            }
            m_world->stop.release();
            if (m_world->part<QPushButton>("backButton")->isVisible())
                QVERIFY(m_world->click("backButton"));
        }
        if (m_world->click("applyButton")) { // unless the bus was quicker
            QVERIFY(m_world->click("writeButton"));
            QVERIFY(m_world->rest());
        }
        QVERIFY(m_world->view()->run().comparison()->isAsWanted());
    }

    void devicesThatAreGoneElsewhereOrTooMany()
    {
        use(u"XM430-W350@1000000:1,XM430-W350@57600:2,XL430-W250@1000000:4,XM430-W350@1000000:9"_s);
        std::atomic<bool> isGone = false;
        sim::Servo *first = m_factory->simulated.servo(1, ProfileRate);
        m_factory->onPacket = [&, first](int, ByteView) { first->setPlugged(!isGone); };
        m_world->window.connectTo(Port, ProfileRate);
        QTRY_VERIFY(!m_world->session.lines().empty() && !m_world->scanner.isRunning());
        QVERIFY(m_world->open());
        QVERIFY(m_world->compare(m_path));
        const QStringList rows = m_world->rows();
        QVERIFY2(rows.contains(u"j2: Found at 57\u2009600 bps, wants 1 Mbps"_s), qPrintable(rows.join(u'\n')));
        QVERIFY2(rows.contains(u"j3: Not found"_s), qPrintable(rows.join(u'\n')));
        QVERIFY2(rows.contains(u"j4: Wrong model"_s), qPrintable(rows.join(u'\n')));
        QCOMPARE(rows.last(), u"XM430-W350: No joint names it"_s);
        QVERIFY(m_world->click("applyButton"));
        QVERIFY2(m_world->note().contains(u"Not done: j3"_s), qPrintable(m_world->note()));
        auto *move = m_world->part<QCheckBox>("moveJoints");
        QVERIFY(move->isVisible());
        WindowDriver::click(move, QPoint(8, move->height() / 2));
        isGone = true; // behind its comparison
        QVERIFY(m_world->click("writeButton"));
        QVERIFY(m_world->rest());
        QVERIFY2(m_world->rows().contains(u"j1: Not found"_s), qPrintable(m_world->rows().join(u'\n')));
        isGone = false;
        for (int i = 0; i < 4; ++i) { // it boots first
            QVERIFY(m_world->click("compareButton"));
            QVERIFY(m_world->rest());
        }
        if (m_world->click("applyButton")) {
            if (move->isVisible() && !move->isChecked())
                WindowDriver::click(move, QPoint(8, move->height() / 2));
            QVERIFY(m_world->click("writeButton"));
            QVERIFY(m_world->rest());
        }
        using State = JointComparison::State;
        const auto &joints = m_world->view()->run().comparison()->joints;
        QCOMPARE(joints[0].state, State::AsWanted);
        QCOMPARE(joints[1].state, State::AsWanted);
        QCOMPARE(joints[2].state, State::Missing);
        m_world.reset();
    }

    void savedFromTheBus()
    {
        QVERIFY(m_world->connectTo(4));
        QVERIFY(m_world->open());
        QVERIFY(save("saveNewAction"));
        QFileDialog *dialog = nullptr;
        QTRY_VERIFY((dialog = m_world->view()->findChild<QFileDialog *>(u"saveDialog"_s)));
        QVERIFY(QTest::qWaitForWindowActive(dialog));
        const QString fresh = m_folder->filePath(u"fresh.yaml"_s);
        auto *line = dialog->findChild<QLineEdit *>(u"fileNameEdit"_s);
        line->selectAll();
        WindowDriver::type(fresh);
        WindowDriver::key(Qt::Key_Return);
        m_world->view()->activateWindow();
        QTRY_VERIFY2(m_world->note().startsWith(u"fresh.yaml is saved"_s), qPrintable(m_world->note()));
        QCOMPARE(m_world->view()->run().path(), fresh);
        QCOMPARE(m_world->view()->run().profile()->joints.size(), 4U);

        writeFile(m_folder->path(), u"arm.yaml"_s, "# mine\n" + profileOf(4));
        QVERIFY(QTest::qWaitForWindowActive(m_world->view()));
        QVERIFY(m_world->load(m_path));
        QVERIFY(save("saveIntoAction"));
        QTRY_VERIFY2(m_world->note().startsWith(u"arm.yaml is saved"_s), qPrintable(m_world->note()));
        QVERIFY(readFile(m_path).startsWith("# mine\nprofile: 1\n"));
        QVERIFY(m_world->click("compareButton"));
        QVERIFY(m_world->rest());
        QVERIFY(m_world->view()->run().comparison()->isAsWanted());
        QCOMPARE(m_writes, 0);
    }

    void soundModels()
    {
        Session session(*m_factory, m_catalog);
        Commands commands(session);
        ProfileRun run(session, commands, {});
        ProfileModel model(m_catalog);
        ProfileFilter filter(model);
        using Mode = QAbstractItemModelTester::FailureReportingMode;
        const QAbstractItemModelTester tester(&model, Mode::QtTest), filterTester(&filter, Mode::QtTest);
        model.show(run);
        QVERIFY(run.load(m_path));
        model.show(run);
        QCOMPARE(model.rowCount(), 4);
        QCOMPARE(filter.rowCount(filter.index(0, 0)), 14);
        run.setLine(&session.open(Port, ProfileRate));
        QTRY_COMPARE(run.line()->state(), BusThread::State::Open);
        run.compare();
        QTRY_VERIFY(!run.isBusy());
        model.show(run);
        QCOMPARE(filter.rowCount(filter.index(0, 0)), 1);
        filter.setOnlyDifferences(false);
        QCOMPARE(filter.rowCount(filter.index(0, 0)), 14);
        UnitPreferences raw;
        raw.raw = true;
        model.setUnits(raw);
        run.apply({}, false);
        QTRY_VERIFY(!run.isBusy());
        filter.setOnlyDifferences(true);
        model.show(run);
        QCOMPARE(model.kind(model.index(0, 0)), ProfileModel::Kind::Written);
        QVERIFY(model.setData(model.index(1, 0), Qt::Unchecked, Qt::CheckStateRole));
        QCOMPARE(model.chosen(), (std::set<std::size_t>{0, 2, 3}));
        writeFile(m_folder->path(), u"arm.yaml"_s, "profile: 7\n");
        run.compare();
        model.show(run);
        QCOMPARE(model.rowCount(), 0);
    }

private:
    void use(const QString &servos)
    {
        m_world.reset();
        m_factory = std::make_unique<VirtualFactory>(m_catalog, servos);
        setUpServos(m_factory->simulated, *profileFromYaml(profileOf(4), u"f.yaml"_s, m_catalog), fourDeviations());
        m_writes = 0;
        m_factory->onPacket = [this](int, ByteView packet) { m_writes += isRegisterWrite(packet) ? 1 : 0; };
        m_world = std::make_unique<World>(*m_factory, m_catalog);
        QVERIFY(QTest::qWaitForWindowActive(&m_world->window));
    }
    bool save(const char *action)
    {
        if (!m_world->click("saveProfileButton"))
            return false;
        const auto *menu = m_world->part<QMenu>("saveProfileButtonMenu");
        return QTest::qWaitFor([&] { return menu->isVisible(); }) && WindowDriver::pick(action);
    }
    QString shutdownRow(const QString &state, bool differs) const
    {
        const Field &field = *m_catalog.find(1020, 50)->find(u"Shutdown");
        const auto text = [&](std::int64_t raw) {
            const QString name = meaning(field, raw);
            return name.isEmpty() ? QString::number(raw) : u"%1 (%2)"_s.arg(name).arg(raw);
        };
        return u"  Shutdown: %1 / %2: %3"_s.arg(text(52), text(differs ? 0 : 52), state);
    }

    const Catalog m_catalog = builtInCatalog();
    std::unique_ptr<QTemporaryDir> m_folder;
    std::unique_ptr<VirtualFactory> m_factory;
    std::unique_ptr<World> m_world;
    QString m_path;
    std::atomic<int> m_writes = 0;
};

DYNASCOPE_UI_TEST(TestProfileView)
#include "tst_profileview.moc"
