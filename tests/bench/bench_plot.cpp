// SPDX-License-Identifier: GPL-3.0-or-later
// One plot frame: new samples come, the view moves on, the panel is painted at 1200 × 700. The same data, antialiasing
// off or on as each draws by default, into the same kind of image, beside QLineSeries and QCustomPlot. "Anew" is what
// the wheel costs: another span with each frame, so axes and all columns are made again; "scrolled" what it costs to pull
// a paused view back by a fiftieth with each frame. Any argument: ours alone.
#undef QT_NO_FOREACH // which QCustomPlot's header needs

#include "ui/common/theme.h"
#include "ui/plot/plotchart.h"

#include <QApplication>
#include <QChart>
#include <QChartView>
#include <QElapsedTimer>
#include <QLineSeries>
#include <QPainter>
#include <QValueAxis>

#include <qcustomplot.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

using namespace dynascope;

namespace {

constexpr QSize PanelSize(1200, 700);
constexpr LineTime Interval = std::chrono::microseconds(600);
constexpr int NewSamples = 28; ///< of each trace between two frames, at 60 Hz

struct Load {
    int traces;
    int samples;
};

/// A slow swing with noise of its own for each trace; made up beforehand, so that making it isn't measured.
class Signals
{
public:
    Signals()
    {
        quint32 state = 1;
        for (int i = 0; i < Length; ++i) {
            state = state * 1664525U + 1013904223U;
            m_values.push_back(
                2048 + static_cast<int>(900 * std::sin(i * 2 * M_PI / Length * 25)) + static_cast<int>(state >> 26));
        }
    }
    std::int32_t operator()(int trace, std::int64_t index) const
    {
        return m_values[static_cast<std::size_t>((index + trace * 997) % Length)];
    }

private:
    static constexpr int Length = 1 << 16;
    std::vector<std::int32_t> m_values;
};

/// Median of the frames, in milliseconds.
double measure(const std::function<void(int frame)> &frame, int frames)
{
    std::vector<double> times;
    for (int i = 0; i < frames + 2; ++i) {
        QElapsedTimer timer;
        timer.start();
        frame(i);
        if (i >= 2)
            times.push_back(static_cast<double>(timer.nsecsElapsed()) / 1e6);
    }
    std::ranges::nth_element(times, times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2));
    return times[times.size() / 2];
}

/// The same target for all three.
void paint(QWidget &widget, QImage &image)
{
    QPainter painter(&image);
    widget.render(&painter, {}, {}, QWidget::DrawWindowBackground | QWidget::DrawChildren);
}

enum class Motion { Live, Anew, Scrolled };

double measureOurs(const Signals &signal, const Load &load, QImage &image, Motion motion)
{
    std::vector<std::unique_ptr<History>> histories;
    std::vector<TraceData> traces;
    std::int64_t count = 0;
    for (int i = 0; i < load.traces; ++i) {
        histories.push_back(std::make_unique<History>());
        TraceData trace;
        trace.history = histories.back().get();
        trace.unit = QStringLiteral("°");
        trace.scale = 360.0 / 4096;
        trace.color = traceColor(i, QApplication::palette());
        traces.push_back(trace);
    }
    const auto append = [&](std::int64_t upTo) {
        for (; count < upTo; ++count) {
            for (int i = 0; i < load.traces; ++i)
                histories[static_cast<std::size_t>(i)]->append(Interval * count, signal(i, count));
        }
    };
    append(motion == Motion::Scrolled ? 2 * load.samples : load.samples);
    TimeWindow window;
    window.setSpan(Interval * load.samples);
    if (motion == Motion::Scrolled)
        window.pause(histories.front()->last().at);
    PlotChart chart(window);
    chart.resize(PanelSize);
    const auto frame = [&](int number) {
        if (motion == Motion::Scrolled) {
            window.pan(Interval * load.samples / (number % 40 < 20 ? -50 : 50));
        } else {
            append(count + NewSamples);
        }
        if (motion == Motion::Anew) // another width of column each time: nothing that was kept is of use
            window.setSpan(Interval * (load.samples - static_cast<int>(count / NewSamples % 7) * load.samples / 100));
        chart.setTraces(traces);
        chart.setNewest(histories.front()->last().at);
        paint(chart, image);
    };
    return measure(frame, 60);
}

