// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/settings/settingsplan.h"

/// What planning and comparing share. Pure.
namespace dynascope {

/// The registers that bound this one or decide on its range, by name.
QStringList limitingRegisters(const Field &field);

/// In which order they are written, see planSettings().
std::vector<const Field *> inOrder(const ControlTable &table, std::vector<const Field *> fields);

/// A sentence without its stop; empty: it is within the range.
QString rangeProblem(const SettingsStep &step, std::int64_t raw, const KnownRange &range);

} // namespace dynascope
