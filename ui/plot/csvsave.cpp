// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/csvsave.h"

#include <QDir>

#include <algorithm>

namespace dynascope {

namespace {

constexpr std::size_t SliceSamples = 100'000; ///< some 10 ns each

CsvColumn columnOf(const TraceData &look)
{
    CsvColumn column;
    column.title = withUnit(look.label(), look.unit);
    column.scale = look.scale;
    column.offset = look.offset;
    column.decimals = look.decimals;
    return column;
}

} // namespace

CsvSave::CsvSave(const Monitor &monitor, QObject *parent)
    : QObject(parent)
    , m_monitor(monitor)
{
    m_slices.setInterval(0);
    connect(&m_slices, &QTimer::timeout, this, &CsvSave::copySome);
}

CsvSave::~CsvSave()
{
    if (m_thread)
        m_thread->wait();
}

QString CsvSave::path() const
{
    return m_work ? m_work->path : QString();
}

void CsvSave::start(const QString &path, const std::vector<Trace> &traces, LineTime from, LineTime end)
{
    Q_ASSERT(!isRunning());
    m_work = std::make_shared<Work>();
    m_work->path = path;
    m_parts.clear();
    for (const Trace &trace : traces) {
        if (!trace.look.visible)
            continue;
        Part part{trace.watch, trace.derived};
        CsvColumn column = columnOf(trace.look);
        if (const History *history = historyOf(part)) {
            const std::uint64_t begin = history->appended() - history->size();
            part.next = begin + history->indexAt(from);
            part.end = begin + history->indexAt(end);
            column.samples.reserve(static_cast<std::size_t>(part.end - part.next));
        }
        m_parts.push_back(part);
        m_work->columns.push_back(std::move(column));
    }
    m_slices.start();
}

const History *CsvSave::historyOf(const Part &part) const
{
    return part.derived ? &part.derived->history() : m_monitor.history(part.watch);
}

void CsvSave::cancel()
{
    if (m_work)
        m_work->cancelled = true;
}

/// False where the samples are no longer there.
bool CsvSave::copy(Part &part, CsvColumn &column, std::size_t &room) const
{
    if (part.next == part.end)
        return true;
    const History *history = historyOf(part);
    if (!history || history->appended() < part.end)
        return false;
    const std::uint64_t begin = history->appended() - history->size();
    part.next = std::clamp(begin, part.next, part.end); // a full history gives its oldest up
    for (; part.next < part.end && room > 0; ++part.next, --room)
        column.samples.push_back(history->at(static_cast<std::size_t>(part.next - begin)));
    return true;
}

void CsvSave::copySome()
{
    std::size_t room = SliceSamples;
    for (std::size_t i = 0; i < m_parts.size() && room > 0 && !m_work->cancelled; ++i) {
        if (!copy(m_parts[i], m_work->columns[i], room)) {
            m_work->result = failure(ErrorKind::NotFound, tr("%1 was not written: its samples were cleared meanwhile")
                                                              .arg(QDir::toNativeSeparators(m_work->path)));
            return finish();
        }
    }
    if (room > 0)
        write();
}

/// Also what was cancelled: the one place that says so is there.
void CsvSave::write()
{
    m_slices.stop();
    m_thread.reset(QThread::create(
        [work = m_work] { work->result = saveCsv(work->path, work->columns, work->cancelled); }));
    connect(m_thread.get(), &QThread::finished, this, &CsvSave::finish);
    m_thread->start();
}

void CsvSave::finish()
{
    m_slices.stop();
    if (m_thread)
        m_thread->wait(); // it has told its end, and takes no longer than that
    m_thread.reset();
    const std::shared_ptr<Work> work = std::move(m_work);
    if (work->result)
        emit written(work->path);
    else
        emit failed(work->result.error());
}

} // namespace dynascope
