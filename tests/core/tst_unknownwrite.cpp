// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/commands.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/sessionfixture.h"
#include "tests/support/testmain.h"

using namespace dynascope;

/// Registers of which nobody knows whether they may be written: only a person who insists writes them.
class TestUnknownWrite : public QObject
{
    Q_OBJECT

private slots:
    void onlyWhoInsistsWrites_data()
    {
        QTest::addColumn<bool>("insists");
        QTest::addColumn<bool>("stopped");
        QTest::addColumn<QString>("refusal"); // a piece of it; empty: written
        QTest::newRow("by the usual way") << false << false << "may be written is not known";
        QTest::newRow("insisting") << true << false << "";
        QTest::newRow("insisting while STOP holds") << true << true << "STOP";
    }

    void onlyWhoInsistsWrites()
    {
        QFETCH(bool, insists);
        QFETCH(bool, stopped);
        QFETCH(QString, refusal);
        // An XM430 that says it were a model that nobody knows.
        VirtualSession all(m_catalog, QStringLiteral("XM430-W350@57600:1"));
        all.line = &all.session.open(QStringLiteral("virtual"), 57600);
        Device &device = all.line->heard({1, 57600, 4711, 45, false, {}});
        QVERIFY(!device.isKnownModel());
        const int byte = device.table().indexOf(u"Byte 65"); // its LED
        QCOMPARE(device.lockReason(byte).isEmpty(), false);
        QCOMPARE(device.lockReason(byte, true), QString());
        all.commands.setStopped(stopped);
        std::optional<Result<void>> outcome;
        const auto done = [&](const Result<void> &result) { outcome = result; };
        if (insists)
            all.commands.writeUnknown(device, byte, 1, done);
        else
            all.commands.writeField(device, byte, 1, done);
        QVERIFY(VirtualSession::waitFor([&] { return outcome.has_value(); }));
        QVERIFY(refusal.isEmpty() ? outcome->has_value() : outcome->error().text.contains(refusal));
        QCOMPARE(device.value(byte).raw, refusal.isEmpty() ? std::optional<std::int64_t>(1) : std::nullopt);
    }

    void whatIsReadOnlyStaysSo()
    {
        VirtualSession all(m_catalog, QStringLiteral("XM430-W350@57600:1"));
        all.open(57600);
        Device &device = *all.line->devices().front();
        const int position = device.table().indexOf(u"Present Position");
        QVERIFY(device.lockReason(position, true).contains(QStringLiteral("read-only")));
    }

    void anUnknownModelIsReadAsFarAsItAnswers()
    {
        VirtualSession all(m_catalog, QStringLiteral("XL-320@1000000:1")); // a short table
        all.line = &all.session.open(QStringLiteral("virtual"), 1000000);
        Device &device = all.line->heard({1, 1000000, 4711, 29, false, {}});
        std::optional<Result<void>> outcome;
        all.commands.readAll(device, [&](const Result<void> &result) { outcome = result; });
        QVERIFY(VirtualSession::waitFor([&] { return outcome.has_value(); }));
        QVERIFY2(outcome->has_value(), outcome->has_value() ? "" : qPrintable(outcome->error().text));
        QCOMPARE(device.raw(u"Byte 0"), std::optional<std::int64_t>(350 & 0xFF));
        QVERIFY(device.raw(u"Byte 46").has_value());
    }

private:
    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestUnknownWrite)
#include "tst_unknownwrite.moc"
