// SPDX-License-Identifier: GPL-3.0-or-later
// Anything as a bus file, as faults, as lines of a control channel: it is refused with a sentence, or what it makes works.
#include "core/sim/busplan.h"
#include "core/sim/control.h"
#include "core/sim/faulttext.h"
#include "tests/fuzz/fuzzinput.h"

using namespace dynascope;
using namespace dynascope::sim;
using namespace std::chrono_literals;
using fuzz::must;

namespace {

void asBusFile(const QByteArray &text, const Catalog &catalog)
{
    const auto plan = readBusPlan(text, QStringLiteral("fuzz.yaml"), catalog);
    if (!plan) {
        must(plan.error().text.startsWith(QStringLiteral("fuzz.yaml:")), "a refusal says where");
        return;
    }
    must(!plan->devices.empty(), "a bus has devices");
    if (const auto bus = makeBus(*plan, catalog))
        (*bus)->advanceTo(20ms);
}

void asLines(const QByteArray &text, const Catalog &catalog)
{
    SimulatedBus bus(catalog);
    must(bus.add({QStringLiteral("XM430-W350"), -1, 57600, 1}).has_value(), "a bus can be made");
    Control control;
    LineTime now{};
    int lines = 0;
    for (const QByteArray &line : text.split('\n')) {
        if (++lines > 20)
            break;
        bus.advanceTo(now += 5ms);
        const QByteArray answer = control.obey(line, bus, now);
        must(!answer.isEmpty() && !answer.contains('\n'), "one line is answered by one line");
    }
    bus.advanceTo(now + 20ms);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    static const Catalog catalog = Catalog::builtIn().value();
    const QByteArray text(reinterpret_cast<const char *>(data), static_cast<qsizetype>(size));
    asBusFile(text, catalog);
    asLines(text, catalog);
    const auto faults = parseFaults(QString::fromUtf8(text));
    must(faults || !faults.error().text.isEmpty(), "a refusal says something");
    return 0;
}
