// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/effectivefield.h"

#include <array>
#include <memory>
#include <span>

namespace dynascope {

/// One code of the Baud Rate register.
struct BaudCode {
    std::uint8_t code = 0;
    int rate = 0; ///< bits per second

    friend bool operator==(const BaudCode &, const BaudCode &) = default;
};

/// Registers that the program itself means, whatever the model: found once, when the table is made.
enum class Known : std::uint8_t {
    Id,
    SecondaryId,
    BaudRate,
    ReturnDelayTime,
    StatusReturnLevel,
    OperatingMode,
    TorqueEnable,
    Led,
    HardwareErrorStatus,
    PresentPosition,
};
QStringView nameOf(Known field); ///< as the manufacturer writes it

/// The control table of one model at one range of firmware. Immutable; shared between threads.
class ControlTable
{
public:
    static constexpr int DefaultReceiveBuffer = 1024; ///< bytes

    /// What a table is made of; see catalog.h for where it comes from.
    struct Description {
        std::uint16_t modelNumber = 0;
        QString model;            ///< "XM430-W350"
        QStringList alsoCalled;   ///< models that have the same number and table
        int modbusNumber = -1;    ///< what Model Number reads in Modbus mode; −1: the same
        QString series;           ///< "X"
        bool addressesOnly = false; ///< area, access, limits and meaning of the registers aren't known
        bool isRaw = false;       ///< of an unknown model: every byte for itself
        int newestFirmware = -1;  ///< of those whose table is known; −1: none is
        int firmwareFrom = 0;
        int firmwareTo = 255;
        /// Pulses per revolution, or where positions are in degrees as many steps as make one; 0 where there are none.
        /// GearRatio changes what a turn is: EffectiveField::turns.
        int resolution = 4096;
        std::vector<int> operatingModes;
        std::vector<BaudCode> baudCodes;
        int fastReadsFrom = -1;   ///< first firmware with Fast Sync/Bulk Read; −1: never
        int backupFrom = -1;      ///< first firmware with Control Table Backup; −1: never
        int clearFrom = -1;       ///< first firmware with Clear (multi-turn position); −1: never
        bool clearsErrors = false; ///< Clear also knows the error (Y series)
        int resetByBroadcastUntil = -1; ///< last firmware that obeys a broadcast Factory Reset (all); −1: none
        int axes = 1;             ///< devices in one housing, each with an ID, that share baud rate and EEPROM lock
        int receiveBuffer = DefaultReceiveBuffer; ///< bytes of the longest packet that the device takes
        QString doubt;            ///< what is uncertain about the whole table, a sentence; empty: nothing
        QString manualPage;       ///< URL; empty: none
        std::vector<Field> fields; ///< by address, no overlaps
    };

    explicit ControlTable(Description description);

    const Description &description() const { return m_description; }
    std::uint16_t modelNumber() const { return m_description.modelNumber; }
    const QString &model() const { return m_description.model; }
    int resolution() const { return m_description.resolution; }
    std::span<const Field> fields() const { return m_description.fields; }
    int size() const { return m_size; } ///< one past the last address
    int axes() const { return m_description.axes; } ///< devices in one housing, each with an ID
    int receiveBuffer() const { return m_description.receiveBuffer; } ///< bytes of the longest packet it takes

    /// By the manufacturer's name, ignoring case, spaces, '-' and '_'; −1 where there is none.
    int indexOf(QStringView name) const;
    const Field *find(QStringView name) const;
    int indexOf(Known field) const { return m_known[static_cast<std::size_t>(field)]; } ///< −1 where there is none
    const Field *find(Known field) const;
    /// The field that begins at this address; nullptr where none does.
    const Field *at(int address) const;
    int indexOf(const Field *field) const;

    std::optional<int> baudRate(int code) const;
    std::optional<int> baudCode(int rate) const;
    bool hasFastReads(int firmware) const;
    bool hasBackup(int firmware) const;
    bool hasClear(int firmware) const;
    /// Is there no table for firmware as new as this? Then the newest is the best guess.
    bool isNewerThanKnown(int firmware) const;

private:
    Description m_description;
    std::vector<std::pair<std::uint32_t, int>> m_byName; ///< hash of the normalised name, and index; sorted
    std::array<int, static_cast<std::size_t>(Known::PresentPosition) + 1> m_known{}; ///< by Known
    int m_size = 0;
};

using ControlTablePtr = std::shared_ptr<const ControlTable>;

/// Lower case without spaces, '-' and '_': how names are compared.
QString normalizedName(QStringView name);

} // namespace dynascope
