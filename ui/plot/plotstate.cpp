// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/plotstate.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>

#include <algorithm>
#include <cmath>

namespace dynascope {

namespace {

constexpr qsizetype MostBytes = 256 * 1024;
constexpr std::size_t MostPanels = 16;
constexpr std::size_t MostTraces = 256;

constexpr int LongestText = 256;

const std::vector<std::pair<Derivation::Kind, QString>> &kindNames()
{
    using Kind = Derivation::Kind;
    static const std::vector<std::pair<Kind, QString>> names{{Kind::Difference, QStringLiteral("difference")},
        {Kind::Derivative, QStringLiteral("derivative")}, {Kind::Average, QStringLiteral("average")},
        {Kind::Scaled, QStringLiteral("scaled")}};
    return names;
}

QString textOf(const QJsonObject &object, const QString &key)
{
    return object[key].toString().left(LongestText);
}

QJsonObject toJson(const PlotState::Trace &trace)
{
    QJsonObject object{{QStringLiteral("line"), trace.line}, {QStringLiteral("model"), trace.modelNumber},
        {QStringLiteral("id"), trace.id}, {QStringLiteral("field"), trace.field},
        {QStringLiteral("color"), trace.color}, {QStringLiteral("visible"), trace.visible}};
    const Derivation &how = trace.derivation;
    const auto name = std::ranges::find(kindNames(), how.kind, &std::pair<Derivation::Kind, QString>::first);
    if (name == kindNames().end())
        return object;
    QJsonObject derived{{QStringLiteral("kind"), name->second}};
    if (how.kind == Derivation::Kind::Difference) {
        derived[QStringLiteral("less")] = QJsonObject{{QStringLiteral("line"), trace.otherLine},
            {QStringLiteral("model"), trace.otherModel}, {QStringLiteral("id"), trace.otherId},
            {QStringLiteral("field"), trace.otherField}};
    } else if (how.kind == Derivation::Kind::Scaled) {
        derived[QStringLiteral("factor")] = how.factor;
        derived[QStringLiteral("offset")] = how.offset;
        derived[QStringLiteral("unit")] = how.unit;
    } else {
        derived[QStringLiteral("microseconds")]
            = static_cast<double>(std::chrono::duration_cast<std::chrono::microseconds>(how.span).count());
    }
    object[QStringLiteral("derived")] = derived;
    return object;
}

void derivationFromJson(const QJsonObject &object, PlotState::Trace &trace)
{
    const QString kind = object[QStringLiteral("kind")].toString();
    const auto name = std::ranges::find(kindNames(), kind, &std::pair<Derivation::Kind, QString>::second);
    if (name == kindNames().end())
        return;
    Derivation &how = trace.derivation;
    how.kind = name->first;
    if (how.kind == Derivation::Kind::Difference) {
        const QJsonObject less = object[QStringLiteral("less")].toObject();
        trace.otherLine = textOf(less, QStringLiteral("line"));
        trace.otherModel = less[QStringLiteral("model")].toInt();
        trace.otherId = less[QStringLiteral("id")].toInt();
        trace.otherField = textOf(less, QStringLiteral("field"));
    } else if (how.kind == Derivation::Kind::Scaled) {
        constexpr double Most = 1e12;
        how.factor = std::clamp(object[QStringLiteral("factor")].toDouble(1), -Most, Most);
        how.offset = std::clamp(object[QStringLiteral("offset")].toDouble(), -Most, Most);
        how.unit = object[QStringLiteral("unit")].toString().left(12);
    } else {
        const double most = std::chrono::duration<double, std::micro>(Derivation::LongestSpan).count();
        how.span = std::chrono::microseconds(
            std::llround(std::clamp(object[QStringLiteral("microseconds")].toDouble(), 0.0, most)));
    }
}

PlotState::Trace traceFromJson(const QJsonObject &object)
{
    PlotState::Trace trace;
    trace.line = textOf(object, QStringLiteral("line"));
    trace.modelNumber = object[QStringLiteral("model")].toInt();
    trace.id = object[QStringLiteral("id")].toInt();
    trace.field = textOf(object, QStringLiteral("field"));
    trace.color = std::clamp(object[QStringLiteral("color")].toInt(), 0, static_cast<int>(MostTraces));
    trace.visible = object[QStringLiteral("visible")].toBool(true);
    derivationFromJson(object[QStringLiteral("derived")].toObject(), trace);
    return trace;
}

std::optional<Watch> findField(
    const std::vector<Device *> &devices, const QString &line, int modelNumber, int id, const QString &field)
{
    for (const Device *device : devices) {
        if (!device->line() || device->line()->name() != line || device->table().modelNumber() != modelNumber
            || device->id() != id)
            continue;
        if (const int index = device->table().indexOf(field); index >= 0)
            return Watch{device->key(), index};
    }
    return std::nullopt;
}

} // namespace

std::optional<TraceKey> PlotState::Trace::find(const std::vector<Device *> &devices) const
{
    const std::optional<Watch> watch = findField(devices, line, modelNumber, id, field);
    if (!watch)
        return std::nullopt;
    TraceKey key(*watch, derivation);
    if (derivation.kind == Derivation::Kind::Difference) {
        const std::optional<Watch> other = findField(devices, otherLine, otherModel, otherId, otherField);
        if (!other)
            return std::nullopt;
        key.derivation.other = *other;
    }
    return key;
}

std::optional<PlotState::Trace> PlotState::Trace::of(const TraceKey &key, const Session &session)
{
    const Device *device = session.device(key.watch.device);
    if (!device || !device->line())
        return std::nullopt;
    const auto fieldName = [](const Device &of, int field) {
        return of.table().fields()[static_cast<std::size_t>(field)].name;
    };
    Trace trace{device->line()->name(), device->table().modelNumber(), device->id(),
        fieldName(*device, key.watch.field)};
    trace.derivation = key.derivation;
    trace.derivation.other = {};
    if (key.derivation.kind == Derivation::Kind::Difference) {
        const Device *other = session.device(key.derivation.other.device);
        if (!other || !other->line())
            return std::nullopt;
        trace.otherLine = other->line()->name();
        trace.otherModel = other->table().modelNumber();
        trace.otherId = other->id();
        trace.otherField = fieldName(*other, key.derivation.other.field);
    }
    return trace;
}

QByteArray PlotState::toBytes() const
{
    const auto list = [](const std::vector<Trace> &traces) {
        QJsonArray array;
        for (const Trace &trace : traces)
            array.append(toJson(trace));
        return array;
    };
    QJsonArray all;
    for (const std::vector<Trace> &panel : panels)
        all.append(list(panel));
    QJsonArray looksArray;
    for (const Look &look : looks) {
        QJsonArray axes;
        for (const Look::Axis &axis : look.axes)
            axes.append(QJsonObject{{QStringLiteral("unit"), axis.unit}, {QStringLiteral("min"), axis.minimum},
                {QStringLiteral("max"), axis.maximum}});
        looksArray.append(QJsonObject{{QStringLiteral("ownTime"), look.hasOwnTime},
            {QStringLiteral("span"), look.spanSeconds}, {QStringLiteral("axes"), axes}});
    }
    const auto milliseconds
        = [](LineTime time) { return static_cast<int>(std::chrono::duration_cast<std::chrono::milliseconds>(time).count()); };
    QJsonObject on{{QStringLiteral("level"), trigger.level}, {QStringLiteral("hysteresis"), trigger.hysteresis},
        {QStringLiteral("kind"), static_cast<int>(trigger.settings.kind)},
        {QStringLiteral("mode"), static_cast<int>(trigger.settings.mode)},
        {QStringLiteral("before"), milliseconds(trigger.settings.before)},
        {QStringLiteral("after"), milliseconds(trigger.settings.after)}};
    if (trigger.trace)
        on[QStringLiteral("trace")] = toJson(*trigger.trace);
    const QJsonObject object{{QStringLiteral("version"), Version}, {QStringLiteral("span"), spanSeconds},
        {QStringLiteral("autoscale"), autoscale}, {QStringLiteral("panels"), all}, {QStringLiteral("looks"), looksArray},
        {QStringLiteral("colors"), list(colors)}, {QStringLiteral("trigger"), on}};
    return QJsonDocument(object).toJson(QJsonDocument::Compact);
}

namespace {

std::vector<PlotState::Trace> tracesFromJson(const QJsonArray &array)
{
    std::vector<PlotState::Trace> traces;
    for (const QJsonValue trace : array) {
        if (traces.size() < MostTraces)
            traces.push_back(traceFromJson(trace.toObject()));
    }
    return traces;
}

PlotState::Look lookFromJson(const QJsonObject &object)
{
    constexpr std::size_t MostAxes = 16;
    PlotState::Look look;
    look.hasOwnTime = object[QStringLiteral("ownTime")].toBool();
    look.spanSeconds = object[QStringLiteral("span")].toInt(look.spanSeconds);
    for (const QJsonValue axis : object[QStringLiteral("axes")].toArray()) {
        const double low = axis[QStringLiteral("min")].toDouble();
        const double high = axis[QStringLiteral("max")].toDouble();
        if (look.axes.size() < MostAxes && low < high && std::abs(low) < 1e12 && std::abs(high) < 1e12)
            look.axes.push_back({axis[QStringLiteral("unit")].toString().left(16), low, high});
    }
    return look;
}

PlotState::TriggerState triggerFromJson(const QJsonObject &object)
{
    constexpr int LongestPart = 300'000; // ms
    PlotState::TriggerState trigger;
    if (object[QStringLiteral("trace")].isObject())
        trigger.trace = traceFromJson(object[QStringLiteral("trace")].toObject());
    trigger.level = std::clamp(object[QStringLiteral("level")].toDouble(), -1e9, 1e9);
    trigger.hysteresis = std::clamp(object[QStringLiteral("hysteresis")].toDouble(), 0.0, 1e9);
    TriggerSettings &settings = trigger.settings;
    settings.kind = static_cast<TriggerSettings::Kind>(std::clamp(object[QStringLiteral("kind")].toInt(), 0, 3));
    settings.mode = static_cast<TriggerSettings::Mode>(std::clamp(object[QStringLiteral("mode")].toInt(1), 0, 2));
    settings.before = std::chrono::milliseconds(std::clamp(object[QStringLiteral("before")].toInt(500), 0, LongestPart));
    settings.after = std::chrono::milliseconds(std::clamp(object[QStringLiteral("after")].toInt(1500), 1, LongestPart));
    return trigger;
}

} // namespace

std::optional<PlotState> PlotState::fromBytes(const QByteArray &bytes)
{
    if (bytes.isEmpty() || bytes.size() > MostBytes)
        return std::nullopt;
    const QJsonDocument document = QJsonDocument::fromJson(bytes);
    if (!document.isObject())
        return std::nullopt;
    const QJsonObject object = document.object();
    if (object[QStringLiteral("version")].toInt(1) > Version)
        return std::nullopt; // of a later program
    PlotState state;
    state.spanSeconds = object[QStringLiteral("span")].toInt(state.spanSeconds);
    state.autoscale = object[QStringLiteral("autoscale")].toBool(true);
    for (const QJsonValue panel : object[QStringLiteral("panels")].toArray()) {
        if (state.panels.size() < MostPanels)
            state.panels.push_back(tracesFromJson(panel.toArray()));
    }
    for (const QJsonValue look : object[QStringLiteral("looks")].toArray()) {
        if (state.looks.size() < state.panels.size())
            state.looks.push_back(lookFromJson(look.toObject()));
    }
    state.colors = tracesFromJson(object[QStringLiteral("colors")].toArray());
    state.trigger = triggerFromJson(object[QStringLiteral("trigger")].toObject());
    return state;
}

} // namespace dynascope
