// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/simulatedbus.h"
#include "core/table/catalog.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/simclient.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace dynascope::sim;
using namespace simclient;

/// What one servo answers, packet by packet. Packets are written "ID INSTRUCTION parameters", answers "ID ERROR data".
class TestServo : public QObject
{
    Q_OBJECT

private slots:
    void answers_data()
    {
        QTest::addColumn<QString>("before");
        QTest::addColumn<QString>("request");
        QTest::addColumn<QString>("answer");

        QTest::newRow("ping") << "" << "01 01" << "01 00 FC 03 2D";
        QTest::newRow("read model number") << "" << "01 02 00 00 02 00" << "01 00 FC 03";
        QTest::newRow("another ID is not ours") << "" << "02 01" << "";
        QTest::newRow("broadcast read is never answered") << "" << "FE 02 00 00 02 00" << "";
        QTest::newRow("unknown instruction") << "" << "01 77" << "01 02";
        QTest::newRow("read without its parameters") << "" << "01 02 00 00" << "01 05";

        QTest::newRow("a gap reads as 0") << "" << "01 02 0E 00 06 00" << "01 00 00 00 00 00 00 00";
        QTest::newRow("the table's last byte") << "" << "01 02 95 02 01 00" << "01 00 00";
        QTest::newRow("past the table: an error and no data") << "" << "01 02 95 02 02 00" << "01 07";

        QTest::newRow("write LED") << "" << "01 03 41 00 01" << "01 00";
        QTest::newRow("what was written is read") << "01 03 41 00 01" << "01 02 41 00 01 00" << "01 00 01";
        QTest::newRow("beyond the register's range") << "" << "01 03 41 00 02" << "01 04";
        QTest::newRow("fewer bytes than the register has") << "" << "01 03 74 00 00 08" << "01 05";
        QTest::newRow("read-only") << "" << "01 03 84 00 00 00 00 00" << "01 07";
        QTest::newRow("no register there") << "" << "01 03 0E 00 00" << "01 07";
        QTest::newRow("write past the table") << "" << "01 03 96 02 00" << "01 07";
        QTest::newRow("no mode of this model") << "" << "01 03 0B 00 02" << "01 04";
        QTest::newRow("no rate of this model") << "" << "01 03 08 00 08" << "01 04";
        QTest::newRow("two registers at once") << "" << "01 03 70 00 64 00 00 00 00 08 00 00" << "01 00";
        QTest::newRow("both were written") << "01 03 70 00 64 00 00 00 00 08 00 00" << "01 02 70 00 08 00"
                                           << "01 00 64 00 00 00 00 08 00 00";
        QTest::newRow("one bad value spoils both") << "01 03 70 00 64 00 00 00 00 20 00 00" << "01 02 70 00 04 00"
                                                   << "01 00 00 00 00 00";
        QTest::newRow("goal beyond Max Position Limit") << "01 03 30 00 00 08 00 00" << "01 03 74 00 01 08 00 00"
                                                        << "01 06";

        QTest::newRow("EEPROM is open without torque") << "" << "01 03 09 00 0A" << "01 00";
        QTest::newRow("EEPROM is locked under torque") << "01 03 40 00 01" << "01 03 09 00 0A" << "01 07";
        QTest::newRow("what was refused stays as it was") << "01 03 40 00 01;FE 03 09 00 0A" << "01 02 09 00 01 00"
                                                          << "01 00 FA";

        QTest::newRow("level 1 answers reads") << "01 03 44 00 01" << "01 02 41 00 01 00" << "01 00 00";
        QTest::newRow("level 1 does not answer writes") << "01 03 44 00 01" << "01 03 41 00 01" << "";
        QTest::newRow("level 0 answers pings") << "01 03 44 00 00" << "01 01" << "01 00 FC 03 2D";
        QTest::newRow("level 0 does not answer reads") << "01 03 44 00 00" << "01 02 41 00 01 00" << "";

        QTest::newRow("Reg Write changes nothing yet") << "01 04 41 00 01" << "01 02 41 00 01 00" << "01 00 00";
        QTest::newRow("Registered Instruction") << "01 04 41 00 01" << "01 02 45 00 01 00" << "01 00 01";
        QTest::newRow("Action carries it out") << "01 04 41 00 01;01 05" << "01 02 41 00 01 00" << "01 00 01";
        QTest::newRow("broadcast Action too") << "01 04 41 00 01;FE 05" << "01 02 41 00 01 00" << "01 00 01";
        QTest::newRow("Action with nothing registered") << "" << "01 05" << "01 02";
        QTest::newRow("Action only once") << "01 04 41 00 01;01 05" << "01 05" << "01 02";
        QTest::newRow("Reg Write is checked at once") << "" << "01 04 41 00 02" << "01 04";

        QTest::newRow("Sync Write") << "FE 83 41 00 01 00 02 01 01 01" << "01 02 41 00 01 00" << "01 00 01";
        QTest::newRow("Bulk Write") << "FE 93 01 41 00 01 00 01" << "01 02 41 00 01 00" << "01 00 01";
        QTest::newRow("Secondary ID obeys") << "01 03 0C 00 07;07 03 41 00 01" << "01 02 41 00 01 00" << "01 00 01";
        QTest::newRow("Secondary ID never answers") << "01 03 0C 00 07" << "07 01" << "";
        QTest::newRow("Secondary ID leaves EEPROM alone") << "01 03 0C 00 07;07 03 09 00 0A" << "01 02 09 00 01 00"
                                                          << "01 00 FA";
        QTest::newRow("253 and up: no Secondary ID") << "01 03 0C 00 FD;FD 03 41 00 01" << "01 02 41 00 01 00"
                                                     << "01 00 00";

        QTest::newRow("Reboot with a parameter is ignored") << "" << "01 08 00" << "";
        QTest::newRow("Reset with a wrong option") << "" << "01 06 07" << "01 04";
        QTest::newRow("Clear the turns") << "" << "01 10 01 44 58 4C 22" << "01 00";
        QTest::newRow("Clear with a wrong key") << "" << "01 10 01 44 58 4C 23" << "01 04";
        QTest::newRow("Clear error is not for X") << "" << "01 10 02 45 52 43 4C" << "01 04";
        QTest::newRow("Backup") << "" << "01 20 01 43 54 52 4C" << "01 00";
        QTest::newRow("Backup Ready") << "01 20 01 43 54 52 4C" << "01 02 93 00 01 00" << "01 00 01";
        QTest::newRow("Backup under torque") << "01 03 40 00 01" << "01 20 01 43 54 52 4C" << "01 01";
        QTest::newRow("Restore without a backup") << "" << "01 20 02 43 54 52 4C" << "01 01";

        QTest::newRow("ID change answers with the old ID") << "" << "01 03 07 00 09" << "01 00";
        QTest::newRow("then it has the new one") << "01 03 07 00 09" << "09 01" << "09 00 FC 03 2D";

        QTest::newRow("Indirect Data reads where it points") << "01 03 A8 00 41 00;01 03 41 00 01"
                                                             << "01 02 E0 00 01 00" << "01 00 01";
        QTest::newRow("Indirect Data writes where it points") << "01 03 A8 00 41 00;01 03 E0 00 01"
                                                              << "01 02 41 00 01 00" << "01 00 01";
        QTest::newRow("Indirect Data takes the range of what it points at") << "01 03 A8 00 41 00" << "01 03 E0 00 02"
                                                                            << "01 04";
        QTest::newRow("Indirect Data takes the access of what it points at") << "01 03 A8 00 7A 00"
                                                                             << "01 03 E0 00 01" << "01 07";
        QTest::newRow("only RAM may be pointed at") << "" << "01 03 A8 00 07 00" << "01 04";
    }

    void answers()
    {
        QFETCH(QString, before);
        QFETCH(QString, request);
        QFETCH(QString, answer);
        SimulatedBus bus(m_catalog);
        QVERIFY(bus.add({QStringLiteral("XM430-W350"), -1, 57600, 1}));
        Client client{bus};
        client.exchangeAll(before);
        QCOMPARE(hex(client.exchange(request)), hex(status(answer)));
    }

private:
    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestServo)
#include "tst_servo.moc"
