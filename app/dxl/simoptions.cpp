// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/simoptions.h"

#include "app/dxl/arguments.h"
#include "core/sim/control.h"
#include "core/sim/faulttext.h"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace dynascope::dxl {
namespace {

QString joined(const std::vector<std::string> &words)
{
    QStringList list;
    for (const std::string &word : words)
        list.append(QString::fromStdString(word));
    return list.join(u' ');
}

std::string footer()
{
    QString text = QStringLiteral("Faults (--fault, and 'fault' of the control channel), separated by spaces:\n");
    for (const QString &line : sim::faultHelp())
        text += QStringLiteral("  ") + line + u'\n';
    text += QStringLiteral("dxl sim ctl PATH help lists what can be done to the bus while it runs.");
    return text.toStdString();
}

std::string controlFooter()
{
    QString text =
        QStringLiteral("COMMAND is one of these. WHO is an ID, ID@BAUD, #1 for the first device, its name, or all:\n");
    for (const QString &line : sim::Control::commandHelp())
        text += QStringLiteral("  ") + line + u'\n';
    return text.toStdString();
}

} // namespace

struct SimArguments::Typed {
    std::string devices, busFile, link, control, controlled;
    std::vector<std::string> faults;
    std::optional<std::uint64_t> seed;
    CLI::App *sim = nullptr, *ctl = nullptr;
};

SimArguments::SimArguments() : m_typed(std::make_unique<Typed>()) { }
SimArguments::~SimArguments() = default;

void SimArguments::describe(CLI::App &app)
{
    Typed &typed = *m_typed;
    CLI::App *sim = app.add_subcommand("sim", "Serve simulated devices on a pseudo-terminal until interrupted; its path "
                                              "is the first line of standard output");
    sim->add_option("--devices", typed.devices,
                    "MODEL[/FIRMWARE]@BAUD:ID, joined by commas; ID+ID2 for a model with two axes")
        ->type_name("LIST");
    sim->add_option("--bus", typed.busFile, "Or a YAML file that says more: names, registers, loads, faults")
        ->type_name("FILE");
    sim->add_option("--link", typed.link, "Also a symbolic link to the terminal")->type_name("PATH");
    sim->add_option("--fault", typed.faults, "What is wrong with the line, see below; several are joined")
        ->type_name("WORDS")
        ->take_all();
    sim->add_option("--seed", typed.seed, "Of everything that is left to chance (1): the same seed, the same bus")
        ->type_name("N");
    sim->add_option("--control", typed.control, "-: also take lines for the control channel from standard input, and "
                                                "answer on standard output")
        ->type_name("-");
    sim->footer(footer());
    sim->require_subcommand(0, 1);
    typed.sim = sim;
    typed.ctl = sim->add_subcommand("ctl", "Do something to a bus that is being served");
    typed.ctl->footer(controlFooter());
    typed.ctl->add_option("PATH", typed.controlled, "Its link or terminal")->required()->type_name({});
    typed.ctl->fallthrough(false)->prefix_command(); // what follows is the simulator's language: -0.3 is a torque, no option
}

Result<SimOptions> SimArguments::understand() const
{
    const Typed &typed = *m_typed;
    SimOptions options;
    options.devices = QString::fromStdString(typed.devices);
    options.busFile = QString::fromStdString(typed.busFile);
    options.link = QString::fromStdString(typed.link);
    options.faults = joined(typed.faults);
    options.seed = typed.seed;
    options.controlledByInput = typed.control == "-";
    options.isControl = typed.ctl && typed.ctl->parsed();
    if (options.isControl) {
        options.controlled = QString::fromStdString(typed.controlled);
        options.line = joined(typed.ctl->remaining());
        if (options.line.trimmed().isEmpty() || options.line.contains(u'\n'))
            return wrong(QStringLiteral("say what to do: dxl sim ctl PATH help lists what there is"));
        return options;
    }
    if (!typed.control.empty() && !options.controlledByInput)
        return wrong(QStringLiteral("--control takes -, for standard input"));
    if (options.devices.isEmpty() == options.busFile.isEmpty())
        return wrong(QStringLiteral("sim needs devices: --devices LIST or --bus FILE, one of them"));
    if (const auto faults = sim::parseFaults(options.faults); !faults)
        return wrong(QStringLiteral("--fault: ") + faults.error().text);
    return options;
}

} // namespace dynascope::dxl
