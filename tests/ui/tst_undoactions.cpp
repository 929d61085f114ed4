// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/journal/undo.h"
#include "tests/support/uitest.h"
#include "tests/support/workbenchfixture.h"
#include "ui/common/messagebar.h"
#include "ui/journal/journalmodel.h"
#include "ui/mainwindow.h"

#include <QAbstractItemModelTester>
#include <QAction>
#include <QDialog>
#include <QFileDialog>
#include <QLabel>
#include <QPushButton>
#include <QTemporaryDir>
#include <QTranslator>
#include <QTreeView>

using namespace dynascope;
using namespace Qt::StringLiterals;

namespace {

constexpr int Baud = 1'000'000;

struct World {
    World()
        : catalog(Catalog::builtIn().value())
        , lines(catalog, u"XM430-W350@1000000:1"_s)
        , session(lines, catalog)
        , commands(session, &journal)
        , undo(session, commands)
        , monitor(session)
        , stop(session, commands)
        , window(
              (monitor.setPaused(true), Workbench{session, commands, monitor, scanner, stop, lines, &journal, &undo}))
    {
        window.show();
        window.connectTo(u"sim"_s, Baud);
    }

    Device *device() { return session.lines().empty() ? nullptr : session.lines().front()->deviceAt(1, Baud); }
    std::optional<std::int64_t> raw(QStringView name) { return device()->raw(name); }
    void write(QStringView name, std::int64_t raw)
    {
        commands.writeField(*device(), device()->table().indexOf(name), raw);
        QTRY_COMPARE(device()->raw(name), raw);
    }
    QAction &action(const char *name) { return *window.findChild<QAction *>(QLatin1String(name)); }
    QDialog *dialog(const char *name)
    {
        auto *found = window.findChild<QDialog *>(QLatin1String(name));
        return found && found->isVisible() ? found : nullptr;
    }

    Catalog catalog;
    test::VirtualLines lines;
    Journal journal;
    Session session;
    Commands commands;
    Undo undo;
    Monitor monitor;
    Scanner scanner;
    StopControl stop;
    MainWindow window;
};

} // namespace

