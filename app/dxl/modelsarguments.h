// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace dynascope::dxl {

/// What `dxl models` was told, as typed.
struct ModelsArguments {
    enum class Act { List, Show, Check, Import };
    Act act = Act::List;
    std::string model; ///< MODEL[/FIRMWARE], by name or number
    std::string file;
    std::string out; ///< empty: standard output
    std::string name;
    int number = -1;
};

} // namespace dynascope::dxl
