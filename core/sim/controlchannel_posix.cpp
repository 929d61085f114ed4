// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/controlchannel.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace dynascope::sim {
namespace {

constexpr std::size_t MostClients = 8;
constexpr std::size_t SmallPiece = 4096; ///< a pipe that is ready takes so much without blocking

/// Somebody who sends lines and takes answers.
struct Peer {
    int input = -1, output = -1; ///< −1: has said all
    bool own = true;             ///< closed with it
    QByteArray heard{}, unsent{};
    bool skipping = false; ///< the rest of a line that is too long

    bool isGone() const { return input < 0 && unsent.isEmpty(); }
};

} // namespace

class ControlChannel::Worker
{
public:
    Worker(PtyServer &server, Settings settings, int wake)
        : m_server(server)
        , m_socket(std::move(settings.socket))
        , m_control({[this] { return status(); }, std::move(settings.quit)}, std::move(settings.names))
        , m_wake(wake)
    {
        if (settings.input >= 0)
            m_peers.push_back({.input = settings.input, .output = settings.output, .own = false});
        m_thread = std::thread([this] { run(); });
        pthread_setname_np(m_thread.native_handle(), "control channel");
    }

    ~Worker()
    {
        m_stop.store(true, std::memory_order_release);
        const std::uint64_t one = 1;
        while (::write(m_wake, &one, sizeof one) < 0 && errno == EINTR) { }
        m_thread.join();
        for (Peer &peer : m_peers)
            close(peer);
        ::close(m_wake);
    }

private:
    QJsonObject status() const; ///< on the server's thread
    void run();
    void read(Peer &peer);
    void takeLines(Peer &peer);
    void write(Peer &peer);
    static void close(Peer &peer);

    PtyServer &m_server;
    std::unique_ptr<ControlSocket> m_socket;
    Control m_control; ///< on the server's thread
    std::vector<Peer> m_peers;
    const int m_wake; ///< an eventfd
    std::atomic<bool> m_stop = false;
    std::thread m_thread;
};

QJsonObject ControlChannel::Worker::status() const
{
    const PtyServer::State state = m_server.state();
    const auto micro = [](LineTime time) { return std::chrono::duration<double, std::micro>(time).count(); };
    const QJsonObject lateness{{QStringLiteral("p50"), micro(state.pacing.median)},
                               {QStringLiteral("p99"), micro(state.pacing.percentile99)},
                               {QStringLiteral("worst"), micro(state.pacing.worst)}};
    const QJsonObject pacing{{QStringLiteral("keepsUp"), state.pacing.keepsUp},
                             {QStringLiteral("replies"), static_cast<qint64>(state.pacing.replies)},
                             {QStringLiteral("late"), static_cast<qint64>(state.pacing.late)},
                             {QStringLiteral("latenessUs"), lateness}};
    return {{QStringLiteral("port"), state.path}, {QStringLiteral("pacing"), pacing}};
}

void ControlChannel::Worker::run()
{
    sigset_t pipe; // whoever reads the answers may go: that is an error of writing, not the end
    sigemptyset(&pipe);
    sigaddset(&pipe, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &pipe, nullptr);
    while (!m_stop.load(std::memory_order_acquire)) {
        std::vector<pollfd> waited{{m_wake, POLLIN, 0},
                                   {m_socket && m_peers.size() < MostClients ? m_socket->descriptor() : -1, POLLIN, 0}};
        for (const Peer &peer : m_peers) {
            const bool answers = !peer.unsent.isEmpty(); // first it takes what it has asked for
            waited.push_back({answers ? peer.output : peer.input, static_cast<short>(answers ? POLLOUT : POLLIN), 0});
        }
        if (poll(waited.data(), waited.size(), -1) < 0 && errno != EINTR)
            return;
        for (std::size_t i = 0; i < m_peers.size(); ++i) {
            if (waited[i + 2].revents == 0)
                continue;
            m_peers[i].unsent.isEmpty() ? read(m_peers[i]) : write(m_peers[i]);
            takeLines(m_peers[i]);
        }
        std::erase_if(m_peers, [](Peer &peer) {
            if (peer.isGone())
                close(peer);
            return peer.isGone();
        });
        if (waited[1].revents != 0) {
            const int client = m_socket->accept();
            if (client >= 0)
                m_peers.push_back({.input = client, .output = client});
        }
    }
}

void ControlChannel::Worker::read(Peer &peer)
{
    std::array<char, 4096> chunk{};
    const ssize_t count = ::read(peer.input, chunk.data(), chunk.size());
    if (count > 0) {
        peer.heard.append(chunk.data(), count);
    } else if (count == 0 || (errno != EINTR && errno != EAGAIN)) {
        if (!peer.heard.isEmpty())
            peer.heard.append('\n'); // a last line without an end is one too
        peer.input = -1; // what it asked for before is answered
    }
}

/// One after the other, each when the answer before it has gone: an unread answer holds up nobody else, and no more than
/// one is kept.
void ControlChannel::Worker::takeLines(Peer &peer)
{
    while (peer.unsent.isEmpty()) {
        const qsizetype end = peer.heard.indexOf('\n');
        if (end < 0) {
            if (peer.heard.size() > Control::LongestLine) {
                peer.heard.clear();
                peer.skipping = true;
            }
            return;
        }
        QByteArray line = peer.heard.first(end);
        peer.heard.remove(0, end + 1);
        if (std::exchange(peer.skipping, false))
            line = QByteArray(Control::LongestLine + 1, 'x'); // refused with the reason
        if (line.trimmed().isEmpty() || line.trimmed().startsWith('#'))
            continue;
        m_server.call([&](SimulatedBus &bus, LineTime now) { peer.unsent = m_control.obey(line, bus, now) + '\n'; });
        write(peer);
    }
}

void ControlChannel::Worker::write(Peer &peer)
{
    while (!peer.unsent.isEmpty()) {
        const auto size = static_cast<std::size_t>(peer.unsent.size());
        pollfd ready{peer.output, POLLOUT, 0};
        if (!peer.own && poll(&ready, 1, 0) == 0)
            return;
        const ssize_t count = peer.own ? ::send(peer.output, peer.unsent.constData(), size, MSG_NOSIGNAL)
                                       : ::write(peer.output, peer.unsent.constData(), std::min(size, SmallPiece));
        if (count > 0) {
            peer.unsent.remove(0, count);
        } else if (errno == EAGAIN) {
            return;
        } else if (errno != EINTR) {
            peer.unsent.clear();
            peer.heard.clear();
            close(peer);
            return;
        }
    }
}

void ControlChannel::Worker::close(Peer &peer)
{
    if (peer.own && peer.output >= 0)
        ::close(peer.output);
    peer.input = peer.output = -1;
}

Result<std::unique_ptr<ControlChannel>> ControlChannel::start(PtyServer &server, Settings settings)
{
    const int wake = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    if (wake < 0)
        return failure(ErrorKind::PortUnsuitable, QStringLiteral("The simulator needs more open files than allowed"));
    std::unique_ptr<ControlChannel> channel(new ControlChannel);
    channel->m_worker = std::make_unique<Worker>(server, std::move(settings), wake);
    return channel;
}

ControlChannel::~ControlChannel() = default;

} // namespace dynascope::sim
