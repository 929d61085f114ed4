// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/uitest.h"
#include "ui/common/messagebar.h"

#include <QLabel>
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

    void aWarningIsNotLostBehindAnError_data()
    {
        QTest::addColumn<QList<MessageKind>>("kinds");
        const auto warning = MessageKind::Warning;
        const auto error = MessageKind::Error;
        QTest::newRow("before a success") << QList{error, warning, MessageKind::Success};
        QTest::newRow("before something to know") << QList{error, warning, MessageKind::Info};
        QTest::newRow("after a success") << QList{error, MessageKind::Success, warning};
        QTest::newRow("shown before the error came") << QList{warning, error};
        QTest::newRow("shown before, then a success") << QList{warning, error, MessageKind::Success};
    }
    void aWarningIsNotLostBehindAnError()
    {
        QFETCH(QList<MessageKind>, kinds);
        MessageBar bar;
        for (const MessageKind kind : kinds)
            bar.post(kind, QString::number(int(kind)));
        QCOMPARE(bar.kind(), MessageKind::Error);
        bar.dismiss();
        QCOMPARE(bar.kind(), MessageKind::Warning);
        bar.dismiss();
        QVERIFY(bar.isHidden());
    }

    void whatWentWellPassesAWarning()
    {
        MessageBar bar;
        bar.post(MessageKind::Warning, QStringLiteral("it has restarted"));
        bar.post(MessageKind::Success, QStringLiteral("too early"));
        QCOMPARE(bar.text(), QStringLiteral("it has restarted"));
        QTRY_COMPARE((bar.post(MessageKind::Success, QStringLiteral("saved")), bar.text()), QStringLiteral("saved"));
        bar.post(MessageKind::Info, QStringLiteral("by the way"));
        QCOMPARE(bar.text(), QStringLiteral("saved"));
        bar.dismiss(); // as its time does
        QCOMPARE(bar.text(), QStringLiteral("it has restarted"));
        bar.dismiss();
        QVERIFY(bar.isHidden());
    }

    void theNewestOfATopicReplacesWhatWasSaidBefore()
    {
        MessageBar bar;
        bar.post({MessageKind::Error, QStringLiteral("it failed"), {}, {}, QStringLiteral("device 1")});
        bar.post({MessageKind::Success, QStringLiteral("another's success"), {}, {}, QStringLiteral("device 2")});
        QCOMPARE(bar.text(), QStringLiteral("it failed"));
        bar.post({MessageKind::Success, QStringLiteral("it worked"), {}, {}, QStringLiteral("device 1")});
        QCOMPARE(bar.text(), QStringLiteral("it worked"));
        bar.post({MessageKind::Error, QStringLiteral("it failed"), {}, {}, QStringLiteral("device 2")});
        QCOMPARE(bar.text(), QStringLiteral("it failed"));
        bar.dismiss();
        QVERIFY(bar.isHidden()); // what waited of device 2 is outdated
    }

    void showsSentences_data()
    {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("shown");
        QTest::newRow("words") << QStringLiteral("device 1 did not answer") << QStringLiteral("Device 1 did not answer.");
        QTest::newRow("sentence") << QStringLiteral("Is it powered?") << QStringLiteral("Is it powered?");
        QTest::newRow("path") << QStringLiteral("/dev/ttyUSB0 is busy") << QStringLiteral("/dev/ttyUSB0 is busy.");
        QTest::newRow("address") << QStringLiteral("tcp://h:1 is gone.") << QStringLiteral("tcp://h:1 is gone.");
    }
    void showsSentences()
    {
        QFETCH(QString, text);
        MessageBar bar;
        bar.post(MessageKind::Warning, text);
        QTEST(bar.findChild<QLabel *>(QStringLiteral("messageText"))->text(), "shown");
    }

    void whatIsSaidAgainIsCounted()
    {
        MessageBar bar;
        for (int i = 0; i < 2; ++i)
            bar.post(MessageKind::Warning, QStringLiteral("It has restarted."));
        QCOMPARE(bar.findChild<QLabel *>(QStringLiteral("messageText"))->text(),
                 QStringLiteral("It has restarted (2 times)."));
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

    void theTroubleOfATopicGoes()
    {
        MessageBar bar;
        bar.post({MessageKind::Error, QStringLiteral("it failed"), {}, {}, QStringLiteral("device 1")});
        bar.post({MessageKind::Warning, QStringLiteral("another's"), {}, {}, QStringLiteral("device 2")});
        bar.retractTopic(QStringLiteral("device 3"));
        QCOMPARE(bar.text(), QStringLiteral("it failed"));
        bar.retractTopic(QStringLiteral("device 1"));
        QCOMPARE(bar.text(), QStringLiteral("another's"));
        bar.post({MessageKind::Success, QStringLiteral("it worked"), {}, {}, QStringLiteral("device 2")});
        bar.retractTopic(QStringLiteral("device 2"));
        QCOMPARE(bar.text(), QStringLiteral("it worked")); // which is no trouble
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
