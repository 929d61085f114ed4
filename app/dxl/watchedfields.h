// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/dxl/device.h"
#include "app/dxl/options.h"
#include "core/bus/poll_values.h"

namespace dynascope::dxl {

/// One register of one device that `dxl watch` reads again and again. PollSpan::device is its place in the list.
struct WatchedField {
    Device *device = nullptr;
    const Field *field = nullptr;
    EffectiveField units; ///< as they were at the begin
    bool nameDevice = false;
    Error error; ///< why it came last without a value; empty where it had one

    QString name() const; ///< "Present Position", with several devices "ID 1: Present Position"
};

/// The registers that are asked for of this device. InvalidArgument: it hasn't one of them.
Result<void> addWatched(Device &device, const Options &options, bool nameDevice, std::vector<WatchedField> &fields);
PollPlan planOf(Bus &bus, const std::vector<WatchedField> &fields);

/// "time_s,ID 1: Present Position [deg]".
QByteArray csvHeading(const std::vector<WatchedField> &fields);
/// One sample as text, comma-separated values or a JSON object. `time` is in seconds.
QByteArray sampleLine(const Options &options, const std::vector<WatchedField> &fields, const Batch &batch, double time);

} // namespace dynascope::dxl
