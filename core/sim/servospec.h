// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/result.h"
#include "core/table/catalog.h"

#include <vector>

namespace dynascope::sim {

/// One device of a simulated bus: MODEL[/FIRMWARE]@BAUD:ID, or :ID+ID2 for a model with two axes, which is two servos
/// with one baud rate and one lock of the EEPROM.
struct ServoSpec {
    QString model;
    int firmware = -1; ///< −1: the newest the catalog knows
    int baudRate = 57600;
    int id = 1;
    int secondId = -1; ///< of the second axis; −1: it has none

    friend bool operator==(const ServoSpec &, const ServoSpec &) = default;
};

/// Is there such a device? Writes the model's name as the catalog does; the message speaks of this device alone.
Result<void> checkServoSpec(ServoSpec &spec, const Catalog &catalog);
/// "XM430-W350@57600:1,XL330-M288/52@1000000:7"; the message names the entry that is wrong.
Result<std::vector<ServoSpec>> parseServoSpecs(QStringView text, const Catalog &catalog);

} // namespace dynascope::sim
