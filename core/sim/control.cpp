// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/control.h"

#include "core/protocol/protocol_values.h"
#include "core/sim/controlnumbers.h"
#include "core/sim/controlverbs.h"
#include "core/sim/faulttext.h"
#include "core/sim/truth.h"

#include <QJsonArray>
#include <QJsonDocument>

#include <algorithm>
#include <array>

namespace dynascope::sim {
namespace {

std::optional<bool> onOrOff(QStringView text)
{
    return text == u"on" ? std::optional(true) : text == u"off" ? std::optional(false) : std::nullopt;
}

QByteArray compact(const QJsonObject &object)
{
    return QJsonDocument(object).toJson(QJsonDocument::Compact);
}

} // namespace

struct Control::Verb {
    const char16_t *name;
    int fewest, most; ///< words behind it
    Answer (Control::*run)(const Call &);
    const char16_t *help;
};

std::span<const Control::Verb> Control::verbs()
{
    static constexpr int Many = 1000;
    static const std::array all{
        Verb{u"status", 0, 0, &Control::status, u"status: the port, the devices, the faults, and whether the wire's pace is kept"},
        Verb{u"truth", 0, 1, &Control::truthOf, u"truth [WHO]: registers and physical state as they really are"},
        Verb{u"fault", 0, Many, &Control::fault, u"fault WORDS: adds faults to the line, as --fault takes them; fault clear: none"},
        Verb{u"unplug", 1, 1, &Control::unplug, u"unplug WHO, unplug adapter: pulled out"},
        Verb{u"plug", 1, 1, &Control::plug, u"plug WHO, plug adapter: plugged in again"},
        Verb{u"power", 1, 2, &Control::power, u"power on|off [WHO]: of the bus, or of a device"},
        Verb{u"supply", 1, 2, &Control::supply, u"supply [WHO] VOLTS: its voltage"},
        Verb{u"temperature", 2, 2, &Control::temperature, u"temperature WHO DEGREES: around it, in degrees Celsius"},
        Verb{u"push", 2, 3, &Control::push, u"push WHO TORQUE [SECONDS]: a hand pushes, N m; without SECONDS until push WHO 0"},
        Verb{u"hold", 1, 2, &Control::hold, u"hold WHO [DEGREES]: a hand keeps the shaft where it is, or there"},
        Verb{u"release", 1, 1, &Control::release, u"release WHO: the hand lets go"},
        Verb{u"stops", 2, 3, &Control::stops, u"stops WHO LOWEST HIGHEST, stops WHO none: hard stops of the shaft, degrees"},
        Verb{u"gravity", 2, 2, &Control::gravity, u"gravity WHO TORQUE: of an arm when horizontal, N m"},
        Verb{u"inertia", 2, 2, &Control::inertia, u"inertia WHO VALUE: of what the shaft turns, kg m2"},
        Verb{u"angle", 2, 2, &Control::angle, u"angle WHO DEGREES: the shaft jumps there"},
        Verb{u"error", 2, 2, &Control::hardwareError, u"error WHO BITS: as if these bits of Hardware Error Status had happened"},
        Verb{u"write", 2, Many, &Control::write, u"write WHO REGISTER=VALUE: past the wire, raw, with all a Write's checks"},
        Verb{u"quit", 0, 0, &Control::quit, u"quit: ends the simulator"},
        Verb{u"help", 0, 1, &Control::help, u"help [COMMAND]"},
    };
    return all;
}

Control::Control(Surroundings surroundings, QStringList names)
    : m_around(std::move(surroundings))
    , m_names(std::move(names))
{
}

QStringList Control::commandHelp()
{
    QStringList lines;
    for (const Verb &verb : verbs())
        lines << QString::fromUtf16(verb.help);
    return lines;
}

QByteArray Control::obey(const QByteArray &line, SimulatedBus &bus, LineTime now)
{
    const QString text = QString::fromUtf8(line).trimmed();
    const auto run = [&]() -> Answer {
        if (line.size() > LongestLine)
            return wrong(QStringLiteral("A line has %1 bytes at most").arg(LongestLine));
        Words words = QStringView(text).split(u' ', Qt::SkipEmptyParts);
        if (words.isEmpty())
            return wrong(QStringLiteral("No command; help lists them"));
        const QStringView name = words.takeFirst();
        const auto all = verbs();
        const auto verb = std::ranges::find_if(all, [&](const Verb &one) { return name == one.name; });
        if (verb == all.end())
            return wrong(QStringLiteral("No command is called %1; help lists them").arg(name.toString()));
        if (words.size() < verb->fewest || words.size() > verb->most)
            return wrong(QString::fromUtf16(verb->help));
        return (this->*verb->run)({bus, now, words, QStringView(text).sliced(name.size()).trimmed()});
    };
    const Answer answer = run();
    if (!answer) {
        QByteArray sentence = answer.error().text.toUtf8();
        std::ranges::replace(sentence, '\n', ' ');
        return "error: " + sentence;
    }
    return answer->isEmpty() ? QByteArray("ok") : *answer;
}

QString Control::nameOf(std::size_t index) const
{
    return m_names.value(static_cast<qsizetype>(index));
}

Result<std::vector<Servo *>> Control::who(QStringView text, const SimulatedBus &bus) const
{
    std::vector<Servo *> found;
    const auto &servos = bus.servos();
    const QStringView id = text.indexOf(u'@') < 0 ? text : text.first(text.indexOf(u'@'));
    const QStringView baud = text.indexOf(u'@') < 0 ? QStringView() : text.sliced(text.indexOf(u'@') + 1);
    bool isId = false, isNumber = false;
    const int wantedId = id.toInt(&isId);
    const int number = text.startsWith(u'#') ? text.sliced(1).toInt(&isNumber) : 0;
    for (std::size_t i = 0; i < servos.size(); ++i) {
        const bool byId = isId && servos[i]->id() == wantedId
            && (baud.isNull() || QString::number(servos[i]->baudRate()) == baud);
        if (text == u"all" || byId || (isNumber && number == static_cast<int>(i) + 1)
            || (!text.isEmpty() && nameOf(i) == text))
            found.push_back(servos[i].get());
    }
    if (found.empty())
        return failure(ErrorKind::NotFound, QStringLiteral("No device is %1; a device is its ID, ID@BAUD, #1 for the "
                                                           "first, its name, or all").arg(text.toString()));
    if (found.size() > 1 && text != u"all")
        return wrong(QStringLiteral("%1 devices are %2: say ID@BAUD, or #1 for the first")
                         .arg(found.size()).arg(text.toString()));
    return found;
}

Control::Answer Control::help(const Call &call)
{
    QJsonArray lines;
    for (const Verb &verb : verbs()) {
        if (call.words.isEmpty() || call.words[0] == verb.name)
            lines.append(QString::fromUtf16(verb.help));
    }
    if (call.words.isEmpty() || call.words[0] == u"fault") {
        for (const QString &line : faultHelp())
            lines.append(line.simplified());
    }
    if (lines.isEmpty())
        return wrong(QStringLiteral("No command is called %1; help lists them").arg(call.words[0].toString()));
    return QJsonDocument(lines).toJson(QJsonDocument::Compact);
}

Control::Answer Control::status(const Call &call)
{
    QJsonObject status = m_around.status ? m_around.status() : QJsonObject();
    QJsonArray devices;
    for (std::size_t i = 0; i < call.bus.servos().size(); ++i) {
        const Servo &servo = *call.bus.servos()[i];
        QJsonObject device{{QStringLiteral("id"), servo.id()},
                           {QStringLiteral("baud"), servo.baudRate()},
                           {QStringLiteral("model"), servo.model()},
                           {QStringLiteral("deaf"), servo.isDeaf(call.now)}};
        if (!nameOf(i).isEmpty())
            device.insert(QStringLiteral("name"), nameOf(i));
        devices.append(device);
    }
    status.insert(QStringLiteral("devices"), devices);
    status.insert(QStringLiteral("unplugged"), call.bus.isUnplugged());
    LineFaults none;
    none.seed = call.bus.faults().seed;
    status.insert(QStringLiteral("faulty"), call.bus.faults() != none);
    return compact(status);
}

Control::Answer Control::truthOf(const Call &call)
{
    if (call.words.isEmpty() || call.words[0] == u"all")
        return compact(truth(call.bus));
    const auto found = who(call.words[0], call.bus);
    if (!found)
        return tl::unexpected(found.error());
    return compact(truth(*found->front()));
}

Control::Answer Control::fault(const Call &call)
{
    LineFaults faults = call.bus.faults();
    if (call.words.isEmpty())
        return wrong(QStringLiteral("Which? help fault lists them"));
    if (call.rest == u"clear") {
        const std::uint64_t seed = faults.seed;
        faults = {};
        faults.seed = seed;
    } else {
        auto read = parseFaults(call.rest, std::move(faults));
        if (!read)
            return tl::unexpected(read.error());
        faults = std::move(*read);
    }
    call.bus.setFaults(std::move(faults));
    return {};
}

Control::Answer Control::setPlugged(const Call &call, bool plugged)
{
    if (call.words[0] == u"adapter") {
        LineFaults faults = call.bus.faults();
        faults.unplugged = !plugged;
        faults.unplugAtSent.reset();
        faults.unplugAtAnswered.reset();
        call.bus.setFaults(std::move(faults));
        return {};
    }
    const auto found = who(call.words[0], call.bus);
    if (!found)
        return tl::unexpected(found.error());
    for (Servo *servo : *found)
        servo->setPlugged(plugged);
    return {};
}

Control::Answer Control::plug(const Call &call)
{
    return setPlugged(call, true);
}

Control::Answer Control::unplug(const Call &call)
{
    return setPlugged(call, false);
}

Control::Answer Control::power(const Call &call)
{
    const auto on = onOrOff(call.words[0]);
    if (!on)
        return wrong(QStringLiteral("power on or power off"));
    if (call.words.size() < 2) {
        verbs::setPower(call.bus, *on);
        return {};
    }
    const auto found = who(call.words[1], call.bus);
    if (!found)
        return tl::unexpected(found.error());
    for (Servo *servo : *found)
        servo->setPower(*on);
    return {};
}

Control::Answer Control::quit(const Call &)
{
    if (!m_around.quit)
        return failure(ErrorKind::NotSupported, QStringLiteral("This simulator ends otherwise"));
    m_around.quit();
    return {};
}

} // namespace dynascope::sim
