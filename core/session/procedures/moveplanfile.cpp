// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/procedures/moveplan.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>

#include <cmath>

namespace dynascope {
namespace {

constexpr int Format = 1;
constexpr qsizetype LargestFile = 1024 * 1024, MostDevices = 512, MostSteps = 2048, MostRates = 32;
constexpr qsizetype LongestText = 1024;

tl::unexpected<Error> damaged()
{
    return failure(ErrorKind::BadFile, QStringLiteral("this is no plan of moves, or it is damaged"));
}

/// Nothing where it isn't a whole number from `least` to `most`.
std::optional<int> number(const QJsonValue &value, int least, int most)
{
    const double raw = value.toDouble(std::nan(""));
    if (!(raw >= least && raw <= most) || std::floor(raw) != raw)
        return std::nullopt;
    return static_cast<int>(raw);
}

QJsonArray toArray(const MovePlace &place)
{
    return {place.baudRate, place.id};
}

std::optional<MovePlace> placeOf(const QJsonValue &value)
{
    const QJsonArray array = value.toArray();
    const auto rate = number(array.at(0), 1, HighestBaudRate), id = number(array.at(1), 0, MaximumId);
    if (array.size() != 2 || !rate || !id)
        return std::nullopt;
    return MovePlace{*rate, *id};
}

QJsonObject toObject(const MoveDevice &device)
{
    QJsonArray rates;
    for (const auto &[rate, code] : device.rates)
        rates.append(QJsonArray{rate, code});
    return {{QLatin1String("name"), device.place.name.left(LongestText)},
            {QLatin1String("place"), toArray({device.place.baudRate, device.place.id})},
            {QLatin1String("goal"), toArray(device.goal)},
            {QLatin1String("model"), device.place.modelNumber},
            {QLatin1String("firmware"), device.firmware},
            {QLatin1String("secondary"), device.secondaryId},
            {QLatin1String("torque"), device.place.torqueAddress},
            {QLatin1String("idAt"), device.idAddress},
            {QLatin1String("baudAt"), device.baudAddress},
            {QLatin1String("rates"), rates}};
}

std::optional<MoveDevice> deviceOf(const QJsonObject &object)
{
    const auto value = [&](const char *key, int least, int most) {
        return number(object.value(QLatin1String(key)), least, most);
    };
    const auto place = placeOf(object.value(QLatin1String("place")));
    const auto goal = placeOf(object.value(QLatin1String("goal")));
    const auto model = value("model", 0, 65535), firmware = value("firmware", 0, 255),
               secondary = value("secondary", -1, 255), torque = value("torque", 0, 65535),
               idAt = value("idAt", 0, 65535), baudAt = value("baudAt", 0, 65535);
    const QJsonArray rates = object.value(QLatin1String("rates")).toArray();
    if (!place || !goal || !model || !firmware || !secondary || !torque || !idAt || !baudAt || rates.size() > MostRates)
        return std::nullopt;
    MoveDevice device;
    device.place.id = static_cast<std::uint8_t>(place->id);
    device.place.baudRate = place->baudRate;
    device.place.modelNumber = static_cast<std::uint16_t>(*model);
    device.place.torqueAddress = static_cast<std::uint16_t>(*torque);
    device.place.name = object.value(QLatin1String("name")).toString().left(LongestText);
    device.firmware = *firmware;
    device.secondaryId = *secondary;
    device.goal = *goal;
    device.idAddress = static_cast<std::uint16_t>(*idAt);
    device.baudAddress = static_cast<std::uint16_t>(*baudAt);
    for (const QJsonValue &each : rates) {
        const auto rate = number(each.toArray().at(0), 1, HighestBaudRate), code = number(each.toArray().at(1), 0, 255);
        if (!rate || !code)
            return std::nullopt;
        device.rates.emplace_back(*rate, *code);
    }
    return device;
}

} // namespace

QByteArray toJson(const MovePlan &plan)
{
    QJsonArray devices, steps;
    for (const MoveDevice &device : plan.devices)
        devices.append(toObject(device));
    for (const MoveStep &step : plan.steps) {
        steps.append(QJsonObject{{QLatin1String("device"), static_cast<int>(step.device)},
                                 {QLatin1String("from"), toArray(step.from)},
                                 {QLatin1String("to"), toArray(step.to)},
                                 {QLatin1String("detour"), step.isDetour}});
    }
    return QJsonDocument(QJsonObject{{QLatin1String("moves"), Format},
                                     {QLatin1String("line"), plan.line.left(LongestText)},
                                     {QLatin1String("adapter"), plan.adapter.left(LongestText)},
                                     {QLatin1String("torqueOff"), plan.turnTorqueOff},
                                     {QLatin1String("next"), static_cast<int>(plan.next)},
                                     {QLatin1String("devices"), devices},
                                     {QLatin1String("steps"), steps}})
        .toJson(QJsonDocument::Indented);
}

Result<MovePlan> movePlanFromJson(const QByteArray &json)
{
    const QJsonObject object = json.size() > LargestFile ? QJsonObject() : QJsonDocument::fromJson(json).object();
    const QJsonArray devices = object.value(QLatin1String("devices")).toArray();
    const QJsonArray steps = object.value(QLatin1String("steps")).toArray();
    const auto next = number(object.value(QLatin1String("next")), 0, static_cast<int>(steps.size()));
    if (object.value(QLatin1String("moves")).toInt() != Format || !next || devices.size() > MostDevices
        || steps.size() > MostSteps)
        return damaged();
    MovePlan plan;
    plan.line = object.value(QLatin1String("line")).toString().left(LongestText);
    plan.adapter = object.value(QLatin1String("adapter")).toString().left(LongestText);
    plan.turnTorqueOff = object.value(QLatin1String("torqueOff")).toBool();
    plan.next = static_cast<std::size_t>(*next);
    for (const QJsonValue &each : devices) {
        const auto device = deviceOf(each.toObject());
        if (!device)
            return damaged();
        plan.devices.push_back(*device);
    }
    std::vector<MovePlace> places; // each step begins where its device is, and changes one thing
    for (const MoveDevice &device : plan.devices)
        places.push_back({device.place.baudRate, device.place.id});
    for (const QJsonValue &each : steps) {
        const auto device = number(each[QLatin1String("device")], 0, static_cast<int>(plan.devices.size()) - 1);
        const auto from = placeOf(each[QLatin1String("from")]), to = placeOf(each[QLatin1String("to")]);
        if (!device || !from || !to)
            return damaged();
        MovePlace &place = places[static_cast<std::size_t>(*device)];
        if (place != *from || (from->id != to->id) == (from->baudRate != to->baudRate))
            return damaged();
        place = *to;
        plan.steps.push_back({static_cast<std::size_t>(*device), *from, *to, each[QLatin1String("detour")].toBool()});
    }
    return plan;
}

} // namespace dynascope
