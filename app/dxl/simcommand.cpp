// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/commands.h"
#include "app/dxl/interrupt.h"
#include "core/sim/busplan.h"
#include "core/sim/controlchannel.h"
#include "core/sim/faulttext.h"
#include "core/yaml/yamltree.h"

#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>

#include <cstdio>

namespace dynascope::dxl {
namespace {

constexpr int StandardInput = 0, StandardOutput = 1;

Result<sim::BusPlan> planOf(const SimOptions &options, const Catalog &catalog)
{
    if (options.busFile.isEmpty()) {
        const auto specs = sim::parseServoSpecs(options.devices, catalog);
        return specs ? Result<sim::BusPlan>(sim::planOf(*specs)) : tl::unexpected(specs.error());
    }
    QFile file(options.busFile);
    if (!file.open(QIODevice::ReadOnly))
        return failure(ErrorKind::BadFile, QStringLiteral("%1: %2").arg(options.busFile, file.errorString()));
    return sim::readBusPlan(file.read(MaximumYamlSize + 1), options.busFile, catalog);
}

/// What the command line says on top of the plan.
Result<void> complete(sim::BusPlan &plan, const SimOptions &options)
{
    if (options.seed)
        plan.seed = options.seed;
    auto faults = sim::parseFaults(options.faults, plan.faults);
    if (!faults)
        return tl::unexpected(faults.error());
    plan.faults = std::move(*faults);
    return {};
}

/// Help is a list of lines for people; what else is answered goes out as it came, for programs.
QByteArray readable(const QByteArray &answer)
{
    const QJsonDocument document = QJsonDocument::fromJson(answer);
    if (!document.isArray())
        return answer;
    QStringList lines;
    for (const QJsonValue &line : document.array())
        lines << line.toString();
    return lines.join(u'\n').toUtf8();
}

ExitCode control(const SimOptions &options, bool json, Output &output)
{
    const auto answer = sim::askControl(options.controlled, options.line.toUtf8());
    if (!answer)
        return output.fail(answer.error());
    const QByteArray refused = "error: ";
    if (answer->startsWith(refused))
        return output.refuse({ErrorKind::InvalidArgument, QString::fromUtf8(answer->mid(refused.size()))});
    output.line(json ? *answer : readable(*answer));
    return ExitCode::Done;
}

void warn(const QString &text)
{
    std::fprintf(stderr, "dxl: %s\n", qUtf8Printable(text));
}

} // namespace

ExitCode simCommand(const Catalog &catalog, const Options &all, Output &output)
{
    const SimOptions &options = all.sim;
    if (options.isControl)
        return control(options, all.json, output);
    Interrupt interrupt; // before the server's thread begins
    auto plan = planOf(options, catalog);
    if (!plan)
        return output.refuse(plan.error());
    if (const auto good = complete(*plan, options); !good)
        return output.refuse(good.error());
    auto bus = sim::makeBus(*plan, catalog);
    if (!bus)
        return output.refuse(bus.error());
    // Before the link: one that another simulator serves is left to it.
    std::unique_ptr<sim::ControlSocket> socket;
    if (!options.link.isEmpty()) {
        auto listening = sim::ControlSocket::listen(sim::controlSocketPath(options.link));
        if (!listening)
            return output.fail(listening.error());
        socket = std::move(*listening);
    }
    const auto server = sim::PtyServer::start(std::move(*bus), options.link, {}, warn);
    if (!server)
        return output.fail(server.error());
    const QString path = (*server)->path();
    if (!socket) {
        if (auto listening = sim::ControlSocket::listen(sim::controlSocketPath(path)))
            socket = std::move(*listening);
        else
            warn(listening.error().text); // the bus is served all the same
    }
    std::printf("%s\n", qUtf8Printable(path));
    std::fflush(stdout);
    const int input = options.controlledByInput ? StandardInput : -1;
    const auto channel = sim::ControlChannel::start(
        **server, {std::move(socket), input, StandardOutput, sim::namesOf(*plan), &Interrupt::request});
    if (!channel)
        return output.fail(channel.error());
    interrupt.wait();
    return ExitCode::Done;
}

} // namespace dynascope::dxl
