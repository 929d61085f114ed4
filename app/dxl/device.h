// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/operations.h"
#include "core/bus/scan.h"
#include "core/table/catalog.h"

#include <map>

namespace dynascope::dxl {

/// One device on the line with the table that its model and firmware have, and what has been read of it so far.
class Device
{
public:
    Device(Bus &bus, std::uint8_t id) : m_bus(bus) { m_found.id = id; }

    /// Pings; from then on the device has a table if its model is known, and the bus knows how it answers.
    Result<void> identify(const Catalog &catalog);

    /// Of an unknown model: from here on its table is one of bare bytes (rawtable.h).
    void takeRawTable(const Catalog &catalog);

    Bus &bus() const { return m_bus; }
    std::uint8_t id() const { return m_found.id; }
    const Found &found() const { return m_found; } ///< once it is identified
    /// At 0 it answers Ping alone: nothing can be read.
    bool isMute() const { return m_statusReturnLevel == 0; }
    bool isIdentified() const { return !m_model.isEmpty(); }
    const QString &model() const { return m_model; } ///< "XM430-W350"; empty until it is identified
    QString name() const; ///< "XM430-W350 (ID 1)"
    const ControlTable *table() const { return m_table.get(); }

    /// InvalidArgument names the fields that come nearest.
    Result<const Field *> field(const QString &name) const;

    Result<Bytes> read(int address, int length);
    Result<std::int64_t> read(const Field &field);

    /// The field's unit now; reads the registers that decide on it, not those that limit it.
    EffectiveField units(const Field &field);
    /// Its unit and its limits now. Registers that the device refuses to show limit nothing, nor do those of a mute one: it
    /// will refuse by itself. Fails where one of them could not be read for another reason.
    Result<EffectiveField> limits(const Field &field);

    /// `field` will have this value when units and limits matter, whatever was read before.
    void assume(const Field &field, std::int64_t raw);
    /// `field` has this value, or it is being written: from now on the device answers by it.
    void learn(const Field &field, std::int64_t raw);
    /// Other registers may have changed with a write: forget what was read.
    void forget() { m_known.clear(); }
    /// The device is elsewhere after a change of its ID or baud rate; the line works there.
    Result<void> follow(const Found &found);
    Result<void> enter(); ///< the line works where the device is: another one may have been followed elsewhere

private:
    Result<std::optional<std::int64_t>> lookUp(QStringView name);
    void setTraits(std::uint8_t statusReturnLevel);

    Bus &m_bus;
    Found m_found;
    std::uint8_t m_statusReturnLevel = 2;
    ControlTablePtr m_table;
    QString m_model;
    std::map<QString, std::int64_t> m_known; ///< by normalised name
};

} // namespace dynascope::dxl
