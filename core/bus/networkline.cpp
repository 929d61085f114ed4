// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/networkline.h"

#include "core/bus/messages.h"

#include <algorithm>
#include <cmath>

namespace dynascope {

using namespace std::chrono_literals;

namespace {

constexpr LineTime Server = 60ms; ///< its adapter's latency (16), its gathering of bytes (20), scheduling on both sides
constexpr LineTime LongestAllowance = 1s; ///< whatever connecting took
constexpr LineTime FirstLook = 100ms;     ///< a server that can't open its port ends the connection within that
constexpr LineTime AgreementLimit = 3s;
constexpr LineTime RatePatience = 1s;
constexpr LineTime LongestWay = 200ms; ///< to the server and back: connecting may have taken seconds
constexpr LineTime CancelInterval = 20ms;
constexpr std::size_t WordsAtMost = 80;
constexpr int DiscardAtMost = 16; ///< reads: who sends without end is not waited for

/// What a server says before it hangs up, fit to be shown.
QString wordsIn(ByteView bytes)
{
    QString text;
    for (const std::uint8_t byte : bytes.first(std::min(bytes.size(), WordsAtMost)))
        text += byte >= 0x20 && byte < 0x7F ? QLatin1Char(static_cast<char>(byte)) : QLatin1Char(' ');
    return text.simplified();
}

bool isNear(int made, int wanted)
{
    return std::abs(static_cast<double>(made) - wanted) <= UartTolerance * wanted;
}

} // namespace

Result<std::unique_ptr<NetworkLine>> NetworkLine::open(const QString &name, int baudRate, const NetworkOptions &options,
                                                       const std::atomic<bool> &cancel)
{
    const Result<NetworkAddress> address = NetworkAddress::parse(name);
    if (!address)
        return tl::unexpected(address.error());
    Result<posix::TcpSocket> socket = posix::TcpSocket::connect(name, *address, options.connectLimit, cancel);
    if (!socket)
        return tl::unexpected(socket.error());
    std::unique_ptr<NetworkLine> line(new NetworkLine(name, std::move(*socket), options));
    if (Result<void> started = line->start(*address, baudRate, cancel); !started)
        return tl::unexpected(started.error());
    return line;
}

NetworkLine::NetworkLine(QString name, posix::TcpSocket socket, const NetworkOptions &options)
    : m_name(std::move(name))
    , m_socket(std::move(socket))
    , m_hostAllowance(options.hostAllowance.value_or(std::min(Server + 4 * m_socket.roundTrip(), LongestAllowance)))
{
}

NetworkLine::~NetworkLine() = default;

Result<void> NetworkLine::start(const NetworkAddress &address, int baudRate, const std::atomic<bool> &cancel)
{
    Bytes greetings;
    if (address.kind == NetworkAddress::Kind::Raw) {
        m_baudRate = address.serverBaud > 0 ? address.serverBaud : baudRate;
    } else {
        m_control.emplace();
        if (Result<void> agreed = agree(greetings, cancel); !agreed)
            return agreed;
    }
    for (const LineTime until = now() + FirstLook; now() < until;) {
        if (cancel.load(std::memory_order_acquire))
            return tl::unexpected(messages::cancelled());
        if (!receive(greetings, std::min(until, now() + CancelInterval)))
            return tl::unexpected(messages::connectionEnded(m_name, wordsIn(greetings)));
        greetings.resize(std::min(greetings.size(), WordsAtMost));
    }
    if (!m_control)
        return {};
    send(Rfc2217::portSettings());
    return setRate(baudRate, cancel);
}

/// Who doesn't want this option says so, or nothing at all.
Result<void> NetworkLine::agree(Bytes &greetings, const std::atomic<bool> &cancel)
{
    send(Rfc2217::greeting());
    const LineTime deadline = now() + AgreementLimit + m_socket.roundTrip();
    while (m_control->agreement() == Rfc2217::Agreement::Pending && now() < deadline) {
        if (cancel.load(std::memory_order_acquire))
            return tl::unexpected(messages::cancelled());
        if (!receive(greetings, now() + CancelInterval))
            return tl::unexpected(messages::connectionEnded(m_name, wordsIn(greetings)));
        greetings.resize(std::min(greetings.size(), WordsAtMost));
    }
    if (m_control->agreement() != Rfc2217::Agreement::Agreed)
        return tl::unexpected(messages::notRfc2217(m_name));
    return {};
}

/// Appends the port's bytes, answers Telnet's questions. False: the connection is lost.
bool NetworkLine::receive(Bytes &buffer, LineTime deadline)
{
    if (!m_control)
        return m_socket.read(buffer, deadline);
    m_raw.clear();
    const bool fine = m_socket.read(m_raw, deadline);
    m_answer.clear();
    m_control->feed(m_raw, buffer, m_answer);
    return fine && (m_answer.empty() || m_socket.write(m_answer));
}

bool NetworkLine::send(ByteView bytes)
{
    return !m_lost && m_socket.write(bytes);
}

Result<void> NetworkLine::write(ByteView packet)
{
    if (!send(m_control ? ByteView(Rfc2217::escaped(packet)) : packet))
        return lose(messages::connectionLost(m_name));
    const LineTime underway = std::min<LineTime>(5ms + 2 * m_socket.roundTrip(), 50ms);
    m_drainedBy = now() + static_cast<LineTime::rep>(packet.size()) * byteTime() + underway;
    return {};
}

Result<void> NetworkLine::read(Bytes &buffer, LineTime deadline)
{
    if (m_lost)
        return tl::unexpected(*m_lost);
    if (!m_waiting.empty()) {
        buffer.insert(buffer.end(), m_waiting.begin(), m_waiting.end());
        m_waiting.clear();
        return {};
    }
    const std::size_t before = buffer.size();
    do {
        const bool fine = receive(buffer, deadline);
        if (buffer.size() > before) {
            m_drainedBy = {}; // an answer: the request has left
            return {};
        }
        if (!fine)
            return lose(messages::connectionLost(m_name));
    } while (now() < deadline); // Telnet's own words are no data
    return {};
}

void NetworkLine::discardInput()
{
    m_waiting.clear();
    if (m_lost)
        return;
    Bytes ignored;
    for (int i = 0; i < DiscardAtMost; ++i) {
        ignored.clear();
        if (!receive(ignored, LineTime(0)) || ignored.empty())
            return; // who reads or writes next sees that the connection is lost
    }
}

/// Asks for a rate and waits for the server's word on it. Empty: it gave none, or we were cancelled.
std::optional<int> NetworkLine::request(int bitsPerSecond, const std::atomic<bool> &cancel)
{
    if (!send(m_control->requestRate(bitsPerSecond)))
        return std::nullopt;
    const LineTime deadline = now() + RatePatience + std::min(m_socket.roundTrip(), LongestWay);
    while (!m_control->confirmedRate() && now() < deadline && !cancel.load(std::memory_order_acquire)) {
        m_waiting.clear(); // of the old rate
        if (!receive(m_waiting, std::min(deadline, now() + CancelInterval)))
            return std::nullopt;
    }
    return m_control->confirmedRate();
}

Result<void> NetworkLine::setBaudRate(int bitsPerSecond)
{
    return setRate(bitsPerSecond, false);
}

Result<void> NetworkLine::setRate(int bitsPerSecond, const std::atomic<bool> &cancel)
{
    if (m_lost)
        return tl::unexpected(*m_lost);
    if (!m_control)
        return tl::unexpected(messages::rateIsTheServers(m_name, bitsPerSecond));
    if (bitsPerSecond <= 0)
        return tl::unexpected(messages::rateRefused(m_name, bitsPerSecond, 0));
    // The request overtakes what the server has not sent yet.
    while (now() < m_drainedBy) {
        m_waiting.clear();
        if (!receive(m_waiting, m_drainedBy))
            return lose(messages::connectionLost(m_name));
    }
    const std::optional<int> made = request(bitsPerSecond, cancel);
    if (made && isNear(*made, bitsPerSecond)) {
        m_baudRate = bitsPerSecond;
        return {};
    }
    const std::optional<int> back = made ? request(m_baudRate, cancel) : std::nullopt;
    if (cancel.load(std::memory_order_acquire))
        return lose(messages::cancelled());
    if (!back || !isNear(*back, m_baudRate))
        return lose(messages::rateNotConfirmed(m_name, made ? m_baudRate : bitsPerSecond));
    return tl::unexpected(messages::rateRefused(m_name, bitsPerSecond, *made));
}

/// Closed at once: what comes over a connection whose state is unknown belongs to nobody.
Result<void> NetworkLine::lose(const Error &why)
{
    if (!m_lost) {
        m_lost = why;
        m_socket.close();
    }
    return tl::unexpected(*m_lost);
}

bool NetworkLineFactory::knows(const QString &name) const
{
    return NetworkAddress::isNetworkName(name);
}

Result<std::unique_ptr<Line>> NetworkLineFactory::open(const QString &name, int baudRate)
{
    return openUnless(false, name, baudRate);
}

Result<std::unique_ptr<Line>> NetworkLineFactory::openUnless(const std::atomic<bool> &cancel, const QString &name,
                                                             int baudRate)
{
    Result<std::unique_ptr<NetworkLine>> line = NetworkLine::open(name, baudRate, m_options, cancel);
    if (!line)
        return tl::unexpected(line.error());
    return std::unique_ptr<Line>(std::move(*line));
}

} // namespace dynascope
