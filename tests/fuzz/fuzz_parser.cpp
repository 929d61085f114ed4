// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes in any pieces: the parser tells the same events, every packet it tells stood in the stream with a good CRC,
// and no byte is counted twice. The first byte chooses the pieces, the rest is the stream.
#include "core/protocol/parser.h"
#include "tests/fuzz/fuzzinput.h"
#include "tests/support/oracle.h"

using namespace dynascope;
using fuzz::must;

namespace {

/// Events as bytes, to be compared.
struct Told {
    std::vector<Bytes> events;
    std::size_t packetBytes = 0;

    void add(const Parser::Event &event)
    {
        if (const auto *packet = std::get_if<Parser::Packet>(&event)) {
            Bytes text{'P', packet->id, static_cast<std::uint8_t>(packet->instruction), packet->errorField,
                       std::uint8_t(packet->forgotStuffing)};
            text.insert(text.end(), packet->parameters.begin(), packet->parameters.end());
            text.insert(text.end(), packet->raw.begin(), packet->raw.end());
            events.push_back(std::move(text));
            packetBytes += packet->raw.size();
            const Bytes covered(packet->raw.begin(), packet->raw.end() - 2);
            must(littleEndian(ByteView(packet->raw).last(2), 2) == oracle::crc(covered), "a packet's CRC is good");
        } else if (const auto *damaged = std::get_if<Parser::Damaged>(&event)) {
            Bytes text{'D'};
            text.insert(text.end(), damaged->raw.begin(), damaged->raw.end());
            events.push_back(std::move(text));
        } else {
            Bytes text{'N'};
            appendLittleEndian(text, static_cast<std::uint32_t>(std::get<Parser::Noise>(event).bytes), 4);
            events.push_back(std::move(text));
        }
    }
};

Told parse(const Bytes &stream, unsigned pieces)
{
    Parser parser;
    Told told;
    const auto drain = [&] {
        while (const auto event = parser.next())
            told.add(*event);
    };
    unsigned state = pieces;
    for (std::size_t at = 0; at < stream.size();) {
        state = state * 1103515245U + 12345U;
        const std::size_t wanted = pieces == 0 ? stream.size() : 1 + (state >> 16) % pieces;
        const std::size_t size = std::min(wanted, stream.size() - at);
        parser.feed(ByteView(stream).subspan(at, size));
        drain();
        at += size;
    }
    while (!parser.buffered().empty()) {
        const std::size_t before = parser.buffered().size();
        parser.giveUp();
        drain();
        must(parser.buffered().size() < before, "giving up leads on");
    }
    must(told.packetBytes + parser.noiseBytes() <= stream.size(), "no byte is counted twice");
    return told;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    fuzz::Input input(data, size);
    const unsigned pieces = 1 + input.byte() % 40;
    const Bytes stream = input.rest();
    must(parse(stream, 0).events == parse(stream, pieces).events, "any pieces give the same events");
    return 0;
}
