// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/catalog.h"
#include "ui/table/tableactions.h"

#include <QTest>

#include <algorithm>
#include <memory>

namespace dynascope {

/// Servos that nobody is connected to, and a record of what the table asked for.
struct TableFixture {
    struct Write {
        int id = 0;
        QString field;
        std::int64_t raw = 0;
    };

    static const Catalog &catalog()
    {
        static const Catalog loaded = Catalog::builtIn().value();
        return loaded;
    }

    /// A servo with the values it leaves the factory with.
    Device *add(int id, int model = 1020)
    {
        ControlTablePtr table = catalog().findOrRaw(model, 45);
        Found found;
        found.id = static_cast<std::uint8_t>(id);
        found.baudRate = 1000000;
        found.modelNumber = static_cast<std::uint16_t>(model);
        found.firmware = 45;
        devices.push_back(std::make_unique<Device>(static_cast<DeviceKey>(id), nullptr, table, found));
        Device *device = devices.back().get();
        for (const Field &field : table->fields())
            set(device, field.name, field.initial.value_or(0));
        if (table->indexOf(u"ID") >= 0)
            set(device, QStringLiteral("ID"), id);
        return device;
    }

    static void set(Device *device, const QString &name, std::int64_t raw)
    {
        const Field *field = device->table().find(name);
        Q_ASSERT(field);
        PollValue value;
        value.device = device->key();
        value.address = field->address;
        value.data = bytesFromRaw(*field, raw);
        device->take(value);
    }

    static int field(const Device *device, QStringView name) { return device->table().indexOf(name); }

    std::vector<Device *> all() const
    {
        std::vector<Device *> pointers;
        for (const auto &device : devices)
            pointers.push_back(device.get());
        return pointers;
    }

    TableActions actions()
    {
        TableActions made;
        made.write = [this](Device &device, int index, std::int64_t raw) {
            writes.push_back({device.id(), device.table().fields()[static_cast<std::size_t>(index)].name, raw});
        };
        made.torqueOff = [this](const std::vector<Device *> &which, std::function<void(Result<void>)> done) {
            for (Device *device : which) {
                torqueOff.push_back(device->id());
                if (torqueGoesOff)
                    set(device, QStringLiteral("Torque Enable"), 0);
            }
            if (torqueGoesOff)
                done({});
            else
                done(failure(ErrorKind::NothingReceived, QStringLiteral("nothing came back")));
        };
        made.readAll = [this](Device &device) { reads.push_back(device.id()); };
        made.isWatched = [this](const Watch &watch) { return watched.contains(watch); };
        return made;
    }

    /// "3 Goal Position=2048" for each, in their order.
    QStringList written() const
    {
        QStringList lines;
        for (const Write &write : writes)
            lines << QStringLiteral("%1 %2=%3").arg(write.id).arg(write.field).arg(write.raw);
        return lines;
    }

    std::vector<std::unique_ptr<Device>> devices;
    std::vector<Write> writes;
    std::vector<int> torqueOff;
    std::vector<int> reads;
    std::set<Watch> watched;
    bool torqueGoesOff = true;
};

/// An XM430 on its way somewhere, as it looks in the middle of work.
inline void makeBusy(Device *device)
{
    const std::pair<const char16_t *, int> values[]
        = {{u"Firmware Version", 45}, {u"Baud Rate", 3}, {u"Return Delay Time", 0}, {u"Model Information", 0},
           {u"Min Position Limit", 512}, {u"Max Position Limit", 3584}, {u"Torque Enable", 1},
           {u"Position P Gain", 640}, {u"Goal PWM", 885}, {u"Goal Current", 1193}, {u"Goal Velocity", 200},
           {u"Profile Acceleration", 20}, {u"Profile Velocity", 120}, {u"Goal Position", 2731}, {u"Moving", 1},
           {u"Moving Status", 50}, {u"Present PWM", 87}, {u"Present Current", -14}, {u"Present Velocity", 44},
           {u"Present Position", 2287}, {u"Velocity Trajectory", 45}, {u"Position Trajectory", 2301},
           {u"Present Input Voltage", 121}, {u"Present Temperature", 34}, {u"Realtime Tick", 18231}};
    for (const auto &[name, raw] : values)
        TableFixture::set(device, QString::fromUtf16(name), raw);
}

} // namespace dynascope
