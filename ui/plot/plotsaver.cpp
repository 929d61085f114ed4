// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/plotsaver.h"

#include "ui/common/filedialogs.h"
#include "ui/plot/plotchart.h"
#include "ui/plot/plotdrawing.h"
#include "ui/plot/plotpanel.h"
#include "ui/plot/tracemodel.h"

#include <QBuffer>
#include <QDir>
#include <QPainter>
#include <QPointer>
#include <QSvgGenerator>

namespace dynascope {

namespace {

using namespace std::chrono_literals;

constexpr auto Patience = 500ms;
const QString Topic = QStringLiteral("save");

} // namespace

PlotSaver::PlotSaver(const Monitor &monitor, const std::vector<PlotPanel *> &panels, QWidget &window)
    : m_panels(panels)
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
    askWhereToSave(&m_window, title, suffix, suggestedFileName(suffix), std::move(save));
}

std::vector<CsvSave::Trace> PlotSaver::traces() const
{
    std::vector<CsvSave::Trace> all;
    for (const PlotPanel *panel : m_panels) {
        const std::vector<TraceData> drawn = panel->model().drawn(panel->palette());
        for (std::size_t row = 0; row < drawn.size(); ++row)
            all.push_back({panel->model().watch(static_cast<int>(row)), drawn[row],
                panel->model().derivedHistory(static_cast<int>(row))});
    }
    return all;
}

void PlotSaver::saveCsv(const PlotPanel &timed)
{
    if (m_csv.isRunning())
        return sayItLasts();
    const TimeView view = timed.chart().view();
    ask(tr("Save the samples in sight"), QStringLiteral("csv"), [this, from = view.from(), end = view.to()](const QString &path) {
        if (m_csv.isRunning())
            return sayItLasts();
        m_csv.start(path, traces(), from, end);
        m_patience.start();
    });
}

/// As sharp as on the screen.
void PlotSaver::savePicture()
{
    const PlotDrawing drawing(m_panels);
    QPixmap picture(drawing.size() * m_window.devicePixelRatioF());
    picture.setDevicePixelRatio(m_window.devicePixelRatioF());
    if (!picture.isNull()) {
        QPainter painter(&picture);
        drawing.paint(painter);
    }
    ask(tr("Save the plots as a picture"), QStringLiteral("png"), [this, picture](const QString &path) {
        if (const Result<void> result = dynascope::savePicture(path, picture))
            sayWritten(path);
        else
            sayFailed(result.error());
    });
}

void PlotSaver::saveDrawing()
{
    const PlotDrawing drawing(m_panels);
    QByteArray svg;
    QBuffer buffer(&svg);
    QSvgGenerator generator;
    generator.setOutputDevice(&buffer);
    generator.setSize(drawing.size());
    generator.setViewBox(QRect(QPoint(), drawing.size()));
    generator.setResolution(96);
    generator.setTitle(tr("Dynascope plots"));
    for (PlotPanel *panel : m_panels)
        panel->chart().setVector(true);
    {
        QPainter painter(&generator);
        drawing.paint(painter);
    }
    for (PlotPanel *panel : m_panels)
        panel->chart().setVector(false);
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
