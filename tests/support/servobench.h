// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sim/power.h"
#include "core/sim/servo.h"
#include "core/table/catalog.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/simclient.h"

#include <QTest>

namespace simclient {

/// Servos on a bench: a bus in virtual time, and a client that speaks by the wire alone.
class ServoBench
{
public:
    explicit ServoBench(const dynascope::Catalog &catalog) : m_catalog(catalog) { }

    void start(const QString &model = QStringLiteral("XM430-W350"), int firmware = -1, int baud = 57600, int id = 1,
               int secondId = -1)
    {
        m_bus = std::make_unique<dynascope::sim::SimulatedBus>(m_catalog);
        m_client.emplace(Client{*m_bus, baud});
        add(model, firmware, baud, id, secondId);
    }
    void add(const QString &model, int firmware = -1, int baud = 57600, int id = 1,
             int secondId = -1)
    {
        const auto servo = m_bus->add({model, firmware, baud, id, secondId});
        QVERIFY2(servo, qPrintable(servo ? QString() : servo.error().text));
    }
    dynascope::sim::SimulatedBus &bus() { return *m_bus; }
    dynascope::sim::Power &power()
    {
        m_bus->advanceTo(m_client->now);
        return m_bus->power();
    }
    dynascope::sim::Servo &servo(int index = 0)
    {
        m_bus->advanceTo(m_client->now);
        return *m_bus->servos().at(static_cast<std::size_t>(index));
    }
    Client &client() { return *m_client; }

    /// What a register holds now, past the wire.
    std::int64_t value(QStringView name, int index = 0)
    {
        m_bus->advanceTo(m_client->now);
        return servo(index).value(name);
    }
    /// A Write by the wire, as any client's.
    Bytes writePacket(QStringView name, std::int64_t raw, int index = 0)
    {
        const dynascope::Field *field = servo(index).table().find(name);
        if (!field)
            qFatal("%s has no such register", qPrintable(servo(index).model()));
        Bytes parameters;
        dynascope::appendLittleEndian(parameters, field->address, 2);
        const Bytes data = dynascope::bytesFromRaw(*field, raw);
        parameters.insert(parameters.end(), data.begin(), data.end());
        return oracle::instruction(static_cast<std::uint8_t>(servo(index).id()), 3, parameters);
    }
    /// The error field of the answer to a Write; −1 where none came.
    int tryWrite(QStringView name, std::int64_t raw, int index = 0)
    {
        const Bytes heard = m_client->exchange(writePacket(name, raw, index));
        return heard.size() == 11 ? heard[8] : -1;
    }
    void write(QStringView name, std::int64_t raw, int index = 0)
    {
        QCOMPARE(tryWrite(name, raw, index) & 0x7F, 0);
    }
    void ask(const QString &request, const QString &answer)
    {
        QCOMPARE(hex(m_client->exchange(request)), hex(status(answer)));
    }
    void wait(LineTime duration)
    {
        m_client->now += duration;
        m_bus->advanceTo(m_client->now);
    }

private:
    const dynascope::Catalog &m_catalog;
    std::unique_ptr<dynascope::sim::SimulatedBus> m_bus;
    std::optional<Client> m_client;
};

} // namespace simclient
