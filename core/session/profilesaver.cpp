// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/profilesaver.h"

#include "core/session/procedures/atbaud.h"
#include "core/table/catalog.h"

#include <QFileInfo>

#include <set>

namespace dynascope {

void ProfileSaver::saveNew(const QString &path, LineSession &line, ProfileSaveOptions options, Done done)
{
    std::set<int> rates{line.baudRate()};
    for (const auto &device : line.devices())
        rates.insert(device->baudRate());
    if (options.name.isEmpty())
        options.name = QFileInfo(path).completeBaseName();
    save({path, {}, options}, line, {rates.begin(), rates.end()}, done);
}

void ProfileSaver::saveInto(const QString &path, LineSession &line, const ProfileSaveOptions &options, Done done)
{
    const auto text = profileText(path);
    if (!text)
        return done(tl::unexpected(text.error()));
    const auto profile = profileFromYaml(*text, path, m_session.catalog()); // refused before anybody is asked
    if (!profile)
        return done(tl::unexpected(profile.error()));
    save({path, *text, options}, line, profile->baudRates(), done);
}

void ProfileSaver::save(const Target &target, LineSession &line, const std::vector<int> &rates, const Done &done)
{
    if (isBusy())
        return;
    m_line = &line;
    m_progress = 0;
    m_job = line.bus().run<Read>(
        Priority::Normal, this,
        [this, rates, &catalog = m_session.catalog()](JobContext &context) {
            return readAll(context, rates, catalog, [this, &context](double progress) {
                context.post([this, progress] {
                    m_progress = progress;
                    emit changed();
                });
            });
        },
        [this, target, done](const Result<Read> &read) {
            m_job = 0;
            const auto saved = write(target, read);
            emit changed();
            done(saved);
        });
    emit changed();
}

Result<std::vector<Found>> ProfileSaver::findAll(JobContext &context, const std::vector<int> &rates, QStringList &notes)
{
    std::vector<Found> all;
    for (const int rate : rates) {
        const AtBaud there(context.bus(), rate);
        if (!there.entered())
            return tl::unexpected(there.entered().error());
        ScanHooks hooks;
        hooks.between = [&context](double) { return context.checkpoint(); };
        const auto scan = scanBaud(context.bus(), {}, hooks);
        if (!scan)
            return tl::unexpected(scan.error());
        for (const Found &found : scan->devices) {
            if (!found.doubt.isEmpty())
                return failure(ErrorKind::NotConfirmed, tr("ID %1 at %2 bps: %3; nothing was saved")
                                                            .arg(found.id).arg(rate).arg(found.doubt));
            all.push_back(found);
        }
        if (!scan->unreadable.isEmpty())
            notes << tr("%1 bps: %2").arg(rate).arg(scan->unreadable);
    }
    return all;
}

Result<ProfileSaver::Read> ProfileSaver::readAll(JobContext &context, const std::vector<int> &rates,
                                                 const Catalog &catalog, const std::function<void(double)> &progress)
{
    Read read;
    const auto found = findAll(context, rates, read.notes);
    if (!found)
        return tl::unexpected(found.error());
    progress(0.5);
    std::vector<ReadSpansPlan> asked;
    for (const Found &each : *found) {
        const ControlTablePtr table = catalog.find(each.modelNumber, each.firmware);
        if (!table) {
            read.notes << tr("ID %1 at %2 bps is of the unknown model %3 and is left out")
                              .arg(each.id).arg(each.baudRate).arg(each.modelNumber);
            continue;
        }
        context.bus().addTraits(profileTraits(each, table->description().fastReadsFrom, table->receiveBuffer()));
        read.devices.push_back({each, {}, {}});
        asked.push_back(planSaveReading(each, *table));
    }
    const auto images = readImages(context, asked);
    if (!images)
        return tl::unexpected(images.error());
    for (std::size_t i = 0; i < read.devices.size(); ++i) {
        const auto &image = (*images)[i];
        if (!image)
            return failure(image.error().kind, tr("%1; nothing was saved").arg(image.error().text));
        read.devices[i].image = *image;
    }
    progress(1);
    return read;
}

Result<SavedProfile> ProfileSaver::write(const Target &target, const Result<Read> &read)
{
    if (!read)
        return tl::unexpected(read.error());
    std::vector<SavedDevice> devices = read->devices;
    if (devices.empty())
        return failure(ErrorKind::NotFound, tr("Nobody answered whose registers are known; nothing was saved"));
    for (SavedDevice &device : devices) { // what a person calls it is what its joint is called
        const Device *known = m_line ? m_line->deviceAt(device.found.id, device.found.baudRate) : nullptr;
        if (known && known->modelNumber() == device.found.modelNumber)
            device.name = known->nickname();
    }
    auto saved = saveProfile(target.before, target.path, devices, m_session.catalog(), target.options);
    if (!saved)
        return saved;
    saved->notes = read->notes + saved->notes;
    if (saved->text != target.before) {
        if (const auto written = writeProfile(target.path, saved->text); !written)
            return tl::unexpected(written.error());
    }
    return saved;
}

void ProfileSaver::cancel()
{
    if (m_job && m_line)
        m_line->bus().cancel(m_job);
}

} // namespace dynascope
