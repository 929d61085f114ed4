// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/testmain.h"

#include <QLocale>
#include <QRegularExpression>
#include <QSettings>

#include <algorithm>
#include <array>
#include <atomic>

namespace dynascope::test {

namespace {

/// Said by Qt, meant for nobody.
constexpr std::array harmless{
    "This plugin does not support propagateSizeHints()", // the offscreen platform, for every window
    "This plugin does not support raise()",              // the same, for every menu and list
    "This plugin does not support grabbing the keyboard",
};

std::atomic<QtMessageHandler> next = nullptr; // QTest's while test functions run, else nothing
std::atomic<int> late = 0;                    // warnings while no test function runs

void handleMessage(QtMsgType type, const QMessageLogContext &context, const QString &message)
{
    const bool warns = type == QtWarningMsg || type == QtCriticalMsg;
    const bool expected = std::any_of(harmless.begin(), harmless.end(),
                                      [&](const char *text) { return message == QLatin1String(text); });
    if (warns && expected)
        return;
    const QtMessageHandler handler = next.load();
    if (!handler) {
        late += warns ? 1 : 0;
        fprintf(stderr, "%s%s\n", warns ? "Unexpected: " : "", qUtf8Printable(message));
        return;
    }
    // QTest looks first at what the test function told it to ignore, then at this; it forgets both when it ends.
    if (warns && QTest::currentTestFunction())
        QTest::failOnWarning(QRegularExpression(QStringLiteral("^")));
    handler(warns ? QtWarningMsg : type, context, message);
}

} // namespace

Surroundings::Surroundings()
{
    // QTemporaryDir makes it readable by its owner only, which XDG_RUNTIME_DIR has to be.
    const QByteArray path = m_directory.path().toUtf8();
    for (const char *name : {"XDG_RUNTIME_DIR", "XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_CACHE_HOME", "XDG_STATE_HOME"})
        qputenv(name, path);
    qputenv("QT_QPA_PLATFORM", "offscreen");
    qputenv("LC_ALL", "C.UTF-8");
    QLocale::setDefault(QLocale::c());
    QSettings::setDefaultFormat(QSettings::IniFormat);
    QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, m_directory.path());
    qInstallMessageHandler(handleMessage);
}

void watchWarnings()
{
    const QtMessageHandler previous = qInstallMessageHandler(handleMessage);
    if (previous != handleMessage)
        next = previous;
}

int run(QObject &test, int argc, char **argv)
{
    const int failed = QTest::qExec(&test, argc, argv);
    next = nullptr; // QTest's handler must not be called after its end
    qInstallMessageHandler(handleMessage);
    return failed != 0 || late != 0 ? 1 : 0;
}

} // namespace dynascope::test
