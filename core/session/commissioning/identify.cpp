// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/commissioning/identify.h"

#include "core/session/deviceplace.h"
#include "core/session/journal/journalwrites.h"
#include "core/session/procedures/atbaud.h"
#include "core/session/texts.h"

namespace dynascope {
namespace {

std::vector<const Field *> ledsOf(const ControlTable &table)
{
    std::vector<const Field *> leds;
    for (const char16_t *name : {u"LED", u"LED Red", u"LED Green", u"LED Blue"}) {
        const Field *led = table.find(QStringView(name));
        if (led && led->isWritable())
            leds.push_back(led);
    }
    return leds;
}

Result<void> light(JobContext &context, const Found &device, const ControlTable &table, const Field &led, bool on,
                   const CommissionHooks &hooks)
{
    const std::int64_t most = led.maximum.number.value_or(1);
    const std::int64_t raw = on ? most : 0;
    const CommissionWrite write{device, changeOf(led, raw)};
    if (hooks.begun)
        hooks.begun(write);
    WriteFieldPlan plan{placeOf(device, table, table.model()),
                        {device.id, led.address, bytesFromRaw(led, raw)},
                        {}};
    plan.before = {{device.id, led.address, led.size}};
    const auto written = writeField(context, plan);
    const auto after = written ? written->after : tl::unexpected(written.error());
    if (hooks.ended) {
        CommissionWritten outcome;
        if (after)
            outcome.after = *after;
        else
            outcome.error = after.error();
        if (written)
            outcome.before = written->before;
        hooks.ended(write, outcome);
    }
    return after ? Result<void>() : tl::unexpected(after.error());
}

} // namespace

bool hasLed(const ControlTable &table)
{
    return !ledsOf(table).empty();
}

Result<void> identifyByLed(JobContext &context, const Found &device, const ControlTable &table,
                           const CommissionHooks &hooks)
{
    constexpr int Slices = 15;
    const std::vector<const Field *> leds = ledsOf(table);
    if (leds.empty())
        return failure(ErrorKind::NotSupported,
                       CommissioningText::tr("%1 has no LED to be told by").arg(table.model()));
    for (const Field *led : leds) {
        if (const auto lit = light(context, device, table, *led, true, hooks); !lit)
            return lit;
    }
    for (int i = 0; i < Slices; ++i) {
        if (const auto waited = context.bus().wait(std::chrono::milliseconds(100)); !waited)
            return waited;
        if (const auto go = context.checkpoint(); !go)
            return go;
    }
    for (const Field *led : leds) {
        if (const auto out = light(context, device, table, *led, false, hooks); !out)
            return out;
    }
    return {};
}

} // namespace dynascope
