// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"
#include "core/sim/supply.h"

#include <memory>
#include <vector>

namespace dynascope::sim {

class Servo;

/// What feeds the servos of a bus. Unless told otherwise a servo joins the first supply whose voltage its factory
/// limits allow, or gets a new one at the voltage of its data sheet: a 5 V servo beside 12 V ones has a converter.
/// Owned by the bus, on its thread; a change counts from the moment the bus has been advanced to.
class Power
{
public:
    void connect(Servo &servo, LineTime now);
    void beginAt(LineTime now);
    void advanceTo(LineTime now);

    /// One supply for all servos from now on, those it harms included.
    void setVoltage(double volts);
    void setResistance(double ohms); ///< of each supply and its wires
    void setOn(bool on);             ///< the main switch
    bool isOn() const { return m_on; }
    const std::vector<std::unique_ptr<Supply>> &supplies() const { return m_supplies; }

private:
    Supply &supplyFor(Servo &servo, LineTime now);

    std::vector<Servo *> m_servos;
    std::vector<std::unique_ptr<Supply>> m_supplies;
    double m_ohms = Supply::UsualResistance;
    bool m_on = true, m_common = false;
};

} // namespace dynascope::sim
