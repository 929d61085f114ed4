// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/common/theme.h"

#include <QApplication>
#include <QStandardPaths>
#include <QTest>

/// As QTEST_MAIN, with our theme, and settings that belong to the test alone.
#define DYNASCOPE_UI_TEST(TestClass)                                                                                    \
    int main(int argc, char **argv)                                                                                     \
    {                                                                                                                   \
        QStandardPaths::setTestModeEnabled(true);                                                                       \
        QApplication application(argc, argv);                                                                           \
        application.setOrganizationName(QStringLiteral("dynascope-test"));                                              \
        application.setApplicationName(QStringLiteral(#TestClass));                                                     \
        dynascope::applyTheme(application, dynascope::ColorScheme::Light);                                              \
        TestClass test;                                                                                                 \
        return QTest::qExec(&test, argc, argv);                                                                         \
    }
