// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/backupoptions.h"

#include "app/dxl/arguments.h"
#include "core/session/backup/restore.h"

#include <CLI/CLI.hpp>

#include <string>

namespace dynascope::dxl {
namespace {

Result<std::vector<std::uint8_t>> idsOf(const std::string &text)
{
    return parseIdList(QString::fromStdString(text));
}

QStringList namesOf(const std::vector<std::string> &typed)
{
    QStringList names;
    for (const std::string &text : typed)
        names << QString::fromStdString(text).split(u',', Qt::SkipEmptyParts);
    return names;
}

/// A number is a device, everything else a file.
Result<CompareSide> sideOf(const std::string &text)
{
    bool isNumber = false;
    const int number = QString::fromStdString(text).toInt(&isNumber);
    if (isNumber && (number < 0 || number > 252))
        return wrong(QStringLiteral("%1 is no ID (0 to 252); a file of that name is ./%1").arg(number));
    return isNumber ? CompareSide{number, {}} : CompareSide{-1, QString::fromStdString(text)};
}

} // namespace

struct BackupArguments::Typed {
    std::string ids, file, folder, left, right, calibration;
    std::vector<std::string> only, except;
    bool inServo = false, yes = false, replace = false, dryRun = false, torqueOff = false, torqueBack = false;
    bool withIdAndBaud = false, all = false;
};

BackupArguments::BackupArguments() : m_typed(std::make_unique<Typed>()) { }
BackupArguments::~BackupArguments() = default;

void BackupArguments::describe(CLI::App &app)
{
    Typed &typed = *m_typed;
    CLI::App *backup = app.add_subcommand("backup", "Save all registers of devices to files");
    backup->add_option("IDS", typed.ids, "The devices, 0 to 252: 7 or 1,3-5")->required()->type_name({});
    backup->add_option("FILE", typed.file, "Where to, for one device (MODEL-idNNN-TIME.yaml here)")->type_name({});
    backup->add_option("--folder", typed.folder, "The folder for files named after their devices")->type_name("PATH");
    backup->add_flag("--replace", typed.replace, "FILE may be there already");
    backup->add_flag("--in-servo", typed.inServo, "Into the device itself instead (Control Table Backup)");
    backup->add_flag("--yes", typed.yes, "Don't ask");
    backup->footer("The file is YAML, a register a line. --in-servo: " + inServoConditions().toStdString());

    CLI::App *restore = app.add_subcommand("restore", "Put registers of a device back to what a backup holds");
    restore->add_option("IDS", typed.ids, "The device; with --in-servo one or more: 1,3-5")->required()->type_name({});
    restore->add_option("FILE", typed.file, "The backup: of this model, of any firmware")->type_name({});
    restore->add_flag("--dry-run", typed.dryRun, "Only say what would be written, and what could not be carried");
    restore->add_flag("--yes", typed.yes, "Don't ask; needed where nobody can be asked");
    restore->add_flag("--torque-off", typed.torqueOff,
                      "Turn torque off where it locks the EEPROM; what a joint carries may fall");
    restore->add_flag("--torque-back", typed.torqueBack, "Then on again, with the goal where the joint is");
    restore->add_option("--only", typed.only, "These registers alone: operating_mode,homing_offset")->type_name("LIST");
    restore->add_option("--except", typed.except, "All but these registers")->type_name("LIST");
    restore
        ->add_option("--calibration", typed.calibration,
                     "yes or no: also Homing Offset, which belongs to the single device (where model, firmware and ID "
                     "are those of the backup)")
        ->type_name("WORD")
        ->check(CLI::IsMember({"yes", "no"}).description({}));
    restore->add_flag("--with-id-and-baud", typed.withIdAndBaud,
                      "At last move it to the backup's ID and baud rate, as dxl move does");
    restore->add_flag("--in-servo", typed.inServo, "From the backup that the device itself holds; no FILE");
    restore->footer(
        "Only what differs is written, EEPROM before RAM, each register read back; never torque on, never a "
        "goal. Stopped anywhere, the same once more goes on. --in-servo: "
        + inServoConditions().toStdString());

    CLI::App *compare = app.add_subcommand("compare", "Compare two backups, two devices, or one with the other");
    compare->add_option("A", typed.left, "The ID of a device, or a backup's file")->required()->type_name({});
    compare->add_option("B", typed.right, "Another one")->required()->type_name({});
    compare->add_flag("--all", typed.all, "Also what is the same, and what can only be read");
    compare->footer("Registers are compared by name. Exit code 0: all is the same but for readings, 1: it is not.");
}

Result<BackupOptions> BackupArguments::understandBackup() const
{
    BackupOptions options;
    options.inServo = m_typed->inServo;
    options.yes = m_typed->yes;
    options.replace = m_typed->replace;
    std::string ids = m_typed->ids;
    // As it was called before there were files: backup store|restore IDS.
    if (ids == "store" || ids == "restore") {
        options.inServo = true;
        options.restores = ids == "restore";
        ids = m_typed->file;
    } else {
        options.file = QString::fromStdString(m_typed->file);
    }
    options.folder = QString::fromStdString(m_typed->folder);
    auto list = idsOf(ids);
    if (!list)
        return tl::unexpected(list.error());
    options.ids = std::move(*list);
    if (options.inServo && (!options.file.isEmpty() || !options.folder.isEmpty()))
        return wrong(QStringLiteral("--in-servo keeps the backup in the device: no FILE, no --folder"));
    if (!options.file.isEmpty() && !options.folder.isEmpty())
        return wrong(QStringLiteral("FILE or --folder, one of them"));
    if (!options.file.isEmpty() && options.ids.size() > 1)
        return wrong(QStringLiteral("one FILE is for one device; --folder makes a file of each"));
    return options;
}

Result<BackupOptions> BackupArguments::understandRestore() const
{
    BackupOptions options;
    const Typed &typed = *m_typed;
    options.inServo = typed.inServo;
    options.restores = true;
    options.file = QString::fromStdString(typed.file);
    options.yes = typed.yes;
    options.dryRun = typed.dryRun;
    options.torqueOff = typed.torqueOff;
    options.torqueBack = typed.torqueBack;
    options.withIdAndBaud = typed.withIdAndBaud;
    options.only = namesOf(typed.only);
    options.except = namesOf(typed.except);
    if (!typed.calibration.empty())
        options.calibration = typed.calibration == "yes";
    auto list = idsOf(typed.ids);
    if (!list)
        return tl::unexpected(list.error());
    options.ids = std::move(*list);
    if (options.inServo) {
        const bool isMore = !options.file.isEmpty() || options.dryRun || options.torqueOff || options.torqueBack
                            || options.withIdAndBaud || options.calibration || !options.only.isEmpty()
                            || !options.except.isEmpty();
        if (isMore)
            return wrong(QStringLiteral("--in-servo restores all of what the device holds: with --yes alone"));
        return options;
    }
    if (options.file.isEmpty())
        return wrong(QStringLiteral("say the backup's FILE, or --in-servo for the one that the device holds"));
    if (options.ids.size() != 1)
        return wrong(QStringLiteral("one FILE is restored to one device"));
    if (options.torqueBack && !options.torqueOff)
        return wrong(QStringLiteral("--torque-back is for --torque-off"));
    return options;
}

Result<BackupOptions> BackupArguments::understandCompare() const
{
    BackupOptions options;
    options.all = m_typed->all;
    for (const std::string &text : {m_typed->left, m_typed->right}) {
        const auto side = sideOf(text);
        if (!side)
            return tl::unexpected(side.error());
        options.sides.push_back(*side);
        if (side->id >= 0)
            options.ids.push_back(static_cast<std::uint8_t>(side->id));
    }
    return options;
}

} // namespace dynascope::dxl
