// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sim/servo.h"
#include "core/sim/simulatedbus.h"

#include <QStringList>

#include <map>

namespace dynascope::test {

/// All writable registers of all servos, by the servo's number and the register's name.
using ServoImage = std::map<std::pair<int, QString>, std::int64_t>;

inline ServoImage imageOf(const sim::SimulatedBus &bus)
{
    ServoImage image;
    int number = 0;
    for (const auto &servo : bus.servos()) {
        ++number;
        for (const Field &field : servo->table().fields()) {
            if (field.isWritable())
                image[{number, field.name}] = servo->value(field);
        }
    }
    return image;
}

inline QStringList differences(const ServoImage &one, const ServoImage &other)
{
    QStringList all;
    for (const auto &[where, raw] : one) {
        const std::int64_t now = other.at(where);
        if (now != raw)
            all << QStringLiteral("servo %1, %2: %3, was %4").arg(where.first).arg(where.second).arg(now).arg(raw);
    }
    return all;
}

} // namespace dynascope::test
