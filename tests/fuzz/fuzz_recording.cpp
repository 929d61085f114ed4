// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as a recording: refused with a sentence that names the file, or it is read to its end, and every batch of it
// is what the header says it can be.
#include "core/record/jsonsample.h"
#include "core/record/recording.h"
#include "tests/fuzz/fuzzinput.h"

#include <QBuffer>

using namespace dynascope;
using fuzz::must;

namespace {

void check(const RecordedBatch &batch, const RecordingHeader &header)
{
    for (const RecordedReply &reply : batch.replies) {
        must(header.device(reply.device) != nullptr, "a reply is of a device of the header");
        must(reply.data.empty() || reply.data.size() == reply.length, "a reply is whole or none");
        must(reply.address + reply.length <= 0x10000, "registers have addresses of two bytes");
    }
    for (const PollValue &value : batchOf(batch, header).values)
        must(value.data.empty() || value.data.size() == value.length, "a value is whole or none");
    (void)jsonSamples(batch, header, 1000);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    auto file = std::make_unique<QBuffer>();
    file->setData(reinterpret_cast<const char *>(data), static_cast<int>(size));
    file->open(QIODevice::ReadOnly);
    const auto recording = Recording::open(std::move(file), QStringLiteral("f"));
    if (!recording) {
        must(recording.error().text.startsWith(u"f: "), "a refusal names the file");
        return 0;
    }
    must((*recording)->begin() <= (*recording)->end(), "it begins before it ends");
    ReplaySource source(**recording);
    std::size_t batches = 0;
    while (const auto batch = source.next()) {
        check(*batch, (*recording)->header());
        must(++batches <= 1'000'000, "it has an end");
    }
    source.seek((*recording)->begin() + ((*recording)->end() - (*recording)->begin()) / 2);
    (void)source.next();
    return 0;
}
