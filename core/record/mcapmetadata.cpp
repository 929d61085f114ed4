// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/record/mcapmetadata.h"

#include "core/record/recordedvalue.h"

#include <algorithm>

namespace dynascope::mcap {
namespace {

constexpr int Version = 1;
constexpr qsizetype MostFields = 100'000; ///< of a channel
constexpr qsizetype MostDevices = 1000;   ///< of a channel
constexpr qint64 LongestSpan = 2048;       ///< bytes: more fits into no packet's answer of a servo
const QString FieldsOf = QStringLiteral("fields."); ///< and the device's number

/// The texts' values by their keys, and whether all were there and in their range.
class TextReader
{
public:
    explicit TextReader(const Texts &texts) : m_texts(texts) { }

    QString text(const char16_t *key) const
    {
        const auto found = m_texts.find(QString::fromUtf16(key));
        return found == m_texts.end() ? QString() : found->second;
    }
    qint64 number(const char16_t *key, qint64 from, qint64 to)
    {
        bool isNumber = false;
        const qint64 value = text(key).toLongLong(&isNumber);
        m_ok = m_ok && isNumber && value >= from && value <= to;
        return m_ok ? value : from;
    }
    bool ok() const { return m_ok; }

private:
    const Texts &m_texts;
    bool m_ok = true;
};

constexpr qint64 LongestTime = qint64(1) << 61; ///< so that sums of two fit

void add(Texts &texts, const char16_t *key, const QString &value)
{
    texts[QString::fromUtf16(key)] = value;
}

QString toHex(const std::vector<RecordedSpan> &image)
{
    QStringList lines;
    for (const RecordedSpan &span : image) {
        const QByteArray bytes(reinterpret_cast<const char *>(span.data.data()), qsizetype(span.data.size()));
        lines << QStringLiteral("%1:%2").arg(span.address).arg(QString::fromLatin1(bytes.toHex()));
    }
    return lines.join(u' ');
}

std::vector<RecordedSpan> imageFrom(const QString &text)
{
    std::vector<RecordedSpan> image;
    for (const QString &part : text.split(u' ', Qt::SkipEmptyParts)) {
        const qsizetype colon = part.indexOf(u':');
        bool isNumber = false;
        const int address = part.left(colon).toInt(&isNumber);
        const QByteArray bytes = QByteArray::fromHex(part.mid(colon + 1).toLatin1());
        if (colon < 0 || !isNumber || address < 0 || address + bytes.size() > 0x10000)
            continue;
        image.push_back({static_cast<std::uint16_t>(address), Bytes(bytes.begin(), bytes.end())});
    }
    return image;
}

Builder &cdrText(Builder &builder, const QString &text)
{
    const QByteArray utf8 = text.toUtf8().replace('\0', ' ');
    while (builder.content().size() % 4 != 0) // as behind the four bytes of the encapsulation
        builder.number(std::uint8_t(0));
    builder.number(static_cast<std::uint32_t>(utf8.size() + 1));
    builder.bytes({reinterpret_cast<const std::uint8_t *>(utf8.constData()), static_cast<std::size_t>(utf8.size())});
    return builder.number(std::uint8_t(0));
}

/// `at`: how far the message has been read; moves on.
QString cdrText(Cursor &cursor, std::size_t &at)
{
    (void)cursor.bytes((4 - at % 4) % 4);
    at += (4 - at % 4) % 4;
    const auto size = cursor.number<std::uint32_t>();
    const ByteView bytes = cursor.bytes(size);
    at += 4 + bytes.size();
    if (bytes.empty())
        return {};
    return QString::fromUtf8(reinterpret_cast<const char *>(bytes.data()), qsizetype(bytes.size()) - 1);
}

} // namespace

Texts textsOf(const RecordingHeader &header)
{
    Texts texts;
    add(texts, u"version", QString::number(Version));
    add(texts, u"start_unix_ns", QString::number(header.startUnix));
    add(texts, u"start_line_ns", QString::number(header.startLine.count()));
    add(texts, u"program", header.program);
    add(texts, u"name", header.name);
    add(texts, u"notes", header.notes);
    return texts;
}

std::optional<RecordingHeader> headerFrom(const Texts &texts)
{
    TextReader reader(texts);
    RecordingHeader header;
    if (reader.number(u"version", 1, Version) != Version)
        return std::nullopt;
    header.startUnix = reader.number(u"start_unix_ns", 0, LongestTime);
    header.startLine = LineTime(reader.number(u"start_line_ns", -LongestTime, LongestTime));
    header.program = reader.text(u"program");
    header.name = reader.text(u"name");
    header.notes = reader.text(u"notes");
    return reader.ok() ? std::optional(header) : std::nullopt;
}

Texts textsOf(const RecordedDevice &device)
{
    Texts texts;
    add(texts, u"device", QString::number(device.key));
    add(texts, u"label", device.label);
    add(texts, u"line", device.line);
    add(texts, u"id", QString::number(device.id));
    add(texts, u"baud_rate", QString::number(device.baudRate));
    add(texts, u"model", device.model);
    add(texts, u"model_number", QString::number(device.modelNumber));
    add(texts, u"firmware", QString::number(device.firmware));
    add(texts, u"control_table", toHex(device.image));
    return texts;
}

std::optional<RecordedDevice> deviceFrom(const Texts &texts)
{
    TextReader reader(texts);
    RecordedDevice device;
    device.key = static_cast<quint32>(reader.number(u"device", 0, 0xFFFFFFFFLL));
    device.label = reader.text(u"label");
    device.line = reader.text(u"line");
    device.id = static_cast<int>(reader.number(u"id", 0, 255));
    device.baudRate = static_cast<int>(reader.number(u"baud_rate", 0, 1'000'000'000));
    device.model = reader.text(u"model");
    device.modelNumber = static_cast<int>(reader.number(u"model_number", 0, 0xFFFF));
    device.firmware = static_cast<int>(reader.number(u"firmware", 0, 255));
    device.image = imageFrom(reader.text(u"control_table"));
    return reader.ok() ? std::optional(device) : std::nullopt;
}

Texts textsOf(const ValueLayout &layout)
{
    QStringList devices;
    Texts texts;
    for (const ValueLayout::Part &part : layout.parts()) {
        QStringList fields; // name, address, size, signed, direction bit, unit, scale, decimals
        for (const RecordedField &field : part.fields)
            fields << toLine(field);
        devices << QStringLiteral("%1 %2").arg(part.device).arg(part.member);
        texts[FieldsOf + QString::number(part.device)] = fields.join(u'\n');
    }
    add(texts, u"devices", devices.join(u'\n'));
    add(texts, u"address", QString::number(layout.address()));
    add(texts, u"length", QString::number(layout.length()));
    return texts;
}

std::optional<ValueLayout> layoutFrom(const Texts &texts)
{
    TextReader reader(texts);
    const auto address = static_cast<std::uint16_t>(reader.number(u"address", 0, 0xFFFF));
    const auto length = static_cast<std::uint16_t>(reader.number(u"length", 1, LongestSpan));
    const QStringList devices = reader.text(u"devices").split(u'\n');
    if (!reader.ok() || devices.size() > MostDevices || address + length > 0x10000)
        return std::nullopt;
    qsizetype count = 0;
    std::vector<ValueLayout::Part> parts;
    for (const QString &line : devices) {
        ValueLayout::Part part;
        bool isNumber = false;
        part.device = line.section(u' ', 0, 0).toUInt(&isNumber);
        part.member = rosName(line.section(u' ', 1, 1));
        const auto lines = texts.find(FieldsOf + QString::number(part.device));
        if (!isNumber || lines == texts.end())
            return std::nullopt;
        for (const QString &text : lines->second.split(u'\n')) {
            const std::optional<RecordedField> field = fieldFromLine(text);
            if (!field || field->address < address || field->end() > address + length || ++count > MostFields)
                return std::nullopt;
            part.fields.push_back(*field);
        }
        parts.push_back(std::move(part));
    }
    return ValueLayout(address, length, std::move(parts));
}

Bytes messageOf(const RecordedEvent &event)
{
    Builder message;
    message.number(std::uint32_t(0x0100)); // 00 01 00 00: CDR, low byte first
    cdrText(cdrText(message, event.kind), event.text);
    return message.content();
}

std::optional<RecordedEvent> eventFrom(ByteView message)
{
    Cursor cursor(message);
    if (cursor.number<std::uint32_t>() != 0x0100)
        return std::nullopt;
    std::size_t at = 4;
    RecordedEvent event;
    event.kind = cdrText(cursor, at);
    event.text = cdrText(cursor, at);
    return cursor.ok() ? std::optional(event) : std::nullopt;
}

} // namespace dynascope::mcap
