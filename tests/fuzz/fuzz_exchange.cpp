// SPDX-License-Identifier: GPL-3.0-or-later
// Operations of every kind against a line whose answers the input dictates: each ends within a bounded time, and no
// value is returned as good unless a complete answer with it (CRC, ID, length, no error) came while the operation ran.
#include "core/bus/operations.h"
#include "core/bus/scan.h"
#include "tests/fuzz/dictatedline.h"
#include "tests/support/oracle.h"

using namespace dynascope;
using namespace std::chrono_literals;
using fuzz::must;

namespace {

constexpr Bytes::value_type Header[] = {0xFF, 0xFF, 0xFD, 0x00};

std::vector<std::size_t> headersIn(ByteView stream)
{
    std::vector<std::size_t> places;
    for (std::size_t at = 0; at + 11 <= stream.size(); ++at) {
        if (std::ranges::equal(stream.subspan(at, 4), Header) && stream[at + 7] == 0x55)
            places.push_back(at);
    }
    return places;
}

bool crcHolds(ByteView upToCrc)
{
    const ByteView covered = upToCrc.first(upToCrc.size() - 2);
    return oracle::crc(Bytes(covered.begin(), covered.end())) == littleEndian(upToCrc.last(2), 2);
}

/// Is there a whole ordinary status of `id` without error that carries these data, stuffed or sent unstuffed?
bool holdsStatus(ByteView stream, std::uint8_t id, const Bytes &data)
{
    Bytes plain{0x55, 0};
    plain.insert(plain.end(), data.begin(), data.end());
    for (const std::size_t at : headersIn(stream)) {
        const std::size_t size = 7 + littleEndian(stream.subspan(at + 5), 2);
        if (stream[at + 4] != id || size < 11 || at + size > stream.size() || !crcHolds(stream.subspan(at, size)))
            continue;
        Bytes body(stream.begin() + static_cast<std::ptrdiff_t>(at + 7),
                   stream.begin() + static_cast<std::ptrdiff_t>(at + size - 2));
        body[1] &= 0x7F; // an alert rides beside a good value
        if (body == oracle::stuff(plain) || body == plain)
            return true;
        // A sender may stuff one pattern and forget another: dropping any FD behind FF FF FD must lead there.
        std::size_t i = 0;
        for (std::size_t b = 0; b < body.size() && i <= plain.size(); ++b) {
            if (i < plain.size() && body[b] == plain[i])
                ++i;
            else if (body[b] != 0xFD)
                i = plain.size() + 1;
        }
        if (i == plain.size())
            return true;
    }
    return false;
}

/// Is there a fast reply with a block of `id` without error that carries these data, all CRCs up to it good?
bool holdsFastBlock(ByteView stream, std::uint8_t id, const Bytes &data)
{
    for (const std::size_t at : headersIn(stream)) {
        // Blocks of other lengths may stand before it (bulk): its place is wherever all bytes up to it check.
        for (std::size_t block = at + 8; stream[at + 4] == 0xFE && block + data.size() + 4 <= stream.size(); ++block) {
            if (stream[block + 1] == id && (stream[block] & 0x7F) == 0
                && std::ranges::equal(stream.subspan(block + 2, data.size()), data)
                && crcHolds(stream.subspan(at, block + data.size() + 4 - at)))
                return true;
        }
    }
    return false;
}

void mustHaveCome(ByteView stream, std::uint8_t id, const Bytes &data, std::size_t asked)
{
    must(data.size() == asked, "a value has the length that was asked for");
    must(holdsStatus(stream, id, data) || holdsFastBlock(stream, id, data), "a value returned as good has come");
}

std::vector<Span> spansFrom(fuzz::Input &input, bool same)
{
    std::vector<Span> spans;
    const std::uint16_t address = input.word() % 1200;
    const auto length = static_cast<std::uint16_t>(1 + input.byte());
    const int count = 1 + input.byte() % 8;
    for (int i = 0; i < count; ++i) {
        const auto id = static_cast<std::uint8_t>(i * 7 % 253);
        const auto own = static_cast<std::uint16_t>(address + i);
        spans.push_back(same ? Span{id, address, length}
                             : Span{id, own, static_cast<std::uint16_t>(1 + input.byte() % 40)});
    }
    return spans;
}

void readManyAndCheck(Bus &bus, fuzz::DictatedLine &line, const std::vector<Span> &spans)
{
    const auto values = readMany(bus, spans);
    const Bytes stream = line.takeDelivered();
    if (!values)
        return;
    must(values->size() == spans.size(), "every span has its entry");
    for (std::size_t i = 0; i < spans.size(); ++i) {
        if ((*values)[i])
            mustHaveCome(stream, spans[i].id, (*values)[i]->data, spans[i].length);
        else
            must(!(*values)[i].error().text.isEmpty(), "an error says something");
    }
}

void scanAndCheck(Bus &bus, fuzz::DictatedLine &line)
{
    const auto found = scanBaud(bus, {0, 40}, {});
    const Bytes stream = line.takeDelivered();
    for (const Found &device : found.value_or(BaudScan()).devices) {
        const Bytes data{std::uint8_t(device.modelNumber), std::uint8_t(device.modelNumber >> 8), device.firmware};
        must(device.id <= MaximumId, "only devices are found");
        if (!device.doubt.isEmpty() && device.modelNumber == 0) // somebody is there, but can't be read
            continue;
        mustHaveCome(stream, device.id, data, 3);
    }
}

void pingAndCheck(Bus &bus, fuzz::DictatedLine &line, std::uint8_t id)
{
    const auto reply = ping(bus, id);
    if (reply) {
        const Bytes data{std::uint8_t(reply->modelNumber), std::uint8_t(reply->modelNumber >> 8), reply->firmware};
        must(reply->id == id, "a Ping is answered by who was asked");
        mustHaveCome(line.takeDelivered(), id, data, 3);
    }
}

void act(Bus &bus, fuzz::DictatedLine &line, fuzz::Input &input)
{
    const std::uint8_t kind = input.byte();
    const std::uint8_t id = input.byte() % 253;
    const auto data = [&input, id] { return SpanData{id, input.word(), Bytes(1 + input.byte() % 200, 0xFF)}; };
    switch (kind % 14) {
    case 0: return pingAndCheck(bus, line, id);
    case 1: {
        const Span span{id, input.word(), static_cast<std::uint16_t>(1 + input.byte())};
        if (const auto reply = read(bus, span))
            mustHaveCome(line.takeDelivered(), id, reply->data, span.length);
        return;
    }
    case 2: (void)write(bus, data()); return;
    case 3: (void)regWrite(bus, data()); return;
    case 4: (void)action(bus, id); return;
    case 5: (void)factoryReset(bus, id, ResetOption::AllButIdAndBaud); return;
    case 6: (void)reboot(bus, id); return;
    case 7: (void)clear(bus, id, ClearOption::Position); return;
    case 8: (void)backup(bus, id, BackupOption::Store); return;
    case 9: return readManyAndCheck(bus, line, spansFrom(input, true));
    case 10: return readManyAndCheck(bus, line, spansFrom(input, false));
    case 11: {
        std::vector<SpanData> writes;
        for (const Span &span : spansFrom(input, kind & 16))
            writes.push_back({span.id, span.address, Bytes(span.length, 0x5A)});
        (void)writeMany(bus, writes);
        return;
    }
    case 12: {
        const SpanData written = data();
        if (const auto back = writeVerified(bus, written)) {
            must(*back == written.data, "what is verified is what was written");
            mustHaveCome(line.takeDelivered(), id, *back, written.data.size());
        }
        return;
    }
    default: return scanAndCheck(bus, line);
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    constexpr LineTime LongestOperation = 120s; // a scan in which every ID seems to be there and is asked again
    constexpr int MostOperations = 6;
    fuzz::Input input(data, size);
    fuzz::DictatedLine line(input);
    Bus bus(line);
    const std::uint8_t level = input.byte();
    std::vector<Traits> traits;
    for (int id = 0; id < 50; ++id) {
        Traits each;
        each.id = static_cast<std::uint8_t>(id);
        each.fastReads = level & 4;
        each.statusReturnLevel = level % 4 % 3;
        traits.push_back(each);
    }
    bus.setTraits(std::move(traits));
    for (int i = 0; i < MostOperations && !input.isEmpty(); ++i) {
        (void)line.takeDelivered();
        const LineTime begin = line.now();
        act(bus, line, input);
        must(line.now() - begin < LongestOperation, "every operation ends");
    }
    return 0;
}
