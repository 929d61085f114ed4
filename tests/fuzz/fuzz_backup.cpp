// SPDX-License-Identifier: GPL-3.0-or-later
// Any text as a backup: refused with a sentence that names its place, or it means the same once written anew, equals
// itself, and a restore of it to a device of its model is planned or refused.
#include "core/session/backup/restore.h"
#include "core/session/deviceplace.h"
#include "tests/fuzz/fuzzinput.h"

using namespace dynascope;
using fuzz::must;

namespace {

const Catalog &catalog()
{
    static const Catalog tables = Catalog::builtIn().value();
    return tables;
}

/// A device as the factory made it.
Backup freshDevice(int modelNumber, const ControlTablePtr &table, int firmware)
{
    Backup device;
    device.modelNumber = modelNumber;
    device.model = table->model();
    device.firmware = firmware;
    device.id = 1;
    device.baudRate = 57600;
    device.table = table;
    for (const Field &field : table->fields())
        device.registers.push_back({table->indexOf(&field), field.initial.value_or(0)});
    return device;
}

void plan(const Backup &backup, int firmware)
{
    const ControlTablePtr table = catalog().find(backup.modelNumber, firmware);
    if (!table)
        return;
    Found found{};
    found.id = 1;
    found.baudRate = 57600;
    found.modelNumber = static_cast<std::uint16_t>(backup.modelNumber);
    found.firmware = static_cast<std::uint8_t>(firmware);
    const auto restored =
        planRestore(backup, freshDevice(backup.modelNumber, table, firmware), placeOf(found, *table, backup.model), {});
    if (!restored) {
        must(!restored.error().text.isEmpty(), "a refusal has a reason");
        return;
    }
    // A goal that a new mode resets is given back what the device held; none gets what the file says.
    for (const SettingsStep &step : restored->settings.steps) {
        const bool isTorque = table->at(step.where.address) == table->find(Known::TorqueEnable);
        must((!step.isGoal || step.to.empty()) && !isTorque, "nothing moves");
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    const QByteArray text(reinterpret_cast<const char *>(data), static_cast<qsizetype>(size));
    const Result<Backup> backup = backupFromYaml(text, QStringLiteral("f"), catalog());
    if (!backup) {
        must(backup.error().text.startsWith(u"f"), "a refusal names the file");
        return 0;
    }
    const QByteArray yaml = toYaml(*backup);
    const Result<Backup> again = backupFromYaml(yaml, QStringLiteral("f"), catalog());
    must(again && toYaml(*again) == yaml, "a backup is read as it was written");
    for (const ComparedRegister &row : compareBackups(*backup, *again))
        must(row.isSame(), "a backup equals itself");
    plan(*backup, backup->firmware);
    plan(*backup, 1);
    return 0;
}
