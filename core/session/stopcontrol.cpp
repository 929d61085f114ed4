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
    connect(&m_prepareTimer, &QTimer::timeout, this, [this] {
        prepare();
        if (m_active) // somebody went
            update();
    });
    connect(&session, &Session::lineAdded, this, &StopControl::follow);
    connect(&session, &Session::lineAboutToBeRemoved, this, [this](LineSession *line) {
        m_generations.erase(line);
        m_waiting.erase(line);
        update();
    });
    connect(&session, &Session::deviceAdded, this, [this](Device *device) {
        m_prepareTimer.start();
        if (m_active)
            turnOff(*device);
    });
    connect(&session, &Session::deviceAboutToBeRemoved, this, [this](Device *device) {
        m_outcomes.erase(device->key());
        m_prepareTimer.start();
    });
    for (const auto &line : session.lines())
        follow(line.get());
}

void StopControl::follow(LineSession *line)
{
    connect(line, &LineSession::deviceChanged, this, [this] { m_prepareTimer.start(); });
    connect(line, &LineSession::deviceLocated, this, [this](Device *device) {
        if (m_active) // pressed while it booted or moved: the packets went to where it was
            turnOff(*device);
    });
    connect(line, &LineSession::stateChanged, this, [this, line] { adopt(*line); });
    adopt(*line);
}

void StopControl::adopt(LineSession &line)
{
    m_prepareTimer.start();
    int &known = m_generations[&line];
    if (known != line.generation()) {
        known = line.generation();
        m_waiting.erase(&line); // its old thread reports no more
        connect(&line.bus(), &BusThread::stopFinished, this,
                [this, at = &line](const std::vector<StopOutcome> &outcomes) { take(at, outcomes); });
    }
    if (m_active && line.state() == BusThread::State::Open && !line.bus().isStopped())
        stop(line); // plugged in again while STOP is held
}

void StopControl::prepare()
{
    for (const auto &line : m_session.lines()) {
        std::vector<StopTarget> targets;
        for (const auto &device : line->devices()) {
            const Field *torque = device->table().find(Known::TorqueEnable);
            if (!torque)
                continue;
            targets.push_back({device->key(), device->id(), device->baudRate(), torque->address,
                               static_cast<std::uint16_t>(device->modelNumber())});
        }
        line->bus().setStopTargets(std::move(targets));
    }
}

void StopControl::stop(LineSession &line)
{
    if (m_prepareTimer.isActive()) { // a device came or moved just now
        m_prepareTimer.stop();
        prepare();
    }
    m_waiting.insert(&line);
    line.bus().stop();
}

void StopControl::press()
{
    m_active = true;
    m_commands.setStopped(true);
    m_outcomes.clear();
    m_waiting.clear();
    for (const auto &line : m_session.lines())
        stop(*line); // also one that is lost: it says of each device that it isn't confirmed
    noteAll();
    update();
}

void StopControl::noteAll()
{
    m_notes.clear();
    for (const Device *device : m_session.devices()) {
        const Field *torque = device->table().find(Known::TorqueEnable);
        if (!torque || !m_commands.journal() || (device->raw(Known::TorqueEnable) && !device->mayHaveTorqueOn()))
            continue;
        JournalEntry entry;
        entry.by = JournalAuthor::Stop;
        entry.device = journalDevice(*device);
        entry.changes = {changeOf(*torque, 0)};
        if (const auto old = device->raw(Known::TorqueEnable))
            entry.changes.front().before = bytesFromRaw(*torque, *old);
        m_notes[device->key()] = JournalNote(m_commands.journal(), std::move(entry));
    }
}

void StopControl::release()
{
    m_active = false;
    m_commands.setStopped(false);
    m_outcomes.clear();
    m_waiting.clear();
    for (const auto &line : m_session.lines())
        line->bus().release();
    update();
}

/// A device that turns up while STOP is held.
void StopControl::turnOff(Device &device)
{
    if (!device.table().find(Known::TorqueEnable))
        return update();
    const DeviceKey key = device.key();
    note({key, false, tr("Not asked yet")});
    m_commands.setTorque({&device}, false, [this, key](const Result<void> &result) {
        if (!m_active)
            return;
        note({key, result.has_value(), result ? QString() : result.error().text});
        update();
    });
    update();
}

void StopControl::note(const StopOutcome &outcome)
{
    m_outcomes[outcome.device] = outcome;
}

void StopControl::take(LineSession *line, const std::vector<StopOutcome> &outcomes)
{
    m_waiting.erase(line);
    if (!m_active)
        return;
    for (const StopOutcome &outcome : outcomes) {
        note(outcome);
        Device *device = m_session.device(outcome.device);
        if (const auto noted = m_notes.extract(outcome.device)) {
            JournalNote &journalled = noted.mapped();
            JournalEntry end = journalled.entry();
            end.state = outcome.off ? JournalState::Done : JournalState::Unconfirmed;
            if (outcome.off)
                end.changes.front().shown = end.changes.front().after;
            journalled.finish(end);
        }
        if (device && outcome.off)
            device->takeReadBack(device->table().indexOf(Known::TorqueEnable), 0);
    }
    update();
}

QStringList StopControl::uncovered() const
{
    QStringList names;
    for (const Device *device : m_session.devices()) {
        if (!device->table().find(Known::TorqueEnable))
            names << device->displayName();
    }
    return names;
}

bool StopControl::isConfirmed() const
{
    return m_active && m_waiting.empty() && uncovered().isEmpty()
        && std::ranges::all_of(m_outcomes, [](const auto &entry) { return entry.second.off; });
}

void StopControl::update()
{
    m_report.clear();
    if (m_active && !m_waiting.empty()) {
        m_report = tr("Turning torque off…");
    } else if (m_active) {
        QStringList open;
        int off = 0;
        for (const auto &[key, outcome] : m_outcomes) {
            const Device *device = m_session.device(key);
            off += outcome.off ? 1 : 0;
            if (!outcome.off && device)
                open << device->displayName();
        }
        QStringList sentences;
        if (off == 1)
            sentences << tr("Torque is off on one device.");
        else if (off > 1)
            sentences << tr("Torque is off on %1 devices.").arg(off);
        else
            sentences << tr("No device confirmed that its torque is off.");
        if (!open.isEmpty())
            sentences << tr("Not confirmed: %1.").arg(open.join(QStringLiteral(", ")));
        if (const QStringList names = uncovered(); !names.isEmpty())
            sentences << tr("Not covered, since their model is unknown: %1.").arg(names.join(QStringLiteral(", ")));
        m_report = sentences.join(QLatin1Char(' '));
    }
    emit changed();
}

} // namespace dynascope
