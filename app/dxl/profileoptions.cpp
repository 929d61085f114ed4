// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/profileoptions.h"

#include "app/dxl/arguments.h"
#include "core/session/scanner.h"

#include <CLI/CLI.hpp>

#include <string>

namespace dynascope::dxl {

struct ProfileArguments::Typed {
    std::string action, file, joints, bauds, ids, name;
    bool quick = false, calibration = false, all = false;
    bool dryRun = false, move = false, torqueOff = false, torqueBack = false;
};

ProfileArguments::ProfileArguments() : m_typed(std::make_unique<Typed>()) { }
ProfileArguments::~ProfileArguments() = default;

void ProfileArguments::describe(CLI::App &app, bool &yes)
{
    Typed &typed = *m_typed;
    CLI::App *profile = app.add_subcommand("profile", "A robot as one file has it: save it, check it, set it up");
    profile->add_option("ACTION", typed.action, "save, check, diff or apply")
        ->required()
        ->type_name({})
        ->check(CLI::IsMember({"save", "check", "diff", "apply"}).description({}));
    profile->add_option("FILE", typed.file, "The profile, YAML")->required()->type_name({});
    profile->add_option("--joints", typed.joints, "check, diff, apply: only these, by name: shoulder,elbow (all)")
        ->type_name("LIST");
    profile->add_flag("--quick", typed.quick, "check, diff: don't look for devices that no joint names");
    profile
        ->add_option("--bauds", typed.bauds,
                     "save: baud rates to look for devices at: 57600,1000000 or all (those of the file, else that of "
                     "--baud)")
        ->type_name("LIST");
    profile->add_option("--ids", typed.ids, "save: only these devices: 1,4-7 (everybody found)")->type_name("LIST");
    profile->add_option("--name", typed.name, "save: the robot's name in a new file")->type_name("NAME");
    profile->add_flag("--calibration", typed.calibration,
                      "save: also what belongs to one single device and not to its place (Homing Offset)");
    profile->add_flag("--all", typed.all,
                      "save: every register that can be written, also what is as the factory had it");
    profile->add_flag("--dry-run", typed.dryRun, "apply: only say what would be written");
    profile->add_flag("--yes", yes, "apply: don't ask; needed where nobody can be asked");
    profile->add_flag("--move", typed.move, "apply: bring joints that are at another baud rate to theirs first");
    profile->add_flag("--torque-off", typed.torqueOff,
                      "apply: turn torque off where it locks a register; what a joint carries may fall");
    profile->add_flag("--torque-back", typed.torqueBack,
                      "apply: turn it on again afterwards, the goal being where the joint then is");
    profile->footer(
        "check ends with 0 where all is as wanted and with 1 where not; diff names each register. apply writes "
        "only what differs, EEPROM first, and reads it back; the same once more writes nothing. save changes "
        "values where they stand in the file and leaves the rest of it as it is.");
}

Result<ProfileOptions> ProfileArguments::understand() const
{
    const Typed &typed = *m_typed;
    ProfileOptions options;
    options.action = typed.action == "save"    ? ProfileAction::Save
                     : typed.action == "diff"  ? ProfileAction::Diff
                     : typed.action == "apply" ? ProfileAction::Apply
                                               : ProfileAction::Check;
    options.file = QString::fromStdString(typed.file);
    for (const QString &name : QString::fromStdString(typed.joints).split(u',', Qt::SkipEmptyParts))
        options.joints << name.trimmed();
    if (!typed.bauds.empty()) {
        auto bauds = parseBauds(QString::fromStdString(typed.bauds), allBauds());
        if (!bauds)
            return wrong(QStringLiteral("--bauds: ") + bauds.error().text);
        options.bauds = std::move(*bauds);
    }
    if (!typed.ids.empty()) {
        auto ids = parseIdList(QString::fromStdString(typed.ids));
        if (!ids)
            return tl::unexpected(ids.error());
        options.ids = std::move(*ids);
    }
    options.name = QString::fromStdString(typed.name);
    options.quick = typed.quick;
    options.calibration = typed.calibration;
    options.all = typed.all;
    options.dryRun = typed.dryRun;
    options.move = typed.move;
    options.torqueOff = typed.torqueOff;
    options.torqueBack = typed.torqueBack;
    const bool saves = options.action == ProfileAction::Save, applies = options.action == ProfileAction::Apply;
    if (!saves
        && (options.calibration || options.all || !options.bauds.empty() || !options.ids.empty()
            || !options.name.isEmpty()))
        return wrong(QStringLiteral("--bauds, --ids, --name, --calibration and --all are for save"));
    if (!applies && (options.dryRun || options.move || options.torqueOff || options.torqueBack))
        return wrong(QStringLiteral("--dry-run, --move, --torque-off and --torque-back are for apply"));
    if (saves && !options.joints.isEmpty())
        return wrong(QStringLiteral("--joints is for check, diff and apply; of save, --ids"));
    if (options.torqueBack && !options.torqueOff)
        return wrong(
            QStringLiteral("--torque-back turns torque on again where --torque-off turned it off, which isn't given"));
    return options;
}

} // namespace dynascope::dxl
