// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QTest>

/// As QTEST_GUILESS_MAIN, and an unexpected warning fails the test.
#define DYNASCOPE_CORE_TEST(TestClass)                                                                                  \
    int main(int argc, char **argv)                                                                                     \
    {                                                                                                                   \
        QCoreApplication application(argc, argv);                                                                       \
        TestClass test;                                                                                                 \
        return QTest::qExec(&test, argc, argv);                                                                         \
    }
