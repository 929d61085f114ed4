// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/answerfaults.h"

#include <QString>

namespace dynascope {

/// One row of the Bus health view: a device, or the line as a whole.
struct HealthRow {
    quint32 key = 0; ///< DeviceKey; 0: the line
    QString name;    ///< nickname and model
    DeviceQuality quality;
    double bytesPerSecond = 0;
    quint64 strays = 0; ///< of the line
    bool onlyPing = false; ///< it answers nothing else: no fault of cable or power

    bool isLine() const { return key == 0; }
    friend bool operator==(const HealthRow &, const HealthRow &) = default;
};

// clang-format off
enum class HealthColumn {
    Name, Id, Bad, Good, Missing, CutOff, Damaged, WrongLength, Late, Retries, Median, Slow, Rate
};
// clang-format on
constexpr int HealthColumns = 13;

std::optional<AnswerFault> faultOf(HealthColumn column); ///< nothing: the column counts no fault

QString healthHeading(HealthColumn column);
QString healthCell(const HealthRow &row, HealthColumn column);
QString widestHealthCell(HealthColumn column); ///< so that nothing moves while figures grow
QString verdictText(Verdict verdict);          ///< "bad"

/// What the column says, for its heading: with faults also what usually causes them.
QString healthHelp(HealthColumn column);
/// What the cell says about its device.
QString healthHelp(const HealthRow &row, HealthColumn column);

} // namespace dynascope
