// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/watch.h"

#include <QObject>

#include <map>

namespace dynascope {

class Monitor;
class Session;

/// Remembers in the settings how often a person wants a field of a device, by line, model, ID and field, and wants it so
/// again when it is next watched.
class WantedRates : public QObject
{
    Q_OBJECT

public:
    /// Both outlive this.
    WantedRates(Session &session, Monitor &monitor, QObject *parent);

private:
    void look();
    QString keyOf(const Watch &watch) const; ///< empty: its device is gone

    Session &m_session;
    Monitor &m_monitor;
    std::map<Watch, double> m_seen; ///< of what is watched: Hz
};

} // namespace dynascope
