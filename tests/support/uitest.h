// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/testmain.h"
#include "ui/common/theme.h"

#include <QApplication>

/// As QTEST_MAIN, offscreen, with our theme and settings that belong to the test alone; an unexpected warning fails the
/// test. The application goes on when a test has closed its last window.
#define DYNASCOPE_UI_TEST(TestClass)                                                                                   \
    int main(int argc, char **argv)                                                                                    \
    {                                                                                                                  \
        return dynascope::test::main<QApplication, TestClass>(argc, argv, [](QApplication &application) {              \
            application.setOrganizationName(QStringLiteral("dynascope-test"));                                         \
            application.setApplicationName(QStringLiteral(#TestClass));                                                \
            QApplication::setQuitOnLastWindowClosed(false);                                                            \
            dynascope::applyTheme(application, dynascope::ColorScheme::Light);                                         \
        });                                                                                                            \
    }
