// SPDX-License-Identifier: GPL-3.0-or-later
// Any file as a control table, alone and as one that extends those of the program: it is refused with a sentence, or
// every table it gives is fit for use.
#include "core/table/catalog.h"
#include "core/table/jsonguard.h"
#include "core/table/units.h"
#include "tests/fuzz/fuzzinput.h"

using namespace dynascope;
using fuzz::must;

namespace {

void use(const ControlTable &table, const Field &field)
{
    const RegisterLookup initial = [&](QStringView name) -> std::optional<std::int64_t> {
        const Field *other = table.find(name);
        return other ? other->initial : std::nullopt;
    };
    const EffectiveField now = effective(field, initial);
    for (const std::int64_t raw : {smallestRaw(field), std::int64_t(0), largestRaw(field), field.initial.value_or(1)}) {
        (void)valueText(field, now, table.resolution(), raw);
        (void)checkRange(field, now, raw, table.resolution(), AngleUnit::Degrees);
        const Bytes bytes = bytesFromRaw(field, raw);
        must(bytes.size() == field.size, "a value fills its register");
    }
    for (const std::int64_t raw : {smallestRaw(field), largestRaw(field)})
        must(rawFromBytes(field, bytesFromRaw(field, raw)) == raw, "bytes hold every value");
}

void use(const ControlTable &table)
{
    int end = 0;
    for (const Field &field : table.fields()) {
        must(field.size == 1 || field.size == 2 || field.size == 4, "a register has 1, 2 or 4 bytes");
        must(field.address >= end, "registers are in order and don't overlap");
        end = field.end();
        must(table.find(field.name) == &field, "a register is found by its name");
        must(table.at(field.address) == &field, "a register is found by its address");
        use(table, field);
    }
    must(table.size() == end, "the table ends with its last register");
}

void add(Catalog catalog, const QByteArray &json)
{
    const std::size_t before = catalog.models().size();
    const auto added = catalog.add(json, QStringLiteral("fuzz.json"));
    if (!added) {
        must(!added.error().text.isEmpty(), "a refusal says something");
        must(catalog.models().size() == before, "what is refused changes nothing");
        return;
    }
    for (const Catalog::ModelInfo &model : catalog.models()) {
        for (const int firmware : {0, model.newestFirmware, 255}) {
            const ControlTablePtr table = catalog.find(model.modelNumber, firmware);
            must(table != nullptr, "a model has a table at every firmware");
            if (catalog.models().size() <= before + 8)
                use(*table);
        }
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    static const Catalog known = Catalog::builtIn().value();
    const QByteArray json(reinterpret_cast<const char *>(data), static_cast<qsizetype>(size));
    add(known, json);
    if (!json.contains("extends"))
        add(Catalog(), json);
    return 0;
}
