// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/commissionfixture.h"
#include "tests/support/uitest.h"
#include "tests/support/workbenchfixture.h"
#include "ui/commission/commissiondialog.h"
#include "ui/commission/commissionmodel.h"
#include "ui/commission/commissionsetup.h"
#include "ui/common/present.h"
#include "ui/mainwindow.h"

#include <QAbstractItemModelTester>
#include <QAction>
#include <QComboBox>
#include <QFile>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>
#include <QTreeView>

using namespace dynascope;
using namespace Qt::StringLiterals;
using test::PluggedSession;

namespace {

/// A dialog beside a window, as a person sees and uses it.
struct World {
    World(const Catalog &catalog, const QString &servos, bool areIn = false)
        : session(catalog, servos, areIn, &journal)
    {
        window.show();
        dialog = new CommissionDialog(session.all.commands, session.line(), session.folder.path(), &window);
        present(*dialog, u"virtual"_s);
    }
    ~World()
    {
        if (dialog)
            dialog->reject();
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    }
    template <typename T>
    T &find(const char *name) const
    {
        auto *found = dialog->findChild<T *>(QLatin1String(name));
        if (!found)
            qFatal("there is no %s", name);
        return *found;
    }
    void click(const char *name) const { QTest::mouseClick(&find<QPushButton>(name), Qt::LeftButton); }
    QString sentence() const { return find<QLabel>("commissionSentence").text(); }
    QString note() const { return find<QLabel>("commissionNote").text(); }
    QString cell(int row, CommissionColumn column) const
    {
        const auto &view = find<QTreeView>("commissionView");
        return view.model()->index(row, static_cast<int>(column)).data().toString();
    }
    void begin(int count) const
    {
        find<QSpinBox>("commissionFirstId").setValue(11);
        find<QSpinBox>("commissionCount").setValue(count);
        find<QComboBox>("commissionBaud").setCurrentText(u"1M"_s);
        click("commissionStart");
    }

    Journal journal;
    QWidget window;
    PluggedSession session;
    QPointer<CommissionDialog> dialog;
};

} // namespace

