// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/registerfile.h"

#include <algorithm>

namespace dynascope::sim {
namespace {

// What gains are at power-up where no table says. Chosen: those of XM430.
constexpr std::int64_t UsualPositionP = 800, UsualVelocityP = 100, UsualVelocityI = 1920;

} // namespace

RegisterFile::RegisterFile(ControlTablePtr table)
    : m_table(std::move(table))
    , m_covering(static_cast<std::size_t>(m_table->size()), nullptr)
    , m_indirectFor(m_covering.size(), nullptr)
    , m_image(m_covering.size(), 0)
{
    for (std::size_t i = 0; i < m_known.size(); ++i)
        m_known[i] = findRegister(*m_table, static_cast<Reg>(i));
    const QString data = QStringLiteral("Indirect Data ");
    for (const Field &field : m_table->fields()) {
        std::fill(m_covering.begin() + field.address, m_covering.begin() + field.end(), &field);
        if (field.name.startsWith(data))
            m_indirectFor[field.address]
                = m_table->find(QStringLiteral("Indirect Address ") + field.name.mid(data.size()));
    }
    resetEeprom();
    set(Reg::ModelNumber, m_table->modelNumber());
    m_kept = m_image;
    resetRam();
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
    return known ? initialOf(*known) : 0;
}

std::int64_t RegisterFile::initialOf(const Field &field) const
{
    if (field.initial)
        return *field.initial;
    const std::pair<Reg, std::int64_t> usual[] = {{Reg::PositionPGain, UsualPositionP},
                                                  {Reg::VelocityPGain, UsualVelocityP},
                                                  {Reg::VelocityIGain, UsualVelocityI}};
    for (const auto &gain : usual) {
        if (&field == this->field(gain.first))
            return std::min(gain.second, field.maximum.number.value_or(gain.second));
    }
    // A limit of which no factory value is stated limits nothing: at 0 no goal could be set.
    const auto &all = m_table->fields();
    const bool isLimit = std::any_of(all.begin(), all.end(),
                                     [&field](const Field &other) { return other.maximum.reg == field.name; });
    return isLimit ? field.maximum.number.value_or(0) : 0;
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

DeviceError RegisterFile::check(const Run &run, const Refusals &refusals) const
{
    const int end = run.address + static_cast<int>(run.data.size());
    for (int at = run.address; at < end; ++at) {
        const Field *field = covering(at);
        if (!field || !field->isWritable())
            return DeviceError::Access;
    }
    const std::vector<const Field *> fields = fieldsIn(run);
    for (const Field *field : fields) {
        if (field->address < run.address)
            return refusals.misaligned;
        if (field->end() > end)
            return DeviceError::DataLength;
    }
    for (const Field *field : fields) {
        const auto offset = static_cast<std::size_t>(field->address - run.address);
        const ByteView bytes = ByteView(run.data).subspan(offset, field->size);
        const DeviceError error = checkValue(*field, rawFromBytes(*field, bytes), refusals.beyondLimit);
        if (error != DeviceError::None)
            return error;
    }
    return DeviceError::None;
}

/// Named values are the only ones; a pointer leads into RAM, or where nothing stands.
bool RegisterFile::isAllowed(const Field &field, std::int64_t raw) const
{
    if (!field.values.empty() && std::ranges::find(field.values, raw, &EnumValue::value) == field.values.end())
        return false;
    if (&field == this->field(Reg::BaudRate))
        return m_table->baudRate(static_cast<int>(raw)).has_value();
    if (!field.name.startsWith(u"Indirect Address"))
        return true;
    const Field *target = raw >= 0 && raw < m_table->size() ? covering(static_cast<int>(raw)) : nullptr;
    return !target || target->area != Area::Eeprom;
}

DeviceError RegisterFile::checkValue(const Field &field, std::int64_t raw, DeviceError limitError) const
{
    if (!isAllowed(field, raw))
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
    const Bound *bound = tooLow ? &field.minimum : &field.maximum;
    for (const Alternate &alternate : field.alternates) {
        const std::int64_t masked = lookup(alternate.reg).value_or(0) & static_cast<std::int64_t>(alternate.mask);
        if (std::ranges::find(alternate.values, masked) == alternate.values.end())
            continue;
        const Bound &other = tooLow ? alternate.minimum : alternate.maximum;
        if (other.isSet())
            bound = &other;
        break; // the first that holds counts
    }
    return bound->reg.isEmpty() ? DeviceError::DataRange : limitError;
}

void RegisterFile::resetEeprom()
{
    for (const Field &field : m_table->fields()) {
        const bool ofTheModel = &field == this->field(Reg::ModelNumber) || &field == this->field(Reg::FirmwareVersion);
        if (isKept(field) && !ofTheModel)
            set(field, initialOf(field));
    }
}

void RegisterFile::resetRam()
{
    const std::int64_t backup = get(Reg::BackupReady); // the backup is kept in flash
    for (const Field &field : m_table->fields()) {
        if (field.area == Area::Ram)
            set(field, initialOf(field));
        else if (field.area == Area::Hybrid)
            set(field, rawFromBytes(field, ByteView(m_kept).subspan(field.address, field.size)));
    }
    set(Reg::BackupReady, backup);
    for (const auto &goal : {std::pair(Reg::GoalPwm, Reg::PwmLimit), std::pair(Reg::GoalCurrent, Reg::CurrentLimit)}) {
        const Field *known = field(goal.first);
        if (known && !known->initial)
            set(*known, get(goal.second));
    }
}

void RegisterFile::keep(const Field &field, ByteView value)
{
    if (isKept(field) && value.size() == field.size)
        std::ranges::copy(value, m_kept.begin() + field.address);
}

void RegisterFile::keepAll()
{
    for (const Field &field : m_table->fields())
        keep(field, bytes(field));
}

void RegisterFile::losePower()
{
    for (const Field &field : m_table->fields()) {
        if (isKept(field))
            set(field, rawFromBytes(field, ByteView(m_kept).subspan(field.address, field.size)));
    }
    resetRam();
}

} // namespace dynascope::sim