double measureLineSeries(const Signals &signal, const Load &load, QImage &image)
{
    auto *chart = new QChart; // the view's
    chart->legend()->hide();
    auto *time = new QValueAxis;
    auto *value = new QValueAxis;
    chart->addAxis(time, Qt::AlignBottom);
    chart->addAxis(value, Qt::AlignLeft);
    std::vector<QLineSeries *> series;
    for (int i = 0; i < load.traces; ++i) {
        series.push_back(new QLineSeries);
        chart->addSeries(series.back());
        series.back()->attachAxis(time);
        series.back()->attachAxis(value);
        series.back()->setPen(QPen(traceColor(i, QApplication::palette()), 1));
    }
    const double seconds = load.samples * 1e-3;
    time->setRange(-seconds, 0);
    value->setRange(60, 300);
    QChartView view(chart);
    view.resize(PanelSize);
    std::int64_t first = 0;
    const auto frame = [&](int) {
        first += NewSamples;
        for (int trace = 0; trace < load.traces; ++trace) {
            QList<QPointF> points;
            points.reserve(load.samples);
            for (int i = 0; i < load.samples; ++i)
                points.append({(i - load.samples) * 1e-3, signal(trace, first + i) * 360.0 / 4096});
            series[static_cast<std::size_t>(trace)]->replace(points);
        }
        paint(view, image);
    };
    return measure(frame, load.traces * load.samples > 100'000 ? 5 : 20);
}

double measureCustomPlot(const Signals &signal, const Load &load, QImage &image)
{
    QCustomPlot plot;
    plot.resize(PanelSize);
    plot.setViewport(QRect(QPoint(), PanelSize));
    plot.xAxis->setRange(-load.samples * 1e-3, 0);
    plot.yAxis->setRange(60, 300);
    for (int i = 0; i < load.traces; ++i) {
        plot.addGraph()->setAdaptiveSampling(true);
        plot.graph(i)->setPen(QPen(traceColor(i, QApplication::palette()), 1));
    }
    std::int64_t first = 0;
    QVector<double> keys(load.samples);
    QVector<double> values(load.samples);
    const auto frame = [&](int) {
        first += NewSamples;
        for (int trace = 0; trace < load.traces; ++trace) {
            for (int i = 0; i < load.samples; ++i) {
                keys[i] = (i - load.samples) * 1e-3;
                values[i] = signal(trace, first + i) * 360.0 / 4096;
            }
            plot.graph(trace)->setData(keys, values, true);
        }
        plot.replot(QCustomPlot::rpImmediateRefresh);
        paint(plot, image);
    };
    return measure(frame, load.traces * load.samples > 100'000 ? 5 : 20);
}

} // namespace

int main(int argc, char **argv)
{
    qputenv("QT_QPA_PLATFORM", "offscreen");
    QApplication application(argc, argv);
    applyTheme(application, ColorScheme::Light);
    const Signals signal;
    QImage image(PanelSize, QImage::Format_ARGB32_Premultiplied);
    std::printf("One plot frame, 1200 x 700, median, ms (in brackets: how many times ours)\n");
    std::printf(
        "%-18s %10s %12s %10s %20s %20s\n", "traces x samples", "ours", "ours, anew", "scrolled", "QLineSeries", "QCustomPlot");
    const bool oursOnly = argc > 1;
    for (const Load load : {Load{8, 2000}, Load{40, 2000}, Load{40, 60'000}, Load{40, 1'000'000}}) {
        const double ours = measureOurs(signal, load, image, Motion::Live);
        const double anew = measureOurs(signal, load, image, Motion::Anew);
        const double scrolled = measureOurs(signal, load, image, Motion::Scrolled);
        std::printf("%3d x %-12d %10.2f %12.2f %10.2f", load.traces, load.samples, ours, anew, scrolled);
        if (load.samples < 1'000'000 && !oursOnly) {
            const double series = measureLineSeries(signal, load, image);
            const double custom = measureCustomPlot(signal, load, image);
            std::printf(" %12.2f (%5.1f) %12.2f (%5.1f)", series, series / ours, custom, custom / ours);
        }
        std::printf("\n");
        std::fflush(stdout);
    }
    return 0;
}
