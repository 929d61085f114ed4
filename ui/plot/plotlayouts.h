// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/plot/plotstate.h"

namespace dynascope {

/// Arrangements of the plots that a person has named, in the user's settings. Each belongs to the robot whose devices it
/// shows: which that is, is asked of the devices that are there.
namespace plotlayouts {

struct Layout {
    QString name;
    PlotState state;
};

inline constexpr std::size_t Most = 64;
inline constexpr qsizetype LongestName = 60;

std::vector<Layout> load(); ///< by name; what is damaged is passed over
/// Replaces one of this name. False: the name is empty, or there are too many.
bool store(const QString &name, const PlotState &state);
void remove(const QString &name);

/// Are half of its devices there?
bool fits(const PlotState &state, const std::vector<Device *> &devices);
/// Its traces on the line where their devices are now: an adapter may have another name today.
PlotState found(PlotState state, const std::vector<Device *> &devices);

} // namespace plotlayouts

} // namespace dynascope
