// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/commissionoptions.h"

#include "app/dxl/arguments.h"

#include <CLI/CLI.hpp>

#include <string>

namespace dynascope::dxl {

struct CommissionArguments::Typed {
    std::string model, ids, names, profile, labels;
    int firmware = 0;
    bool torqueOff = false, present = false, noLed = false;
};

CommissionArguments::CommissionArguments() : m_typed(std::make_unique<Typed>()) { }
CommissionArguments::~CommissionArguments() = default;

void CommissionArguments::describe(CLI::App &app)
{
    Typed &typed = *m_typed;
    CLI::App *commission = app.add_subcommand(
        "commission", "New servos, plugged in one after the other, get their IDs, the baud rate and settings");
    commission->add_option("--model", typed.model, "What they are; what is plugged in and isn't, is left as it is")
        ->type_name("MODEL");
    commission->add_option("--ids", typed.ids, "The IDs they get, one after the other: 11-16")->type_name("LIST");
    commission->add_option("--names", typed.names, "What they are called, one name for each ID: shoulder,elbow")
        ->type_name("LIST");
    commission->add_option("--firmware", typed.firmware, "The oldest firmware that will do (any)")
        ->type_name("N")
        ->check(CLI::Range(0, 255).description({}));
    commission
        ->add_option("--profile", typed.profile,
                     "Instead: the joints of a robot's profile, with their places, firmware and registers")
        ->type_name("FILE");
    commission
        ->add_option("--labels", typed.labels, "Write a list of who was ticked off: as CSV where FILE ends with .csv, "
                                               "else as text")
        ->type_name("FILE");
    commission->add_flag("--present", typed.present,
                         "Take one that answers already for the first; without it whoever was there before is left alone");
    commission->add_flag("--torque-off", typed.torqueOff, "Turn torque off where it locks the EEPROM");
    commission->add_flag("--no-led", typed.noLed, "Don't light the LED of each one that is done");
    commission->footer("The new baud rate is that of --baud. The chain may grow, or each servo be unplugged before the "
                       "next. Two new ones at once, another model or an ID that is taken: said, and nothing is written. "
                       "Started once more with the same list, it ticks off what stands as wanted and goes on.");
}

Result<CommissionWishes> CommissionArguments::understand() const
{
    const Typed &typed = *m_typed;
    CommissionWishes wishes;
    wishes.model = QString::fromStdString(typed.model);
    wishes.profile = QString::fromStdString(typed.profile);
    wishes.labels = QString::fromStdString(typed.labels);
    wishes.firmware = typed.firmware;
    wishes.turnTorqueOff = typed.torqueOff;
    wishes.takesPresent = typed.present;
    wishes.lightsLed = !typed.noLed;
    const bool hasList = !typed.model.empty() || !typed.ids.empty();
    if (hasList == !typed.profile.empty() || typed.model.empty() != typed.ids.empty())
        return wrong(QStringLiteral("say which servos: --model with --ids, or --profile"));
    if (!wishes.profile.isEmpty() && (!typed.names.empty() || typed.firmware > 0))
        return wrong(QStringLiteral("--names and --firmware stand in the profile"));
    if (!hasList)
        return wishes;
    const auto ids = parseIdList(QString::fromStdString(typed.ids));
    if (!ids)
        return tl::unexpected(ids.error());
    wishes.ids.assign(ids->begin(), ids->end());
    if (!typed.names.empty())
        wishes.names = QString::fromStdString(typed.names).split(u',');
    return wishes;
}

} // namespace dynascope::dxl
