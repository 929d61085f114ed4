// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/support/workbenchfixture.h"
#include "ui/common/filedialogs.h"
#include "ui/devices/devicepanel.h"
#include "ui/mainwindow.h"
#include "ui/plot/plotarea.h"

#include <QAction>
#include <QComboBox>
#include <QDialog>
#include <QFile>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QPointer>
#include <QPushButton>
#include <QSettings>
#include <QTemporaryDir>

using namespace dynascope;

/// What is open beside the window takes nothing from STOP. Clicks and keys go to native windows, as the system's do.
class TestDialogs : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        QSettings().clear();
        m_bench = std::make_unique<test::WorkbenchFixture>();
        m_window = std::make_unique<MainWindow>(m_bench->workbench());
        m_window->show();
        m_window->activateWindow();
        QVERIFY(QTest::qWaitForWindowActive(m_window.get()));
        m_window->connectTo(QStringLiteral("sim"), 1000000);
        QTRY_COMPARE(m_bench->session.devices().size(), std::size_t(3));
        QTRY_VERIFY(!m_bench->scanner.isRunning());
        m_first = m_bench->device(1, 1000000);
        QVERIFY(m_first);
        select(first());
    }
    void cleanup()
    {
        m_window.reset();
        m_bench.reset();
    }

    void takeNothingFromStop_data()
    {
        QTest::addColumn<QByteArray>("action");
        for (const char *name :
             {"renameAction", "changeIdAction", "changeBaudAction", "moveManyAction", "factoryResetAction",
                                 "rebootAction", "shortcutsAction", "aboutAction", "savePictureAction", "quitAction"})
            QTest::newRow(name) << QByteArray(name);
    }
    void takeNothingFromStop()
    {
        QFETCH(QByteArray, action);
        trigger("torqueOnAction");
        QTRY_VERIFY(first().isTorqueOn());
        m_window->findChild<PlotArea *>()->addTrace({first().key(), first().table().indexOf(u"Present Position")});
        trigger(action.constData());
        const QPointer<QDialog> dialog = opened();
        QVERIFY(dialog);
        QVERIFY(!QApplication::activeModalWidget());
        click(*m_window->findChild<QWidget *>(QStringLiteral("stopButton")));
        QVERIFY(m_bench->stop.isActive());
        QTRY_VERIFY(m_bench->stop.isConfirmed());
        QVERIFY(!first().isTorqueOn());
        QVERIFY(dialog && dialog->isVisible());
        m_bench->stop.release();
        QCoreApplication::processEvents();

        QTest::keyClick(m_window->windowHandle(), Qt::Key_Escape); // the click has given it the focus
        QVERIFY(m_bench->stop.isActive());
        m_bench->stop.release();
        QCoreApplication::processEvents();
        QVERIFY(dialog && dialog->isVisible());

        QTest::keyClick(dialog->windowHandle(), Qt::Key_Escape);
        QVERIFY(m_bench->stop.isActive());
        QTRY_VERIFY(!dialog); // as Esc always does
    }

    void aDoubleClickOnStopDoesNotReleaseIt()
    {
        auto &button = *m_window->findChild<QWidget *>(QStringLiteral("stopButton"));
        QTest::mouseDClick(m_window->windowHandle(), Qt::LeftButton, {}, middleOf(button));
        QVERIFY(m_bench->stop.isActive());
        click(button);
        QVERIFY(!m_bench->stop.isActive());
    }

    void aClickOnStopWhileAPopupIsOpen_data()
    {
        QTest::addColumn<QByteArray>("popup");
        QTest::newRow("menu") << QByteArray("menu");
        QTest::newRow("context menu") << QByteArray("deviceMenu");
        QTest::newRow("list") << QByteArray("portCombo");
        QTest::newRow("scan options") << QByteArray("scanOptionsAction");
    }
    void aClickOnStopWhileAPopupIsOpen()
    {
        QFETCH(QByteArray, popup);
        if (popup == "menu")
            m_window->findChildren<QMenu *>().constFirst()->popup(m_window->mapToGlobal(QPoint(5, 60)));
        else if (popup == "deviceMenu")
            QTest::mouseClick(m_window->findChild<QWidget *>(QStringLiteral("moreActionsButton")), Qt::LeftButton);
        else if (popup == "portCombo")
            m_window->findChild<QComboBox *>(QStringLiteral("portCombo"))->showPopup();
        else
            trigger(popup.constData());
        QTRY_VERIFY(QApplication::activePopupWidget());
        click(*m_window->findChild<QWidget *>(QStringLiteral("stopButton")));
        QVERIFY(m_bench->stop.isActive());
        QVERIFY(!QApplication::activePopupWidget());
        QCoreApplication::processEvents(); // what Qt would send again
        QVERIFY(m_bench->stop.isActive());
    }

    void theSameAgainComesToTheFront()
    {
        trigger("changeIdAction");
        const QPointer<QDialog> dialog = opened();
        m_window->activateWindow();
        trigger("changeIdAction");
        QCOMPARE(m_window->findChildren<QDialog *>().size(), 1);
        QTRY_COMPARE(QApplication::activeWindow(), dialog.data());
    }

    void staysWithItsDevice()
    {
        trigger("changeIdAction");
        const QPointer<QDialog> dialog = opened();
        QVERIFY2(dialog->windowTitle().contains(QStringLiteral("XM430-W350, ID 1")), qPrintable(dialog->windowTitle()));
        select(*m_bench->device(4, 1000000));
        QVERIFY2(dialog->windowTitle().contains(QStringLiteral("XM430-W350, ID 1")), qPrintable(dialog->windowTitle()));
        line().moveDevice(first(), {7, 57600, 1020, 45, false, {}});
        QVERIFY2(dialog->windowTitle().contains(QStringLiteral("ID 7")), qPrintable(dialog->windowTitle()));
        const QString who = dialog->findChild<QLabel *>(QStringLiteral("who"))->text();
        QVERIFY2(who.contains(QStringLiteral("ID 7 at 57")), qPrintable(who));
        QCOMPARE(dialog->findChild<QLabel *>(QStringLiteral("takenIds"))->text(), QStringLiteral("1"));
        trigger("changeIdAction"); // of the other one: that is another dialog
        QCOMPARE(m_window->findChildren<QDialog *>().size(), 2);
        line().forget(first().key());
        QTRY_VERIFY(!dialog);
        QCOMPARE(m_window->findChildren<QDialog *>().size(), 1);
    }

    void theRatesOfferedFollowTheDevice()
    {
        trigger("changeBaudAction");
        auto *rates = opened()->findChild<QComboBox *>(QStringLiteral("newBaud"));
        rates->setCurrentIndex(rates->findData(2000000));
        line().moveDevice(first(), {1, 115200, 1020, 45, false, {}});
        QCOMPARE(rates->findData(115200), -1);
        QVERIFY(rates->findData(1000000) >= 0);
        QCOMPARE(rates->currentData().toInt(), 2000000); // what was chosen stays
    }

    void aQuestionGoesWithItsDevice_data()
    {
        QTest::addColumn<QByteArray>("action");
        QTest::newRow("question") << QByteArray("rebootAction");
        QTest::newRow("nickname") << QByteArray("renameAction");
    }
    void aQuestionGoesWithItsDevice()
    {
        QFETCH(QByteArray, action);
        trigger("torqueOnAction");
        QTRY_VERIFY(first().isTorqueOn());
        trigger(action.constData());
        const QPointer<QDialog> dialog = opened();
        QVERIFY(dialog);
        line().forget(first().key());
        QTRY_VERIFY(!dialog);
    }

    void allCloseWithTheWindow()
    {
        trigger("shortcutsAction");
        trigger("changeIdAction");
        QCOMPARE(m_window->findChildren<QDialog *>().size(), 2);
        QVERIFY(m_window->close());
        for (const QDialog *dialog : m_window->findChildren<QDialog *>())
            QVERIFY(!dialog->isVisible());
    }

    void closesOnceNothingIsHeldAnyMore()
    {
        trigger("torqueOnAction");
        QTRY_VERIFY(first().isTorqueOn());
        QVERIFY(!m_window->close());
        const QPointer<QDialog> box = opened();
        m_bench->stop.press();
        QTRY_VERIFY(!first().isTorqueOn());
        QVERIFY(m_window->close());
        QTRY_VERIFY(!box);
    }

    void replacingAFileIsAskedBesideTheWindowToo()
    {
        const QTemporaryDir directory;
        const QString path = directory.filePath(QStringLiteral("a.csv"));
        QFile file(path);
        QVERIFY(file.open(QIODevice::WriteOnly));
        file.close();
        QStringList saved;
        askWhereToSave(m_window.get(), QStringLiteral("Save"), QStringLiteral("csv"), path,
                       [&saved](const QString &chosen) { saved << chosen; });
        const QPointer<QDialog> dialog = opened();
        QVERIFY(dialog);
        dialog->accept();
        QVERIFY(!QApplication::activeModalWidget());
        auto *replace = dialog->findChild<QPushButton *>(QStringLiteral("replaceButton"));
        QVERIFY(replace && replace->isVisible());
        QCOMPARE(saved, QStringList());
        QTest::mouseClick(replace, Qt::LeftButton);
        QCOMPARE(saved, QStringList(path));
        QTRY_VERIFY(!dialog);
    }

    /// The first time where files of that kind usually are, then where the last one was.
    void filesAreAskedForWhereTheLastOneWas()
    {
        const QTemporaryDir usual, other;
        const QString path = other.filePath(QStringLiteral("walk.mcap"));
        QVERIFY(QFile(path).open(QIODevice::WriteOnly));
        const QStringList suffixes{QStringLiteral("mcap")};
        const auto ask = [&] {
            askWhatToOpen(m_window.get(), QStringLiteral("Open"), suffixes, [](const QString &) {}, usual.path());
            return static_cast<QFileDialog *>(m_window->findChild<QDialog *>(QStringLiteral("openDialog")));
        };
        QPointer<QFileDialog> dialog = ask();
        QCOMPARE(dialog->directory(), QDir(usual.path()));
        dialog->selectFile(path);
        static_cast<QDialog *>(dialog)->accept();
        QTRY_VERIFY(!dialog);
        dialog = ask();
        QCOMPARE(dialog->directory(), QDir(other.path()));
        dialog->close();
        askWhereToSave(m_window.get(), QStringLiteral("Save"), QStringLiteral("mcap"), QStringLiteral("run.mcap"), [](const QString &) {});
        auto *save = m_window->findChild<QFileDialog *>(QStringLiteral("saveDialog"));
        QCOMPARE(save->selectedFiles(), QStringList(other.filePath(QStringLiteral("run.mcap"))));
        save->close();
    }

private:
    Device &first() { return *m_first; }
    LineSession &line() { return *m_bench->session.lines().front(); }
    void trigger(const char *name) { m_window->findChild<QAction *>(QString::fromLatin1(name))->trigger(); }

    void select(Device &device)
    {
        auto *panel = m_window->findChild<DevicePanel *>();
        panel->selectDevice(&device);
        QCOMPARE(panel->selectedDevices(), std::vector<Device *>{&device});
    }

    QDialog *opened()
    {
        QDialog *dialog = nullptr;
        (void)QTest::qWaitFor([&dialog] {
            dialog = qobject_cast<QDialog *>(QApplication::activeWindow());
            return dialog != nullptr;
        });
        return dialog;
    }

    QPoint middleOf(QWidget &widget) { return widget.mapTo(m_window.get(), widget.rect().center()); }
    void click(QWidget &widget) { QTest::mouseClick(m_window->windowHandle(), Qt::LeftButton, {}, middleOf(widget)); }

    std::unique_ptr<test::WorkbenchFixture> m_bench;
    std::unique_ptr<MainWindow> m_window;
    Device *m_first = nullptr;
};

DYNASCOPE_UI_TEST(TestDialogs)
#include "tst_dialogs.moc"
