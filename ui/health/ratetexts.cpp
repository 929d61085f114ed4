// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/health/ratetexts.h"

#include "ui/common/texts.h"

#include <QCoreApplication>

namespace dynascope {
namespace {

struct RateTexts {
    Q_DECLARE_TR_FUNCTIONS(RateTexts)
};

using What = RateLimit::What;

QString countText(const std::vector<std::uint8_t> &devices)
{
    if (devices.size() == 1)
        return RateTexts::tr("device %1").arg(devices.front());
    return RateTexts::tr("%1 devices").arg(devices.size());
}

} // namespace

QString hertzText(double hertz)
{
    const int decimals = hertz >= 99.5 ? 0 : hertz >= 0.95 ? 1 : 2;
    return RateTexts::tr("%1 Hz").arg(QString::number(hertz, 'f', decimals));
}

QString intervalText(std::chrono::milliseconds interval)
{
    if (interval.count() == 0)
        return RateTexts::tr("as often as it goes");
    if (interval.count() > 1000)
        return RateTexts::tr("each %1 s").arg(QString::number(static_cast<double>(interval.count()) / 1000, 'g', 3));
    const double hertz = 1000.0 / static_cast<double>(interval.count());
    return RateTexts::tr("%1 Hz").arg(QString::number(hertz, 'g', 3));
}

QString limitName(const RateLimit &limit, int baudRate)
{
    switch (limit.what) {
    case What::Baud: return RateTexts::tr("Bytes at %1").arg(baudText(baudRate));
    case What::ReturnDelay: return RateTexts::tr("Return Delay Time of %1").arg(countText(limit.devices));
    case What::LatencyTimer: return RateTexts::tr("Adapter and computer");
    case What::PlainReads: return RateTexts::tr("Fast reads are off");
    case What::SilentDevice: return RateTexts::tr("Silence of %1").arg(countText(limit.devices));
    case What::Devices: return RateTexts::tr("Devices, until they answer");
    case What::Nothing: break;
    }
    return RateTexts::tr("Nothing");
}

QString limitHelp(const RateLimit &limit, int baudRate)
{
    switch (limit.what) {
    case What::Baud:
        return RateTexts::tr(
                   "Time in which the wire carries requests and answers at %1. A higher baud rate of all devices "
                   "makes it shorter, and so do fewer registers.")
            .arg(baudText(baudRate));
    case What::ReturnDelay:
        return RateTexts::tr(
            "So long each device waits before it answers, by a register in its EEPROM: 500 µs as it comes. "
            "With 0 it answers at once, which every usual adapter can take.");
    case What::LatencyTimer:
        return RateTexts::tr(
            "What the adapter holds answers back, and what this computer takes to notice them. USB adapters "
            "of the usual kind hold back for 16 ms unless they are told not to.");
    case What::PlainReads:
        return RateTexts::tr(
            "One packet with the values of all devices is shorter than one of each, and only the first "
            "device's Return Delay Time counts.");
    case What::SilentDevice:
        return RateTexts::tr("A device that doesn't answer is asked now and then whether it is back, and waited for.");
    case What::Devices: return RateTexts::tr("About 0.1 ms an answer, which nothing makes shorter.");
    case What::Nothing: break;
    }
    return RateTexts::tr("All that is wanted comes as often as it is wanted.");
}

QString remedyText(const RateLimit &limit)
{
    if (!limit.hasRemedy)
        return {};
    switch (limit.what) {
    case What::ReturnDelay: return RateTexts::tr("Set it to 0…");
    case What::LatencyTimer: return RateTexts::tr("Low latency");
    case What::PlainReads: return RateTexts::tr("Turn on");
    default: return {};
    }
}

QString gainText(const RateLimit &limit, double now)
{
    if (!limit.hasRemedy || now <= 0 || limit.rateWithout <= now)
        return {};
    return RateTexts::tr("then %1").arg(hertzText(limit.rateWithout));
}

} // namespace dynascope
