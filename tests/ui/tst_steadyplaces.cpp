// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/support/workbenchfixture.h"
#include "ui/common/messagebar.h"
#include "ui/devices/devicepanel.h"
#include "ui/mainwindow.h"
#include "ui/plot/plotarea.h"
#include "ui/table/lockbar.h"

#include <QAbstractScrollArea>
#include <QComboBox>
#include <QSettings>
#include <QStatusBar>
#include <QTreeView>

using namespace dynascope;

/// What comes and goes by itself moves nothing that could be under a pointer.
class TestSteadyPlaces : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        cleanup(); // where the one before didn't come to its end
        QSettings().clear();
        m_bench = std::make_unique<test::WorkbenchFixture>();
        m_window = std::make_unique<MainWindow>(m_bench->workbench());
        m_window->resize(1440, 880);
        m_window->show();
        QVERIFY(QTest::qWaitForWindowExposed(m_window.get()));
        m_window->connectTo(QStringLiteral("sim"), 1000000);
        QTRY_COMPARE(m_bench->session.devices().size(), std::size_t(3));
        QTRY_VERIFY(!m_bench->scanner.isRunning());
        const Device *shown = m_window->findChild<DevicePanel *>()->selectedDevices().front();
        // Goals and help are there. On a machine that does not keep up with the wire it takes a while.
        QTRY_VERIFY_WITH_TIMEOUT(shown->raw(u"Operating Mode") && shown->raw(u"Present Input Voltage"), 20000);
        find<MessageBar>("messageBar")->clear();
        QCoreApplication::processEvents();
    }
    void cleanup()
    {
        m_window.reset();
        m_bench.reset();
    }

    void nothingMovesWhenSomethingIsSaid_data()
    {
        QTest::addColumn<QByteArray>("bar");
        QTest::addColumn<QSize>("size");
        for (const QSize size : {QSize(1440, 880), QSize(960, 640)}) {
            for (const char *bar : {"messageBar", "stopBar", "lockBar"})
                QTest::addRow("%s, %d wide", bar, size.width()) << QByteArray(bar) << size;
        }
    }
    void nothingMovesWhenSomethingIsSaid()
    {
        QFETCH(QByteArray, bar);
        QFETCH(QSize, size);
        m_window->resize(size);
        const QList<QRect> before = settledPlaces();
        auto *strip = find<QWidget>(bar.constData());
        QVERIFY(strip->isHidden());
        say(bar);
        QTRY_VERIFY(strip->isVisible());
        QCOMPARE(settledPlaces(), before);
        QVERIFY(strip->height() > 20 && strip->width() > 200);
        QVERIFY(m_window->rect().contains(QRect(strip->mapTo(m_window.get(), QPoint()), strip->size())));
        unsay(bar);
        QTRY_VERIFY(strip->isHidden());
        QCOMPARE(settledPlaces(), before);
    }

    void aLongMessageIsWholeAndGrowsUpwards()
    {
        m_window->resize(960, 640);
        auto *bar = find<MessageBar>("messageBar");
        bar->post(MessageKind::Error, QStringLiteral("short"));
        QCoreApplication::processEvents();
        const QRect one = bar->geometry();
        bar->post(MessageKind::Error, QStringLiteral("a sentence of many words. ").repeated(20));
        QTRY_VERIFY(bar->height() > one.height());
        QCOMPARE(bar->geometry().bottom(), one.bottom());
        QVERIFY(bar->height() >= bar->heightForWidth(bar->width()));
    }

    void whatIsSaidStandsAboveWhatStopSays()
    {
        auto *stop = find<MessageBar>("stopBar");
        auto *messages = find<MessageBar>("messageBar");
        m_bench->stop.press();
        messages->post(MessageKind::Warning, QStringLiteral("something else"));
        QTRY_VERIFY(stop->isVisible() && messages->isVisible());
        const auto inWindow = [this](QWidget *bar) {
            return QRect(bar->mapTo(m_window.get(), QPoint()), bar->size());
        };
        QTRY_VERIFY(!inWindow(stop).intersects(inWindow(messages)));
        QVERIFY(inWindow(stop).contains(
            QRect(m_window->statusBar()->mapTo(m_window.get(), QPoint()), m_window->statusBar()->size())));
    }

    void theLockReasonDoesNotCoverItsCell()
    {
        auto *view = find<QTreeView>("tableView");
        auto *bar = find<LockBar>("lockBar");
        const QModelIndex low = view->indexAt(QPoint(5, view->viewport()->height() - 10));
        QVERIFY(low.isValid());
        view->setCurrentIndex(low);
        bar->showReason(QStringLiteral("because"), {});
        QCoreApplication::processEvents();
        const QRect cell(view->viewport()->mapTo(m_window.get(), view->visualRect(low).topLeft()),
                         view->visualRect(low).size());
        QVERIFY(!cell.intersects(QRect(bar->mapTo(m_window.get(), QPoint()), bar->size())));
    }

private:
    void say(const QByteArray &bar)
    {
        if (bar == "messageBar")
            find<MessageBar>("messageBar")->post(MessageKind::Error, QStringLiteral("it did not answer"));
        else if (bar == "stopBar")
            m_bench->stop.press();
        else
            find<LockBar>("lockBar")->showReason(QStringLiteral("because"), QStringLiteral("Way"));
    }

    void unsay(const QByteArray &bar)
    {
        if (bar == "messageBar")
            find<MessageBar>("messageBar")->clear();
        else if (bar == "stopBar")
            m_bench->stop.release();
        else
            find<LockBar>("lockBar")->hide();
    }

    /// Layouts follow a change of size in more than one round of events.
    QList<QRect> settledPlaces()
    {
        QList<QRect> seen = places();
        for (int rounds = 0; rounds < 10; ++rounds) {
            QCoreApplication::processEvents();
            const QList<QRect> now = places();
            if (now != seen)
                rounds = 0;
            seen = now;
        }
        return seen;
    }

    QList<QRect> places()
    {
        QList<QRect> rects;
        const QList<const QWidget *> shown{find<QTreeView>("deviceTree")->viewport(),
                                           find<QTreeView>("tableView")->viewport(), m_window->findChild<PlotArea *>(),
                                           find<QWidget>("goalBar"), find<QWidget>("portCombo")};
        for (const QWidget *widget : shown)
            rects << QRect(widget->mapTo(m_window.get(), QPoint()), widget->size());
        return rects;
    }

    template <typename T>
    T *find(const char *name)
    {
        T *child = m_window->findChild<T *>(QString::fromLatin1(name));
        if (!child)
            qFatal("no %s", name);
        return child;
    }

    std::unique_ptr<test::WorkbenchFixture> m_bench;
    std::unique_ptr<MainWindow> m_window;
};

DYNASCOPE_UI_TEST(TestSteadyPlaces)
#include "tst_steadyplaces.moc"