/// File › Commission new servos, over a simulated line.
class TestCommission : public QObject
{
    Q_OBJECT

private slots:
    void oneAfterTheOther()
    {
        World world(m_catalog, u"XM430-W350@57600:1,XM430-W350@3000000:1"_s);
        QTRY_COMPARE(world.session.line().state(), BusThread::State::Open);
        world.find<QLineEdit>("commissionNames").setText(u"shoulder, elbow"_s);
        world.begin(2);
        const QAbstractItemModelTester tester(world.find<QTreeView>("commissionView").model());
        QTRY_COMPARE(world.sentence(), u"Plug in the servo for shoulder, ID 11"_s);
        QVERIFY(!world.find<QPushButton>("commissionCsv").isEnabled());
        QVERIFY(!world.find<QPushButton>("commissionLed").isEnabled());
        world.session.plug(0);
        QTRY_COMPARE_WITH_TIMEOUT(world.sentence(), u"Plug in the servo for elbow, ID 12"_s, 30'000);
        QTRY_VERIFY(world.cell(0, CommissionColumn::State).contains(u"was ID 1 at")); // once its LED is out again
        QVERIFY(!world.cell(0, CommissionColumn::Firmware).isEmpty());
        QTRY_VERIFY(world.session.line().deviceAt(11, 1'000'000)); // the tree follows
        world.session.plug(1);
        QTRY_COMPARE_WITH_TIMEOUT(world.sentence(), u"All 2 servos are done"_s, 30'000);
        QTRY_VERIFY(world.find<QPushButton>("commissionLed").isEnabled());
        const std::size_t before = world.journal.entries().size();
        QVERIFY(before >= 4);
        QTest::keyClick(&world.find<QPushButton>("commissionLed"), Qt::Key_Space);
        QTRY_COMPARE(world.journal.entries().size(), before + 2); // lit, and put out
        saveLabels(world, "commissionCsv", u"labels.csv"_s, "Joint,ID,");
        saveLabels(world, "commissionPdf", u"labels.pdf"_s, "%PDF");
    }

    void offersIdsThatAreFree()
    {
        World world(m_catalog, u"XM430-W350@57600:1"_s);
        for (const int id : {1, 4, 11})
            world.session.line().heard({static_cast<std::uint8_t>(id), id == 4 ? 57600 : 1000000, 1020, 45, false, {}});
        CommissionSetup setup(world.session.line(), nullptr);
        QCOMPARE(setup.findChild<QSpinBox *>(u"commissionFirstId"_s)->value(), 5); // six in a row
    }

    void twoAtOnce()
    {
        World world(m_catalog, u"XM430-W350@57600:1,XM430-W350@57600:1"_s);
        QTRY_COMPARE(world.session.line().state(), BusThread::State::Open);
        world.begin(2);
        QTRY_COMPARE(world.sentence(), u"Plug in the servo for ID 11"_s);
        world.session.plug(0);
        world.session.plug(1);
        QTRY_VERIFY_WITH_TIMEOUT(world.note().contains(u"two servos at once"), 30'000);
        QVERIFY(world.journal.entries().empty());
        QCOMPARE(world.sentence(), u"Unplug one: one at a time"_s);
        world.session.plug(1, false);
        QTRY_COMPARE_WITH_TIMEOUT(world.sentence(), u"Plug in the servo for ID 12"_s, 30'000);
        QTRY_COMPARE(world.note(), QString());
    }

    void skipBackAndPause()
    {
        World world(m_catalog, u"XM430-W350@57600:1"_s);
        QTRY_COMPARE(world.session.line().state(), BusThread::State::Open);
        world.begin(2);
        QTRY_COMPARE(world.sentence(), u"Plug in the servo for ID 11"_s);
        world.click("commissionSkip");
        QTRY_COMPARE(world.sentence(), u"Plug in the servo for ID 12"_s);
        QCOMPARE(world.cell(0, CommissionColumn::State), u"skipped"_s);
        world.click("commissionPause");
        QTRY_COMPARE(world.sentence(), u"Paused before ID 12"_s);
        auto &view = world.find<QTreeView>("commissionView");
        view.setCurrentIndex(view.model()->index(0, 0));
        world.click("commissionBack");
        QTRY_COMPARE(world.sentence(), u"Paused before ID 11"_s);
        QTest::keyClick(&world.find<QPushButton>("commissionStart"), Qt::Key_Space);
        QTRY_COMPARE(world.sentence(), u"Plug in the servo for ID 11"_s);
        world.session.plug(0);
        QTRY_COMPARE_WITH_TIMEOUT(world.sentence(), u"Plug in the servo for ID 12"_s, 30'000);
    }

    void whoWasThereBefore()
    {
        World world(m_catalog, u"XM430-W350@57600:1"_s, true);
        QTRY_COMPARE(world.session.line().state(), BusThread::State::Open);
        world.begin(1);
        QTRY_VERIFY_WITH_TIMEOUT(world.note().startsWith(u"There before, and left alone: XM430-W350"), 30'000);
        QVERIFY(world.journal.entries().empty());
        world.click("commissionIsNew");
        QTRY_COMPARE_WITH_TIMEOUT(world.sentence(), u"All 1 servos are done"_s, 30'000);
    }

    void stopEndsIt()
    {
        World world(m_catalog, u"XM430-W350@57600:1"_s);
        QTRY_COMPARE(world.session.line().state(), BusThread::State::Open);
        world.begin(1);
        QTRY_COMPARE(world.sentence(), u"Plug in the servo for ID 11"_s);
        world.session.all.stop.press();
        QTRY_COMPARE(world.sentence(), u"Paused before ID 11"_s);
        QVERIFY2(!world.note().isEmpty(), "it says why");
        world.click("commissionStart");
        QVERIFY(world.note().contains(u"STOP is held"));
        QTRY_VERIFY(!world.session.all.stop.isVerifying());
        world.session.all.stop.release();
        world.click("commissionStart");
        world.session.plug(0);
        QTRY_COMPARE_WITH_TIMEOUT(world.sentence(), u"All 1 servos are done"_s, 30'000);
    }

    void goesWithItsLine()
    {
        World world(m_catalog, u"XM430-W350@57600:1"_s);
        QTRY_COMPARE(world.session.line().state(), BusThread::State::Open);
        world.begin(1);
        world.session.all.close();
        QTRY_VERIFY(!world.dialog || !world.dialog->isVisible());
    }

    void setupSaysWhatIsWrong()
    {
        World world(m_catalog, u"XM430-W350@57600:1"_s);
        auto &note = world.find<QLabel>("commissionSetupNote");
        QVERIFY(note.text().startsWith(u"6 servos"));
        world.find<QComboBox>("commissionModel").setCurrentText(u"XM999"_s);
        QCOMPARE(note.text(), u"There is no model XM999."_s);
        QVERIFY(!world.find<QPushButton>("commissionStart").isEnabled());
        world.find<QComboBox>("commissionModel").setCurrentText(u"XM430-W350"_s);
        world.find<QLineEdit>("commissionNames").setText(u"a, b"_s);
        QCOMPARE(note.text(), u"There are 2 names for 6 IDs."_s);
        QFile profile(world.session.folder.filePath(u"arm.yaml"_s));
        QVERIFY(profile.open(QIODevice::WriteOnly));
        profile.write("nonsense: [");
        profile.close();
        world.dialog->findChild<CommissionSetup *>()->loadProfile(profile.fileName());
        QVERIFY2(note.text().contains(u"arm.yaml:"), qPrintable(note.text()));
        QVERIFY(!world.find<QPushButton>("commissionStart").isEnabled());
    }

    void fromTheMenu()
    {
        test::WorkbenchFixture fixture;
        MainWindow window(fixture.workbench());
        window.show();
        auto *action = window.findChild<QAction *>(u"commissionAction"_s);
        QVERIFY(action && !action->isEnabled());
        window.connectTo(u"sim"_s, 1'000'000);
        QTRY_VERIFY(action->isEnabled());
        action->trigger();
        auto *dialog = window.findChild<CommissionDialog *>();
        QVERIFY(dialog && dialog->isVisible());
        QVERIFY(!dialog->isModal());
        action->trigger();
        QCOMPARE(window.findChildren<CommissionDialog *>().size(), 1);
    }

private:
    static void saveLabels(const World &world, const char *button, const QString &name, const QByteArray &begin)
    {
        const QString path = world.session.folder.filePath(name);
        world.click(button);
        auto *dialog = world.dialog->findChild<QFileDialog *>(u"saveDialog"_s);
        QVERIFY(dialog);
        dialog->selectFile(path);
        static_cast<QDialog *>(dialog)->accept();
        QFile file(path);
        QTRY_VERIFY(file.exists());
        QVERIFY(file.open(QIODevice::ReadOnly));
        QVERIFY(file.readAll().startsWith(begin));
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    }

    const Catalog m_catalog = Catalog::builtIn().value();
};

DYNASCOPE_UI_TEST(TestCommission)
#include "tst_commission.moc"
