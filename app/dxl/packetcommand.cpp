// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/commands.h"
#include "app/dxl/packettext.h"
#include "app/dxl/target.h"
#include "core/bus/timing.h"
#include "core/session/journal/journalnote.h"
#include "core/protocol/parser.h"

#include <algorithm>

namespace dynascope::dxl {

namespace {

using namespace std::chrono_literals;

constexpr LineTime Slice = 2ms;
constexpr LineTime ReturnDelay = 508us; ///< the longest that the register can say
constexpr LineTime LongestTail = 1s;    ///< that a wait grows by while bytes come
constexpr int EverySlot = MaximumId + 1;

/// What is due after a packet, as far as it says.
struct Due {
    std::size_t answers = 0; ///< status packets
    std::size_t bytes = 0;   ///< of all of them, stuffing at its worst
    LineTime processing{};
    bool anybody = false; ///< nobody knows how many
};

Due dueAfter(const InstructionPacket &packet)
{
    Due due;
    due.processing = timing::processing(packet.instruction);
    const auto command = decodeCommand(packet);
    const auto *reads = command ? std::get_if<GroupReadCommand>(&*command) : nullptr;
    const auto *read = command ? std::get_if<ReadCommand>(&*command) : nullptr;
    if (packet.id == BroadcastId && packet.instruction == Instruction::Ping) {
        due.anybody = true;
        due.processing = EverySlot * timing::SlotOfBroadcastPing;
        due.bytes = EverySlot * timing::largestStatus(PingReplyLength);
    } else if (reads) {
        due.answers = reads->fast ? 1 : reads->spans.size();
        for (const Span &span : reads->spans)
            due.bytes += timing::largestStatus(span.length);
        due.processing += static_cast<LineTime::rep>(reads->spans.size()) * (ReturnDelay + due.processing);
    } else if (packet.id != BroadcastId) {
        due.answers = 1;
        due.bytes = timing::largestStatus(read ? read->length : PingReplyLength);
    }
    return due;
}

struct Heard {
    Bytes packet;
    LineTime after{}; ///< since the packet had left
    bool echo = false;
};

/// Takes what comes apart until what is due has come, or its time is over.
class Listener
{
public:
    Listener(const Work &work, const Due &due) : m_work(work), m_due(due) { }

    Result<std::vector<Heard>> listen()
    {
        Line &line = m_work.bus.line();
        const LineTime begin = line.now() + timing::times(m_work.options.packet.size(), line.byteTime());
        const LineTime given = m_work.options.listen ? LineTime(std::chrono::milliseconds(*m_work.options.listen))
                                                     : line.hostAllowance() + ReturnDelay + m_due.processing
                                                           + timing::times(m_due.bytes, line.byteTime());
        LineTime until = begin + given;
        while (!m_work.bus.isCancelled() && line.now() < until && (m_work.options.listen || !isComplete())) {
            Bytes bytes;
            if (const auto read = line.read(bytes, std::min(until, line.now() + Slice)); !read)
                return tl::unexpected(read.error());
            m_parser.feed(bytes);
            drain(line.now() - begin);
            if (!bytes.empty() && !m_work.options.listen) // what has begun may end, however loaded the machine is
                until = std::clamp(line.now() + timing::silence(line) + line.hostAllowance(), until,
                                   begin + given + LongestTail);
        }
        while (m_parser.pending().have > 0) {
            m_parser.giveUp();
            drain(line.now() - begin);
        }
        return std::move(m_heard);
    }
    std::size_t noise() const { return m_parser.noiseBytes(); }

private:
    bool isComplete() const { return !m_due.anybody && m_answers >= m_due.answers; }

    void drain(LineTime after)
    {
        while (const auto event = m_parser.next()) {
            if (const auto *packet = std::get_if<Parser::Packet>(&*event)) {
                const bool echo = std::ranges::equal(packet->raw, m_work.options.packet);
                m_heard.push_back({Bytes(packet->raw.begin(), packet->raw.end()), after, echo});
                m_answers += packet->isStatus() ? 1 : 0;
            } else if (const auto *damaged = std::get_if<Parser::Damaged>(&*event)) {
                m_heard.push_back({Bytes(damaged->raw.begin(), damaged->raw.end()), after, false});
            }
        }
    }

