// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/showvalue.h"

#include "core/table/units.h"

namespace dynascope::dxl {

Document fieldDocument(const Device &device, const Field &field, const EffectiveField &units, std::int64_t raw)
{
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
    return document;
}

void showField(Output &output, Device &device, const Field &field, std::int64_t raw)
{
    const EffectiveField units = device.units(field);
    const int resolution = device.table()->resolution();
    const QString number = QString::number(raw);
    const QString value = valueText(field, units, resolution, raw);
    const QString text = value == number ? number : QStringLiteral("%1 (%2)").arg(number, value);
    output.result(device.id(), QStringLiteral("%1 = %2").arg(field.name, text),
                  fieldDocument(device, field, units, raw));
}

namespace {

QString hex(const Bytes &bytes, char separator)
{
    const QByteArray raw(reinterpret_cast<const char *>(bytes.data()), static_cast<qsizetype>(bytes.size()));
    return QString::fromLatin1(separator ? raw.toHex(separator) : raw.toHex());
}

} // namespace

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
        text = hex(bytes, ' ');
        document.add("hex", hex(bytes, 0));
    }
    output.result(device.id(), QStringLiteral("%1 = %2").arg(argument.text(), text), document);
}

void showSent(Output &output, const Device &device, const Field *field, const RegisterArgument &argument,
              const Bytes &bytes)
{
    Document document;
    document.add("id", qint64(device.id()));
    if (argument.isByAddress()) {
        document.add("address", qint64(argument.address)).add("length", qint64(argument.length));
        if (argument.length <= 4)
            document.add("sent", qint64(littleEndian(bytes, argument.length)));
        else
            document.add("sent", hex(bytes, 0));
    } else {
        document.add("field", field->name)
            .add("address", qint64(field->address))
            .add("sent", qint64(rawFromBytes(*field, bytes)));
    }
    document.addFlag("confirmed", false);
    const QString reason = QStringLiteral("the Status Return Level 0 of %1 lets nothing be read back").arg(device.name());
    const QString text = QStringLiteral("%1: sent, but not confirmed: %2").arg(argument.text(), reason);
    output.unconfirmed(output.named(device.id(), text), document);
}

ExitCode showFailure(Output &output, const Device &device, const RegisterArgument &argument, const Error &error,
                     const QString &aftermath)
{
    Document document;
    document.add("id", qint64(device.id()));
    if (argument.isByAddress())
        document.add("address", qint64(argument.address)).add("length", qint64(argument.length));
    else
        document.add("field", argument.field);
    Error named = withWayOut(error, device);
    document.add("error", named.text);
    output.failedResult(document);
    if (named.kind == ErrorKind::Cancelled && !aftermath.isEmpty())
        output.note(output.named(device.id(), QStringLiteral("%1: interrupted%2").arg(argument.text(), aftermath)));
    named.text = output.named(device.id(), QStringLiteral("%1: %2%3").arg(argument.text(), named.text, aftermath));
    return output.fail(named);
}

Error withWayOut(const Error &error, const Device &device)
{
    if (!device.isMute() || error.kind != ErrorKind::NothingReceived)
        return error;
    return {error.kind, error.text + QStringLiteral("; write status_return_level=1 first")};
}

QString areaName(Area area)
{
    switch (area) {
    case Area::Eeprom: return QStringLiteral("EEPROM");
    case Area::Ram: return QStringLiteral("RAM");
    case Area::Hybrid: return QStringLiteral("HYBRID");
    case Area::Unknown: break;
    }
    return QStringLiteral("?");
}

QString accessName(Access access)
{
    switch (access) {
    case Access::Read: return QStringLiteral("R");
    case Access::ReadWrite: return QStringLiteral("RW");
    case Access::Unknown: break;
    }
    return QStringLiteral("?");
}

} // namespace dynascope::dxl
