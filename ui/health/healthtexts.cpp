// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/health/healthtexts.h"

#include "ui/common/texts.h"

#include <QCoreApplication>

namespace dynascope {
namespace {

/// The context of what is translated here.
class HealthTexts
{
    Q_DECLARE_TR_FUNCTIONS(HealthTexts)
};

/// Nobody needs the last digit of many.
QString compact(quint64 number)
{
    if (number < 1'000'000)
        return grouped(number);
    if (number < 1'000'000'000)
        return HealthTexts::tr("%1 k").arg(grouped(number / 1000));
    return HealthTexts::tr("%1 M").arg(grouped(number / 1'000'000));
}

QString percent(double share)
{
    return HealthTexts::tr("%1 %").arg(100 * share, 0, 'f', 2);
}

QString none()
{
    return QStringLiteral("–");
}

QString milliseconds(const DurationCounts &durations, double part)
{
    if (durations.count() == 0)
        return none();
    const double value = std::chrono::duration<double, std::milli>(durations.percentile(part)).count();
    return QString::number(value, 'f', value < 100 ? 2 : 0);
}

QString who(const HealthRow &row)
{
    return row.isLine() ? HealthTexts::tr("The line")
                        : HealthTexts::tr("%1, ID %2").arg(row.name).arg(row.quality.id);
}

QString badHelp(const HealthRow &row)
{
    const DeviceQuality &quality = row.quality;
    const auto fault = mainFault(quality);
    if (row.onlyPing) {
        return HealthTexts::tr("%1 answers Ping but no Read, as a Status Return Level of 0 tells a device to; that "
                               "says nothing against power, plugs or cable.")
            .arg(who(row));
    }
    if (quality.asked() == 0)
        return HealthTexts::tr("%1: nothing has been asked since counting began.").arg(who(row));
    if (!fault)
        return HealthTexts::tr("%1: all %2 answers were good.").arg(who(row), grouped(quality.asked()));
    return HealthTexts::tr("%1: %2 of %3 answers were bad, mostly “%4”. %5")
        .arg(who(row), grouped(quality.bad()), grouped(quality.asked()), faultName(*fault), usualCauses(*fault));
}

} // namespace

std::optional<AnswerFault> faultOf(HealthColumn column)
{
    switch (column) {
    case HealthColumn::Missing: return AnswerFault::Missing;
    case HealthColumn::CutOff: return AnswerFault::CutOff;
    case HealthColumn::Damaged: return AnswerFault::Damaged;
    case HealthColumn::WrongLength: return AnswerFault::WrongLength;
    case HealthColumn::Late: return AnswerFault::Late;
    default: return std::nullopt;
    }
}

QString healthHeading(HealthColumn column)
{
    if (const auto fault = faultOf(column))
        return faultName(*fault);
    switch (column) {
    case HealthColumn::Name: return HealthTexts::tr("Device");
    case HealthColumn::Id: return HealthTexts::tr("ID");
    case HealthColumn::Bad: return HealthTexts::tr("Bad answers");
    case HealthColumn::Good: return HealthTexts::tr("Good");
    case HealthColumn::Retries: return HealthTexts::tr("Retries");
    case HealthColumn::Median: return HealthTexts::tr("p50 ms");
    case HealthColumn::Slow: return HealthTexts::tr("p99 ms");
    case HealthColumn::Rate: return HealthTexts::tr("Bytes/s");
    default: return {};
    }
}

QString healthCell(const HealthRow &row, HealthColumn column)
{
    const DeviceQuality &quality = row.quality;
    if (const auto fault = faultOf(column))
        return compact(countOf(quality, *fault));
    switch (column) {
    case HealthColumn::Name: return row.isLine() ? HealthTexts::tr("Whole line") : row.name;
    case HealthColumn::Id: return row.isLine() ? QString() : QString::number(quality.id);
    case HealthColumn::Bad: return quality.asked() > 0 ? percent(quality.badShare()) : none();
    case HealthColumn::Good: return compact(quality.good);
    case HealthColumn::Retries: return compact(quality.retries);
    case HealthColumn::Median: return milliseconds(quality.responses, 0.5);
    case HealthColumn::Slow: return milliseconds(quality.responses, 0.99);
    case HealthColumn::Rate: return grouped(static_cast<quint64>(qRound64(row.bytesPerSecond)));
    default: return {};
    }
}

QString widestHealthCell(HealthColumn column)
{
    switch (column) {
    case HealthColumn::Id: return QStringLiteral("252");
    case HealthColumn::Bad: return percent(1);
    case HealthColumn::Good: return grouped(100'000) + QStringLiteral(" k");
    case HealthColumn::Median:
    case HealthColumn::Slow: return QStringLiteral("00.00");
    case HealthColumn::Rate: return grouped(100'000);
    default: return grouped(10'000);
    }
}

QString verdictText(Verdict verdict)
{
    switch (verdict) {
    case Verdict::Bad: return HealthTexts::tr("bad");
    case Verdict::Poor: return HealthTexts::tr("poor");
    case Verdict::Good: return HealthTexts::tr("good");
    case Verdict::Unknown: break;
    }
    return HealthTexts::tr("not asked");
}

QString healthHelp(HealthColumn column)
{
    if (const auto fault = faultOf(column))
        return QStringLiteral("%1: %2 %3").arg(faultName(*fault), faultMeaning(*fault), usualCauses(*fault));
    switch (column) {
    case HealthColumn::Name:
    case HealthColumn::Id: return HealthTexts::tr("The devices at the line's baud rate, the worst first.");
    case HealthColumn::Bad:
        return HealthTexts::tr("Share of bad answers among all that were asked for. The bar is logarithmic, with marks "
                               "at 0.1 %, from where on a cable is poor, and at 1 %, from where on it is bad.");
    case HealthColumn::Good:
        return HealthTexts::tr("Answers that came whole and in time. A refusal is one: the wire did its part.");
    case HealthColumn::Retries: return HealthTexts::tr("Requests sent again because the answer was bad.");
    case HealthColumn::Median:
        return HealthTexts::tr("Half of the answers had come so long after the end of the request, those before it in "
                               "a group read included. For the line: whole exchanges.");
    case HealthColumn::Slow:
        return HealthTexts::tr("99 of 100 answers had come so long after the end of the request. Much more than p50: "
                               "the adapter's latency timer, a USB hub, or a computer with too much to do.");
    case HealthColumn::Rate: return HealthTexts::tr("Bytes of good answers a second, now.");
    default: return {};
    }
}

QString healthHelp(const HealthRow &row, HealthColumn column)
{
    if (const auto fault = faultOf(column); fault && !(row.onlyPing && *fault == AnswerFault::Missing)) {
        return HealthTexts::tr("%1, %2: %3 of %4 answers. %5 %6")
            .arg(who(row), faultName(*fault), grouped(countOf(row.quality, *fault)), grouped(row.quality.asked()),
                 faultMeaning(*fault), usualCauses(*fault));
    }
    if (!faultOf(column) && column != HealthColumn::Name && column != HealthColumn::Id && column != HealthColumn::Bad)
        return healthHelp(column);
    QString text = badHelp(row);
    if (row.strays > 0)
        text += HealthTexts::tr(" %1 packets came that nobody asked for.").arg(grouped(row.strays));
    return text;
}

} // namespace dynascope
