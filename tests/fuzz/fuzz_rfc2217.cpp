// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes from a server, in any pieces: the same data, answers and state, no more data than came, at most one answer
// per option and direction, no rate that wasn't asked for. And what is escaped comes back as it was. The first byte
// chooses the pieces, the second whether a rate has been asked for; the rest is the stream.
#include "core/bus/rfc2217.h"
#include "tests/fuzz/fuzzinput.h"

using namespace dynascope;
using fuzz::must;

namespace {

struct Heard {
    Rfc2217 client;
    Bytes data;
    Bytes answer;
};

Heard hear(const Bytes &stream, std::size_t piece, bool asked)
{
    Heard heard;
    if (asked)
        (void)heard.client.requestRate(57600);
    for (std::size_t at = 0; at < stream.size(); at += piece) {
        const ByteView part = ByteView(stream).subspan(at, std::min(piece, stream.size() - at));
        heard.client.feed(part, heard.data, heard.answer);
    }
    return heard;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    constexpr std::size_t MostAnswers = std::size_t(3) * 256 * 2;
    fuzz::Input input(data, size);
    const std::size_t piece = 1 + input.byte() % 40;
    const bool asked = input.byte() & 1;
    const Bytes stream = input.rest();
    const Heard whole = hear(stream, stream.size() + 1, asked);
    const Heard pieces = hear(stream, piece, asked);
    must(whole.data == pieces.data && whole.answer == pieces.answer, "any pieces give the same");
    must(whole.client.agreement() == pieces.client.agreement()
             && whole.client.confirmedRate() == pieces.client.confirmedRate(),
         "any pieces lead to the same state");
    must(whole.data.size() <= stream.size(), "no data is invented");
    must(whole.answer.size() <= MostAnswers, "no option is answered twice");
    must(asked || !whole.client.confirmedRate(), "no rate is confirmed that wasn't asked for");

    const Heard back = hear(Rfc2217::escaped(stream), piece, false);
    must(back.data == stream && back.answer.empty(), "what is escaped comes back");
    return 0;
}
