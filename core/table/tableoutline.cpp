// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/tableoutline.h"

#include "core/table/jsonscanner.h"

namespace dynascope {
namespace {

int numberIn(QByteArrayView text)
{
    bool ok = false;
    const int number = text.toByteArray().toInt(&ok);
    return ok ? number : -1; // null among them
}

void take(TableOutline::Facts &facts, QByteArrayView key, QByteArrayView value)
{
    if (key == "series")
        facts.series = QString::fromUtf8(value);
    else if (key == "newestFirmware")
        facts.newestFirmware = numberIn(value);
    else if (key == "modbusNumberOffset")
        facts.modbusNumberOffset = numberIn(value);
    else if (key == "addressesOnly")
        facts.addressesOnly = value == "true";
}

void take(TableOutline::Model &model, QByteArrayView key, QByteArrayView value)
{
    if (key == "number")
        model.number = numberIn(value);
    else if (key == "replaces")
        model.replaces = numberIn(value);
    else if (key == "alsoCalled")
        model.alsoCalled.append(QString::fromUtf8(value));
    else
        take(model.own, key, value);
}

} // namespace

void TableOutline::Facts::lay(const Facts &over)
{
    if (over.series)
        series = over.series;
    if (over.newestFirmware)
        newestFirmware = over.newestFirmware;
    if (over.modbusNumberOffset)
        modbusNumberOffset = over.modbusNumberOffset;
    if (over.addressesOnly)
        addressesOnly = over.addressesOnly;
}

TableOutline outlineOf(QByteArrayView json)
{
    TableOutline outline;
    QByteArrayView key[4]; // the last one seen at each depth
    JsonScanner scanner(json);
    for (auto token = scanner.next(); token != JsonScanner::Token::End; token = scanner.next()) {
        const int depth = scanner.depth();
        if (token == JsonScanner::Token::Key && depth < 4) {
            key[depth] = scanner.text();
            if (depth == 2 && key[1] == "models")
                outline.models.push_back({QString::fromUtf8(scanner.text()), -1, -1, {}, {}});
        } else if (token == JsonScanner::Token::Value) {
            const bool inModel = key[1] == "models" && !outline.models.empty();
            if (depth == 1 && key[1] == "extends")
                outline.extends = QString::fromUtf8(scanner.text());
            else if (depth == 1)
                take(outline.shared, key[1], scanner.text());
            else if (inModel && (depth == 3 || (depth == 4 && key[3] == "alsoCalled")))
                take(outline.models.back(), key[3], scanner.text());
        }
    }
    return outline;
}

} // namespace dynascope
