// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/record/sessionstream.h"

#include "core/record/jsonsample.h"

namespace dynascope {

SessionStream::SessionStream(const Workbench &workbench, QObject *parent)
    : QObject(parent)
    , m_workbench(workbench)
{
    const auto follow = [this](LineSession *line) { connect(line, &LineSession::batchTaken, this, &SessionStream::send); };
    connect(&workbench.session, &Session::lineAdded, this, follow);
    for (const auto &line : workbench.session.lines())
        follow(line.get());
}

Result<void> SessionStream::start(const StreamWishes &wishes)
{
    stop();
    auto sender = posix::UdpSender::open(wishes.place(), posix::UdpSender::Names::Refuse);
    if (!sender)
        return tl::unexpected(sender.error());
    m_sender.emplace(std::move(*sender));
    m_wishes = wishes;
    m_sent = 0;
    m_devices = std::make_unique<WatchedDevices>(m_workbench.session, m_workbench.monitor);
    m_header.startUnix = std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count();
    m_header.startLine = std::chrono::steady_clock::now().time_since_epoch();
    m_header.devices = m_devices->devices();
    connect(m_devices.get(), &WatchedDevices::changed, this, [this] { m_header.devices = m_devices->devices(); });
    emit changed();
    return {};
}

void SessionStream::stop()
{
    if (!m_sender)
        return;
    m_sender.reset();
    m_devices.reset();
    emit changed();
}

void SessionStream::send(const Batch &batch)
{
    if (!m_sender)
        return;
    RecordedBatch recorded;
    recorded.begin = batch.begin;
    for (const PollValue &value : batch.values)
        recorded.replies.push_back({value.device, value.address, value.length, value.data, value.at});
    for (const QByteArray &datagram : jsonSamples(recorded, m_header, posix::UdpSender::LargestDatagram)) {
        m_sender->send(datagram);
        ++m_sent;
    }
}

} // namespace dynascope
