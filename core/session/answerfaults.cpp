// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/answerfaults.h"

#include <QCoreApplication>

#include <cmath>

namespace dynascope {
namespace {

constexpr double PoorShare = 0.001;
constexpr double BadShare = 0.01;
constexpr quint64 Accidents = 2;

/// The context of what is translated here.
class AnswerFaults
{
    Q_DECLARE_TR_FUNCTIONS(AnswerFaults)
};

} // namespace

quint64 countOf(const DeviceQuality &quality, AnswerFault fault)
{
    switch (fault) {
    case AnswerFault::Missing: return quality.timeouts - quality.cutOff;
    case AnswerFault::CutOff: return quality.cutOff;
    case AnswerFault::Damaged: return quality.crcErrors;
    case AnswerFault::WrongLength: return quality.lengthErrors;
    case AnswerFault::Late: return quality.lateAnswers;
    }
    return 0;
}

std::optional<AnswerFault> mainFault(const DeviceQuality &quality)
{
    std::optional<AnswerFault> most;
    for (const AnswerFault fault : AllAnswerFaults) {
        if (countOf(quality, fault) > (most ? countOf(quality, *most) : 0))
            most = fault;
    }
    return most;
}

QString faultName(AnswerFault fault)
{
    switch (fault) {
    case AnswerFault::Missing: return AnswerFaults::tr("Timeouts");
    case AnswerFault::CutOff: return AnswerFaults::tr("Cut off");
    case AnswerFault::Damaged: return AnswerFaults::tr("CRC");
    case AnswerFault::WrongLength: return AnswerFaults::tr("Length");
    case AnswerFault::Late: return AnswerFaults::tr("Late");
    }
    return {};
}

QString faultMeaning(AnswerFault fault)
{
    switch (fault) {
    case AnswerFault::Missing: return AnswerFaults::tr("No answer of this device came in time.");
    case AnswerFault::CutOff: return AnswerFaults::tr("An answer began and then fell silent.");
    case AnswerFault::Damaged: return AnswerFaults::tr("The checksum found bytes of the answer changed.");
    case AnswerFault::WrongLength: return AnswerFaults::tr("The answer was valid, but not as long as asked for.");
    case AnswerFault::Late:
        return AnswerFaults::tr("The answer came after its time, or could not be told from one that did.");
    }
    return {};
}

QString usualCauses(AnswerFault fault)
{
    switch (fault) {
    case AnswerFault::Missing:
        return AnswerFaults::tr("Usually the device has no power, another ID or baud rate, or the chain is broken "
                                "before it; now and then only: a loose plug, or a voltage that drops under load.");
    case AnswerFault::CutOff:
        return AnswerFaults::tr("Usually a loose plug, a device that restarts because its voltage drops, or an "
                                "adapter that loses bytes.");
    case AnswerFault::Damaged:
        return AnswerFaults::tr("Usually noise, a loose or long cable, wrong termination, or two devices that share "
                                "one ID and talk at once.");
    case AnswerFault::WrongLength:
        return AnswerFaults::tr("Usually two devices that share one ID, or another program that uses the line, too.");
    case AnswerFault::Late:
        return AnswerFaults::tr("Usually the adapter's latency timer (16 ms where nobody changed it), a USB hub, or "
                                "a computer with too much to do.");
    }
    return {};
}

Verdict verdictOn(const DeviceQuality &quality)
{
    if (quality.asked() == 0)
        return Verdict::Unknown;
    if (quality.badShare() >= BadShare && quality.bad() > Accidents)
        return Verdict::Bad;
    return quality.badShare() >= PoorShare ? Verdict::Poor : Verdict::Good;
}

std::pair<Verdict, long long> badness(const DeviceQuality &quality)
{
    return {verdictOn(quality), std::llround(quality.badShare() * 1e4)};
}

} // namespace dynascope
