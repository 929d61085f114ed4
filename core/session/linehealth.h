// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/quality_values.h"

#include <QObject>

#include <deque>

namespace dynascope {

/// What the answers on a line are like since counting began, by the ID of the devices that stand there now. GUI thread;
/// owned by LineSession, which hands in what the bus thread counts. The bus knows IDs only: what a scan asks at another
/// baud rate counts for the ID as well.
class LineHealth : public QObject
{
    Q_OBJECT

public:
    using QObject::QObject;

    const LineQuality &quality() const { return m_shown; } ///< since counting began
    double seconds() const;                                ///< so long has been counted
    /// Of good answers, between the last two reports.
    double bytesPerSecond(std::uint8_t id) const;
    double bytesPerSecond() const; ///< of all devices
    const LineDelays &delays() const { return m_latest.polled.delays; } ///< what adapter and host add, as measured
    /// Answers a second to what is read at this interval, over the last seconds.
    double answersPerSecond(std::chrono::milliseconds interval) const;

    /// A person wants to see what it is like from now on.
    void startAnew();

    /// @name For LineSession
    /// @{
    void startAnew(std::uint8_t id); ///< another device stands there now
    void begin();                    ///< a new bus thread counts from nothing
    void take(LineQuality quality);
    /// @}

signals:
    void changed(); ///< about twice a second while the line is open

private:
    void show();
    void keep(const LineQuality &quality);
    double rate(quint64 now, quint64 before) const;

    LineQuality m_latest;   ///< as the bus thread counts
    LineQuality m_previous; ///< the report before
    LineQuality m_origin;   ///< where counting began
    struct Polled {
        LineTime at{};
        PollReport report;
    };
    std::deque<Polled> m_polled; ///< of the last seconds, while the plan was the same
    LineQuality m_shown;
};

} // namespace dynascope
