// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/commands.h"
#include "app/dxl/target.h"
#include "core/bus/operations.h"
#include "core/bus/scan.h"
#include "core/session/volatilespan.h"

#include <map>

namespace dynascope::dxl {

namespace {

void print(const Work &work, const Found &found)
{
    const QString model = modelName(work.catalog, found.modelNumber);
    Document document;
    document.add("id", qint64(found.id))
        .add("baud", qint64(found.baudRate))
        .add("model", model)
        .add("model_number", qint64(found.modelNumber))
        .add("firmware", qint64(found.firmware))
        .addFlag("alert", found.alert);
    QString text = QStringLiteral("%1 bps, ID %2: %3 (model %4), firmware %5")
                       .arg(found.baudRate).arg(found.id).arg(model).arg(found.modelNumber).arg(found.firmware);
    if (found.modelNumber == 0) // nothing of it could be read
        text = QStringLiteral("%1 bps, ID %2: unreadable").arg(found.baudRate).arg(found.id);
    if (found.alert)
        text += QStringLiteral(", alert: see Hardware Error Status");
    if (!found.doubt.isEmpty()) {
        document.add("doubt", found.doubt);
        text += QStringLiteral("; doubtful: %1").arg(found.doubt);
    }
    work.output.result(text, document);
}

QString names(const std::vector<int> &bauds)
{
    QStringList list;
    for (const int baud : bauds)
        list.append(QString::number(baud));
    return list.join(QStringLiteral(", "));
}

void adviseAfterSilence(const Work &work, const std::vector<int> &tried)
{
    const Options &options = work.options;
    const bool serversRate = !work.bus.line().canSetBaudRate();
    QString text = QStringLiteral("nobody answered at %1, IDs %2 to %3")
                       .arg(serversRate ? QStringLiteral("the server's rate") : names(tried) + QStringLiteral(" bps"))
                       .arg(options.ids.first)
                       .arg(options.ids.last);
    text += serversRate ? QStringLiteral("; is it that of the devices, and are they powered?")
            : tried.size() > 1
                ? QStringLiteral("; is the bus powered and connected?")
                : QStringLiteral("; to look at every baud rate: dxl --port %1 scan --bauds all").arg(options.port);
    work.output.note(text);
}

/// How far the scan is.
struct Progress {
    std::size_t rate = 0, rates = 1;

    void show(const Work &work, double part) const
    {
        const double done = (static_cast<double>(rate) + part) / static_cast<double>(rates);
        work.output.progress(done, QStringLiteral("%1 bps").arg(work.bus.line().baudRate()));
    }
};

/// Everything at one baud rate; how many were found.
Result<std::size_t> scanAt(const Work &work, int baud, const Progress &progress)
{
    if (const auto set = work.bus.setBaudRate(baud); !set)
        return tl::unexpected(set.error());
    progress.show(work, 0);
    // Printed when the rate is done: what makes an answer doubtful comes after it.
    ScanHooks hooks;
    hooks.between = [&work, &progress](double part) -> Result<void> {
        progress.show(work, part);
        return {};
    };
    hooks.volatileOf = [&work](const Found &device) {
        const ControlTablePtr table = work.catalog.find(device.modelNumber, device.firmware);
        return table ? volatileSpanOf(*table) : std::nullopt;
    };
    const auto found = scanBaud(work.bus, {work.options.ids.first, work.options.ids.last, work.options.sweep}, hooks);
    if (!found)
        return tl::unexpected(found.error());
    for (const Found &device : found->devices)
        print(work, device);
    if (!found->unreadable.isEmpty())
        work.output.note(QStringLiteral("%1 bps: %2").arg(work.bus.line().baudRate()).arg(found->unreadable));
    return found->devices.size();
}

constexpr QChar Placeholder{0x1f};

/// What is said of this rate and may be said of others, too.
QString patternOf(QString text, int baud)
{
    return text.replace(QStringLiteral(" %1 ").arg(baud), QStringLiteral(" %1 ").arg(Placeholder));
}

} // namespace

ExitCode scanCommand(const Work &work)
{
    work.output.expectMany();
    std::vector<int> silent;
    std::size_t found = 0;
    std::map<QString, QStringList> refused; ///< rates by what was said of them
    bool failed = false;
    std::vector<int> bauds = work.options.bauds;
    if (!work.bus.line().canSetBaudRate()) {
        if (bauds.size() > 1)
            work.output.note(
                QStringLiteral("the rate of %1 is the server's: only that one is scanned").arg(work.bus.line().name()));
        bauds = {work.bus.line().baudRate()};
    }
    Progress progress{0, bauds.size()};
    for (const int baud : bauds) {
        if (work.output.isClosed())
            break;
        const auto count = scanAt(work, baud, progress);
        ++progress.rate;
        if (count) {
            found += *count;
            if (*count == 0)
                silent.push_back(baud);
            continue;
        }
        const bool unsuitable = count.error().kind == ErrorKind::PortUnsuitable;
        if (unsuitable && bauds.size() > 1)
            refused[patternOf(count.error().text, baud)] << QString::number(baud);
        else
            work.output.fail(count.error());
        if (endsAll(count.error()))
            return ExitCode::Failed;
        // Of several rates nobody expects every port to do each; garbage at one of them doesn't end the search.
        failed = failed || !unsuitable || bauds.size() == 1;
    }
    for (const auto &[pattern, rates] : refused)
        work.output.note(QString(pattern).replace(Placeholder, rates.join(QStringLiteral(", "))));
    if (found == 0 && !failed && !silent.empty())
        adviseAfterSilence(work, silent);
    return failed ? ExitCode::Failed : ExitCode::Done;
}

} // namespace dynascope::dxl
