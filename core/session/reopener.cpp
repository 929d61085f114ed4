// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/reopener.h"

#include "core/bus/networkaddress_values.h"

#include <QFileInfo>

#include <algorithm>
#include <chrono>

namespace dynascope {
namespace {

using namespace std::chrono_literals;

constexpr auto LookInterval = 1s;
constexpr int LooksAtMost = 30; ///< between two tries to reach a server on the network

bool isIdle(const LineSession &line)
{
    return line.state() == BusThread::State::Lost || line.state() == BusThread::State::Closed;
}

} // namespace

Reopener::Reopener(Session &session, PortList &ports, QObject *parent)
    : QObject(parent), m_session(session), m_ports(ports), m_seen(ports.ports())
{
    connect(&session, &Session::lineAdded, this, &Reopener::follow);
    connect(&session, &Session::lineAboutToBeRemoved, this, [this](LineSession *line) {
        m_adapters.erase(line);
        m_lost.erase(line);
    });
    for (const auto &line : session.lines()) {
        follow(line.get());
        onState(line.get());
    }
    connect(&m_timer, &QTimer::timeout, this, &Reopener::look);
    m_timer.start(LookInterval);
}

void Reopener::follow(LineSession *line)
{
    connect(line, &LineSession::stateChanged, this, [this, line] { onState(line); });
}

void Reopener::onState(LineSession *line)
{
    if (line->state() == BusThread::State::Lost) {
        m_lost.try_emplace(line, Lost{line->name()});
        return;
    }
    if (line->state() == BusThread::State::Closed)
        onRefused(line);
    if (line->state() != BusThread::State::Open)
        return;
    take(m_ports.ports());
    const PortInfo info = infoOf(line->name());
    m_adapters[line] = {info.identity, info.description, QFileInfo(line->name()).isSymLink()};
    const auto lost = m_lost.find(line);
    if (lost == m_lost.end())
        return;
    const QString former = lost->second.name;
    m_lost.erase(lost);
    emit lineBack(line, former);
}

/// Just plugged in, a port may not be ours to open for a moment: its rights come a little later.
void Reopener::onRefused(LineSession *line)
{
    constexpr int Patience = 4;
    const Error why = line->bus().error();
    const auto lost = m_lost.find(line);
    if (lost == m_lost.end() || why.kind == ErrorKind::PortNotFound || why.kind == ErrorKind::Cancelled)
        return;
    if (++lost->second.refusals == Patience)
        emit lineRefused(line, why);
}

void Reopener::take(std::vector<PortInfo> ports)
{
    if (ports == m_seen)
        return;
    m_seen = std::move(ports);
    emit portsChanged();
}

/// A link (/dev/serial/by-id/...) is followed.
PortInfo Reopener::infoOf(const QString &name) const
{
    const QString target = QFileInfo(name).canonicalFilePath();
    const auto at = std::ranges::find_if(
        m_seen, [&](const PortInfo &info) { return info.name == name || (!target.isEmpty() && info.name == target); });
    return at == m_seen.end() ? PortInfo() : *at;
}

/// Without serial numbers the kind decides, as far as the system tells it.
bool Reopener::isSame(const Adapter &adapter, const QString &name) const
{
    const PortInfo now = infoOf(name);
    if (!adapter.identity.isEmpty() || !now.identity.isEmpty())
        return adapter.identity == now.identity;
    return adapter.description.isEmpty() || now.description.isEmpty() || adapter.description == now.description;
}

Result<QString> Reopener::whereIs(const LineSession &line) const
{
    const QString name = line.name();
    const auto known = m_adapters.find(&line);
    const Adapter adapter = known == m_adapters.end() ? Adapter() : known->second;
    const QString &identity = adapter.identity;
    const bool same = isSame(adapter, name);
    // Two of the same number (cheap adapters have such) are nobody in particular.
    if (!identity.isEmpty() && !same && !adapter.isLink
        && std::ranges::count(m_seen, identity, &PortInfo::identity) == 1)
        return std::ranges::find(m_seen, identity, &PortInfo::identity)->name;
    const bool isThere = NetworkAddress::isNetworkName(name) || QFileInfo::exists(name)
                         || std::ranges::find(m_seen, name, &PortInfo::name) != m_seen.end();
    if (!isThere)
        return failure(ErrorKind::PortNotFound, tr("%1 is not plugged in").arg(name));
    if (known != m_adapters.end() && !same) {
        return failure(ErrorKind::PortUnsuitable,
                       tr("Another adapter is at %1 now. To use it, disconnect and connect again.").arg(name));
    }
    return name;
}

Result<void> Reopener::reopen(LineSession &line)
{
    take(m_ports.ports());
    const Result<QString> where = whereIs(line);
    if (!where)
        return tl::unexpected(where.error());
    if (const auto lost = m_lost.find(&line); lost != m_lost.end())
        lost->second = {lost->second.name, lost->second.refusals};
    line.reopen(*where);
    return {};
}

bool Reopener::isOpenElsewhere(const LineSession &line, const QString &name) const
{
    return std::ranges::any_of(m_session.lines(), [&](const auto &other) {
        return other.get() != &line && other->name() == name && !isIdle(*other);
    });
}

/// Each try costs a connection, and a server that is off may stay so for days.
bool Reopener::isTurn(const LineSession &line)
{
    const auto lost = m_lost.find(&line);
    if (lost == m_lost.end() || !NetworkAddress::isNetworkName(line.name()))
        return true;
    if (lost->second.looksLeft-- > 0)
        return false;
    lost->second.looksLeft = lost->second.looksNext - 1;
    lost->second.looksNext = std::min(2 * lost->second.looksNext, LooksAtMost);
    return true;
}

void Reopener::look()
{
    take(m_ports.ports());
    if (!m_automatic)
        return;
    for (const auto &line : m_session.lines()) {
        if (!m_lost.contains(line.get()) || !isIdle(*line))
            continue;
        const Result<QString> where = whereIs(*line);
        if (where && !isOpenElsewhere(*line, *where) && isTurn(*line))
            line->reopen(*where);
    }
}

} // namespace dynascope
