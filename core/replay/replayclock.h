// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"

namespace dynascope {

/// Where a replay stands in its recording, and how fast it goes on. Knows no timer: it is told how much time has passed.
/// Any one thread.
class ReplayClock
{
public:
    static constexpr double SlowestSpeed = 1.0 / 64;
    static constexpr double FastestSpeed = 1024;

    ReplayClock() = default;
    ReplayClock(LineTime begin, LineTime end); ///< stands at `begin`; an `end` before it is taken for it

    void extend(LineTime end); ///< there is more behind what was known, if it is later

    LineTime begin() const { return m_begin; }
    LineTime end() const { return m_end; }
    LineTime position() const { return m_position; }
    void seek(LineTime to); ///< as far as the recording goes; playing goes on

    bool isPlaying() const { return m_isPlaying; }
    void play(); ///< from its begin, where it stands at the end
    void pause() { m_isPlaying = false; }

    double speed() const { return m_speed; } ///< seconds of the recording a second
    void setSpeed(double speed);             ///< within the limits

    /// So much time has passed on the wall. True where the position is another one; at the end it stops playing.
    bool advance(LineTime passed);

private:
    LineTime m_begin{}, m_end{}, m_position{};
    double m_speed = 1;
    double m_rest = 0; ///< ns that were too short to move it
    bool m_isPlaying = false;
};

} // namespace dynascope
