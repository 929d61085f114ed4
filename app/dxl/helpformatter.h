// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>

namespace dynascope::dxl {

/// Help as CLI11 makes it, in our words (commands) and in lines that a terminal holds.
class HelpFormatter final : public CLI::Formatter
{
public:
    std::string make_help(const CLI::App *app, std::string name, CLI::AppFormatMode mode) const override;
};

/// Lines of more than `width` characters broken at spaces; what follows stands below the text of its column, which is the
/// one at `column` where the line has two.
std::string wrapped(const std::string &text, std::size_t width, std::size_t column);

} // namespace dynascope::dxl
