// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QStringList>

#include <vector>

namespace dynascope {
class Catalog;
}

namespace dynascope::dxl {

/// What can be typed behind `dxl`, or behind one of its commands.
struct Words {
    QString name; ///< of the command; empty: of the program itself
    QString help;
    QStringList options;
    QStringList helps; ///< of the options
    QStringList words; ///< what stands for itself: on, off...
    enum class Fields { None, Names, Assignments } fields = Fields::None;
    bool takesFiles = false;
};

/// An option behind which a value stands, and what is offered as that.
struct ValuedOption {
    QString name;
    QStringList values;
    bool takesFiles = false;
};

/// Everything that is completed, made from the one description of commands and options.
struct Completions {
    Words program;
    std::vector<Words> commands;
    std::vector<ValuedOption> valued; ///< of all commands, each once
    QStringList fields; ///< as a person types them: present_position

    QStringList names() const; ///< of the commands
};

Completions completionsOf(const Catalog &catalog);

} // namespace dynascope::dxl
