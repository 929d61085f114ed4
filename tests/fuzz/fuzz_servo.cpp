// SPDX-License-Identifier: GPL-3.0-or-later
// A hostile controller: any bytes and any well-formed instructions, at any rate and moment, to simulated servos.
// Nothing hangs, a servo keeps an ID, and one servo left to finish its answers says only well-formed status packets.
#include "core/protocol/parser.h"
#include "core/sim/packetassembler.h"
#include "core/sim/servo.h"
#include "core/sim/simulatedbus.h"
#include "tests/fuzz/fuzzinput.h"
#include "tests/support/oracle.h"

using namespace dynascope;
using namespace std::chrono_literals;
using fuzz::must;

namespace {

constexpr int Rates[] = {57600, 1'000'000, 4'000'000, 9600};
constexpr std::uint8_t Codes[] = {0x01, 0x02, 0x03, 0x04, 0x05, 0x06, 0x08, 0x10,
                                  0x20, 0x82, 0x83, 0x8A, 0x92, 0x93, 0x9A, 0x55};

/// What the pty server does with bytes that come in pieces: none is lost, none is made.
void assemble(const Bytes &bytes, std::size_t piece)
{
    sim::PacketAssembler assembler;
    Bytes out;
    LineTime now{};
    const auto drain = [&] {
        while (const auto packet = assembler.next(now)) {
            must(!packet->empty(), "a piece has bytes");
            out.insert(out.end(), packet->begin(), packet->end());
        }
    };
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
        assembler.feed(ByteView(bytes).subspan(at, std::min(piece, bytes.size() - at)), now);
        drain();
        now += 1ms;
    }
    while (const auto due = assembler.deadline()) {
        now = *due;
        const std::size_t before = out.size();
        drain();
        must(out.size() > before, "waiting for the rest of a packet ends");
    }
    must(out == bytes, "what comes in pieces goes on whole");
}

struct Controller {
    sim::SimulatedBus &bus;
    LineTime now{};
    int baudRate = 57600;
    Bytes heard = {};
    bool askedFast = false; ///< perhaps: one whose reply is cut off where a device listed is missing

    void send(const Bytes &bytes)
    {
        askedFast = askedFast
            || std::ranges::any_of(bytes, [](std::uint8_t byte) { return byte == 0x8A || byte == 0x9A; });
        bus.send(bytes, now, baudRate);
        now += static_cast<LineTime::rep>(bytes.size()) * LineTime(10'000'000'000LL / baudRate);
    }
    /// Until nothing more is to come.
    void listen()
    {
        int steps = 0;
        bus.receive(heard, now, baudRate);
        while (const auto next = bus.nextArrival()) {
            must(*next > now, "what is to come is not past");
            now = *next;
            bus.receive(heard, now, baudRate);
            must(++steps < 1'000'000, "an answer ends");
        }
    }
};

void mustBeWellFormed(const Bytes &heard)
{
    Parser parser;
    parser.feed(heard);
    std::size_t packets = 0;
    while (const auto event = parser.next()) {
        const auto *packet = std::get_if<Parser::Packet>(&*event);
        must(packet && packet->isStatus() && !packet->forgotStuffing, "a servo says status packets only");
        packets += packet->raw.size();
    }
    must(packets == heard.size(), "a servo says whole packets only");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    constexpr int MostActs = 40;
    static const Catalog catalog = Catalog::builtIn().value();
    fuzz::Input input(data, size);
    const bool alone = input.byte() & 1;
    sim::SimulatedBus bus(catalog);
    must(bus.add({QStringLiteral("XM430-W350"), -1, 57600, 1}).has_value(), "a servo");
    if (!alone) {
        must(bus.add({QStringLiteral("XL330-M288"), -1, 57600, 2}).has_value(), "a second servo");
        must(bus.add({QStringLiteral("XL430-W250"), -1, 1'000'000, 1}).has_value(), "a third servo");
    }
    Controller controller{bus};
    controller.now = 2s; // everybody has booted
    bus.advanceTo(controller.now);
    for (int i = 0; i < MostActs && !input.isEmpty(); ++i) {
        const std::uint8_t act = input.byte();
        const bool hurries = act & 0x80; // into the answer
        switch (act % 6) {
        case 0: {
            const Bytes bytes = input.bytes(input.byte());
            assemble(bytes, 1 + act / 6);
            controller.send(bytes);
            break;
        }
        case 1: case 2: case 3: {
            const std::uint8_t id = input.byte();
            const std::uint8_t code = Codes[input.byte() % std::size(Codes)];
            const Bytes packet = oracle::instruction(id, code, input.bytes(input.byte() % 80));
            controller.send(packet);
            break;
        }
        case 4: controller.now += input.byte() * (hurries ? 10us : 4000us); break;
        case 5:
            if (!alone)
                controller.baudRate = Rates[input.byte() % std::size(Rates)];
            break;
        }
        if (alone || !hurries)
            controller.listen();
    }
    controller.listen();
    for (const auto &servo : bus.servos())
        must(servo->id() >= 0 && servo->id() <= MaximumId, "a servo keeps an ID");
    if (alone && !controller.askedFast)
        mustBeWellFormed(controller.heard);
    return 0;
}
