// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/stopcontrol.h"

#include <algorithm>

namespace dynascope {

StopControl::StopControl(Session &session, Commands &commands, QObject *parent)
    : QObject(parent)
    , m_session(session)
    , m_commands(commands)
{
    m_prepareTimer.setSingleShot(true);
    m_prepareTimer.setInterval(0);
    connect(&m_prepareTimer, &QTimer::timeout, this, &StopControl::prepare);
    const auto soon = [this] { m_prepareTimer.start(); };
    connect(&session, &Session::lineAdded, this, [this, soon](LineSession *line) {
        connect(line, &LineSession::deviceChanged, this, soon);
        connect(line, &LineSession::stateChanged, this, [this, soon, line] {
            connect(&line->bus(), &BusThread::stopFinished, this, &StopControl::take, Qt::UniqueConnection);
            soon();
        });
        connect(&line->bus(), &BusThread::stopFinished, this, &StopControl::take, Qt::UniqueConnection);
    });
    connect(&session, &Session::deviceAdded, this, soon);
    connect(&session, &Session::deviceAboutToBeRemoved, this, soon);
}

void StopControl::prepare()
{
    for (const auto &line : m_session.lines()) {
        std::vector<StopTarget> targets;
        for (const auto &device : line->devices()) {
            if (const Field *torque = device->table().find(u"Torque Enable"))
                targets.push_back({device->key(), device->id(), device->baudRate(), torque->address});
        }
        line->bus().setStopTargets(std::move(targets));
    }
}

void StopControl::press()
{
    m_active = true;
    m_outcomes.clear();
    m_waiting = 0;
    m_commands.setStopped(true);
    for (const auto &line : m_session.lines()) {
        if (line->state() != BusThread::State::Open)
            continue;
        ++m_waiting;
        line->bus().stop();
    }
    makeReport();
    emit changed();
}

void StopControl::release()
{
    m_active = false;
    m_outcomes.clear();
    m_commands.setStopped(false);
    for (const auto &line : m_session.lines())
        line->bus().release();
    makeReport();
    emit changed();
}

void StopControl::take(const std::vector<StopOutcome> &outcomes)
{
    m_waiting = std::max(0, m_waiting - 1);
    for (const StopOutcome &outcome : outcomes) {
        m_outcomes.push_back(outcome);
        Device *device = m_session.device(outcome.device);
        if (!device || !outcome.off)
            continue;
        PollValue value;
        value.address = placeOf(*device).torqueAddress;
        value.data = {0};
        value.at = device->lastHeard();
        device->take(value);
    }
    makeReport();
    emit changed();
}

bool StopControl::isConfirmed() const
{
    return m_active && m_waiting == 0 && std::ranges::all_of(m_outcomes, &StopOutcome::off);
}

void StopControl::makeReport()
{
    m_report.clear();
    if (!m_active)
        return;
    if (m_waiting > 0) {
        m_report = tr("Turning torque off…");
        return;
    }
    QStringList open;
    for (const StopOutcome &outcome : m_outcomes) {
        const Device *device = m_session.device(outcome.device);
        if (!outcome.off && device)
            open << device->displayName();
    }
    const auto off = std::ranges::count_if(m_outcomes, &StopOutcome::off);
    m_report = tr("Torque is off on %n device(s).", nullptr, static_cast<int>(off));
    if (!open.isEmpty())
        m_report += QLatin1Char(' ') + tr("Not confirmed: %1.").arg(open.join(QStringLiteral(", ")));
}

} // namespace dynascope
