// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/watchedfields.h"

#include "app/dxl/showvalue.h"
#include "core/table/units.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace dynascope::dxl {

namespace {

bool isBareNumber(const EffectiveField &units)
{
    return units.unit == Unit::None && units.scale == 1.0;
}

QByteArray csvCell(const WatchedField &field, std::int64_t raw)
{
    if (isBareNumber(field.units))
        return QByteArray::number(qint64(raw));
    const Physical value = physical(field.units, field.device->table()->resolution(), raw);
    return QByteArray::number(value.value, 'f', value.decimals);
}

/// Without a value where it was not read: who is silent is asked rarely.
std::optional<std::int64_t> valueIn(const Batch &batch, std::size_t index, const Field &field)
{
    const auto value = std::ranges::find(batch.values, static_cast<quint32>(index), &PollValue::device);
    if (value == batch.values.end() || value->data.empty())
        return std::nullopt;
    return rawFromBytes(field, value->data);
}

Document valueDocument(const WatchedField &field, std::optional<std::int64_t> raw)
{
    if (raw)
        return fieldDocument(*field.device, *field.field, field.units, *raw);
    Document document;
    return document.add("id", qint64(field.device->id()))
        .add("field", field.field->name)
        .add("address", qint64(field.field->address))
        .add("error", field.error.text);
}

} // namespace

QString WatchedField::name() const
{
    return nameDevice ? QStringLiteral("ID %1: %2").arg(QString::number(device->id()), field->name) : field->name;
}

Result<void> addWatched(Device &device, const Options &options, bool nameDevice, std::vector<WatchedField> &fields)
{
    for (const RegisterArgument &argument : options.registers) {
        if (argument.isByAddress()) {
            return failure(
                ErrorKind::InvalidArgument,
                QStringLiteral("%1: watch takes fields by their name, whose units it knows").arg(argument.text()));
        }
        const auto field = device.field(argument.field);
        if (!field)
            return tl::unexpected(field.error());
        fields.push_back({&device, *field, device.units(**field), nameDevice, {}});
    }
    return {};
}

PollPlan planOf(Bus &bus, const std::vector<WatchedField> &fields)
{
    PollPlan plan;
    std::vector<bool> known(256, false);
    for (std::size_t i = 0; i < fields.size(); ++i) {
        const WatchedField &one = fields[i];
        plan.spans.push_back({static_cast<quint32>(i), {one.device->id(), one.field->address, one.field->size}, {}});
        if (!known[one.device->id()])
            plan.traits.push_back(bus.traits(one.device->id()));
        known[one.device->id()] = true;
    }
    return plan;
}

QByteArray csvHeading(const std::vector<WatchedField> &fields)
{
    QString text = QStringLiteral("time_s");
    for (const WatchedField &field : fields) {
        const QString unit = unitId(field.units.unit);
        text += u',' + field.name() + (unit.isEmpty() ? QString() : QStringLiteral(" [%1]").arg(unit));
    }
    return text.toUtf8();
}

QByteArray sampleLine(const Options &options, const std::vector<WatchedField> &fields, const Batch &batch, double time)
{
    QByteArray text = QByteArray::number(time, 'f', 4);
    std::vector<Document> values;
    for (std::size_t i = 0; i < fields.size(); ++i) {
        const WatchedField &field = fields[i];
        const std::optional<std::int64_t> raw = valueIn(batch, i, *field.field);
        if (options.json) {
            values.push_back(valueDocument(field, raw));
        } else if (options.csv) {
            text += ',' + (raw ? csvCell(field, *raw) : QByteArray());
        } else {
            const int resolution = field.device->table()->resolution();
            const QString shown = raw ? valueText(*field.field, field.units, resolution, *raw) : QStringLiteral("-");
            text += QStringLiteral("  %1 = %2").arg(field.name(), shown).toUtf8();
        }
    }
    if (!options.json)
        return text;
    Document document;
    document.add("time_s", std::round(time * 1e4) / 1e4).add("values", values);
    return document.toJson().replace("\n ", ""); // one line
}

} // namespace dynascope::dxl
