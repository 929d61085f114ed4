// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "ui/common/messagebar.h"

#include <QPushButton>
#include <QToolButton>

using namespace dynascope;

class TestMessageBar : public QObject
{
    Q_OBJECT

private slots:
    void hidesUntilThereIsSomething()
    {
        MessageBar bar;
        QVERIFY(bar.isHidden());
        bar.post(MessageKind::Info, QStringLiteral("hello"));
        QVERIFY(!bar.isHidden());
        QTest::mouseClick(bar.findChild<QToolButton *>(QStringLiteral("messageClose")), Qt::LeftButton);
        QVERIFY(bar.isHidden());
        QVERIFY(!bar.kind());
    }

    void countsTheSame()
    {
        MessageBar bar;
        for (int i = 0; i < 3; ++i)
            bar.post(MessageKind::Error, QStringLiteral("gone"));
        QCOMPARE(bar.text(), QStringLiteral("gone"));
        QCOMPARE(bar.count(), 3);
        bar.post(MessageKind::Error, QStringLiteral("other"));
        QCOMPARE(bar.count(), 1);
    }

    void whatMattersMostIsShown()
    {
        MessageBar bar;
        bar.post(MessageKind::Info, QStringLiteral("a"));
        bar.post(MessageKind::Error, QStringLiteral("b"));
        QCOMPARE(bar.text(), QStringLiteral("b"));
        bar.post(MessageKind::Success, QStringLiteral("c"));
        bar.post(MessageKind::Warning, QStringLiteral("d"));
        QCOMPARE(bar.text(), QStringLiteral("b"));
        bar.dismiss();
        QCOMPARE(bar.text(), QStringLiteral("d")); // the newest of those that waited
        bar.dismiss();
        QVERIFY(bar.isHidden());
    }

    void actionRunsOnceAndCloses()
    {
        MessageBar bar;
        int runs = 0;
        bar.post({MessageKind::Error, QStringLiteral("lost"), QStringLiteral("Reconnect"), [&runs] { ++runs; }});
        auto *button = bar.findChild<QPushButton *>(QStringLiteral("messageAction"));
        QVERIFY(!button->isHidden());
        QTest::mouseClick(button, Qt::LeftButton);
        QCOMPARE(runs, 1);
        QVERIFY(bar.isHidden());
    }

    void whatIsNoLongerSoGoes()
    {
        MessageBar bar;
        bar.post(MessageKind::Info, QStringLiteral("saved"));
        bar.post(MessageKind::Error, QStringLiteral("gone"));
        bar.post(MessageKind::Success, QStringLiteral("found"));
        bar.retract(QStringLiteral("something else"));
        QCOMPARE(bar.text(), QStringLiteral("gone"));
        bar.retract(QStringLiteral("gone"));
        QCOMPARE(bar.text(), QStringLiteral("found"));
        bar.post(MessageKind::Error, QStringLiteral("refused"));
        bar.post(MessageKind::Warning, QStringLiteral("slow"));
        bar.retract(QStringLiteral("slow")); // waits
        bar.dismiss();
        QVERIFY(bar.isHidden());
    }

    void ownerDecidesWhereItCantBeDismissed()
    {
        MessageBar bar;
        bar.setDismissable(false);
        bar.post(MessageKind::Error, QStringLiteral("held"));
        bar.post(MessageKind::Info, QStringLiteral("held, all off"));
        QCOMPARE(bar.text(), QStringLiteral("held, all off"));
        QVERIFY(bar.findChild<QToolButton *>(QStringLiteral("messageClose"))->isHidden());
    }
};

DYNASCOPE_UI_TEST(TestMessageBar)
#include "tst_messagebar.moc"
