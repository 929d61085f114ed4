// SPDX-License-Identifier: GPL-3.0-or-later
// Anything typed: as the value of a register, as an argument of dxl, as a list of simulated servos. It is refused with
// a sentence, or what it means is within bounds. Two bytes choose model and register, one the registers that decide on
// its unit and range; the rest is the text.
#include "app/dxl/arguments.h"
#include "app/dxl/composepacket.h"
#include "app/dxl/packettext.h"
#include "core/protocol/parser.h"
#include "core/protocol/protocol_values.h"
#include "core/sim/simulatedbus.h"
#include "core/table/catalog.h"
#include "core/table/units.h"
#include "tests/fuzz/fuzzinput.h"

#include <cmath>

using namespace dynascope;
using fuzz::must;

namespace {

template <typename T>
bool accepted(const Result<T> &result)
{
    must(result || !result.error().text.isEmpty(), "a refusal says something");
    return result.has_value();
}

void asValue(const Catalog &catalog, fuzz::Input &input, const QString &text, int decider)
{
    const auto models = catalog.models();
    const auto &model = models[input.byte() % models.size()];
    const ControlTablePtr table = catalog.find(model.modelNumber, model.newestFirmware);
    const auto fields = table->fields();
    const Field &field = fields[input.byte() % fields.size()];
    const EffectiveField now = effective(field, [&](QStringView name) -> std::optional<std::int64_t> {
        if (name == u"Drive Mode" || name == u"Operating Mode")
            return decider % 17;
        const Field *other = table->find(name);
        return other && decider < 128 ? other->initial : std::nullopt;
    });
    for (const AngleUnit angle : {AngleUnit::Degrees, AngleUnit::Radians, AngleUnit::Pulses}) {
        const auto raw = parseValue(field, now, table->resolution(), text, angle);
        if (!accepted(raw))
            continue;
        must(*raw >= smallestRaw(field) && *raw <= largestRaw(field), "an accepted value fits its register");
        must(!now.minimum || *raw >= *now.minimum, "an accepted value is not below the range");
        must(!now.maximum || *raw <= *now.maximum, "an accepted value is not above the range");
        must(rawFromBytes(field, bytesFromRaw(field, *raw)) == *raw, "an accepted value survives the wire");
        const auto again = parseValue(field, now, table->resolution(), QString::number(*raw), angle);
        must(again && *again == *raw, "its raw number means the same");
        const Physical shown = physical(now, table->resolution(), *raw, angle);
        must(std::isfinite(shown.value), "an accepted value can be shown");
    }
}

void asArgument(const Catalog &catalog, const QString &text)
{
    const auto fits = [](const dxl::RegisterArgument &argument) {
        return !argument.isByAddress() || (argument.address >= 0 && argument.address + argument.length <= 0x10000);
    };
    if (const auto argument = dxl::parseRegister(text); accepted(argument))
        must(fits(*argument), "an address is on the device");
    if (const auto argument = dxl::parseAssignment(text); accepted(argument)) {
        must(fits(*argument) && !argument->value.isEmpty(), "an assignment says what to write where");
        if (argument->isByAddress()) {
            const auto bytes = dxl::parseRawValue(*argument);
            must(!accepted(bytes) || bytes->size() == static_cast<std::size_t>(argument->length),
                 "a raw value has as many bytes as were named");
        }
    }
    if (const auto bauds = dxl::parseBauds(text, {57600}); accepted(bauds))
        must(!bauds->empty() && std::ranges::min(*bauds) > 0, "baud rates are positive");
    if (const auto ids = dxl::parseIds(text); accepted(ids))
        must(ids->first >= 0 && ids->first <= ids->last && ids->last <= MaximumId, "IDs are those of devices");
    if (const auto specs = sim::parseServoSpecs(text, catalog); accepted(specs)) {
        for (const sim::ServoSpec &spec : *specs)
            must(catalog.model(spec.model) && spec.id >= 0 && spec.id <= MaximumId, "simulated servos can be");
    }
}

void asPacket(const QString &text)
{
    if (const auto packet = dxl::composePacket(text.split(u' ', Qt::SkipEmptyParts)); accepted(packet)) {
        Parser parser;
        parser.feed(*packet);
        const auto event = parser.next();
        must(event && std::holds_alternative<Parser::Packet>(*event), "what is composed is a packet");
        must(!dxl::PacketText().describe(*packet).isEmpty(), "and can be described");
    }
    for (const bool raw : {false, true}) {
        const auto packet = dxl::packetFromHex(text, raw);
        if (accepted(packet)) {
            must(!packet->empty() && packet->size() <= MaximumPacketSize, "bytes that a device can take");
            must(!dxl::PacketText().describe(*packet).isEmpty(), "whatever they are can be described");
        }
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    static const Catalog catalog = Catalog::builtIn().value();
    fuzz::Input chooser(data, std::min<std::size_t>(size, 2));
    fuzz::Input input(data + std::min<std::size_t>(size, 2), size - std::min<std::size_t>(size, 2));
    const int decider = input.byte();
    const Bytes typed = input.rest();
    const QString text =
        QString::fromUtf8(reinterpret_cast<const char *>(typed.data()), static_cast<qsizetype>(typed.size()));
    asValue(catalog, chooser, text, decider);
    asArgument(catalog, text);
    asPacket(text);
    return 0;
}
