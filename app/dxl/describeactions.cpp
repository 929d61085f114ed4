// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/typed.h"

#include <CLI/CLI.hpp>

namespace dynascope::dxl {

namespace {

void addWord(CLI::App &command, const std::string &name, std::string &word, const std::vector<std::string> &words,
             const std::string &help)
{
    command.add_option(name, word, help)->required()->type_name({})->check(CLI::IsMember(words).description({}));
}

void addYes(CLI::App &command, Typed &typed)
{
    command.add_flag("--yes", typed.yes, "Don't ask; needed where nobody can be asked");
}

void describeStop(CLI::App &app, Typed &typed)
{
    CLI::App *stop = app.add_subcommand("stop", "Turn the torque of all devices off, and look whether it is");
    stop->add_option("IDS", typed.ids,
                     "The devices: 1,3-5; each is told as soon as it has said what it is (whoever "
                     "answers a Ping to all, which takes most of a second)")
        ->type_name({});
    stop->add_option("--model", typed.model, "The model of all IDS: they are told before anything is asked")
        ->type_name("MODEL");
    stop->add_option("--bauds", typed.bauds, "Baud rates to stop devices at: 57600,1000000 or all (that of --baud)")
        ->type_name("LIST");
    stop->footer("Each model is written to at its own Torque Enable, twice, then read back. Joints that bear a load "
                 "will drop it.");
}

} // namespace

void describeActions(CLI::App &app, Typed &typed)
{
    CLI::App *torque = app.add_subcommand("torque", "Turn torque on or off and read it back");
    addWord(*torque, "STATE", typed.state, {"on", "off"}, "on or off");
    addIds(*torque, typed);
    CLI::App *led = app.add_subcommand("led", "Turn the LED on or off and read it back");
    addWord(*led, "STATE", typed.state, {"on", "off"}, "on or off");
    addIds(*led, typed);

    CLI::App *reboot = app.add_subcommand("reboot", "Restart devices and wait until they are back");
    addIds(*reboot, typed);
    reboot->footer("Torque goes off, RAM goes back to its defaults, a latched Hardware Error is cleared.");

    CLI::App *reset = app.add_subcommand("reset", "Put the EEPROM back to what the factory wrote, and restart");
    addWord(*reset, "OPTION", typed.option, {"all", "all-but-id", "all-but-id-and-baud"},
            "all (the device then has ID 1 at 57600 bps), all-but-id or all-but-id-and-baud");
    addIds(*reset, typed);
    addYes(*reset, typed);
    reset->footer("Refused where somebody is at the place the device will have.");

    CLI::App *clear = app.add_subcommand("clear", "Bring the Present Position back into one turn, or clear errors");
    addWord(*clear, "WHAT", typed.option, {"position", "error"},
            "position (of several turns), or error (Y series only)");
    addIds(*clear, typed);

    typed.backup.describe(app);
    describeStop(app, typed);
}

void describePacket(CLI::App &app, Typed &typed)
{
    CLI::App *packet = app.add_subcommand("packet", "Send one packet and show what answers it");
    packet->add_option("WORD", typed.words, "INSTRUCTION and what belongs to it, see below")->type_name({});
    packet->add_option("--hex", typed.hex, "The packet's bytes, with or without CRC: \"FF FF FD 00 01 03 00 01\"")
        ->type_name("BYTES");
    packet->add_flag("--raw", typed.raw, "With --hex: send exactly these bytes, right or wrong");
    packet->add_option("--listen", typed.listen, "How long to wait for answers, in ms (until what is due has come)")
        ->type_name("MS")
        ->check(CLI::Range(0, 60'000).description({}));
    packet->footer("ping ID · read ID ADDRESS LENGTH · write|reg-write ID ADDRESS BYTE... · action|reboot ID ·\n"
                   "reset ID all|all-but-id|all-but-id-and-baud · clear ID position|error · backup ID store|restore ·\n"
                   "sync-read|fast-sync-read ADDRESS LENGTH ID... · bulk-read|fast-bulk-read ID:ADDRESS:LENGTH... ·\n"
                   "sync-write ADDRESS ID=BYTE,BYTE... · bulk-write ID:ADDRESS=BYTE,BYTE...\n"
                   "Numbers are decimal, or hexadecimal after 0x; the ID of everybody is 254. Nothing is checked "
                   "against a control table.");
}

} // namespace dynascope::dxl
