// SPDX-License-Identifier: GPL-3.0-or-later
// Any text as what the program keeps between two runs: refused with a sentence, or it means the same once written anew.
// A byte: a line of the journal or a plan of moves; then the text.
#include "core/session/journal/journalentry.h"
#include "core/session/procedures/moveplan.h"
#include "tests/fuzz/fuzzinput.h"

using namespace dynascope;
using fuzz::must;

namespace {

void readEntry(const QByteArray &text)
{
    const Result<JournalEntry> entry = journalEntryFromJson(text);
    if (!entry) {
        must(!entry.error().text.isEmpty(), "a refusal has a reason");
        return;
    }
    const QByteArray line = toJson(*entry);
    must(!line.contains('\n'), "an entry is one line");
    const Result<JournalEntry> again = journalEntryFromJson(line);
    must(again && *again == *entry, "an entry is read as it was written");
}

void readPlan(const QByteArray &text)
{
    const Result<MovePlan> plan = movePlanFromJson(text);
    if (!plan) {
        must(!plan.error().text.isEmpty(), "a refusal has a reason");
        return;
    }
    const QByteArray json = toJson(*plan);
    const Result<MovePlan> again = movePlanFromJson(json);
    must(again && toJson(*again) == json, "a plan is read as it was written");
    must(plan->next <= plan->steps.size(), "the next step is one of the plan, or the end");
    for (const MoveStep &step : plan->steps)
        must(step.device < plan->devices.size(), "a step is of a device of the plan");
    for (std::size_t device = 0; device < plan->devices.size(); ++device)
        (void)plan->placeOf(device);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    if (size == 0)
        return 0;
    const QByteArray text(reinterpret_cast<const char *>(data) + 1, static_cast<qsizetype>(size - 1));
    if ((data[0] & 1) != 0)
        readPlan(text);
    else
        readEntry(text);
    return 0;
}