/// Edit › Undo, Redo, Journal.
class TestUndoActions : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        m_world = std::make_unique<World>();
        QTRY_VERIFY(m_world->device());
        m_world->commands.readAll(*m_world->device());
        QTRY_VERIFY(m_world->raw(u"Moving Threshold"));
        QVERIFY(QTest::qWaitForWindowActive(&m_world->window));
    }
    void cleanup() { m_world.reset(); }

    void byKeys()
    {
        QVERIFY(!m_world->action("undoAction").isEnabled());
        m_world->write(u"Moving Threshold", 33);
        QTRY_VERIFY(m_world->action("undoAction").isEnabled());
        QCOMPARE(m_world->action("undoAction").text(), u"&Undo Moving Threshold of XM430-W350 #1"_s);
        QTest::keyClick(&m_world->window, Qt::Key_Z, Qt::ControlModifier);
        QTRY_COMPARE(m_world->raw(u"Moving Threshold"), 10);
        QTRY_VERIFY(m_world->action("redoAction").isEnabled());
        QVERIFY(!m_world->action("undoAction").isEnabled());
        QTest::keyClick(&m_world->window, Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
        QTRY_COMPARE(m_world->raw(u"Moving Threshold"), 33);
    }

    void whatMovesIsAskedFirst()
    {
        m_world->commands.setTorque({m_world->device()}, true);
        QTRY_COMPARE(m_world->raw(u"Torque Enable"), 1);
        m_world->write(u"Goal Position", 2100);
        m_world->action("undoAction").trigger();
        QTRY_VERIFY(m_world->dialog("undoBox"));
        QCOMPARE(m_world->raw(u"Goal Position"), 2100);
        m_world->dialog("undoBox")->reject();
        QTRY_VERIFY(!m_world->dialog("undoBox"));
        QCOMPARE(m_world->raw(u"Goal Position"), 2100);
        m_world->action("undoAction").trigger();
        QTRY_VERIFY(m_world->dialog("undoBox"));
        auto *accept = m_world->dialog("undoBox")->findChild<QPushButton *>(u"undoAnywayButton"_s);
        QCOMPARE(accept->text(), u"Let it move"_s);
        QVERIFY(!accept->isDefault()); // Return moves nothing
        QTest::mouseClick(accept, Qt::LeftButton);
        QTRY_VERIFY(m_world->raw(u"Goal Position") != 2100);
        QCOMPARE(m_world->raw(u"Torque Enable"), 1);
    }

    void theJournalTakesTheSelectedBack()
    {
        m_world->write(u"Moving Threshold", 33);
        m_world->write(u"LED", 1);
        m_world->action("journalAction").trigger();
        QTRY_VERIFY(m_world->dialog("journalDialog"));
        QDialog &dialog = *m_world->dialog("journalDialog");
        auto *view = dialog.findChild<QTreeView *>(u"journalView"_s);
        auto *undo = dialog.findChild<QPushButton *>(u"journalUndoButton"_s);
        QTRY_COMPARE(view->model()->rowCount(), 2);
        const auto text = [&](int row, JournalColumn column) {
            return view->model()->index(row, static_cast<int>(column)).data().toString();
        };
        QCOMPARE(text(0, JournalColumn::Register), u"LED"_s); // the newest first
        QCOMPARE(text(0, JournalColumn::Change), u"Off → On"_s);
        QCOMPARE(text(1, JournalColumn::Device), u"XM430-W350 #1"_s);
        QCOMPARE(text(1, JournalColumn::By), u"window"_s);
        QVERIFY(!undo->isEnabled());
        QCOMPARE(undo->toolTip(), u"Select entries first"_s);
        view->setCurrentIndex(view->model()->index(1, 0)); // the older one alone
        QTRY_VERIFY(undo->isEnabled());
        QTest::mouseClick(undo, Qt::LeftButton);
        QTRY_COMPARE(m_world->raw(u"Moving Threshold"), 10);
        QCOMPARE(m_world->raw(u"LED"), 1);
        QTRY_COMPARE(view->model()->rowCount(), 3);
        QCOMPARE(text(0, JournalColumn::State), u"undo of 1"_s);
        QCOMPARE(text(2, JournalColumn::State), u"undone"_s);
        QTRY_VERIFY(!undo->isEnabled()); // still selected, and undone
        QCOMPARE(undo->toolTip(), u"Entry 1 is undone already"_s);
    }

    void theSelectedBecomeAScript()
    {
        m_world->write(u"Moving Threshold", 33);
        m_world->write(u"LED", 1);
        m_world->action("journalAction").trigger();
        QTRY_VERIFY(m_world->dialog("journalDialog"));
        QDialog &dialog = *m_world->dialog("journalDialog");
        auto *view = dialog.findChild<QTreeView *>(u"journalView"_s);
        QTRY_COMPARE(view->model()->rowCount(), 2);
        view->setCurrentIndex(view->model()->index(1, 0)); // the older one alone
        QTest::mouseClick(dialog.findChild<QPushButton *>(u"journalScriptButton"_s), Qt::LeftButton);
        auto *asked = dialog.findChild<QFileDialog *>(u"saveDialog"_s);
        QVERIFY(asked);
        const QTemporaryDir folder;
        asked->selectFile(folder.filePath(u"mine.sh"_s));
        static_cast<QDialog *>(asked)->accept();
        QFile file(folder.filePath(u"mine.sh"_s));
        QTRY_VERIFY(file.exists());
        QVERIFY(file.open(QIODevice::ReadOnly));
        const QByteArray script = file.readAll();
        QVERIFY2(script.contains("write 1 'Moving_Threshold=33'"), script.constData());
        QVERIFY2(!script.contains("LED"), script.constData());
        QTRY_VERIFY(dialog.findChild<QLabel *>(u"journalSaid"_s)->text().contains(u"mine.sh"_s));
    }

    void theCursorStaysWithItsEntry()
    {
        m_world->write(u"Moving Threshold", 33);
        m_world->write(u"LED", 1);
        m_world->action("journalAction").trigger();
        QTRY_VERIFY(m_world->dialog("journalDialog"));
        auto *view = m_world->dialog("journalDialog")->findChild<QTreeView *>(u"journalView"_s);
        QTRY_COMPARE(view->model()->rowCount(), 2);
        view->setCurrentIndex(view->model()->index(1, 0)); // the older one
        m_world->write(u"LED", 0);
        QTRY_COMPARE(view->model()->rowCount(), 3);
        QCOMPARE(view->currentIndex().row(), 2);
        QVERIFY(view->selectionModel()->isRowSelected(2) && !view->selectionModel()->isRowSelected(1));
        view->setFocus();
        QTest::keyClick(view, Qt::Key_Up);
        QCOMPARE(view->currentIndex().row(), 1);
    }

    void itsWordsCanBeTranslated()
    {
        struct Marking final : QTranslator {
            QString translate(const char *context, const char *text, const char *, int) const override
            {
                return QLatin1String(context) == u"dynascope::JournalModel" ? u'*' + QString::fromUtf8(text) : QString();
            }
            bool isEmpty() const override { return false; }
        } marking;
        m_world->commands.reboot(*m_world->device());
        QTRY_COMPARE(m_world->device()->state(), Device::State::Present);
        QVERIFY(qApp->installTranslator(&marking));
        const JournalModel model(m_world->journal, m_world->catalog);
        for (const JournalColumn column : {JournalColumn::By, JournalColumn::Register}) {
            const QString text = model.index(0, static_cast<int>(column)).data().toString();
            QVERIFY2(text.startsWith(u'*'), qPrintable(text));
        }
        qApp->removeTranslator(&marking);
    }

    void ratesAreSaidAsEverywhere()
    {
        m_world->commands.changeBaud(*m_world->device(), 57600, false);
        QTRY_VERIFY(!m_world->journal.entries().empty()
                    && m_world->journal.entries().back().state == JournalState::Done);
        const JournalModel model(m_world->journal, m_world->catalog);
        const QModelIndex change = model.index(0, static_cast<int>(JournalColumn::Change));
        QCOMPARE(change.data().toString(), u"1 Mbps → 57\u2009600 bps"_s);
        const QString tip = change.data(Qt::ToolTipRole).toString();
        QVERIFY2(tip.endsWith(u": 1 Mbps → 57\u2009600 bps"_s), qPrintable(tip));
    }

    void aRefusalIsSaid()
    {
        m_world->write(u"Moving Threshold", 33);
        m_world->write(u"Moving Threshold", 44);
        std::optional<QString> problem;
        connect(&m_world->undo, &Undo::finished, this, [&](int, const QString &text) { problem = text; });
        m_world->undo.run({1}, Direction::Undo, {});
        QTRY_VERIFY(problem);
        QVERIFY2(problem->contains(u"has changed meanwhile: it is 44, not 33"_s), qPrintable(*problem));
        QCOMPARE(m_world->raw(u"Moving Threshold"), 44);
    }

    void modelIsSound()
    {
        JournalModel model(m_world->journal, m_world->catalog);
        const QAbstractItemModelTester tester(&model, QAbstractItemModelTester::FailureReportingMode::QtTest);
        m_world->write(u"LED", 1);
        QTRY_COMPARE(model.rowCount(), 1);
    }

private:
    std::unique_ptr<World> m_world;
};

DYNASCOPE_UI_TEST(TestUndoActions)
#include "tst_undoactions.moc"
