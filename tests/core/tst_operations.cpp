// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/operations.h"
#include "tests/support/exchangetext.h"
#include "tests/support/fakeservos.h"
#include "tests/support/oracle.h"
#include "tests/support/testmain.h"

using namespace dynascope;
using namespace std::chrono_literals;

class TestOperations : public QObject
{
    Q_OBJECT

private slots:
    void pingsReadsWrites()
    {
        FakeLine line;
        FakeServos devices(line);
        devices.servos[3].registers[132] = 0xA6;
        Bus bus(line);
        const auto pinged = ping(bus, 3);
        QVERIFY(pinged);
        QCOMPARE(pinged->modelNumber, 1025);
        QCOMPARE(pinged->firmware, 45);
        QCOMPARE(read(bus, {3, 132, 4})->data, (Bytes{0xA6, 0, 0, 0}));
        QVERIFY(write(bus, {3, 65, {1}}));
        QCOMPARE(devices.servos[3].registers[65], std::uint8_t(1));
        QCOMPARE(ping(bus, 4).error().kind, ErrorKind::NothingReceived);
        QCOMPARE(write(bus, {BroadcastId, 65, {0}}).has_value(), true);
    }

    void readsMany()
    {
        FakeLine line;
        FakeServos devices(line);
        for (const int id : {1, 2, 4})
            devices.servos[id].registers[132] = static_cast<std::uint8_t>(id);
        Bus bus(line);
        const std::vector<Span> spans{{1, 132, 4}, {2, 132, 4}, {3, 132, 4}, {4, 132, 4}};
        const auto values = readMany(bus, spans);
        QVERIFY(values);
        QCOMPARE((*values)[0]->data[0], std::uint8_t(1));
        QCOMPARE((*values)[1]->data[0], std::uint8_t(2));
        QVERIFY(!(*values)[2]); // missing; and the one behind it is read all the same
        QCOMPARE((*values)[3]->data[0], std::uint8_t(4));
    }

    void writesMany()
    {
        FakeLine line;
        FakeServos devices(line);
        devices.servos[1];
        devices.servos[2];
        Bus bus(line);
        const std::vector<SpanData> writes{{1, 116, {1, 0, 0, 0}}, {2, 116, {2, 0, 0, 0}}};
        QVERIFY(writeMany(bus, writes));
        QCOMPARE(devices.servos[1].registers[116], std::uint8_t(1));
        QCOMPARE(devices.servos[2].registers[116], std::uint8_t(2));
    }

    void verifiesByReadingBack()
    {
        FakeLine line;
        line.answer(oracle::status(3, 0, {})).answer(oracle::status(3, 0, {0})).answer(oracle::status(3, 0, {5}));
        Bus bus(line);
        QCOMPARE(*writeVerified(bus, {3, 9, {5}}), Bytes{5}); // EEPROM took a while

        FakeLine stubborn;
        stubborn.handler = [](const Bytes &request) -> FakeLine::Answer {
            return {{500us, oracle::status(3, 0, request[7] == 2 ? Bytes{0} : Bytes{})}};
        };
        Bus stubbornBus(stubborn);
        const auto value = writeVerified(stubbornBus, {3, 9, {5}});
        QCOMPARE(value.error().kind, ErrorKind::NotConfirmed);
        QCOMPARE(value.error().text, QStringLiteral("device 3 took the value, but reads back 00 instead of 05"));

        FakeLine refusing;
        refusing.answer(oracle::status(3, 7, {}));
        Bus refusingBus(refusing);
        QCOMPARE(writeVerified(refusingBus, {3, 9, {5}}).error().kind, ErrorKind::Refused);
    }

    void readingBackWaitsForABusyDevice_data()
    {
        QTest::addColumn<int>("busy"); ///< ms that it hears nothing after the write
        for (const int busy : {1, 10, 30, 60})
            QTest::addRow("%d ms", busy) << busy;
    }
    void readingBackWaitsForABusyDevice()
    {
        QFETCH(int, busy);
        FakeLine line;
        FakeServos devices(line);
        devices.servos[3].registers[9] = 1;
        LineTime until{};
        line.handler = [&](const Bytes &request) -> FakeLine::Answer {
            if (line.now() < until)
                return {};
            FakeLine::Answer answer = devices.answer(request);
            if (request[7] == 3)
                until = line.now() + busy * 1ms;
            return answer;
        };
        Bus bus(line);
        const auto value = writeVerified(bus, {3, 9, {5}});
        QVERIFY2(value, value ? "" : qPrintable(value.error().text));
        QCOMPARE(*value, Bytes{5});
    }

    void aLostAnswerToAWriteIsReadBack()
    {
        FakeLine line;
        FakeServos devices(line);
        devices.servos[3].registers[9] = 1;
        int statuses = 0;
        line.handler = [&](const Bytes &request) -> FakeLine::Answer {
            FakeLine::Answer answer = devices.answer(request);
            if (request[7] == 3 && ++statuses <= 3)
                return {};
            return answer;
        };
        Bus bus(line);
        QCOMPARE(*writeVerified(bus, {3, 9, {5}}), Bytes{5});
    }

    void saysWhatBecameOfALostWrite()
    {
        const auto verified = [](const FakeLine::Handler &handler) {
            FakeLine line;
            line.handler = handler;
            Bus bus(line);
            return exchangetext::untimed(writeVerified(bus, {3, 9, {5}}).error().text);
        };
        const QString silence = QStringLiteral("device 3 did not answer: nothing was received in time");
        const QString mayBe = QStringLiteral("; the write may have been executed");
        QCOMPARE(verified([](const Bytes &) { return FakeLine::Answer(); }), silence + mayBe);
        // Answers Ping, which proves that nothing older is in flight, and the write, but no Read.
        QCOMPARE(verified([](const Bytes &request) -> FakeLine::Answer {
            if (request[7] == 2)
                return {};
            return {{500us, oracle::status(3, 0, request[7] == 1 ? Bytes{6, 4, 38} : Bytes{})}};
        }), silence + mayBe);
        QCOMPARE(verified([](const Bytes &request) -> FakeLine::Answer {
            if (request[7] == 3)
                return {};
            return {{500us, oracle::status(3, 0, request[7] == 1 ? Bytes{6, 4, 38} : Bytes{1})}};
        }), silence + QStringLiteral("; the register reads back 01 instead of 05"));
    }

    void aSilentOneIsToldWithThoseAlive()
    {
        FakeLine line;
        line.handler = [](const Bytes &request) -> FakeLine::Answer {
            if (request[4] == 9 || request[4] == 8)
                return {};
            return {{500us, oracle::status(request[4], 0, {6, 4, 38})}};
        };
        Bus bus(line);
        QVERIFY(ping(bus, 9).error().text.startsWith(QStringLiteral("device 9 did not answer: nothing was received")));
        QVERIFY(!ping(bus, 9).error().text.contains(u';')); // nobody else was asked
        QVERIFY(!ping(bus, 8));
        QVERIFY(ping(bus, 9).error().text.endsWith(QStringLiteral("nothing else on the line has answered lately")));
        QVERIFY(ping(bus, 1));
        QVERIFY(ping(bus, 9).error().text.endsWith(QStringLiteral("; device 1 on this line answers")));
        QVERIFY(ping(bus, 3));
        QVERIFY(ping(bus, 9).error().text.endsWith(QStringLiteral("; devices 1, 3 on this line answer")));
        QVERIFY(bus.wait(1min));
        QVERIFY(!ping(bus, 9).error().text.contains(u';'));
    }
};

DYNASCOPE_CORE_TEST(TestOperations)
#include "tst_operations.moc"
