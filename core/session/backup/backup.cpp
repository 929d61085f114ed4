// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/backup/backup.h"

#include "core/session/journal/journalwrites.h"

#include <algorithm>

namespace dynascope {

const BackupRegister *Backup::find(const Field *field) const
{
    const int index = table && field ? table->indexOf(field) : -1;
    const auto found = std::ranges::lower_bound(registers, index, {}, &BackupRegister::field);
    return index >= 0 && found != registers.end() && found->field == index ? &*found : nullptr;
}

const BackupRegister *Backup::find(QStringView name) const
{
    return table ? find(table->find(name)) : nullptr;
}

RegisterLookup Backup::lookup() const
{
    return [this](QStringView name) -> std::optional<std::int64_t> {
        const BackupRegister *one = find(name);
        return one ? std::optional(one->raw) : std::nullopt;
    };
}

QString Backup::text(const BackupRegister &one) const
{
    const Field &field = fieldOf(one);
    return valueText(field, effective(field, lookup()), table->resolution(), one.raw);
}

QString Backup::name() const
{
    return QStringLiteral("%1 (ID %2)").arg(model).arg(id);
}

BackupReadPlan planBackupReading(const DevicePlace &place, const ControlTable &table)
{
    BackupReadPlan plan{{place, spansOf(table, place.id, [](const Field &) { return true; })}, {}};
    for (const Field &field : table.fields())
        plan.registers.push_back({place.id, field.address, field.size});
    return plan;
}

Result<RegisterImage> readForBackup(JobContext &context, const BackupReadPlan &plan)
{
    auto images = readImages(context, {plan.spans});
    if (!images)
        return tl::unexpected(images.error());
    Result<RegisterImage> &image = images->front();
    if (!image)
        return image;
    ReadSpansPlan missing{plan.spans.place, {}};
    for (const Span &span : plan.registers) {
        if (image->bytes(span.address, span.length).empty())
            missing.spans.push_back(span);
    }
    // Of an unknown model that is most of its bytes: whatever it refused as a stretch it refuses bytewise, too.
    if (missing.spans.empty() || missing.spans.size() == plan.registers.size())
        return image;
    const auto values = readSpans(context, missing);
    if (!values)
        return tl::unexpected(values.error());
    image->take(*values);
    return image;
}

namespace {

/// What was read beside the fields, as far as any of it is not 0.
std::vector<BackupBytes> bytesBeside(const ControlTable &table, const RegisterImage &image)
{
    std::vector<BackupBytes> all;
    const auto add = [&](int from, int to) {
        for (int begin = from; begin < to; begin += static_cast<int>(Backup::MostBytes) / 4) {
            BackupBytes one{begin, {}};
            for (int address = begin; address < std::min(to, begin + static_cast<int>(Backup::MostBytes) / 4);
                 ++address) {
                const Bytes byte = image.bytes(static_cast<std::uint16_t>(address), 1);
                if (byte.empty())
                    break;
                one.bytes.push_back(byte.front());
            }
            const bool saysSomething = std::ranges::any_of(one.bytes, [](std::uint8_t byte) { return byte != 0; });
            if (saysSomething)
                all.push_back(std::move(one));
        }
    };
    int end = 0;
    for (const Field &field : table.fields()) {
        add(end, field.address);
        end = field.end();
    }
    return all;
}

/// Of an unknown model all that was read, whatever it is.
std::vector<BackupBytes> everyByte(const RegisterImage &image, int size)
{
    std::vector<BackupBytes> all;
    for (int address = 0; address < size; ++address) {
        const Bytes byte = image.bytes(static_cast<std::uint16_t>(address), 1);
        if (byte.empty())
            continue;
        const bool follows = !all.empty() && address % 16 != 0
                             && all.back().address + static_cast<int>(all.back().bytes.size()) == address;
        if (!follows)
            all.push_back({address, {}});
        all.back().bytes.push_back(byte.front());
    }
    return all;
}

} // namespace

Backup backupOf(const Found &found, const QString &model, const ControlTablePtr &table, const RegisterImage &image,
                const QDateTime &at)
{
    Backup backup;
    backup.modelNumber = found.modelNumber;
    backup.model = model;
    backup.firmware = found.firmware;
    backup.id = found.id;
    backup.baudRate = found.baudRate;
    backup.at = at.toUTC();
    backup.table = table;
    if (table->description().isRaw) {
        backup.bytes = everyByte(image, table->size());
        return backup;
    }
    for (const Field &field : table->fields()) {
        const Bytes bytes = image.bytes(field.address, field.size);
        if (bytes.empty())
            backup.unread << field.name;
        else
            backup.registers.push_back({table->indexOf(&field), rawFromBytes(field, bytes)});
    }
    backup.bytes = bytesBeside(*table, image);
    return backup;
}

} // namespace dynascope
