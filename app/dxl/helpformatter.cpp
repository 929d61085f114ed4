// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/helpformatter.h"

#include <algorithm>
#include <sstream>

namespace dynascope::dxl {

namespace {

constexpr std::size_t Width = 100;

void replace(std::string &text, const std::string &from, const std::string &to)
{
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
}

std::size_t indentOf(const std::string &line, std::size_t column)
{
    const std::size_t leading = std::min(line.find_first_not_of(' '), line.size());
    const bool twoColumns = leading > 0 && line.size() > column && line[column - 1] == ' ' && line[column] != ' ';
    return twoColumns ? column : leading;
}

} // namespace

std::string wrapped(const std::string &text, std::size_t width, std::size_t column)
{
    std::string all;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        const std::size_t indent = indentOf(line, column);
        while (line.size() > width) {
            const std::size_t space = line.rfind(' ', width);
            if (space == std::string::npos || space <= indent)
                break; // a word that is longer than the line
            all += line.substr(0, line.find_last_not_of(' ', space) + 1) + '\n';
            line = std::string(indent, ' ') + line.substr(space + 1);
        }
        all += line + '\n';
    }
    return all;
}

std::string HelpFormatter::make_help(const CLI::App *app, std::string name, CLI::AppFormatMode mode) const
{
    std::string text = CLI::Formatter::make_help(app, std::move(name), mode);
    replace(text, "\nSubcommands:\n", "\nCommands:\n");
    if (app->get_prefix_command()) // what follows is no option of ours, and CLI11 doesn't speak of it
        replace(text, "[OPTIONS] PATH", "PATH COMMAND...");
    replace(text, "[SUBCOMMAND]", app->get_parent() ? "[COMMAND]" : "COMMAND");
    return wrapped(text, Width, get_column_width());
}

} // namespace dynascope::dxl
