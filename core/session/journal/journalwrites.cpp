// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/journal/journalwrites.h"

#include "core/bus/scan.h"
#include "core/bus/usbidentity.h"
#include "core/session/linesession.h"

#include <QFileInfo>

#include <algorithm>

namespace dynascope {
namespace {

constexpr int LargestGap = 8; ///< bytes that are cheaper to read through than to ask again

} // namespace

JournalDevice journalDevice(const Found &found, const QString &model, const QString &line)
{
    // A link may stand for the port: /dev/serial/by-id/...
    const QString port = line.startsWith(u'/') ? QFileInfo(QFileInfo(line).canonicalFilePath()).fileName() : QString();
    return {line,           port.isEmpty() ? QString() : usbIdentity(port).identity,
            model,          found.modelNumber,
            found.firmware, found.id,
            found.baudRate};
}

JournalDevice journalDevice(const Device &device)
{
    return journalDevice(device.found(), device.model(), device.line() ? device.line()->name() : QString());
}

bool isGoalName(QStringView name)
{
    return name.startsWith(QLatin1String("Goal ")) || name == u"Moving Speed"; // the latter: XL-320
}

bool isGoal(const Field &field)
{
    return isGoalName(field.name);
}

bool isIndirectData(const Field &field)
{
    return field.name.startsWith(QLatin1String("Indirect Data"));
}

std::vector<const Field *> affectedBy(const ControlTable &table, const Field &field, bool torqueByGoal)
{
    const Field *torque = table.find(Known::TorqueEnable);
    const bool throughOther = isIndirectData(field);
    const bool wakes = throughOther || (isGoal(field) && torqueByGoal);
    // Mode, direction and offset move the goals, too; of other EEPROM no manual says it for all models.
    const bool moves = wakes || &field == torque || field.area == Area::Eeprom || !field.resets.isEmpty();
    std::vector<const Field *> affected;
    for (const Field &other : table.fields()) {
        if (&other == &field || !other.isWritable())
            continue;
        if (field.resets.contains(other.name) || (moves && isGoal(other)) || (wakes && &other == torque))
            affected.push_back(&other);
    }
    return affected;
}

std::vector<Span> spansOf(const ControlTable &table, std::uint8_t id, const std::function<bool(const Field &)> &wanted,
                          int longest)
{
    std::vector<Span> spans;
    for (const Field &field : table.fields()) {
        if (!wanted(field))
            continue;
        if (!spans.empty()) {
            Span &last = spans.back();
            const int end = last.address + last.length;
            if (field.address - end <= LargestGap && field.end() - last.address <= longest) {
                last.length = static_cast<std::uint16_t>(field.end() - last.address);
                continue;
            }
        }
        spans.push_back({id, field.address, field.size});
    }
    return spans;
}

std::function<bool(const Field &)> among(std::vector<const Field *> fields)
{
    return [fields = std::move(fields)](const Field &field) { return std::ranges::find(fields, &field) != fields.end(); };
}

RegisterChange changeOf(const Field &field, Bytes after)
{
    return {field.name, field.address, field.isSigned, {}, std::move(after), {}};
}

RegisterChange changeOf(const Field &field, std::int64_t after)
{
    return changeOf(field, bytesFromRaw(field, after));
}

void addResets(JournalEntry &entry, const ControlTable &table, const Field &field,
               const std::function<Bytes(const Field &)> &before)
{
    for (const QString &name : field.resets) {
        const Field *other = table.find(name);
        const bool counts = other && other->isWritable() && other != &field && !isGoal(*other)
                            && other != table.find(Known::TorqueEnable);
        Bytes old = counts ? before(*other) : Bytes();
        if (!old.empty())
            entry.changes.push_back({other->name, other->address, other->isSigned, std::move(old), {}, {}});
    }
}

Bytes bytesIn(std::span<const PollValue> values, int address, std::size_t length)
{
    for (const PollValue &value : values) {
        const int from = address - value.address;
        if (from < 0 || static_cast<std::size_t>(from) + length > value.data.size())
            continue;
        const auto begin = value.data.begin() + from;
        return {begin, begin + static_cast<std::ptrdiff_t>(length)};
    }
    return {};
}

void takeReadings(JournalEntry &entry, const std::vector<RegisterChange> &affected, std::span<const PollValue> before,
                  std::span<const PollValue> after)
{
    RegisterChange &main = entry.changes.front();
    if (Bytes old = bytesIn(before, main.address, main.after.size()); !old.empty())
        main.before = std::move(old);
    main.shown = bytesIn(after, main.address, main.after.size());
    for (const RegisterChange &one : affected) {
        RegisterChange change = one;
        change.after = bytesIn(after, one.address, one.after.size());
        change.before = bytesIn(before, one.address, one.after.size());
        if (change.after.empty() || change.before.empty() || change.after == change.before)
            continue;
        change.shown = change.after;
        entry.changes.push_back(std::move(change));
    }
}

JournalState stateAfter(const Error &error)
{
    switch (error.kind) {
    case ErrorKind::Refused:
    case ErrorKind::NotSent:
    case ErrorKind::InvalidArgument:
    case ErrorKind::NotSupported:
    case ErrorKind::NotFound:
    case ErrorKind::PortNotFound:
    case ErrorKind::PortForbidden:
    case ErrorKind::PortBusy:
    case ErrorKind::PortUnsuitable: return JournalState::Failed;
    default: return JournalState::Unconfirmed; // ended in its middle, or nothing says that it arrived
    }
}

} // namespace dynascope
