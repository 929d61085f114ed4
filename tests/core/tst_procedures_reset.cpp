// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/builtincatalog.h"
#include "tests/support/sessionfixture.h"
#include "tests/support/testmain.h"

#include <QFile>

using namespace dynascope;

/// Factory Reset as the window asks for it: session, bus thread and simulated servos in virtual time.
class TestProceduresReset : public QObject
{
    Q_OBJECT

private slots:
    // One that obeys is looked for in tst_session, where time passes while it boots.
    void oneThatIgnoredItIsFoundAtItsOldPlace()
    {
        Journal journal;
        VirtualSession all(m_catalog, QStringLiteral("XM430-W350@1000000:5"), &journal);
        all.factory.isLost = [](ByteView packet) {
            return packet[7] == static_cast<std::uint8_t>(Instruction::FactoryReset);
        };
        all.open(1000000);
        Device &device = *all.line->devices().front();
        std::optional<Result<void>> outcome;
        all.commands.factoryReset(device, ResetOption::All, [&](const Result<void> &result) { outcome = result; });
        QVERIFY(VirtualSession::waitFor([&] { return outcome.has_value(); }));
        QVERIFY(!*outcome);
        QCOMPARE(outcome->error().text,
                 QStringLiteral("XM430-W350 #5 still answers at ID 5, 1000000 bps: it did not take the reset"));
        QCOMPARE(device.id(), 5);
        QCOMPARE(device.baudRate(), 1000000);
        QCOMPARE(device.state(), Device::State::Present);
        const JournalEntry &entry = journal.entries().back();
        QCOMPARE(entry.kind, JournalKind::FactoryReset);
        QVERIFY(entry.state != JournalState::Done && !entry.movedTo);
        QVERIFY2(entry.note.contains(QStringLiteral("did not take the reset")), qPrintable(entry.note));
    }

    void oneOfTwoAxesKeepsItsId()
    {
        Catalog catalog = test::builtInCatalog();
        QFile file(QStringLiteral(DYNASCOPE_SOURCE_DIR "/tests/data/tables/two-axes.json"));
        QVERIFY(file.open(QIODevice::ReadOnly));
        QVERIFY(catalog.add(file.readAll(), QStringLiteral("two-axes.json")));
        VirtualSession all(catalog, QStringLiteral("Two axes@1000000:11+12"));
        all.open(1000000);
        Device &device = *all.line->devices().back();
        std::optional<Result<void>> outcome;
        all.commands.factoryReset(device, ResetOption::All, [&](const Result<void> &result) { outcome = result; });
        QVERIFY(VirtualSession::waitFor([&] { return outcome.has_value(); }));
        QVERIFY(!*outcome);
        QVERIFY2(outcome->error().text.contains(QStringLiteral("one of two axes")), qPrintable(outcome->error().text));
        QCOMPARE(device.id(), 12);
    }

private:
    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestProceduresReset)
#include "tst_procedures_reset.moc"
