// SPDX-License-Identifier: GPL-3.0-or-later
// What is seen goes into files.
#include "ui/plot/plotarea.h"

#include "ui/plot/plotchart.h"
#include "ui/plot/plotpanel.h"
#include "ui/plot/plotsaver.h"
#include "ui/plot/tracemodel.h"

#include <QBuffer>
#include <QPainter>
#include <QSplitter>
#include <QSvgGenerator>

namespace dynascope {

void PlotArea::saveCsvFile()
{
    // The view as it is now: a live one moves on while the person chooses a name.
    const TimeView view = m_present->chart().view();
    const auto traces = [this] {
        std::vector<CsvSave::Trace> all;
        for (const PlotPanel *panel : m_panels) {
            const std::vector<TraceData> drawn = panel->model().drawn(palette());
            for (std::size_t row = 0; row < drawn.size(); ++row)
                all.push_back({panel->model().watch(static_cast<int>(row)), drawn[row],
                    panel->model().derivedHistory(static_cast<int>(row))});
        }
        return all;
    };
    m_saver->askForCsv(traces, view.from(), view.to());
}

/// As it is now: a live plot moves on while the person chooses a name.
void PlotArea::saveSvg()
{
    QByteArray drawing;
    QBuffer buffer(&drawing);
    QSvgGenerator generator;
    generator.setOutputDevice(&buffer);
    generator.setSize(m_splitter->size());
    generator.setViewBox(m_splitter->rect());
    generator.setResolution(96);
    generator.setTitle(tr("Dynascope plots"));
    for (PlotPanel *panel : m_panels)
        panel->chart().setVector(true);
    {
        QPainter painter(&generator);
        m_splitter->render(&painter);
    }
    for (PlotPanel *panel : m_panels)
        panel->chart().setVector(false);
    m_saver->askForDrawing(drawing);
}

} // namespace dynascope
