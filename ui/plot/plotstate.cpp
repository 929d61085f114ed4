// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/plotstate.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>

#include <algorithm>

namespace dynascope {

namespace {

constexpr qsizetype MostBytes = 256 * 1024;
constexpr int MostPanels = 16;
constexpr int MostTraces = 256;

QJsonObject toJson(const PlotState::Trace &trace)
{
    return {{QStringLiteral("line"), trace.line}, {QStringLiteral("model"), trace.modelNumber},
        {QStringLiteral("id"), trace.id}, {QStringLiteral("field"), trace.field},
        {QStringLiteral("color"), trace.color}, {QStringLiteral("visible"), trace.visible}};
}

PlotState::Trace traceFromJson(const QJsonObject &object)
{
    PlotState::Trace trace;
    trace.line = object[QStringLiteral("line")].toString();
    trace.modelNumber = object[QStringLiteral("model")].toInt();
    trace.id = object[QStringLiteral("id")].toInt();
    trace.field = object[QStringLiteral("field")].toString();
    trace.color = std::clamp(object[QStringLiteral("color")].toInt(), 0, MostTraces);
    trace.visible = object[QStringLiteral("visible")].toBool(true);
    return trace;
}

} // namespace

bool PlotState::Trace::fits(const Device &device) const
{
    return device.line() && device.line()->name() == line && device.table().modelNumber() == modelNumber
        && device.id() == id && device.table().indexOf(field) >= 0;
}

QByteArray PlotState::toBytes() const
{
    QJsonArray all;
    for (const std::vector<Trace> &panel : panels) {
        QJsonArray traces;
        for (const Trace &trace : panel)
            traces.append(toJson(trace));
        all.append(traces);
    }
    const QJsonObject object{{QStringLiteral("span"), spanSeconds}, {QStringLiteral("autoscale"), autoscale},
        {QStringLiteral("panels"), all}};
    return QJsonDocument(object).toJson(QJsonDocument::Compact);
}

std::optional<PlotState> PlotState::fromBytes(const QByteArray &bytes)
{
    if (bytes.isEmpty() || bytes.size() > MostBytes)
        return std::nullopt;
    const QJsonDocument document = QJsonDocument::fromJson(bytes);
    if (!document.isObject())
        return std::nullopt;
    const QJsonObject object = document.object();
    PlotState state;
    state.spanSeconds = object[QStringLiteral("span")].toInt(state.spanSeconds);
    state.autoscale = object[QStringLiteral("autoscale")].toBool(true);
    for (const QJsonValue panel : object[QStringLiteral("panels")].toArray()) {
        if (state.panels.size() == MostPanels)
            break;
        std::vector<Trace> traces;
        for (const QJsonValue trace : panel.toArray()) {
            if (traces.size() < MostTraces)
                traces.push_back(traceFromJson(trace.toObject()));
        }
        state.panels.push_back(std::move(traces));
    }
    return state;
}

} // namespace dynascope
