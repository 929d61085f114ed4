// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/plotsaver.h"

#include "ui/common/filedialogs.h"

#include <QDir>
#include <QPointer>

namespace dynascope {

namespace {

using namespace std::chrono_literals;

constexpr auto Patience = 500ms;
const QString Topic = QStringLiteral("save");

} // namespace

PlotSaver::PlotSaver(const Monitor &monitor, QWidget *window)
    : QObject(window)
    , m_window(window)
    , m_csv(monitor)
{
    m_patience.setSingleShot(true);
    m_patience.setInterval(Patience);
    connect(&m_patience, &QTimer::timeout, this, &PlotSaver::sayItLasts);
    connect(&m_csv, &CsvSave::written, &m_patience, &QTimer::stop);
    connect(&m_csv, &CsvSave::failed, &m_patience, &QTimer::stop);
    connect(&m_csv, &CsvSave::written, this, &PlotSaver::sayWritten);
    connect(&m_csv, &CsvSave::failed, this, &PlotSaver::sayFailed);
}

void PlotSaver::ask(const QString &title, const QString &suffix, std::function<void(const QString &)> save)
{
    askWhereToSave(m_window, title, suffix, suggestedFileName(suffix), std::move(save));
}

void PlotSaver::askForCsv(std::function<std::vector<CsvSave::Trace>()> traces, LineTime from, LineTime end)
{
    if (m_csv.isRunning())
        return sayItLasts();
    ask(tr("Save the samples in sight"), QStringLiteral("csv"),
        [this, traces = std::move(traces), from, end](const QString &path) {
            if (m_csv.isRunning())
                return sayItLasts();
            m_csv.start(path, traces(), from, end);
            m_patience.start();
        });
}

void PlotSaver::askForPicture(const QPixmap &picture)
{
    ask(tr("Save the plots as a picture"), QStringLiteral("png"),
        [this, picture](const QString &path) {
        if (const Result<void> result = savePicture(path, picture))
            sayWritten(path);
        else
            sayFailed(result.error());
    });
}

void PlotSaver::askForDrawing(const QByteArray &svg)
{
    ask(tr("Save the plots as a drawing"), QStringLiteral("svg"), [this, svg](const QString &path) {
        if (const Result<void> result = saveBytes(path, svg))
            sayWritten(path);
        else
            sayFailed(result.error());
    });
}

void PlotSaver::sayItLasts()
{
    emit posted({MessageKind::Info, tr("%1 is being written").arg(QDir::toNativeSeparators(m_csv.path())), tr("Cancel"),
        [csv = QPointer<CsvSave>(&m_csv)] {
            if (csv)
                csv->cancel();
        },
        Topic});
}

void PlotSaver::sayWritten(const QString &path)
{
    emit posted({MessageKind::Success, tr("Saved %1").arg(QDir::toNativeSeparators(path)), {}, {}, Topic});
}

void PlotSaver::sayFailed(const Error &error)
{
    const bool isWanted = error.kind == ErrorKind::Cancelled;
    emit posted({isWanted ? MessageKind::Info : MessageKind::Error, error.text, {}, {}, Topic});
}

} // namespace dynascope
