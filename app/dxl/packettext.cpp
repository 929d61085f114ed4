// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/packettext.h"

#include "core/protocol/parser.h"

#include <QStringList>

#include <algorithm>

namespace dynascope::dxl {

namespace {

QString bytesText(std::size_t count)
{
    return count == 1 ? QStringLiteral("1 byte") : QStringLiteral("%1 bytes").arg(count);
}

QString who(std::uint8_t id)
{
    return id == BroadcastId ? QStringLiteral("everybody") : QStringLiteral("ID %1").arg(id);
}

QString spanText(const Span &span)
{
    return QStringLiteral("%1 at %2").arg(bytesText(span.length)).arg(span.address);
}

QString writeText(std::uint16_t address, ByteView data)
{
    return QStringLiteral("%1 = %2").arg(address).arg(hexText(data));
}

QString optionText(const InstructionPacket &packet)
{
    switch (packet.parameters.empty() ? 0 : packet.parameters.front()) {
    case 0x01:
        return packet.instruction == Instruction::FactoryReset ? QStringLiteral("all but ID")
               : packet.instruction == Instruction::Clear      ? QStringLiteral("position")
                                                               : QStringLiteral("store");
    case 0x02:
        return packet.instruction == Instruction::FactoryReset ? QStringLiteral("all but ID and baud")
               : packet.instruction == Instruction::Clear      ? QStringLiteral("error")
                                                               : QStringLiteral("restore");
    default: return QStringLiteral("all");
    }
}

QStringList spansText(const std::vector<Span> &spans)
{
    QStringList texts;
    for (const Span &span : spans)
        texts << QStringLiteral("%1: %2").arg(who(span.id), spanText(span));
    return texts;
}

QStringList writesText(const std::vector<SpanData> &writes)
{
    QStringList texts;
    for (const SpanData &write : writes)
        texts << QStringLiteral("%1: %2").arg(who(write.id), writeText(write.address, write.data));
    return texts;
}

QString commandText(const InstructionPacket &packet, const dynascope::Command &command)
{
    if (const auto *read = std::get_if<ReadCommand>(&command))
        return spanText({packet.id, read->address, read->length});
    if (const auto *write = std::get_if<WriteCommand>(&command))
        return writeText(write->address, write->data);
    if (const auto *reads = std::get_if<GroupReadCommand>(&command))
        return spansText(reads->spans).join(QStringLiteral("; "));
    if (const auto *writes = std::get_if<GroupWriteCommand>(&command))
        return writesText(writes->writes).join(QStringLiteral("; "));
    const bool hasOption = std::holds_alternative<FactoryResetCommand>(command)
                           || std::holds_alternative<ClearCommand>(command)
                           || std::holds_alternative<BackupCommand>(command);
    return hasOption ? optionText(packet) : QString();
}

} // namespace

QString hexText(ByteView bytes)
{
    const QByteArray raw(reinterpret_cast<const char *>(bytes.data()), static_cast<qsizetype>(bytes.size()));
    return QString::fromLatin1(raw.toHex(' ').toUpper());
}

QString errorText(DeviceError error, bool alert)
{
    const QString text = error == DeviceError::None
                             ? QStringLiteral("no error")
                             : QStringLiteral("%1 (%2)").arg(deviceErrorName(error)).arg(static_cast<int>(error));
    return alert ? text + QStringLiteral(", alert") : text;
}

std::vector<FastBlock> fastBlocks(ByteView parameters, std::span<const Span> spans)
{
    std::vector<FastBlock> blocks;
    for (const Span &span : spans) {
        const std::size_t size = FastBlockOverhead + span.length;
        if (parameters.size() < size)
            break;
        const ByteView data = parameters.subspan(2, span.length);
        blocks.push_back({parameters[1], static_cast<DeviceError>(parameters[0] & ~AlertBit),
                          (parameters[0] & AlertBit) != 0, Bytes(data.begin(), data.end())});
        parameters = parameters.subspan(size);
    }
    return blocks;
}

QString PacketText::describe(ByteView packet)
{
    Parser parser;
    parser.feed(packet);
    const auto event = parser.next();
    const auto *whole = event ? std::get_if<Parser::Packet>(&*event) : nullptr;
    if (!whole) {
        return event && std::holds_alternative<Parser::Damaged>(*event) ? QStringLiteral("damaged: its CRC is wrong")
                                                                        : QStringLiteral("no whole packet");
    }
    if (whole->isFastStatus())
        return fastStatus(whole->parameters);
    return whole->isStatus() ? status(whole->status()) : request(whole->request());
}

QString PacketText::request(const InstructionPacket &packet)
{
    const auto command = decodeCommand(packet);
    m_asked = command ? std::optional(*command) : std::nullopt;
    const bool group =
        m_asked
        && (std::holds_alternative<GroupReadCommand>(*m_asked) || std::holds_alternative<GroupWriteCommand>(*m_asked));
    QString text = instructionName(packet.instruction);
    if (!group)
        text += QStringLiteral(", ") + who(packet.id);
    const QString what = m_asked ? commandText(packet, *m_asked) : hexText(packet.parameters);
    return what.isEmpty() ? text : QStringLiteral("%1: %2").arg(text, what);
}

QString PacketText::data(std::uint8_t id, ByteView bytes) const
{
    if (m_asked && std::holds_alternative<PingCommand>(*m_asked) && bytes.size() == PingReplyLength)
        return QStringLiteral("model %1, firmware %2").arg(littleEndian(bytes, 2)).arg(bytes[2]);
    std::optional<int> address;
    if (const auto *read = m_asked ? std::get_if<ReadCommand>(&*m_asked) : nullptr)
        address = read->address;
    if (const auto *reads = m_asked ? std::get_if<GroupReadCommand>(&*m_asked) : nullptr) {
        const auto span = std::ranges::find(reads->spans, id, &Span::id);
        if (span != reads->spans.end())
            address = span->address;
    }
    return address ? writeText(static_cast<std::uint16_t>(*address), bytes) : hexText(bytes);
}

QString PacketText::status(const StatusPacket &packet) const
{
    QString text = QStringLiteral("Status, %1: %2").arg(who(packet.id), errorText(packet.error, packet.alert));
    if (!packet.parameters.empty())
        text += QStringLiteral(", ") + data(packet.id, packet.parameters);
    return text;
}

QString PacketText::fastStatus(ByteView parameters) const
{
    const auto *reads = m_asked ? std::get_if<GroupReadCommand>(&*m_asked) : nullptr;
    const std::vector<FastBlock> blocks = reads ? fastBlocks(parameters, reads->spans) : std::vector<FastBlock>();
    if (blocks.empty())
        return QStringLiteral("fast Status: %1").arg(hexText(parameters));
    QStringList texts;
    for (const FastBlock &block : blocks)
        texts << status(block).mid(QStringLiteral("Status, ").size());
    return QStringLiteral("fast Status, ") + texts.join(QStringLiteral("; "));
}

} // namespace dynascope::dxl
