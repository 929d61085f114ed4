// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sim/simulatedbus.h"

#include <QByteArray>
#include <QJsonObject>
#include <QStringList>

#include <functional>

namespace dynascope::sim {

/// What people and scripts do to a simulated bus past its wire: a line of words in; out a line too: "ok", one JSON value,
/// or "error: " with a sentence. Lives on the bus's thread. `help` lists the commands.
class Control
{
public:
    static constexpr qsizetype LongestLine = 4096; ///< bytes; more is refused

    /// What the bus itself can't tell or do.
    struct Surroundings {
        std::function<QJsonObject()> status; ///< goes into the answer to `status`
        std::function<void()> quit;          ///< somebody asked for the end
    };
    explicit Control(Surroundings surroundings = {}, QStringList names = {}); ///< of the bus's servos, in their order

    /// Its commands, a line each: how one is written, and what it does.
    static QStringList commandHelp();

    /// `line` without its end. The bus has been advanced to `now`.
    QByteArray obey(const QByteArray &line, SimulatedBus &bus, LineTime now);

private:
    using Words = QList<QStringView>;
    struct Verb;
    struct Call {
        SimulatedBus &bus;
        LineTime now;
        Words words; ///< behind the command
        QStringView rest; ///< the same, as it was typed
    };
    using Answer = Result<QByteArray>; ///< empty: "ok"

    static std::span<const Verb> verbs();
    Answer help(const Call &call);
    Answer status(const Call &call);
    Answer truthOf(const Call &call);
    Answer fault(const Call &call);
    Answer plug(const Call &call);
    Answer unplug(const Call &call);
    Answer power(const Call &call);
    Answer supply(const Call &call);
    Answer temperature(const Call &call);
    Answer push(const Call &call);
    Answer hold(const Call &call);
    Answer release(const Call &call);
    Answer stops(const Call &call);
    Answer gravity(const Call &call);
    Answer inertia(const Call &call);
    Answer angle(const Call &call);
    Answer hardwareError(const Call &call);
    Answer write(const Call &call);
    Answer quit(const Call &call);

    Answer setPlugged(const Call &call, bool plugged);
    /// One number for each of the devices that the first word names.
    Answer eachWithNumber(const Call &call, QStringView unit, double low, double high,
                          const std::function<void(Servo &, double)> &set);
    /// "all", "#2" (the second), an ID, ID@BAUD, or a name.
    Result<std::vector<Servo *>> who(QStringView text, const SimulatedBus &bus) const;
    QString nameOf(std::size_t index) const;

    Surroundings m_around;
    QStringList m_names;
};

} // namespace dynascope::sim
