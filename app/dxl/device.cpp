// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/device.h"

#include "core/table/nearestnames.h"

#include <QStringList>

#include <algorithm>

namespace dynascope::dxl {

Result<void> Device::identify(const Catalog &catalog)
{
    const auto reply = ping(m_bus, id());
    if (!reply)
        return tl::unexpected(reply.error());
    m_found = {reply->id, m_bus.line().baudRate(), reply->modelNumber, reply->firmware, reply->alert, {}};
    m_table = catalog.find(reply->modelNumber, reply->firmware);
    m_model = modelName(catalog, reply->modelNumber);
    const Field *level = m_table ? m_table->find(u"Status Return Level") : nullptr;
    if (!level)
        return {};
    // A device that answers Ping but no Read has level 0: "Status Return Level".
    const auto value = read(*level);
    if (value)
        setTraits(static_cast<std::uint8_t>(*value));
    else if (value.error().kind == ErrorKind::NothingReceived)
        setTraits(0);
    else
        return tl::unexpected(value.error());
    return {};
}

void Device::takeRawTable(const Catalog &catalog)
{
    if (!m_table)
        m_table = catalog.findOrRaw(m_found.modelNumber, m_found.firmware);
}

QString Device::name() const
{
    return m_model.isEmpty() ? QStringLiteral("ID %1").arg(id()) : QStringLiteral("%1 (ID %2)").arg(m_model).arg(id());
}

Result<const Field *> Device::field(const QString &name) const
{
    if (!m_table) {
        return failure(ErrorKind::InvalidArgument,
                       QStringLiteral("%1: there is no control table for model %2; \"%3\" has to be given as ADDRESS:LENGTH")
                           .arg(this->name()).arg(m_found.modelNumber).arg(name));
    }
    if (const Field *field = m_table->find(name))
        return field;
    const QStringList near = namesNear(*m_table, name);
    return failure(ErrorKind::InvalidArgument,
                   QStringLiteral("%1 has no field \"%2\"%3")
                       .arg(this->name(), name,
                            near.isEmpty() ? QString() : QStringLiteral("; nearest: ") + near.join(QStringLiteral(", "))));
}

Result<Bytes> Device::read(int address, int length)
{
    auto reply = dynascope::read(m_bus, {id(), static_cast<std::uint16_t>(address), static_cast<std::uint16_t>(length)});
    if (!reply)
        return tl::unexpected(reply.error());
    return std::move(reply->data);
}

Result<std::int64_t> Device::read(const Field &field)
{
    const auto bytes = read(field.address, field.size);
    if (!bytes)
        return tl::unexpected(bytes.error());
    const std::int64_t raw = rawFromBytes(field, *bytes);
    learn(field, raw);
    return raw;
}

EffectiveField Device::units(const Field &field)
{
    return effective(field, [&](QStringView name) -> std::optional<std::int64_t> {
        const bool decides = std::any_of(field.alternates.begin(), field.alternates.end(), [&](const Alternate &alternate) {
            return normalizedName(alternate.reg) == normalizedName(name);
        });
        const bool gears = name == field.gearRatio.numerator || name == field.gearRatio.denominator;
        return decides || gears ? lookUp(name).value_or(std::nullopt) : std::nullopt;
    });
}

Result<EffectiveField> Device::limits(const Field &field)
{
    Result<void> readable;
    const EffectiveField limited = effective(field, [&](QStringView name) -> std::optional<std::int64_t> {
        const auto value = readable ? lookUp(name) : std::optional<std::int64_t>();
        if (!value)
            readable = tl::unexpected(value.error());
        return value.value_or(std::nullopt);
    });
    return readable ? Result<EffectiveField>(limited) : tl::unexpected(readable.error());
}

void Device::assume(const Field &field, std::int64_t raw)
{
    m_known[normalizedName(field.name)] = raw;
}

void Device::learn(const Field &field, std::int64_t raw)
{
    assume(field, raw);
    if (normalizedName(field.name) == u"statusreturnlevel")
        setTraits(static_cast<std::uint8_t>(raw));
}

Result<void> Device::follow(const Found &found)
{
    m_found = found;
    setTraits(m_statusReturnLevel);
    return enter();
}

Result<void> Device::enter()
{
    return m_bus.setBaudRate(m_found.baudRate);
}

Result<std::optional<std::int64_t>> Device::lookUp(QStringView name)
{
    const auto known = m_known.find(normalizedName(name));
    if (known != m_known.end())
        return known->second;
    const Field *field = m_table ? m_table->find(name) : nullptr;
    if (!field || isMute())
        return std::nullopt;
    const auto raw = read(*field);
    if (!raw && raw.error().kind != ErrorKind::Refused)
        return tl::unexpected(raw.error());
    return raw ? std::optional(*raw) : std::nullopt;
}

void Device::setTraits(std::uint8_t statusReturnLevel)
{
    m_statusReturnLevel = statusReturnLevel;
    Traits traits;
    traits.id = id();
    traits.baudRate = m_bus.line().baudRate();
    traits.statusReturnLevel = statusReturnLevel;
    traits.firmware = m_found.firmware;
    m_bus.addTraits(traits);
}

} // namespace dynascope::dxl
