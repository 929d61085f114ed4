// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/scanner.h"

#include "core/session/procedures/atbaud.h"

#include <algorithm>

namespace dynascope {
namespace {

struct ScanSummary {
    int found = 0;
    QStringList trouble; ///< bauds that could not be tried, unreadable answers
};

/// What the scan tells the GUI while it runs.
struct ScanNotes {
    std::function<void(const Found &)> found;
    std::function<void(double progress, int baud)> baudBegins;
};

Result<ScanSummary> scan(JobContext &context, const ScanRange &range, const ScanNotes &notes)
{
    ScanSummary summary;
    const AtBaud home(context.bus(), context.bus().line().baudRate());
    const Line &line = context.bus().line();
    const std::vector<int> bauds = line.canSetBaudRate() ? range.bauds : std::vector{line.baudRate()};
    for (std::size_t step = 0; step < bauds.size(); ++step) {
        if (const auto go = context.checkpoint(); !go)
            return tl::unexpected(go.error());
        const int baud = bauds[step];
        const double progress = static_cast<double>(step) / static_cast<double>(bauds.size());
        context.post([notes, progress, baud] { notes.baudBegins(progress, baud); });
        if (const auto set = context.bus().setBaudRate(baud); !set) {
            if (set.error().kind != ErrorKind::PortUnsuitable)
                return tl::unexpected(set.error());
            summary.trouble << set.error().text;
            continue;
        }
        const auto report = [&](const Found &found) {
            context.post([notes, found] { notes.found(found); });
        };
        const auto found = scanBaud(context.bus(), {range.firstId, range.lastId, range.sweep}, report);
        if (found) {
            summary.found += static_cast<int>(found->devices.size());
            if (!found->unreadable.isEmpty())
                summary.trouble << found->unreadable;
            continue;
        }
        const ErrorKind kind = found.error().kind;
        if (kind == ErrorKind::PortLost || kind == ErrorKind::Stopped || kind == ErrorKind::Cancelled)
            return tl::unexpected(found.error());
        summary.trouble << found.error().text;
    }
    return summary;
}

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
    m_found = 0;
    m_wasCancelled = false;
    m_progress = 0;
    m_currentBaud = range.bauds.empty() ? line.baudRate() : range.bauds.front();
    const int run = ++m_run;

    ScanNotes notes;
    notes.found = [this, run](const Found &found) {
        if (run != m_run || !m_line)
            return;
        ++m_found;
        m_line->heard(found);
        emit progressChanged();
    };
    notes.baudBegins = [this, run](double progress, int baud) {
        if (run != m_run)
            return;
        m_progress = progress;
        m_currentBaud = baud;
        emit progressChanged();
    };
    m_job = line.bus().run<ScanSummary>(
        Priority::Scan, this,
        [range, notes](JobContext &context) { return scan(context, range, notes); },
        [this, run](const Result<ScanSummary> &summary) {
            if (run != m_run)
                return;
            m_job = 0;
            m_progress = 1;
            m_wasCancelled = !summary
                && (summary.error().kind == ErrorKind::Cancelled || summary.error().kind == ErrorKind::Stopped);
            const QString message = summary ? summary->trouble.join(QStringLiteral(". ")) : summary.error().text;
            emit progressChanged();
            emit finished(m_found, message);
        });
    emit progressChanged();
}

void Scanner::cancel()
{
    if (m_job && m_line)
        m_line->bus().cancel(m_job);
}

} // namespace dynascope
