// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "tests/support/workbenchfixture.h"
#include "ui/common/texts.h"
#include "ui/devices/devicepanel.h"
#include "ui/mainwindow.h"
#include "ui/plot/plotarea.h"

#include <QAbstractItemView>
#include <QAction>
#include <QDialog>
#include <QHeaderView>
#include <QLabel>
#include <QSettings>
#include <QTextDocumentFragment>
#include <QTreeView>

using namespace dynascope;

namespace {

const QString Name = QStringLiteral("<img src=x>&b");

/// What a person sees of a text that Qt may take for rich.
QString seen(const QString &text)
{
    return Qt::mightBeRichText(text) ? QTextDocumentFragment::fromHtml(text).toPlainText() : text;
}

/// Texts that have lost the name on the way to the eye, and how many have kept it.
class Look
{
public:
    int kept = 0;
    QStringList lost;

    explicit Look(const QWidget &root)
    {
        QList<const QWidget *> all{&root};
        for (const QWidget *widget : root.findChildren<QWidget *>())
            all << widget;
        for (const QWidget *widget : all) {
            tip(widget->toolTip(), widget->objectName());
            const auto *label = qobject_cast<const QLabel *>(widget);
            if (label && label->isVisible() && label->textFormat() != Qt::RichText)
                add(label->text(), label->textFormat() == Qt::PlainText ? label->text() : seen(label->text()),
                    label->objectName());
            if (const auto *view = qobject_cast<const QAbstractItemView *>(widget); view && view->model())
                rows(*view->model(), {});
        }
    }

private:
    void add(const QString &text, const QString &shown, const QString &where)
    {
        if (!text.contains(QStringLiteral("img src")))
            return;
        if (shown.contains(Name))
            ++kept;
        else
            lost << QStringLiteral("%1: %2").arg(where, text);
    }
    void tip(const QString &text, const QString &where) { add(text, seen(text), where); }
    void rows(const QAbstractItemModel &model, const QModelIndex &parent)
    {
        for (int column = 0; column < model.columnCount(parent); ++column) {
            tip(model.headerData(column, Qt::Horizontal, Qt::ToolTipRole).toString(), QStringLiteral("heading"));
            for (int row = 0; row < model.rowCount(parent); ++row) {
                const QModelIndex index = model.index(row, column, parent);
                tip(index.data(Qt::ToolTipRole).toString(), QStringLiteral("row"));
                if (column == 0)
                    rows(model, index);
            }
        }
    }
};

} // namespace

/// A nickname is shown as it was typed, wherever it appears.
class TestPlainText : public QObject
{
    Q_OBJECT

private slots:
    void ratesAreSaidAsEverywhere_data()
    {
        QTest::addColumn<QString>("said");
        QTest::newRow("1000000 bps") << "1 Mbps";
        QTest::newRow("ID 1 at 57600 bps is taken by X, at 4500000 bps it is free")
            << "ID 1 at 57\u2009600 bps is taken by X, at 4.5 Mbps it is free";
        QTest::newRow("9600 bps") << "9\u2009600 bps";
        QTest::newRow("at 57\u2009600 bps") << "at 57\u2009600 bps"; // said so already
        QTest::newRow("bps, 100 bps, x57600 bps, 1.57600 bps, 57600 bpsx") << "";
        QTest::newRow("57600") << "";
    }

    void ratesAreSaidAsEverywhere()
    {
        QFETCH(QString, said);
        const QString text = QString::fromUtf8(QTest::currentDataTag());
        QCOMPARE(withBaudTexts(text), said.isEmpty() ? text : said);
    }

    void init()
    {
        QSettings().clear();
        m_bench = std::make_unique<test::WorkbenchFixture>(
            QStringLiteral("XM430-W350@1000000:1,XM430-W350@1000000:2"));
        m_window = std::make_unique<MainWindow>(m_bench->workbench());
        m_window->resize(1400, 900);
        m_window->show();
        QVERIFY(QTest::qWaitForWindowExposed(m_window.get()));
        m_window->connectTo(QStringLiteral("sim"), 1000000);
        QTRY_COMPARE(m_bench->session.devices().size(), std::size_t(2));
        QTRY_VERIFY(!m_bench->scanner.isRunning());
        for (Device *device : m_bench->session.devices())
            device->setNickname(Name);
        QTRY_VERIFY(first().raw(u"Present Position") && first().raw(u"Operating Mode"));
    }
    void cleanup()
    {
        m_window.reset();
        m_bench.reset();
    }

