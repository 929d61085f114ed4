// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"
#include "core/sim/servo.h"

#include <vector>

namespace dynascope::sim {

/// The motion of the demo's arm: someone else's controller, which writes registers as one would by the wire. It takes a
/// joint smoothly from where it stands, and lets go of it when somebody else writes to it or its torque is gone. On the
/// bus's thread.
class DemoScript
{
public:
    /// One joint's part. A sine is written point by point; a joint with a profile gets its two ends in turn.
    struct Part {
        int centre = 2048;    ///< pulses
        int amplitude = 300;  ///< pulses
        double period = 8;    ///< s
        double phase = 0;     ///< of the period
        int profileVelocity = 0, profileAcceleration = 0; ///< raw; both 0: a sine
    };

    /// The servo outlives the script.
    void add(Servo &servo, const Part &part);
    void resume(LineTime now); ///< takes all joints and turns their torque on
    void tick(LineTime now);
    bool isHeld(const Servo &servo) const; ///< is it the script that moves it?

private:
    struct Joint {
        Servo *servo = nullptr;
        Part part;
        bool held = false;
        LineTime taken{};    ///< when
        double from = 0;     ///< where it stood then
        std::int64_t goal = -1;
    };
    void take(Joint &joint, LineTime now);
    void move(Joint &joint, LineTime now);
    void personWrote(const Servo &servo, int address, ByteView data);

    std::vector<Joint> m_joints;
    LineTime m_begin{};
};

} // namespace dynascope::sim
