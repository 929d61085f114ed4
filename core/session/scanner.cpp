// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/scanner.h"

#include "core/bus/operations.h"
#include "core/session/procedures/atbaud.h"
#include "core/session/volatilespan.h"
#include "core/table/catalog.h"

#include <algorithm>

namespace dynascope {
namespace {

struct ScanSummary {
    QStringList trouble; ///< bauds that could not be tried, unreadable answers
};

/// What the scan tells the GUI while it runs.
struct ScanNotes {
    std::function<void(const Found &)> found;
    std::function<void(double progress, int baud)> goesOn;
};

/// One scan of several rates, on the bus thread.
class RatesScan
{
public:
    RatesScan(JobContext &context, const ScanRange &range, const Catalog &catalog, const ScanNotes &notes)
        : m_context(context), m_range(range), m_notes(notes)
    {
        m_hooks.found = [this](const Found &found) {
            m_context.post([notes = m_notes, found] { notes.found(found); });
        };
        m_hooks.between = [this](double part) {
            tell(part);
            return m_context.checkpoint();
        };
        m_hooks.volatileOf = [&catalog](const Found &found) {
            const ControlTablePtr table = catalog.find(found.modelNumber, found.firmware);
            return table ? volatileSpanOf(*table) : std::nullopt;
        };
    }

    Result<ScanSummary> run()
    {
        Bus &bus = m_context.bus();
        const AtBaud home(bus, bus.line().baudRate());
        m_bauds = bus.line().canSetBaudRate() ? m_range.bauds : std::vector{bus.line().baudRate()};
        for (; m_step < m_bauds.size(); ++m_step) {
            if (const auto go = m_context.checkpoint(); !go)
                return tl::unexpected(go.error());
            m_toldPercent = -1;
            tell(0);
            const Result<void> scanned = scanRate();
            if (scanned)
                continue;
            if (endsAll(scanned.error()))
                return tl::unexpected(scanned.error());
            m_summary.trouble << scanned.error().text; // another rate may do
        }
        return m_summary;
    }

private:
    Result<void> scanRate()
    {
        Bus &bus = m_context.bus();
        if (const auto set = bus.setBaudRate(m_bauds[m_step]); !set)
            return set;
        const auto found = scanBaud(bus, {m_range.firstId, m_range.lastId, m_range.sweep}, m_hooks);
        if (!found)
            return tl::unexpected(found.error());
        if (!found->unreadable.isEmpty())
            m_summary.trouble << found->unreadable;
        return {};
    }

    /// At most once a percent: there may be hundreds of exchanges.
    void tell(double part)
    {
        const double progress = (static_cast<double>(m_step) + part) / static_cast<double>(m_bauds.size());
        const int percent = static_cast<int>(100 * progress);
        if (percent == m_toldPercent)
            return;
        m_toldPercent = percent;
        m_context.post([notes = m_notes, progress, baud = m_bauds[m_step]] { notes.goesOn(progress, baud); });
    }

    JobContext &m_context;
    const ScanRange &m_range;
    const ScanNotes &m_notes;
    ScanHooks m_hooks;
    ScanSummary m_summary;
    std::vector<int> m_bauds;
    std::size_t m_step = 0;
    int m_toldPercent = -1;
};

} // namespace

std::vector<int> likelyBauds(int lastUsed)
{
    std::vector<int> bauds;
    const auto add = [&bauds](int baud) {
        if (baud > 0 && std::ranges::find(bauds, baud) == bauds.end())
            bauds.push_back(baud);
    };
    for (const int baud : {lastUsed, 57600, 1000000, 115200, 2000000, 3000000, 4000000, 4500000, 9600})
        add(baud);
    return bauds;
}

const std::vector<int> &allBauds()
{
    static const std::vector<int> bauds{9600,    57600,   115200,  1000000, 2000000,
                                        3000000, 4000000, 4500000, 6000000, 10500000};
    return bauds;
}

Scanner::Scanner(QObject *parent)
    : QObject(parent)
{
}

void Scanner::start(LineSession &line, const ScanRange &range)
{
    cancel();
    m_line = &line;
    m_seen.clear();
    m_wasCancelled = false;
    m_progress = 0;
    m_currentBaud = range.bauds.empty() ? line.baudRate() : range.bauds.front();
    const int run = ++m_run;

    ScanNotes notes;
    notes.found = [this, run](const Found &found) {
        if (run != m_run || !m_line)
            return;
        m_seen.insert({found.baudRate, found.id}); // a doubtful one comes twice
        m_line->heard(found);
        emit progressChanged();
    };
    notes.goesOn = [this, run](double progress, int baud) {
        if (run != m_run)
            return;
        m_progress = progress;
        m_currentBaud = baud;
        emit progressChanged();
    };
    m_job = line.bus().run<ScanSummary>(
        Priority::Scan, this,
        [range, notes, &catalog = line.catalog()](JobContext &context) {
            return RatesScan(context, range, catalog, notes).run();
        },
        [this, run](const Result<ScanSummary> &summary) {
            if (run != m_run)
                return;
            m_job = 0;
            m_progress = 1;
            m_wasCancelled = !summary
                && (summary.error().kind == ErrorKind::Cancelled || summary.error().kind == ErrorKind::Stopped);
            const QString message = summary ? summary->trouble.join(QStringLiteral(". ")) : summary.error().text;
            emit progressChanged();
            emit finished(found(), message);
        });
    emit progressChanged();
}

void Scanner::cancel()
{
    if (m_job && m_line)
        m_line->bus().cancel(m_job);
}

} // namespace dynascope
