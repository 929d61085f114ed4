// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QCoreApplication>

namespace dynascope::messages {

/// The context under which translators find the bus's messages. English in a program that loads no translation, as dxl.
/// Any thread.
struct Messages {
    Q_DECLARE_TR_FUNCTIONS(Messages)
};

} // namespace dynascope::messages
