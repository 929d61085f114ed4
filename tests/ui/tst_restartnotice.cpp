// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/journal/undo.h"
#include "core/session/ramguard.h"
#include "tests/support/uitest.h"
#include "tests/support/workbenchfixture.h"
#include "ui/common/messagebar.h"
#include "ui/common/theme.h"
#include "ui/mainwindow.h"
#include "ui/table/tableroles.h"

#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QToolButton>
#include <QTreeView>

using namespace dynascope;
using namespace Qt::StringLiterals;

namespace {

constexpr int Baud = 1'000'000;

struct World {
    World()
        : catalog(Catalog::builtIn().value())
        , lines(catalog, u"XM430-W350@1000000:1,XM430-W350@1000000:2,XL430-W250@1000000:3,XL430-W250@1000000:4"_s)
        , session(lines, catalog)
        , commands(session, &journal)
        , undo(session, commands)
        , monitor(session)
        , stop(session, commands)
        , guard(session, monitor, commands, journal)
        , window((monitor.setPaused(true),
                  Workbench{session, commands, monitor, scanner, stop, lines, &journal, &undo, nullptr, &guard}))
    {
        window.resize(1280, 800);
        window.show();
        window.connectTo(u"sim"_s, Baud);
    }

    Device *device(int id)
    {
        return session.lines().empty() ? nullptr
                                       : session.lines().front()->deviceAt(static_cast<std::uint8_t>(id), Baud);
    }
    std::optional<std::int64_t> raw(int id, QStringView name) { return device(id)->raw(name); }
    void write(int id, QStringView name, std::int64_t raw)
    {
        std::optional<bool> written;
        commands.writeField(*device(id), device(id)->table().indexOf(name), raw,
                            [&](const Result<void> &result) { written = result.has_value(); });
        QTRY_VERIFY(written);
        QVERIFY(*written);
    }
    /// Its clock is known, then it loses its RAM by somebody else's hand.
    void restart(int id)
    {
        const QSignalSpy took(&guard, &RamGuard::restarted);
        guard.look(device(id)->key());
        bool isDone = false;
        session.lines().front()->bus().run<void>(
            Priority::Normal, nullptr, // after the look
            [id](JobContext &context) { return dynascope::reboot(context.bus(), static_cast<std::uint8_t>(id)); },
            [&](const Result<void> &) { isDone = true; });
        QTRY_VERIFY(isDone);
        QTRY_VERIFY((QTest::qWait(100), guard.look(device(id)->key()), !took.isEmpty()));
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
    RamGuard guard;
    MainWindow window;
};

} // namespace

/// Marks of what goes with the power, and what the window says and does once it has gone.
class TestRestartNotice : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        m_world = std::make_unique<World>();
        QTRY_VERIFY(m_world->device(4));
        QTRY_VERIFY(!m_world->scanner.isRunning());
        for (int id = 1; id <= 4; ++id) {
            m_world->commands.readAll(*m_world->device(id));
            QTRY_VERIFY(m_world->raw(id, u"Indirect Data 1"));
        }
        QVERIFY(QTest::qWaitForWindowActive(&m_world->window));
        auto *tree = m_world->window.findChild<QTreeView *>(u"deviceTree"_s);
        QVERIFY(tree);
        selectRow(*tree, m_world->device(1)->displayName());
    }
    void cleanup() { m_world.reset(); }

    void marksAndTheirFilter()
    {
        auto *filter = button("filterSetHere");
        QVERIFY(!filter->isVisible());
        m_world->write(1, u"Profile Velocity", 100);
        m_world->write(1, u"Moving Threshold", 33);
        QTRY_VERIFY(filter->isVisible());
        QCOMPARE(state(u"Profile Velocity"_s), RamState::Set);
        QCOMPARE(state(u"Moving Threshold"_s), RamState::NotSet);
        QVERIFY(cell(u"Profile Velocity"_s).data(Qt::ToolTipRole).toString().contains(
            u"Set in this session; gone at power-off."_s));
        table().setCurrentIndex(cell(u"Profile Velocity"_s));
        auto *help = m_world->window.findChild<QLabel *>(u"helpText"_s);
        QTRY_VERIFY(help->text().contains(u"Set in this session; gone at power-off."_s));
        QTest::mouseClick(filter, Qt::LeftButton);
        QCOMPARE(shown(), QStringList{u"Profile Velocity"_s});
        grab(u"set"_s);
        m_world->write(1, u"Profile Velocity", 0); // its initial value
        QTRY_VERIFY(!filter->isVisible());
        QVERIFY(shown().size() > 20);
        QVERIFY(!help->text().contains(u"Set in this session"_s));
    }

    void aRestartIsSaidAndSetAgain()
    {
        m_world->write(1, u"Profile Velocity", 100);
        m_world->write(1, u"Position P Gain", 700);
        m_world->write(1, u"Goal PWM", 300);
        m_world->restart(1);
        QTRY_COMPARE(messages().text(),
                     u"XM430-W350 #1 has restarted (its Realtime Tick began anew). 2 registers set in this session are "
                     "back at their initial values."_s);
        QCOMPARE(messages().kind(), MessageKind::Warning);
        QCOMPARE(state(u"Profile Velocity"_s), RamState::Lost);
        QVERIFY(cell(u"Profile Velocity"_s).data(Qt::ToolTipRole).toString().contains(u"Was set in this session"_s));
        auto *show = messages().findChild<QPushButton *>(u"messageOther"_s);
        QCOMPARE(show->text(), u"Show"_s);
        QTest::mouseClick(show, Qt::LeftButton);
        QTRY_COMPARE(shown(), (QStringList{u"Position P Gain"_s, u"Profile Velocity"_s}));
        QVERIFY(messages().isVisible()); // still offered
        grab(u"lost"_s);
        auto *again = messages().findChild<QPushButton *>(u"messageAction"_s);
        QCOMPARE(again->text(), u"Set again"_s);
        QTest::mouseClick(again, Qt::LeftButton);
        QTRY_COMPARE(messages().text(), u"2 registers are set again"_s);
        QCOMPARE(m_world->raw(1, u"Profile Velocity"), 100);
        QCOMPARE(m_world->raw(1, u"Position P Gain"), 700);
        m_world->commands.readAll(*m_world->device(1));
        QTRY_VERIFY(m_world->raw(1, u"Goal PWM") != 300);
        QVERIFY(m_world->raw(1, u"Torque Enable") != 1);
        QCOMPARE(state(u"Profile Velocity"_s), RamState::Set);
        QVERIFY(m_world->guard.restarts().empty());
    }

    /// Also when the message is gone.
    void theTableOffersItToo()
    {
        m_world->write(1, u"Profile Velocity", 100);
        m_world->restart(1);
        QTRY_VERIFY(messages().text().contains(u"has restarted"_s));
        QTest::mouseClick(messages().findChild<QToolButton *>(u"messageClose"_s), Qt::LeftButton);
        const auto menuAt = [this](const QString &register_) {
            table().setCurrentIndex(cell(register_));
            table().scrollTo(cell(register_));
            emit table().customContextMenuRequested(table().visualRect(cell(register_)).center());
            QStringList texts;
            auto *menu = m_world->window.findChild<QMenu *>(u"tableMenu"_s);
            for (QAction *action : menu ? menu->actions() : QList<QAction *>())
                texts << action->text();
            return std::pair(menu, texts);
        };
        const QString text = u"Set again what the restart took"_s;
        const auto [other, without] = menuAt(u"Position P Gain"_s);
        QVERIFY(other && !without.contains(text));
        delete other;
        const auto [menu, with] = menuAt(u"Profile Velocity"_s);
        QVERIFY(menu && with.contains(text));
        menu->actions().at(with.indexOf(text))->trigger();
        QTRY_COMPARE(m_world->raw(1, u"Profile Velocity"), 100);
        QTRY_COMPARE(state(u"Profile Velocity"_s), RamState::Set);
    }

    void ourOwnRebootIsSaidDifferently()
    {
        m_world->write(1, u"Profile Velocity", 100);
        m_world->commands.reboot(*m_world->device(1));
        QTRY_COMPARE(messages().text(), u"XM430-W350 #1 was rebooted; 1 register set in this session is at its initial "
                                        "value again."_s);
        m_world->write(1, u"Profile Velocity", 50); // by hand: nothing is left to offer
        QTRY_VERIFY(!messages().text().contains(u"was rebooted"_s));
    }

    /// A supply that browns out takes them all: one message, one click.
    void manyAtOnce()
    {
        for (int id = 1; id <= 4; ++id)
            m_world->write(id, u"Profile Velocity", 100 + id);
        for (int id = 1; id <= 4; ++id)
            m_world->restart(id);
        QTRY_COMPARE(messages().text(),
                     u"4 devices have restarted: XM430-W350 #1, XM430-W350 #2, XL430-W250 #3, 1 more. 4 registers set in "
                     "this session are back at their initial values."_s);
        QTest::mouseClick(messages().findChild<QPushButton *>(u"messageAction"_s), Qt::LeftButton);
        QTRY_COMPARE(messages().text(), u"4 registers are set again"_s);
        for (int id = 1; id <= 4; ++id)
            QCOMPARE(m_world->raw(id, u"Profile Velocity"), 100 + id);
    }

    void whatFailsStaysOnOffer()
    {
        m_world->write(1, u"Profile Velocity", 100);
        m_world->restart(1);
        QTRY_VERIFY(messages().text().contains(u"has restarted"_s));
        m_world->lines.unplug();
        QTest::mouseClick(messages().findChild<QPushButton *>(u"messageAction"_s), Qt::LeftButton);
        QTRY_VERIFY(m_world->session.lines().front()->state() != BusThread::State::Open);
        QTRY_COMPARE(m_world->guard.restarts().size(), std::size_t(1));
        QCOMPARE(state(u"Profile Velocity"_s), RamState::Lost);
    }

