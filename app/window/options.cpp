// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/window/options.h"

#include "ui/common/icons.h"

#include <QApplication>
#include <QCommandLineParser>
#include <QFileInfo>

#include <cstdio>
#include <cstdlib>

namespace dynascope {

void setUpApplication(QApplication &application)
{
    QApplication::setOrganizationName(QStringLiteral("dynascope"));
    QApplication::setApplicationName(QStringLiteral("dynascope"));
    QApplication::setApplicationDisplayName(QStringLiteral("Dynascope"));
    QApplication::setApplicationVersion(QStringLiteral(DYNASCOPE_VERSION));
    QApplication::setDesktopFileName(QStringLiteral("dynascope"));
    application.setWindowIcon(applicationIcon());
}

WindowOptions parseOptions(const QApplication &application)
{
    QCommandLineParser parser;
    parser.setApplicationDescription(
        QStringLiteral("Finds DYNAMIXEL servos (Protocol 2.0) on a serial bus, configures them and plots what they do."));
    parser.addHelpOption();
    parser.addVersionOption();
    const QCommandLineOption port(
        QStringLiteral("port"),
        QStringLiteral("Open this port: a path, tcp://HOST:PORT or rfc2217://HOST:PORT for a serial "
                       "server, or \"sim\" for the simulated bus."),
        QStringLiteral("PORT"));
    const QCommandLineOption baud(QStringLiteral("baud"), QStringLiteral("The line's baud rate, bits per second."),
                                  QStringLiteral("RATE"));
    const QCommandLineOption history(
        QStringLiteral("history-budget"),
        QStringLiteral("Memory for what is plotted, megabytes (512). When it is used up, the oldest loses detail."),
        QStringLiteral("MB"));
    QCommandLineOption picture(
        QStringLiteral("offscreen-picture"),
        QStringLiteral("Render the window without a screen for a few seconds, save FILE as PNG and end."),
        QStringLiteral("FILE"));
    QCommandLineOption pictures(QStringLiteral("screenshots"),
                                QStringLiteral("Write the pictures of the documents into FOLDER and end."),
                                QStringLiteral("FOLDER"));
    pictures.setFlags(QCommandLineOption::HiddenFromHelp);
    parser.addPositionalArgument(QStringLiteral("recording"), QStringLiteral("Recordings (.mcap) to be opened, each in its window."),
                                 QStringLiteral("[RECORDING...]"));
    parser.addOptions({port, baud, history, picture, pictures});
    if (!parser.parse(application.arguments())) {
        std::fprintf(stderr, "dynascope: %s\n", qPrintable(parser.errorText()));
        std::exit(2);
    }
    if (parser.isSet(QStringLiteral("help")))
        parser.showHelp(0);
    if (parser.isSet(QStringLiteral("version")))
        parser.showVersion();

    WindowOptions options;
    options.port = parser.value(port);
    options.picture = parser.value(picture);
    options.pictureDirectory = parser.value(pictures);
    if (parser.isSet(baud)) {
        bool isNumber = false;
        options.baudRate = parser.value(baud).toInt(&isNumber);
        if (!isNumber || options.baudRate <= 0) {
            std::fprintf(stderr, "dynascope: --baud takes bits per second, not \"%s\"\n",
                         qPrintable(parser.value(baud)));
            std::exit(2);
        }
    }
    if (parser.isSet(history)) {
        options.historyBudget = parser.value(history).toInt();
        if (options.historyBudget < 16 || options.historyBudget > 1'000'000) {
            std::fprintf(stderr, "dynascope: --history-budget takes 16 to 1000000 megabytes, not \"%s\"\n",
                         qPrintable(parser.value(history)));
            std::exit(2);
        }
    }
    for (const QString &argument : parser.positionalArguments()) {
        if (!QFileInfo(argument).isFile()) {
            std::fprintf(stderr,
                         "dynascope: \"%s\" is neither an option nor a recording that is there; a port is named with --port\n",
                         qPrintable(argument));
            std::exit(2);
        }
        options.recordings << argument;
    }
    return options;
}

} // namespace dynascope
