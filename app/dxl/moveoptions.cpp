// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/moveoptions.h"

#include "app/dxl/arguments.h"

#include <QStringList>

#include <CLI/CLI.hpp>

#include <string>

namespace dynascope::dxl {
namespace {

/// "1=5", or ranges of one length: "1-3=2-4".
Result<void> addIds(const QString &word, std::vector<std::pair<int, int>> &ids)
{
    const QStringList sides = word.split(u'=');
    const auto from = parseIds(sides.first()), to = parseIds(sides.last());
    if (sides.size() != 2 || !from || !to || from->last - from->first != to->last - to->first)
        return wrong(QStringLiteral("\"%1\" is no change of IDs: 1=5, or 1-3=2-4, or several: 1=2 2=1").arg(word));
    for (int i = 0; i <= from->last - from->first; ++i) {
        for (const auto &[old, now] : ids) {
            if (old == from->first + i || now == to->first + i)
                return wrong(QStringLiteral("\"%1\" names an ID for the second time").arg(word));
        }
        ids.emplace_back(from->first + i, to->first + i);
    }
    return {};
}

} // namespace

struct MoveArguments::Typed {
    std::vector<std::string> ids;
    std::string movers;
    std::optional<int> toBaud;
    bool torqueOff = false, dryRun = false, resume = false, forget = false;
};

MoveArguments::MoveArguments() : m_typed(std::make_unique<Typed>()) { }
MoveArguments::~MoveArguments() = default;

void MoveArguments::describe(CLI::App &app)
{
    Typed &typed = *m_typed;
    CLI::App *move = app.add_subcommand("move", "Give devices new IDs, a new baud rate, or both");
    move->add_option("OLD=NEW", typed.ids, "IDs: 1=5, or ranges: 1-3=2-4; swaps and rings, too")->type_name({});
    move->add_option("--to-baud", typed.toBaud, "The new baud rate, bits per second")
        ->type_name("N")
        ->check(CLI::Range(1, HighestBaudRate).description({}));
    move->add_option("--ids", typed.movers, "Who goes to the new baud rate, by the IDs of now: 1,4-7 (everybody found)")
        ->type_name("LIST");
    move->add_flag("--torque-off", typed.torqueOff,
                   "Turn torque off where it locks the EEPROM; what a joint carries may fall");
    move->add_flag("--dry-run", typed.dryRun, "Look, and say what would be written in which order");
    move->add_flag("--resume", typed.resume, "Go on with what a program that was ended left half done");
    move->add_flag("--forget", typed.forget, "Leave that as it is, and forget the plan");
    move->footer("Everything is looked at before anything is written: that the port can do the rate, that everybody is "
                 "there and the new places are free. Then device by device, each verified before the next.");
}

Result<MoveOptions> MoveArguments::understand() const
{
    MoveOptions options;
    for (const std::string &word : m_typed->ids) {
        if (const auto added = addIds(QString::fromStdString(word), options.ids); !added)
            return tl::unexpected(added.error());
    }
    options.toBaud = m_typed->toBaud;
    if (!m_typed->movers.empty()) {
        auto movers = parseIdList(QString::fromStdString(m_typed->movers));
        if (!movers)
            return tl::unexpected(movers.error());
        options.movers = std::move(*movers);
        if (!options.toBaud)
            return wrong(QStringLiteral("--ids says who goes to --to-baud, which isn't given"));
    }
    options.turnTorqueOff = m_typed->torqueOff;
    options.dryRun = m_typed->dryRun;
    options.resume = m_typed->resume;
    options.forget = m_typed->forget;
    const bool isNew = !options.ids.empty() || options.toBaud;
    if (int(isNew) + int(options.resume) + int(options.forget) != 1)
        return wrong(QStringLiteral("say new IDs (1=5), --to-baud, or one of --resume and --forget"));
    return options;
}

} // namespace dynascope::dxl
