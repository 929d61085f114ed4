// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/showvalue.h"

#include "core/table/units.h"

namespace dynascope::dxl {

void showField(Output &output, Device &device, const Field &field, std::int64_t raw)
{
    const EffectiveField units = device.units(field);
    const int resolution = device.table()->resolution();
    const QString named = meaning(field, raw);
    Document document;
    document.add("id", qint64(device.id()))
        .add("field", field.name)
        .add("address", qint64(field.address))
        .add("raw", qint64(raw));
    if (units.unit == Unit::None && units.scale == 1.0)
        document.add("value", qint64(raw));
    else
        document.add("value", physical(units, resolution, raw).value);
    document.add("unit", unitId(units.unit));
    if (!named.isEmpty())
        document.add("meaning", named);
    const QString number = QString::number(raw);
    const QString value = valueText(field, units, resolution, raw);
    const QString text = value == number ? number : QStringLiteral("%1 (%2)").arg(number, value);
    output.result(QStringLiteral("%1 = %2").arg(field.name, text), document);
}

void showBytes(Output &output, const Device &device, const RegisterArgument &argument, const Bytes &bytes)
{
    Document document;
    document.add("id", qint64(device.id()))
        .add("address", qint64(argument.address))
        .add("length", qint64(argument.length));
    QString text;
    if (argument.length <= 4) {
        const std::uint32_t raw = littleEndian(bytes, argument.length);
        document.add("raw", qint64(raw));
        text = QStringLiteral("%1 (0x%2)").arg(raw).arg(raw, 2 * argument.length, 16, QLatin1Char('0'));
    } else {
        text = QString::fromLatin1(
            QByteArray(reinterpret_cast<const char *>(bytes.data()), static_cast<qsizetype>(bytes.size())).toHex(' '));
        document.add("hex", QString(text).remove(u' '));
    }
    output.result(QStringLiteral("%1 = %2").arg(argument.text(), text), document);
}

ExitCode showFailure(Output &output, const Device &device, const RegisterArgument &argument, const Error &error)
{
    Document document;
    document.add("id", qint64(device.id()));
    if (argument.isByAddress())
        document.add("address", qint64(argument.address)).add("length", qint64(argument.length));
    else
        document.add("field", argument.field);
    document.add("error", error.text);
    output.failedResult(document);
    Error named = error;
    named.text = QStringLiteral("%1: %2").arg(argument.text(), error.text);
    return output.fail(named);
}

} // namespace dynascope::dxl
