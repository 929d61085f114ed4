// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/dashboard/faultsaver.h"

namespace dynascope {

std::vector<CsvColumn> columnsOf(const FaultRecord &record)
{
    std::vector<CsvColumn> columns;
    for (const FaultTrace &trace : record.traces) {
        if (trace.samples.empty())
            continue;
        const QString title = record.name + QStringLiteral(" · ") + trace.name;
        columns.push_back({trace.unit.isEmpty() ? title : QStringLiteral("%1 (%2)").arg(title, trace.unit), trace.scale,
                           trace.offset, trace.decimals, trace.samples});
    }
    columns.push_back({FaultSaver::tr("Alarm: %1").arg(record.cause), 1, 0, 0, {{record.at, 1}}});
    return columns;
}

FaultSaver::~FaultSaver()
{
    if (m_thread)
        m_thread->wait();
}

void FaultSaver::save(const QString &path, const FaultRecord &record)
{
    Q_ASSERT(!isRunning());
    m_work = std::make_shared<Work>();
    m_work->path = path;
    m_work->columns = columnsOf(record);
    m_thread.reset(
        QThread::create([work = m_work] { work->result = saveCsv(work->path, work->columns, work->cancelled); }));
    connect(m_thread.get(), &QThread::finished, this, [this] {
        m_thread->wait(); // it has told its end, and takes no longer than that
        const std::shared_ptr<Work> work = std::move(m_work);
        emit finished(work->result ? QString() : work->result.error().text, work->path);
    });
    m_thread->start();
}

} // namespace dynascope
