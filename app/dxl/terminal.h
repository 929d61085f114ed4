// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

#include <cstdio>

namespace dynascope::dxl {

/// Is a person at the other end?
bool isTerminal(std::FILE *stream);

/// Asks on standard error and reads standard input. False also where nobody is there to answer, or Ctrl-C came instead.
bool answersYes(const QString &question);

} // namespace dynascope::dxl
