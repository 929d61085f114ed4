// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/journaloptions.h"

#include "app/dxl/arguments.h"
#include "core/session/journal/journalentry.h"

#include <CLI/CLI.hpp>

#include <string>

namespace dynascope::dxl {
namespace {

/// "7", "5-9", "5-": that one and all behind it.
Result<JournalOptions::Range> parseRange(const QString &word)
{
    const qsizetype dash = word.indexOf(u'-');
    const auto number = [](QStringView text) {
        bool isNumber = false;
        const qint64 value = text.toLongLong(&isNumber);
        return isNumber && value > 0 && value <= LargestJournalNumber ? value : 0;
    };
    JournalOptions::Range range;
    range.from = number(dash < 0 ? QStringView(word) : QStringView(word).left(dash));
    range.isOne = dash < 0;
    range.to = dash < 0                  ? range.from
               : dash + 1 == word.size() ? LargestJournalNumber
                                         : number(QStringView(word).mid(dash + 1));
    if (range.from == 0 || range.to < range.from)
        return wrong(QStringLiteral("\"%1\" names no entries of the journal: 7, 5-9, 5- or last").arg(word));
    return range;
}

} // namespace

struct JournalArguments::Typed {
    std::string action = "list";
    std::vector<std::string> entries;
    int count = 20;
    bool move = false, torqueOff = false, dryRun = false;
};

JournalArguments::JournalArguments() : m_typed(std::make_unique<Typed>()) { }
JournalArguments::~JournalArguments() = default;

void JournalArguments::describe(CLI::App &app)
{
    Typed &typed = *m_typed;
    CLI::App *journal =
        app.add_subcommand("journal", "What was written by window and dxl; take it back or do it again");
    journal->add_option("ACTION", typed.action, "list, undo, redo or export (list)")
        ->type_name({})
        ->check(CLI::IsMember({"list", "undo", "redo", "export"}).description({}));
    journal->add_option("ENTRY", typed.entries, "Entries by number: 7, 5-9, 5- (that one and all after it), or last")
        ->type_name({});
    journal->add_option("--count", typed.count, "list: how many, the newest (20)")
        ->type_name("N")
        ->check(CLI::Range(1, 1'000'000).description({}));
    journal->add_flag("--move", typed.move, "Goals may be put back under torque: the motor moves");
    journal->add_flag("--torque-off", typed.torqueOff,
                      "Torque may be turned off where the EEPROM needs it, or where it was off before: what a joint "
                      "carries may fall");
    journal->add_flag("--dry-run", typed.dryRun, "undo, redo: only say what would be done");
    journal->footer(
        "The newest is undone first. Refused where the device has changed meanwhile, or is another. Torque is "
        "never switched on. export prints a shell script.");
}

Result<JournalOptions> JournalArguments::understand() const
{
    JournalOptions options;
    const std::string &action = m_typed->action;
    options.action = action == "undo"     ? JournalAction::Undo
                     : action == "redo"   ? JournalAction::Redo
                     : action == "export" ? JournalAction::Export
                                          : JournalAction::List;
    options.count = m_typed->count;
    options.mayMove = m_typed->move;
    options.mayTurnTorqueOff = m_typed->torqueOff;
    options.dryRun = m_typed->dryRun;
    for (const std::string &text : m_typed->entries) {
        if (text == "last") {
            options.last = true;
            continue;
        }
        const auto range = parseRange(QString::fromStdString(text));
        if (!range)
            return tl::unexpected(range.error());
        options.ranges.push_back(*range);
    }
    const bool reverts = options.action == JournalAction::Undo || options.action == JournalAction::Redo;
    if (reverts && m_typed->entries.empty())
        return wrong(QStringLiteral("say which entries: 7, 5-9, 5- or last; dxl journal lists them"));
    if (options.last && !reverts)
        return wrong(QStringLiteral("\"last\" is for undo and redo"));
    return options;
}

} // namespace dynascope::dxl
