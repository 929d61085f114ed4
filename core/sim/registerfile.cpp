// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/registerfile.h"

#include <algorithm>

namespace dynascope::sim {
namespace {

constexpr std::array<const char16_t *, static_cast<std::size_t>(Reg::Count)> Names{
    u"Model Number", u"Firmware Version", u"ID", u"Baud Rate", u"Return Delay Time", u"Drive Mode", u"Operating Mode",
    u"Secondary ID", u"Protocol Type", u"Homing Offset", u"Moving Threshold", u"Temperature Limit",
    u"Max Voltage Limit", u"Min Voltage Limit", u"PWM Limit", u"Current Limit", u"Velocity Limit",
    u"Max Position Limit", u"Min Position Limit", u"Startup Configuration", u"Shutdown", u"Torque Enable", u"LED",
    u"Status Return Level", u"Registered Instruction", u"Hardware Error Status", u"Velocity I Gain",
    u"Velocity P Gain", u"Position D Gain", u"Position I Gain", u"Position P Gain", u"Feedforward 2nd Gain",
    u"Feedforward 1st Gain", u"Bus Watchdog", u"Goal PWM", u"Goal Current", u"Goal Velocity",
    u"Profile Acceleration", u"Profile Velocity", u"Goal Position", u"Realtime Tick", u"Moving", u"Moving Status",
    u"Present PWM", u"Present Current", u"Present Load", u"Present Velocity", u"Present Position",
    u"Velocity Trajectory", u"Position Trajectory", u"Present Input Voltage", u"Present Temperature",
    u"Backup Ready",
};

} // namespace

RegisterFile::RegisterFile(ControlTablePtr table)
    : m_table(std::move(table))
    , m_covering(static_cast<std::size_t>(m_table->size()), nullptr)
    , m_indirectFor(m_covering.size(), nullptr)
    , m_image(m_covering.size(), 0)
{
    for (std::size_t i = 0; i < Names.size(); ++i)
        m_known[i] = m_table->find(QStringView(Names[i]));
    const QString data = QStringLiteral("Indirect Data ");
    for (const Field &field : m_table->fields()) {
        std::fill(m_covering.begin() + field.address, m_covering.begin() + field.end(), &field);
        if (field.name.startsWith(data))
            m_indirectFor[field.address]
                = m_table->find(QStringLiteral("Indirect Address ") + field.name.mid(data.size()));
    }
    resetEeprom();
    resetRam();
    set(Reg::ModelNumber, m_table->modelNumber());
}

std::int64_t RegisterFile::get(Reg reg) const
{
    const Field *known = field(reg);
    return known ? get(*known) : 0;
}

void RegisterFile::set(Reg reg, std::int64_t value)
{
    if (const Field *known = field(reg))
        set(*known, value);
}

std::int64_t RegisterFile::initial(Reg reg) const
{
    const Field *known = field(reg);
    return known ? known->initial.value_or(0) : 0;
}

std::int64_t RegisterFile::get(const Field &field) const
{
    return rawFromBytes(field, ByteView(m_image).subspan(field.address, field.size));
}

void RegisterFile::set(const Field &field, std::int64_t value)
{
    const Bytes bytes = bytesFromRaw(field, value);
    std::ranges::copy(bytes, m_image.begin() + field.address);
}

bool RegisterFile::isInside(int address, int length) const
{
    return address + length <= m_table->size();
}

const Field *RegisterFile::covering(int address) const
{
    return address < m_table->size() ? m_covering[static_cast<std::size_t>(address)] : nullptr;
}

int RegisterFile::target(int address) const
{
    const Field *pointer = address < m_table->size() ? m_indirectFor[static_cast<std::size_t>(address)] : nullptr;
    if (!pointer)
        return address;
    const auto to = static_cast<int>(get(*pointer));
    return to < m_table->size() ? to : address;
}

std::vector<RegisterFile::Run> RegisterFile::targets(int address, ByteView data) const
{
    std::vector<Run> runs;
    for (const std::uint8_t byte : data) {
        const int to = target(address++);
        if (runs.empty() || runs.back().address + static_cast<int>(runs.back().data.size()) != to)
            runs.push_back({to, {}});
        runs.back().data.push_back(byte);
    }
    return runs;
}

Bytes RegisterFile::read(int address, int length) const
{
    Bytes data;
    for (int at = address; at < address + length; ++at)
        data.push_back(m_image[static_cast<std::size_t>(target(at))]);
    return data;
}

void RegisterFile::store(const Run &run)
{
    std::ranges::copy(run.data, m_image.begin() + run.address);
}

std::vector<const Field *> RegisterFile::fieldsIn(const Run &run) const
{
    std::vector<const Field *> fields;
    const int end = run.address + static_cast<int>(run.data.size());
    for (int at = run.address; at < end; ++at) {
        const Field *field = covering(at);
        if (field && (fields.empty() || fields.back() != field))
            fields.push_back(field);
    }
    return fields;
}

DeviceError RegisterFile::check(const Run &run, DeviceError limitError) const
{
    const int end = run.address + static_cast<int>(run.data.size());
    for (int at = run.address; at < end; ++at) {
        const Field *field = covering(at);
        if (!field || !field->isWritable())
            return DeviceError::Access;
    }
    for (const Field *field : fieldsIn(run)) {
        if (field->address < run.address || field->end() > end)
            return DeviceError::DataLength;
    }
    for (const Field *field : fieldsIn(run)) {
        const auto offset = static_cast<std::size_t>(field->address - run.address);
        const ByteView bytes = ByteView(run.data).subspan(offset, field->size);
        const DeviceError error = checkValue(*field, rawFromBytes(*field, bytes), limitError);
        if (error != DeviceError::None)
            return error;
    }
    return DeviceError::None;
}

DeviceError RegisterFile::checkValue(const Field &field, std::int64_t raw, DeviceError limitError) const
{
    if (&field == this->field(Reg::OperatingMode)) {
        const auto &modes = m_table->description().operatingModes;
        if (!modes.empty() && std::ranges::find(modes, static_cast<int>(raw)) == modes.end())
            return DeviceError::DataRange;
    }
    if (&field == this->field(Reg::BaudRate) && !m_table->baudRate(static_cast<int>(raw)))
        return DeviceError::DataRange;
    const auto lookup = [this](QStringView name) -> std::optional<std::int64_t> {
        const Field *other = m_table->find(name);
        return other ? std::optional(get(*other)) : std::nullopt;
    };
    const EffectiveField now = effective(field, lookup);
    const bool tooLow = now.minimum && raw < *now.minimum;
    const bool tooHigh = now.maximum && raw > *now.maximum;
    if (!tooLow && !tooHigh)
        return DeviceError::None;
    const bool byRegister = tooLow ? !field.minimum.reg.isEmpty() : !field.maximum.reg.isEmpty();
    return byRegister ? limitError : DeviceError::DataRange;
}

void RegisterFile::resetEeprom()
{
    const std::int64_t model = get(Reg::ModelNumber);
    const std::int64_t firmware = get(Reg::FirmwareVersion);
    resetArea(true);
    set(Reg::ModelNumber, model);
    set(Reg::FirmwareVersion, firmware);
}

void RegisterFile::resetRam()
{
    const std::int64_t backup = get(Reg::BackupReady); // the backup is kept in flash
    resetArea(false);
    set(Reg::BackupReady, backup);
    set(Reg::GoalPwm, get(Reg::PwmLimit));
    set(Reg::GoalCurrent, get(Reg::CurrentLimit));
}

void RegisterFile::resetArea(bool eeprom)
{
    for (const Field &field : m_table->fields()) {
        if ((field.area == Area::Ram) != eeprom)
            set(field, field.initial.value_or(0));
    }
}

} // namespace dynascope::sim