    void inTheWindow()
    {
        action("busHealthAction")->trigger();
        m_window->findChild<PlotArea *>()->addTrace(
            {first().key(), first().table().indexOf(u"Present Position")});
        m_bench->commands.setTorque(m_bench->session.devices(), true);
        QTRY_VERIFY(first().isTorqueOn());
        auto *tree = m_window->findChild<QTreeView *>(QStringLiteral("deviceTree"));
        tree->selectAll();
        const Look window(*m_window);
        QCOMPARE(window.lost, QStringList());
        QVERIFY2(window.kept >= 6, qPrintable(QString::number(window.kept)));
    }

    void whereAFieldIsLocked()
    {
        first().setState(Device::State::Rebooting);
        auto *view = m_window->findChild<QTreeView *>(QStringLiteral("tableView"));
        const QModelIndexList rows = view->model()->match(view->model()->index(0, 0), Qt::DisplayRole,
            QStringLiteral("Profile Velocity"), 1, Qt::MatchExactly | Qt::MatchRecursive);
        QVERIFY(!rows.isEmpty());
        view->setCurrentIndex(rows.front());
        QTest::keyClick(view, Qt::Key_Return);
        auto *bar = m_window->findChild<QWidget *>(QStringLiteral("lockBar"));
        QTRY_VERIFY(bar->isVisible());
        const Look look(*bar);
        QCOMPARE(look.lost, QStringList());
        QCOMPARE(look.kept, 1);
    }

    void inDialogs_data()
    {
        QTest::addColumn<QByteArray>("action");
        for (const char *name : {"changeIdAction", "changeBaudAction", "factoryResetAction", "rebootAction"})
            QTest::newRow(name) << QByteArray(name);
    }
    void inDialogs()
    {
        QFETCH(QByteArray, action);
        m_bench->commands.setTorque({&first()}, true);
        QTRY_VERIFY(first().isTorqueOn());
        this->action(action.constData())->trigger();
        QTRY_VERIFY(qobject_cast<QDialog *>(QApplication::activeWindow()));
        const Look look(*QApplication::activeWindow());
        QCOMPARE(look.lost, QStringList());
        QVERIFY(look.kept > 0);
    }

    void whenTheWindowCloses()
    {
        action("torqueOnAction")->trigger(); // a person's: that counts
        QTRY_VERIFY(first().isTorqueOn());
        QVERIFY(!m_window->close());
        QTRY_VERIFY(qobject_cast<QDialog *>(QApplication::activeWindow()));
        const Look look(*QApplication::activeWindow());
        QCOMPARE(look.lost, QStringList());
        QCOMPARE(look.kept, 1);
    }

    void helpers_data()
    {
        QTest::addColumn<QString>("text");
        QTest::newRow("words") << QStringLiteral("shoulder");
        QTest::newRow("a tag") << QStringLiteral("<b>shoulder</b>\nID 1");
        QTest::newRow("an entity") << QStringLiteral("a &lt; b <i>");
        QTest::newRow("smaller than") << QStringLiteral("a < b");
    }
    void helpers()
    {
        QFETCH(QString, text);
        QCOMPARE(seen(plainToolTip(text)), text);
        QCOMPARE(plainLabel(QStringLiteral("R&D")), QStringLiteral("R&&D"));
    }

private:
    Device &first() { return *m_bench->session.devices().front(); }
    QAction *action(const char *name) const { return m_window->findChild<QAction *>(QString::fromLatin1(name)); }

    std::unique_ptr<test::WorkbenchFixture> m_bench;
    std::unique_ptr<MainWindow> m_window;
};

DYNASCOPE_UI_TEST(TestPlainText)
#include "tst_plaintext.moc"
