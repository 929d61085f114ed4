// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/plotlayouts.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QSettings>

#include <algorithm>
#include <set>

namespace dynascope::plotlayouts {

namespace {

const QString Key = QStringLiteral("plots/layouts");
constexpr qsizetype MostBytes = 8 * 1024 * 1024;

void write(const std::vector<Layout> &layouts)
{
    QJsonArray all;
    for (const Layout &layout : layouts)
        all.append(QJsonObject{{QStringLiteral("name"), layout.name},
            {QStringLiteral("state"), QJsonDocument::fromJson(layout.state.toBytes()).object()}});
    QSettings().setValue(Key, QJsonDocument(all).toJson(QJsonDocument::Compact));
}

const Device *deviceLike(const std::vector<Device *> &devices, int modelNumber, int id)
{
    const auto at = std::ranges::find_if(devices, [&](const Device *device) {
        return device->line() && device->table().modelNumber() == modelNumber && device->id() == id;
    });
    return at == devices.end() ? nullptr : *at;
}

} // namespace

std::vector<Layout> load()
{
    std::vector<Layout> layouts;
    const QByteArray bytes = QSettings().value(Key).toByteArray();
    if (bytes.size() > MostBytes)
        return layouts;
    for (const QJsonValue value : QJsonDocument::fromJson(bytes).array()) {
        const QString name = value[QStringLiteral("name")].toString().left(LongestName);
        const std::optional<PlotState> state = PlotState::fromBytes(
            QJsonDocument(value[QStringLiteral("state")].toObject()).toJson(QJsonDocument::Compact));
        const bool isTwice = std::ranges::find(layouts, name, &Layout::name) != layouts.end();
        if (!name.isEmpty() && !isTwice && state && !state->panels.empty() && layouts.size() < Most)
            layouts.push_back({name, *state});
    }
    std::ranges::sort(layouts, {}, &Layout::name);
    return layouts;
}

bool store(const QString &name, const PlotState &state)
{
    const QString wanted = name.simplified().left(LongestName);
    std::vector<Layout> layouts = load();
    const auto at = std::ranges::find(layouts, wanted, &Layout::name);
    if (wanted.isEmpty() || (at == layouts.end() && layouts.size() >= Most))
        return false;
    if (at != layouts.end())
        at->state = state;
    else
        layouts.push_back({wanted, state});
    write(layouts);
    return true;
}

void remove(const QString &name)
{
    std::vector<Layout> layouts = load();
    std::erase_if(layouts, [&name](const Layout &layout) { return layout.name == name; });
    write(layouts);
}

bool fits(const PlotState &state, const std::vector<Device *> &devices)
{
    std::set<std::pair<int, int>> wanted;
    for (const std::vector<PlotState::Trace> &panel : state.panels) {
        for (const PlotState::Trace &trace : panel)
            wanted.insert({trace.modelNumber, trace.id});
    }
    const auto there = std::ranges::count_if(
        wanted, [&devices](const auto &one) { return deviceLike(devices, one.first, one.second) != nullptr; });
    return 2 * there >= std::ssize(wanted);
}

PlotState found(PlotState state, const std::vector<Device *> &devices)
{
    const auto move = [&devices](PlotState::Trace &trace) {
        if (trace.find(devices))
            return;
        if (const Device *device = deviceLike(devices, trace.modelNumber, trace.id))
            trace.line = device->line()->name();
        if (const Device *other = deviceLike(devices, trace.otherModel, trace.otherId))
            trace.otherLine = other->line()->name();
    };
    for (std::vector<PlotState::Trace> &panel : state.panels)
        std::ranges::for_each(panel, move);
    if (state.trigger.trace)
        move(*state.trigger.trace);
    return state;
}

} // namespace dynascope::plotlayouts
