// SPDX-License-Identifier: GPL-3.0-or-later
// The command line of `dynascope`, as a shell gives it.
#include "tests/support/testmain.h"

#include <QFile>
#include <QImage>
#include <QProcess>
#include <QTemporaryDir>

class TestWindowOptions : public QObject
{
    Q_OBJECT

private slots:
    void refusesWhatMakesNoSense_data();
    void refusesWhatMakesNoSense();
    void drawsItselfUnseen();

private:
    QProcess m_program;

    void run(const QStringList &arguments)
    {
        m_program.start(QStringLiteral(DYNASCOPE_BIN_DIR "/dynascope"), arguments);
        const bool ended = m_program.waitForFinished(60'000);
        if (!ended) {
            m_program.kill();
            m_program.waitForFinished();
        }
        QVERIFY2(ended, qPrintable(m_program.errorString()));
        QCOMPARE(m_program.exitStatus(), QProcess::NormalExit);
    }
};

void TestWindowOptions::refusesWhatMakesNoSense_data()
{
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<QString>("said");
    const auto row = [](const char *name, const QStringList &arguments, const char *said) {
        QTest::newRow(name) << arguments << QString::fromUtf8(said);
    };
    row("a rate that is none", {QStringLiteral("--baud"), QStringLiteral("fast")},
        "dynascope: --baud takes bits per second, not \"fast\"\n");
    row("no memory for plots", {QStringLiteral("--history-budget"), QStringLiteral("0")},
        "dynascope: --history-budget takes 16 to 1000000 megabytes, not \"0\"\n");
    row("memory in words", {QStringLiteral("--history-budget"), QStringLiteral("lots")},
        "dynascope: --history-budget takes 16 to 1000000 megabytes, not \"lots\"\n");
    row("more memory than there is", {QStringLiteral("--history-budget"), QStringLiteral("1000001")},
        "dynascope: --history-budget takes 16 to 1000000 megabytes, not \"1000001\"\n");
    row("a recording that isn't there", {QStringLiteral("nowhere.mcap")},
        "dynascope: \"nowhere.mcap\" is neither an option nor a recording that is there; a port is named with --port\n");
    row("an option that isn't", {QStringLiteral("--sideways")}, "dynascope: Unknown option 'sideways'.\n");
}

void TestWindowOptions::refusesWhatMakesNoSense()
{
    QFETCH(QStringList, arguments);
    run(arguments);
    if (QTest::currentTestFailed())
        return;
    QTEST(QString::fromUtf8(m_program.readAllStandardError()), "said");
    QCOMPARE(m_program.readAllStandardOutput(), QByteArray());
    QCOMPARE(m_program.exitCode(), 2);
}

void TestWindowOptions::drawsItselfUnseen()
{
    const QTemporaryDir folder;
    const QString picture = folder.filePath(QStringLiteral("window.png"));
    run({QStringLiteral("--port"), QStringLiteral("sim"), QStringLiteral("--history-budget"), QStringLiteral("16"),
         QStringLiteral("--offscreen-picture"), picture});
    if (QTest::currentTestFailed())
        return;
    QVERIFY2(m_program.exitCode() == 0, m_program.readAllStandardError().constData());
    QVERIFY(!QImage(picture).isNull());
}

DYNASCOPE_CORE_TEST(TestWindowOptions)
#include "tst_windowoptions.moc"
