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
constexpr int MostPanels = 16;
constexpr int MostTraces = 256;

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
    trace.color = std::clamp(object[QStringLiteral("color")].toInt(), 0, MostTraces);
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
