// SPDX-License-Identifier: GPL-3.0-or-later
// From the bus into a profile's file.
#include "app/dxl/commands.h"
#include "app/dxl/directjob.h"
#include "core/session/profile/profilesave.h"

#include <QFileInfo>

#include <algorithm>

namespace dynascope::dxl {
namespace {

Result<std::vector<Found>> findAll(const Work &work, const std::vector<int> &rates)
{
    const std::vector<std::uint8_t> &wanted = work.options.profile.ids;
    std::vector<Found> all;
    for (const int rate : rates) {
        if (const auto set = work.bus.setBaudRate(rate); !set)
            return tl::unexpected(set.error());
        work.output.progress(static_cast<double>(all.size()) / 253, QStringLiteral("%1 bps").arg(rate));
        const auto scan = scanBaud(work.bus, {});
        if (!scan)
            return tl::unexpected(scan.error());
        for (const Found &found : scan->devices) {
            if (!wanted.empty() && std::ranges::find(wanted, found.id) == wanted.end())
                continue;
            if (!found.doubt.isEmpty())
                return failure(
                    ErrorKind::NotConfirmed,
                    QStringLiteral("ID %1 at %2 bps: %3; nothing was saved").arg(found.id).arg(rate).arg(found.doubt));
            all.push_back(found);
        }
        if (!scan->unreadable.isEmpty())
            work.output.note(QStringLiteral("%1 bps: %2").arg(rate).arg(scan->unreadable));
    }
    return all;
}

Result<std::vector<SavedDevice>> readAll(const Work &work, const std::vector<Found> &found)
{
    std::vector<SavedDevice> devices;
    std::vector<ReadSpansPlan> asked;
    for (const Found &each : found) {
        const ControlTablePtr table = work.catalog.find(each.modelNumber, each.firmware);
        if (!table) {
            work.output.note(QStringLiteral("ID %1 at %2 bps is of the unknown model %3 and is left out")
                                 .arg(each.id)
                                 .arg(each.baudRate)
                                 .arg(each.modelNumber));
            continue;
        }
        work.bus.addTraits(profileTraits(each, table->description().fastReadsFrom, table->receiveBuffer()));
        devices.push_back({each, {}, {}});
        asked.push_back(planSaveReading(each, *table));
    }
    DirectJob job(work.bus);
    const auto images = readImages(job, asked);
    if (!images)
        return tl::unexpected(images.error());
    for (std::size_t i = 0; i < devices.size(); ++i) {
        if (!(*images)[i])
            return failure((*images)[i].error().kind,
                           (*images)[i].error().text + QStringLiteral("; nothing was saved"));
        devices[i].image = *(*images)[i];
    }
    return devices;
}

} // namespace

ExitCode profileSaveCommand(const Work &work)
{
    const ProfileOptions &options = work.options.profile;
    const auto text = profileText(options.file);
    if (!text && text.error().kind != ErrorKind::NotFound)
        return work.output.refuse(text.error());
    const QByteArray before = text.value_or(QByteArray());
    std::vector<int> rates = options.bauds;
    if (!before.trimmed().isEmpty()) { // refused before anybody is asked
        const auto known = profileFromYaml(before, options.file, work.catalog);
        if (!known)
            return work.output.refuse(known.error());
        if (rates.empty())
            rates = known->baudRates();
    }
    if (rates.empty())
        rates = {work.options.baudRate};
    const auto found = findAll(work, rates);
    if (!found)
        return work.output.fail(found.error());
    const auto devices = readAll(work, *found);
    if (!devices)
        return work.output.fail(devices.error());
    ProfileSaveOptions how;
    how.calibration = options.calibration;
    how.all = options.all;
    how.name = options.name.isEmpty() ? QFileInfo(options.file).completeBaseName() : options.name;
    const auto saved = saveProfile(before, options.file, *devices, work.catalog, how);
    if (!saved)
        return work.output.fail(saved.error());
    for (const QString &note : saved->notes)
        work.output.note(note);
    if (saved->text != before) {
        if (const auto written = writeProfile(options.file, saved->text); !written)
            return work.output.fail(written.error());
    }
    Document document;
    document.add("file", options.file)
        .add("changed_values", qint64(saved->changedValues))
        .add("new_registers", qint64(saved->newRegisters))
        .add("new_joints", qint64(saved->newJoints));
    work.output.result(saved->isChanged() ? QStringLiteral("%1: %2 values changed, %3 registers and %4 joints added")
                                                .arg(options.file)
                                                .arg(saved->changedValues)
                                                .arg(saved->newRegisters)
                                                .arg(saved->newJoints)
                                          : QStringLiteral("%1 says so already").arg(options.file),
                       document);
    return ExitCode::Done;
}

} // namespace dynascope::dxl
