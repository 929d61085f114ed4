// SPDX-License-Identifier: GPL-3.0-or-later
// Torque and LED: one register of each device, written together and read back.
#include "app/dxl/commands.h"
#include "app/dxl/directjob.h"
#include "app/dxl/noting.h"
#include "app/dxl/showvalue.h"
#include "app/dxl/target.h"
#include "core/bus/operations.h"
#include "core/session/deviceplace.h"

namespace dynascope::dxl {

namespace {

struct Switch {
    Device *device = nullptr;
    const Field *field = nullptr;
    SpanData data;
    std::vector<const Field *> affected = {}; ///< goals, by torque that comes on
    std::vector<PollValue> before = {};
    JournalNote note = {};

    std::vector<Span> spans(bool itself) const
    {
        std::vector<const Field *> fields = affected;
        if (itself)
            fields.push_back(field);
        return spansOf(*device->table(), device->id(), among(std::move(fields)));
    }
};

/// Torque off waits for no Read.
void noteOld(const Work &work, Switch &one)
{
    const bool isOff = work.options.command == Command::Torque && !work.options.on;
    DirectJob job(work.bus);
    if (!isOff && !one.device->isMute()) {
        one.affected = affectedBy(*one.device, *one.field);
        if (auto read = readSpans(job, {placeOf(one.device->found(), *one.device->table(), {}), one.spans(true)}))
            one.before = std::move(*read);
    }
    one.note = noteWrite(work, *one.device, {changeOf(*one.field, one.data.data)}, one.affected);
}

/// Models with a coloured LED have one register for each colour.
const Field *ledOf(const ControlTable &table)
{
    const Field *led = table.find(Known::Led);
    return led ? led : table.find(u"LED Red");
}

Result<Switch> switchOf(Device &device, const Options &options)
{
    const bool isTorque = options.command == Command::Torque;
    const ControlTable *table = device.table();
    const Field *field = !table ? nullptr : isTorque ? table->find(Known::TorqueEnable) : ledOf(*table);
    if (!field) {
        const QString what = isTorque ? QStringLiteral("Torque Enable") : QStringLiteral("LED");
        return failure(ErrorKind::NotSupported,
                       QStringLiteral("%1: it isn't known where it has its %2").arg(device.name(), what));
    }
    const std::int64_t raw = options.on ? 1 : 0;
    Switch one;
    one.device = &device;
    one.field = field;
    one.data = {device.id(), field->address, bytesFromRaw(*field, raw)};
    return one;
}

/// Reads back what was written to all, and writes by itself where that does not show.
Result<void> confirm(const Work &work, Switch &one, ExitCode &code)
{
    RegisterArgument argument;
    argument.field = one.field->name;
    if (one.device->isMute()) {
        if (const auto sent = write(work.bus, one.data); !sent) {
            one.note.failed(sent.error());
            return sent;
        }
        JournalEntry outcome = one.note.entry();
        outcome.state = JournalState::Unconfirmed;
        one.note.finish(outcome);
        showSent(work.output, *one.device, one.field, argument, one.data.data);
        code = code == ExitCode::Done ? ExitCode::Unconfirmed : code;
        return {};
    }
    auto shown = one.device->read(one.data.address, one.field->size);
    if (!shown || *shown != one.data.data)
        shown = writeVerified(work.bus, one.data);
    if (shown) {
        std::vector<PollValue> after(1);
        after.front().address = one.data.address;
        after.front().data = *shown;
        DirectJob job(work.bus);
        if (auto read = readSpans(job, {placeOf(one.device->found(), *one.device->table(), {}), one.spans(false)}))
            after.insert(after.end(), read->begin(), read->end());
        one.note.done(one.before, after);
        showField(work.output, *one.device, *one.field, rawFromBytes(*one.field, *shown));
        return {};
    }
    one.note.failed(shown.error(), one.before);
    if (endsAll(shown.error()))
        return tl::unexpected(shown.error());
    code = showFailure(work.output, *one.device, argument, shown.error());
    return {};
}

} // namespace

ExitCode switchCommand(const Work &work)
{
    Targets targets = findTargets(work, 1);
    // Whoever answers is let go; torque goes on only where everybody is there.
    const bool all = work.options.command == Command::Torque && work.options.on;
    if (targets.ended || (all && !targets.areAll())) {
        if (!targets.devices.empty())
            work.output.note(QStringLiteral("nothing was written, since not everybody answered"));
        return targets.code;
    }
    ExitCode code = targets.code;
    std::vector<Switch> switches;
    std::vector<SpanData> writes;
    for (Device &device : targets.devices) {
        const auto one = switchOf(device, work.options);
        if (!one) {
            showDeviceFailure(work, device.id(), one.error());
            code = ExitCode::Failed;
            continue;
        }
        switches.push_back(*one);
        writes.push_back(one->data);
    }
    const auto noteAll = [&] {
        for (Switch &one : switches)
            noteOld(work, one);
    };
    const bool isOff = work.options.command == Command::Torque && !work.options.on;
    if (!isOff || writes.size() < 2)
        noteAll();
    if (writes.size() > 1) { // at once, not one joint after the other
        if (const auto sent = writeMany(work.bus, writes); !sent)
            return work.output.fail(sent.error());
        if (isOff) // it waits for no file either
            noteAll();
    }
    for (Switch &one : switches) {
        if (const auto done = confirm(work, one, code); !done)
            return work.output.fail(done.error());
    }
    return code;
}

} // namespace dynascope::dxl