    const Work &m_work;
    Due m_due;
    Parser m_parser;
    std::vector<Heard> m_heard;
    std::size_t m_answers = 0;
};

std::optional<Parser::Packet> parsed(Parser &parser, ByteView bytes)
{
    parser.feed(bytes);
    const auto event = parser.next();
    const auto *packet = event ? std::get_if<Parser::Packet>(&*event) : nullptr;
    return packet ? std::optional(*packet) : std::nullopt;
}

Document answerDocument(const Heard &heard, const QString &text)
{
    Document document;
    document.add("hex", hexText(heard.packet))
        .add("ms", std::chrono::duration<double, std::milli>(heard.after).count());
    Parser parser;
    const auto packet = parsed(parser, heard.packet);
    if (packet && packet->isStatus() && !packet->isFastStatus()) {
        const StatusPacket status = packet->status();
        document.add("id", qint64(status.id))
            .add("error", qint64(static_cast<int>(status.error)))
            .addFlag("alert", status.alert)
            .add("data", hexText(status.parameters));
    }
    if (heard.echo)
        document.addFlag("echo", true);
    return document.add("text", text);
}

Document sentDocument(ByteView packet, const QString &text)
{
    Document document;
    return document.add("hex", hexText(packet)).add("text", text);
}

/// May it change anything?
bool onlyAsks(const Parser::Packet &packet)
{
    if (packet.isStatus())
        return false;
    switch (packet.request().instruction) {
    case Instruction::Ping:
    case Instruction::Read:
    case Instruction::SyncRead:
    case Instruction::BulkRead:
    case Instruction::FastSyncRead:
    case Instruction::FastBulkRead: return true;
    default: return false;
    }
}

/// What it changes is not looked into: as bytes.
void noteSent(const Work &work, ByteView packet, std::uint8_t id)
{
    constexpr std::size_t Longest = 300; // bytes; the journal is for people
    JournalEntry entry;
    entry.kind = JournalKind::Packet;
    entry.by = JournalAuthor::CommandLine;
    entry.device.line = work.options.port;
    entry.device.id = id <= BroadcastId ? id : 0;
    entry.device.baudRate = work.bus.line().baudRate();
    entry.note = hexText(packet.first(std::min(packet.size(), Longest)));
    JournalNote note(&work.journal, entry);
    entry.state = JournalState::Unconfirmed;
    note.finish(entry);
}

} // namespace

ExitCode packetCommand(const Work &work)
{
    const Bytes &packet = work.options.packet;
    Parser parser;
    const auto known = parsed(parser, packet);
    Due due;
    if (known && !known->isStatus())
        due = dueAfter(known->request());
    else
        due.anybody = true; // whoever takes it for something
    // Past the bus, which would discard what comes before it begins to wait.
    if (const auto sent = work.bus.line().write(packet); !sent)
        return work.output.fail(sent.error());
    if (!known || !onlyAsks(*known))
        noteSent(work, packet, packet.size() > 4 ? packet[4] : 0);
    Listener listener(work, due);
    const auto heard = listener.listen();
    if (!heard)
        return work.output.fail(heard.error());

    PacketText texts;
    const QString said = texts.describe(packet);
    QString text = QStringLiteral("> %1  %2").arg(hexText(packet), said);
    std::vector<Document> answers;
    for (const Heard &one : *heard) {
        const QString says = one.echo ? QStringLiteral("its echo") : texts.describe(one.packet);
        text += QStringLiteral("\n< %1  %2").arg(hexText(one.packet), says);
        answers.push_back(answerDocument(one, says));
    }
    Document document;
    document.add("sent", sentDocument(packet, said))
        .add("answers", answers)
        .add("noise_bytes", qint64(listener.noise()));
    work.output.result(text, document);
    const bool answered = std::ranges::any_of(*heard, [](const Heard &one) { return !one.echo; });
    if (answered || due.answers == 0)
        return ExitCode::Done;
    return work.output.fail({ErrorKind::NothingReceived,
                             listener.noise() > 0
                                 ? QStringLiteral("sent; %1 bytes came, but no packet in them").arg(listener.noise())
                                 : QStringLiteral("sent, but nothing answered")});
}

} // namespace dynascope::dxl
