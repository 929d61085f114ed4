// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/faulttext.h"

#include "core/protocol/protocol_values.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dynascope::sim {
namespace {

using Fault = ReplyFault::Kind;

constexpr qsizetype LongestText = 4096;
constexpr std::size_t MostReplyFaults = 256;
constexpr int MostBytes = 1024; ///< in a packet
constexpr LineTime StrictGap = std::chrono::microseconds(1500);

tl::unexpected<Error> wrong(QStringView word, const QString &why)
{
    return failure(ErrorKind::InvalidArgument, QStringLiteral("\"%1\": %2").arg(word.toString(), why));
}

/// One word, taken apart.
struct Word {
    QStringView whole, name, value;
    std::vector<int> ids; ///< none: any
    double share = 1;
    int times = -1;
    bool hasValue = false;
};

std::optional<double> shareOf(QStringView text)
{
    bool ok = false;
    const bool percent = text.endsWith(u'%');
    const double share = (percent ? text.chopped(1) : text).toDouble(&ok) / (percent ? 100 : 1);
    return ok && share >= 0 && share <= 1 ? std::optional(share) : std::nullopt;
}

std::optional<int> wholeOf(QStringView text, int low, int high)
{
    bool ok = false;
    const int number = text.toInt(&ok);
    return ok && number >= low && number <= high ? std::optional(number) : std::nullopt;
}

/// "4,5" and "3-7".
std::optional<std::vector<int>> idsOf(QStringView text)
{
    std::vector<int> ids;
    for (const QStringView part : text.split(u',')) {
        const qsizetype dash = part.indexOf(u'-');
        const auto first = wholeOf(dash < 0 ? part : part.first(dash), 0, MaximumId);
        const auto last = dash < 0 ? first : wholeOf(part.sliced(dash + 1), 0, MaximumId);
        if (!first || !last || *last < *first)
            return std::nullopt;
        for (int id = *first; id <= *last; ++id)
            ids.push_back(id);
    }
    return ids;
}

const QString WrongIds = QStringLiteral("IDs are written 3 or 4,5 or 3-7, from 0 to %1").arg(MaximumId);
const QString WrongShare = QStringLiteral("a share is written 0.02 or 2%, from 0 to 1");

/// NAME[:IDS][=VALUE][@SHARE][*TIMES], from the end on.
Result<Word> takeApart(QStringView text)
{
    Word word;
    word.whole = text;
    if (const qsizetype star = text.lastIndexOf(u'*'); star >= 0) {
        const auto times = wholeOf(text.sliced(star + 1), 1, 1'000'000);
        if (!times)
            return wrong(word.whole, QStringLiteral("behind * stands how often it may happen, from 1 on"));
        word.times = *times;
        text = text.first(star);
    }
    if (const qsizetype at = text.lastIndexOf(u'@'); at >= 0) {
        const auto share = shareOf(text.sliced(at + 1));
        if (!share)
            return wrong(word.whole, WrongShare);
        word.share = *share;
        text = text.first(at);
    }
    if (const qsizetype equals = text.indexOf(u'='); equals >= 0) {
        word.value = text.sliced(equals + 1);
        word.hasValue = true;
        text = text.first(equals);
    }
    if (const qsizetype colon = text.indexOf(u':'); colon >= 0) {
        auto ids = idsOf(text.sliced(colon + 1));
        if (!ids)
            return wrong(word.whole, WrongIds);
        word.ids = std::move(*ids);
        text = text.first(colon);
    }
    word.name = text;
    return word;
}

/// How a word is written, from its help, and what a TIME in it looks like: nobody guesses that it needs a unit.
QString form(const char16_t *help)
{
    const QString form = QStringView(help).toString().section(u' ', 0, 0);
    const bool takesTime = form.contains(QStringLiteral("TIME"));
    return QStringLiteral("it is written %1%2").arg(form, takesTime ? QStringLiteral(", with 250us, 16ms or 1.5s as TIME") : QString());
}

/// What a fault of replies takes behind its '='.
enum class Takes { Share, Id, Number, Bytes, Time };
struct ReplyWord {
    const char16_t *name;
    Fault kind;
    Takes takes;
    const char16_t *help;
};
constexpr std::array ReplyWords{
    ReplyWord{u"drop", Fault::Lost, Takes::Share, u"drop[:IDS][=SHARE]        replies are lost: drop:3=0.02"},
    ReplyWord{u"damage", Fault::Damaged, Takes::Share, u"damage[:IDS][=SHARE]      a bit of a reply is turned"},
    ReplyWord{u"cut", Fault::Cut, Takes::Bytes,
              u"cut[:IDS][=BYTES]         of a reply only so many bytes come; any number of them without BYTES"},
    ReplyWord{u"late", Fault::Late, Takes::Time, u"late[:IDS]=TIME           replies come later: late=20ms@0.1"},
    ReplyWord{u"twice", Fault::Twice, Takes::Time,
              u"twice[:IDS]=TIME          replies come again, so long after their end"},
    ReplyWord{u"reboot", Fault::Reboot, Takes::Share,
              u"reboot[:IDS][=SHARE]      the device reboots instead of answering"},
    ReplyWord{u"wrong-id", Fault::WrongId, Takes::Id, u"wrong-id[:IDS]=ID         replies carry another ID"},
    ReplyWord{u"wrong-length", Fault::WrongLength, Takes::Number,
              u"wrong-length[:IDS]=BYTES  replies carry so many bytes of data more, or fewer (-2)"},
    ReplyWord{u"stray", Fault::StrayBefore, Takes::Id,
              u"stray[:IDS]=ID            a valid reply of another ID comes first"},
    ReplyWord{u"garbage", Fault::NoiseBefore, Takes::Bytes,
              u"garbage[:IDS]=BYTES       so many stray bytes come first"},
};

Result<void> addReplyFault(const Word &word, const ReplyWord &means, LineFaults &faults)
{
    ReplyFault fault{.kind = means.kind, .times = word.times, .share = word.share};
    bool good = true;
    const auto number = [&](int low, int high) {
        const auto value = wholeOf(word.value, low, high);
        good = value.has_value();
        return value.value_or(0);
    };
    switch (means.takes) {
    case Takes::Share:
        if (word.hasValue) {
            const auto share = shareOf(word.value);
            good = share.has_value();
            fault.share = share.value_or(0) * word.share;
        }
        break;
    case Takes::Id: fault.amount = number(0, MaximumId); break;
    case Takes::Number: fault.amount = number(-MostBytes, MostBytes); break;
    case Takes::Bytes: fault.amount = !word.hasValue && means.kind == Fault::Cut ? -1 : number(0, MostBytes); break;
    case Takes::Time: {
        const auto time = parseDuration(word.value);
        good = time.has_value();
        fault.time = time.value_or(LineTime{});
        break;
    }
    }
    if (!good)
        return wrong(word.whole, form(means.help));
    std::vector<int> ids = word.ids;
    if (ids.empty())
        ids.push_back(-1);
    if (faults.replies.size() + ids.size() > MostReplyFaults)
        return wrong(word.whole, QStringLiteral("more than %1 faults of replies").arg(MostReplyFaults));
    for (const int id : ids) {
        fault.id = id;
        faults.replies.push_back(fault);
    }
    return {};
}

using Apply = bool (*)(const Word &, LineFaults &); ///< false: its value makes no sense
struct LineWord {
    const char16_t *name;
    Apply apply;
    const char16_t *help;
};

bool setEcho(const Word &word, LineFaults &faults)
{
    faults.echo.on = true;
    const auto delay = word.hasValue ? parseDuration(word.value) : LineTime{};
    faults.echo.delay = delay.value_or(LineTime{});
    return delay.has_value();
}

bool setTime(const Word &word, LineTime &to)
{
    const auto time = parseDuration(word.value);
    to = time.value_or(to);
    return time.has_value();
}

bool setNoise(const Word &word, LineFaults &faults)
{
    bool ok = false;
    const QStringView text = word.value.endsWith(u"/s") ? word.value.chopped(2) : word.value;
    faults.noisePerSecond = text.toDouble(&ok);
    return ok && faults.noisePerSecond >= 0 && faults.noisePerSecond <= 100'000;
}

bool addIds(const Word &word, std::vector<int> &to)
{
    const auto ids = idsOf(word.value);
    if (ids)
        to.insert(to.end(), ids->begin(), ids->end());
    return ids && to.size() <= MostReplyFaults;
}

bool setPlace(const Word &word, std::optional<int> &to)
{
    to = wholeOf(word.value, 0, 1'000'000'000);
    return to.has_value();
}

bool onlyName(const Word &word) { return !word.hasValue; }

const std::array LineWords{
    LineWord{u"echo", setEcho, u"echo[=TIME]               the adapter returns what is sent, so much later"},
    LineWord{u"latency", [](const Word &w, LineFaults &f) { return setTime(w, f.latencyTimer); },
             u"latency=TIME              the adapter's timer holds what came: latency=16ms"},
    LineWord{u"jitter", [](const Word &w, LineFaults &f) { return setTime(w, f.replyJitter); },
             u"jitter=TIME               devices answer later by anything up to TIME"},
    LineWord{u"noise", setNoise, u"noise=N                   so many stray bytes a second between packets: noise=0.5"},
    LineWord{u"silent", [](const Word &w, LineFaults &f) { return addIds(w, f.silent); },
             u"silent=IDS                these devices hear and obey, but don't answer"},
    LineWord{u"dead-segment", [](const Word &w, LineFaults &f) { return addIds(w, f.deaf); },
             u"dead-segment=IDS          these devices are behind a broken cable: dead-segment=4,5"},
    LineWord{u"unplugged",
             [](const Word &w, LineFaults &f) {
                 f.unplugged = true;
                 return onlyName(w);
             },
             u"unplugged                 the adapter is out of its socket"},
    LineWord{u"unplug-sent", [](const Word &w, LineFaults &f) { return setPlace(w, f.unplugAtSent); },
             u"unplug-sent=N             it is pulled out after N bytes of requests"},
    LineWord{u"unplug-answered", [](const Word &w, LineFaults &f) { return setPlace(w, f.unplugAtAnswered); },
             u"unplug-answered=N         it is pulled out after N bytes of answers"},
    LineWord{u"strict-gaps",
             [](const Word &w, LineFaults &f) {
                 f.bridgedGap = StrictGap;
                 return onlyName(w);
             },
             u"strict-gaps               a request that pauses for more than 1.5 ms is lost; otherwise 20 ms, for busy hosts"},
};

QStringList faultNames()
{
    QStringList names;
    for (const LineWord &word : LineWords)
        names << QString::fromUtf16(word.name);
    for (const ReplyWord &word : ReplyWords)
        names << QString::fromUtf16(word.name);
    return names;
}

Result<void> apply(QStringView text, LineFaults &faults)
{
    const auto word = takeApart(text);
    if (!word)
        return tl::unexpected(word.error());
    const auto named = [&](const auto &one) { return word->name == one.name; };
    if (const auto reply = std::ranges::find_if(ReplyWords, named); reply != ReplyWords.end())
        return addReplyFault(*word, *reply, faults);
    const auto line = std::ranges::find_if(LineWords, named);
    if (line == LineWords.end())
        return wrong(text, QStringLiteral("no fault is called %1; there are %2")
                               .arg(word->name.toString(), faultNames().join(QStringLiteral(", "))));
    const bool plain = word->ids.empty() && word->times < 0 && word->share >= 1;
    if (!plain || !line->apply(*word, faults))
        return wrong(text, form(line->help));
    return {};
}

} // namespace

std::optional<LineTime> parseDuration(QStringView text)
{
    struct Unit {
        const char16_t *name;
        double nanoseconds;
    };
    constexpr std::array units{Unit{u"us", 1e3}, Unit{u"ms", 1e6}, Unit{u"s", 1e9}};
    constexpr double longest = 3600e9;
    for (const Unit &unit : units) {
        const QStringView name(unit.name);
        if (!text.endsWith(name))
            continue;
        bool ok = false;
        const double time = text.chopped(name.size()).trimmed().toDouble(&ok) * unit.nanoseconds;
        if (ok && time >= 0 && time <= longest)
            return LineTime(std::llround(time));
        return std::nullopt;
    }
    return std::nullopt;
}

Result<LineFaults> parseFaults(QStringView text, LineFaults faults)
{
    if (text.size() > LongestText)
        return failure(ErrorKind::InvalidArgument,
                       QStringLiteral("The faults take more than %1 characters").arg(LongestText));
    for (const QStringView word : text.split(u' ', Qt::SkipEmptyParts)) {
        if (const auto applied = apply(word, faults); !applied)
            return tl::unexpected(applied.error());
    }
    return faults;
}

QStringList faultHelp()
{
    QStringList lines;
    for (const LineWord &word : LineWords)
        lines.append(QString::fromUtf16(word.help));
    for (const ReplyWord &word : ReplyWords)
        lines.append(QString::fromUtf16(word.help));
    lines.append(QStringLiteral("Faults of replies also take @SHARE and, to happen so often only, *TIMES: cut=5@10%*3"));
    return lines;
}

} // namespace dynascope::sim
