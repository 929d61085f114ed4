// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QTemporaryDir>
#include <QTest>

namespace dynascope::test {

/// What a test runs in: settings, data and runtime directories that are its own and empty, no screen, the C locale.
/// Made before the application object.
class Surroundings
{
public:
    Surroundings();

private:
    QTemporaryDir m_directory;
};

/// From now on a warning that no test asked for (QTest::ignoreMessage) and that isn't on the list of harmless ones
/// fails the test function it comes in. Any number of calls; QTest puts its own handler in place in between.
void watchWarnings();

/// Runs the test object; the program's exit code. A warning after the last test function counts as well.
int run(QObject &test, int argc, char **argv);

/// QTest asks for the meta object before it calls the first function, and that is the moment to watch: it has put its
/// own message handler in place by then.
template <typename TestClass>
class Watched final : public TestClass
{
public:
    const QMetaObject *metaObject() const override
    {
        watchWarnings();
        return TestClass::metaObject();
    }
};

/// `prepare` is called with the application before the test object is made.
template <typename Application, typename TestClass, typename Prepare>
int main(int argc, char **argv, const Prepare &prepare)
{
    const Surroundings surroundings;
    Application application(argc, argv);
    prepare(application);
    Watched<TestClass> test;
    return run(test, argc, argv);
}

} // namespace dynascope::test

/// As QTEST_GUILESS_MAIN, and an unexpected warning fails the test. With widgets: see uitest.h.
#define DYNASCOPE_CORE_TEST(TestClass)                                                                                 \
    int main(int argc, char **argv)                                                                                    \
    {                                                                                                                  \
        return dynascope::test::main<QCoreApplication, TestClass>(argc, argv, [](QCoreApplication &) {});              \
    }