private:
    MessageBar &messages()
    {
        for (auto *bar : m_world->window.findChildren<MessageBar *>()) {
            if (bar->objectName() != u"stopBar"_s)
                return *bar;
        }
        qFatal("no message bar");
    }
    QToolButton *button(const char *name) { return m_world->window.findChild<QToolButton *>(QLatin1String(name)); }
    QTreeView &table() { return *m_world->window.findChild<QTreeView *>(u"tableView"_s); }
    QModelIndex cell(const QString &register_)
    {
        const QAbstractItemModel &model = *table().model();
        for (int group = 0; group < model.rowCount(); ++group) {
            const QModelIndex parent = model.index(group, 0);
            for (int row = 0; row < model.rowCount(parent); ++row) {
                const QModelIndex index = model.index(row, 0, parent);
                if (fieldAt(index) && fieldAt(index)->name == register_)
                    return index;
            }
        }
        return {};
    }
    RamState state(const QString &register_)
    {
        return static_cast<RamState>(cell(register_).data(RamStateRole).toInt());
    }
    QStringList shown()
    {
        QStringList names;
        const QAbstractItemModel &model = *table().model();
        for (int group = 0; group < model.rowCount(); ++group) {
            for (int row = 0; row < model.rowCount(model.index(group, 0)); ++row)
                names << fieldAt(model.index(row, 0, model.index(group, 0)))->name;
        }
        return names;
    }
    static void selectRow(QTreeView &tree, const QString &text)
    {
        const QModelIndexList found = tree.model()->match(tree.model()->index(0, 0), Qt::DisplayRole, text, 1,
                                                          Qt::MatchContains | Qt::MatchRecursive);
        if (!found.isEmpty())
            tree.setCurrentIndex(found.front());
    }
    /// Pictures for the eye, where they are wanted.
    void grab(const QString &name)
    {
        const QString folder = qEnvironmentVariable("DYNASCOPE_PICTURES");
        if (folder.isEmpty())
            return;
        for (const ColorScheme scheme : {ColorScheme::Light, ColorScheme::Dark}) {
            applyTheme(*qApp, scheme);
            QTest::qWait(50);
            m_world->window.grab().save(folder + (scheme == ColorScheme::Light ? u"/light-"_s : u"/dark-"_s) + name
                                        + u".png"_s);
        }
        applyTheme(*qApp, ColorScheme::Light);
    }

    std::unique_ptr<World> m_world;
};

DYNASCOPE_UI_TEST(TestRestartNotice)
#include "tst_restartnotice.moc"
