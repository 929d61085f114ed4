// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/linesession.h"

#include <QDateTime>

#include <functional>

namespace dynascope {

/// The lines that are open and the devices on them; nothing else. What is done with them are classes of their own:
/// Scanner, Commands, Monitor, StopControl. GUI thread, owned by app.
class Session : public QObject
{
    Q_OBJECT

public:
    /// Both outlive the session.
    Session(LineFactory &factory, const Catalog &catalog, QObject *parent = nullptr);
    ~Session() override;

    const Catalog &catalog() const { return m_catalog; }

    /// What time it is for whoever looks at devices: on the clock of their lines, and on the wall. The machine's, unless a
    /// replay sets its own.
    struct Clock {
        std::function<LineTime()> line;
        std::function<QDateTime()> wall;
    };
    LineTime now() const { return m_clock.line(); }
    QDateTime wallNow() const { return m_clock.wall(); }
    void setClock(Clock clock) { m_clock = std::move(clock); }
    static Clock machineClock();

    const std::vector<std::unique_ptr<LineSession>> &lines() const { return m_lines; }

    /// Opens in the background; the line's state tells how it went. A line of this name that is open is closed first.
    LineSession &open(const QString &name, int baudRate);
    void close(LineSession &line);

    Device *device(DeviceKey key) const;
    std::vector<Device *> devices() const;

signals:
    void lineAdded(dynascope::LineSession *line);
    void lineAboutToBeRemoved(dynascope::LineSession *line);
    void deviceAdded(dynascope::Device *device);
    void deviceAboutToBeRemoved(dynascope::Device *device);

private:
    LineFactory &m_factory;
    const Catalog &m_catalog;
    DeviceKeys m_keys;
    Clock m_clock = machineClock();
    std::vector<std::unique_ptr<LineSession>> m_lines;
};

} // namespace dynascope
