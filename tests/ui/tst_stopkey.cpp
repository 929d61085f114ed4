// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "ui/common/stopkey.h"

#include <QDialog>
#include <QDragEnterEvent>
#include <QLineEdit>
#include <QMenu>
#include <QMimeData>
#include <QShortcut>
#include <QSignalSpy>
#include <QTableWidget>

using namespace dynascope;

/// Takes all keys, as Qt's drag does (QBasicDrag); the offscreen platform has no drags.
class KeyEater final : public QObject
{
public:
    int escapes = 0;

    bool eventFilter(QObject *, QEvent *event) override
    {
        if (event->type() != QEvent::KeyPress && event->type() != QEvent::ShortcutOverride)
            return false;
        escapes += event->type() == QEvent::KeyPress && static_cast<QKeyEvent *>(event)->key() == Qt::Key_Escape;
        return true;
    }
};

class TestStopKey : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { qApp->installEventFilter(&m_key); }
    void init() { QCoreApplication::processEvents(); }

    void inAWindow()
    {
        QWidget window;
        window.show();
        QSignalSpy pressed(&m_key, &StopKey::pressed);
        QTest::keyClick(window.windowHandle(), Qt::Key_Escape);
        QCOMPARE(pressed.count(), 1);
        QTest::keyClick(window.windowHandle(), Qt::Key_A);
        QCOMPARE(pressed.count(), 1);
    }

    void inAnOpenCellEditorWhichCloses()
    {
        QTableWidget table(1, 1);
        table.setItem(0, 0, new QTableWidgetItem(QStringLiteral("before")));
        table.show();
        table.editItem(table.item(0, 0));
        auto *editor = table.findChild<QLineEdit *>();
        QVERIFY(editor);
        editor->setText(QStringLiteral("after"));
        QSignalSpy pressed(&m_key, &StopKey::pressed);
        QTest::keyClick(editor, Qt::Key_Escape);
        QCOMPARE(pressed.count(), 1);
        QTRY_VERIFY(!table.findChild<QLineEdit *>());
        QCOMPARE(table.item(0, 0)->text(), QStringLiteral("before"));
    }

    void inADialogWhichCloses()
    {
        QWidget window;
        window.show();
        QDialog dialog(&window);
        dialog.open();
        QSignalSpy pressed(&m_key, &StopKey::pressed);
        QSignalSpy rejected(&dialog, &QDialog::rejected);
        QTest::keyClick(&dialog, Qt::Key_Escape);
        QCOMPARE(pressed.count(), 1);
        QCOMPARE(rejected.count(), 1);
    }

    void inAMenuWhichCloses()
    {
        QWidget window;
        window.show();
        QMenu menu(&window);
        menu.addAction(QStringLiteral("One"));
        menu.popup(QPoint(10, 10));
        QVERIFY(menu.isVisible());
        QSignalSpy pressed(&m_key, &StopKey::pressed);
        QTest::keyClick(&menu, Qt::Key_Escape);
        QCOMPARE(pressed.count(), 1);
        QTRY_VERIFY(!menu.isVisible());
    }

    void whereAShortcutTakesTheKey()
    {
        QWidget window;
        QShortcut shortcut(QKeySequence(Qt::Key_Escape), &window);
        QSignalSpy taken(&shortcut, &QShortcut::activated);
        window.show();
        window.activateWindow();
        QVERIFY(QTest::qWaitForWindowActive(&window));
        QSignalSpy pressed(&m_key, &StopKey::pressed);
        QTest::keyClick(window.windowHandle(), Qt::Key_Escape);
        QCOMPARE(pressed.count(), 1);
        QCOMPARE(taken.count(), 1);
    }

    void whileADragTakesTheKeys()
    {
        QWidget window;
        window.show();
        KeyEater drag;
        qApp->installEventFilter(&drag);
        const QMimeData mime;
        QDragEnterEvent enters(QPoint(5, 5), Qt::CopyAction, &mime, Qt::LeftButton, Qt::NoModifier);
        QCoreApplication::sendEvent(window.windowHandle(), &enters);
        QCoreApplication::processEvents(); // the drag's own loop
        QSignalSpy pressed(&m_key, &StopKey::pressed);
        QTest::keyClick(window.windowHandle(), Qt::Key_Escape);
        QCOMPARE(pressed.count(), 1);
        QCOMPARE(drag.escapes, 1); // which ends it
    }

    void everyPressCounts()
    {
        QWidget window;
        window.show();
        QSignalSpy pressed(&m_key, &StopKey::pressed);
        for (int i = 0; i < 3; ++i) {
            QTest::keyClick(window.windowHandle(), Qt::Key_Escape);
            QCoreApplication::processEvents();
        }
        QCOMPARE(pressed.count(), 3);
    }

private:
    StopKey m_key;
};

DYNASCOPE_UI_TEST(TestStopKey)
#include "tst_stopkey.moc"
