// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/faultmatrix.h"

#include <QStringList>

#include <algorithm>

namespace faultmatrix {
namespace {

constexpr std::uint16_t GoalPwm = 100, ProfileAcceleration = 108, ProfileVelocity = 112;

bool isFast(Kind kind)
{
    return kind == Kind::FastSyncRead || kind == Kind::FastBulkRead;
}

const std::vector<std::pair<QString, std::vector<Kind>>> &groups()
{
    static const std::vector<std::pair<QString, std::vector<Kind>>> all = [] {
        std::vector<std::pair<QString, std::vector<Kind>>> made;
        for (int i = 0; i < KindCount; ++i)
            made.push_back({nameOf(static_cast<Kind>(i)), {static_cast<Kind>(i)}});
        const std::vector<Kind> idempotent{Kind::Ping, Kind::Read, Kind::Write};
        const std::vector<Kind> commands{Kind::RegWrite, Kind::Action, Kind::FactoryReset,
                                         Kind::Reboot,   Kind::Clear,  Kind::Backup};
        std::vector<Kind> unicast = idempotent;
        unicast.insert(unicast.end(), commands.begin(), commands.end());
        std::vector<Kind> everything;
        for (int i = 0; i < KindCount; ++i)
            everything.push_back(static_cast<Kind>(i));
        made.push_back({QStringLiteral("idempotent"), idempotent});
        made.push_back({QStringLiteral("commands"), commands});
        made.push_back({QStringLiteral("unicast"), unicast});
        made.push_back({QStringLiteral("chained"), {Kind::SyncRead, Kind::BulkRead}});
        made.push_back({QStringLiteral("fast"), {Kind::FastSyncRead, Kind::FastBulkRead}});
        made.push_back({QStringLiteral("unanswered"), {Kind::SyncWrite, Kind::BulkWrite}});
        made.push_back({QStringLiteral("all"), everything});
        return made;
    }();
    return all;
}

} // namespace

Bytes dataOf(std::int64_t value, int size)
{
    Bytes bytes;
    appendLittleEndian(bytes, static_cast<std::uint32_t>(value), size);
    return bytes;
}

bool isGroupRead(Kind kind)
{
    return kind >= Kind::SyncRead && kind <= Kind::FastBulkRead;
}

Span bulkSpan(int id)
{
    static const Span spans[] = {{1, ProfileVelocity, 4}, {2, ProfileAcceleration, 4}, {3, GoalPwm, 2}};
    return spans[id - 1];
}

Request requestOf(Kind kind, int target)
{
    const auto id = static_cast<std::uint8_t>(target);
    const std::vector<std::uint8_t> ids{1, 2, 3};
    const std::vector<Span> spans{bulkSpan(1), bulkSpan(2), bulkSpan(3)};
    const SpanData write{id, ProfileVelocity, dataOf(WrittenValue, 4)};
    std::vector<SpanData> sync, bulk;
    for (const Span &span : spans) {
        sync.push_back({span.id, ProfileVelocity, dataOf(WrittenValue, 4)});
        bulk.push_back({span.id, span.address, dataOf(WrittenValue, span.length)});
    }
    switch (kind) {
    case Kind::Ping: return pingRequest(id);
    case Kind::BroadcastPing: return pingRequest(BroadcastId);
    case Kind::Read: return readRequest({id, ProfileVelocity, 4});
    case Kind::Write: return writeRequest(write);
    case Kind::RegWrite: return regWriteRequest(write);
    case Kind::Action: return actionRequest(id);
    case Kind::FactoryReset: return factoryResetRequest(id, ResetOption::AllButIdAndBaud);
    case Kind::Reboot: return rebootRequest(id);
    case Kind::Clear: return clearRequest(id, ClearOption::Position);
    case Kind::Backup: return backupRequest(id, BackupOption::Store);
    case Kind::SyncRead: return syncReadRequest(ProfileVelocity, 4, ids, false);
    case Kind::FastSyncRead: return syncReadRequest(ProfileVelocity, 4, ids, true);
    case Kind::BulkRead: return bulkReadRequest(spans, false);
    case Kind::FastBulkRead: return bulkReadRequest(spans, true);
    case Kind::SyncWrite: return syncWriteRequest(sync);
    case Kind::BulkWrite: return bulkWriteRequest(bulk);
    }
    return {};
}

QString nameOf(Kind kind)
{
    static const QStringList names{
        QStringLiteral("Ping"),           QStringLiteral("Broadcast Ping"), QStringLiteral("Read"),
        QStringLiteral("Write"),          QStringLiteral("Reg Write"),      QStringLiteral("Action"),
        QStringLiteral("Factory Reset"),  QStringLiteral("Reboot"),         QStringLiteral("Clear"),
        QStringLiteral("Backup"),         QStringLiteral("Sync Read"),      QStringLiteral("Bulk Read"),
        QStringLiteral("Fast Sync Read"), QStringLiteral("Fast Bulk Read"), QStringLiteral("Sync Write"),
        QStringLiteral("Bulk Write")};
    return names.at(static_cast<int>(kind));
}

std::vector<Kind> kindsOf(const char *requests)
{
    std::vector<Kind> kinds;
    for (const QString &name : QString::fromLatin1(requests).split(QStringLiteral(", "))) {
        const auto group = std::ranges::find(groups(), name, &std::pair<QString, std::vector<Kind>>::first);
        if (group == groups().end())
            qFatal("no request \"%s\"", qPrintable(name));
        kinds.insert(kinds.end(), group->second.begin(), group->second.end());
    }
    return kinds;
}

std::size_t replySize(Kind kind, int target)
{
    const std::size_t length = kind == Kind::BulkRead || kind == Kind::FastBulkRead ? bulkSpan(target).length : 4;
    if (isFast(kind))
        return 4 + length + (target == 1 ? 8 : 0);
    if (isGroupRead(kind) || kind == Kind::Read)
        return 11 + length;
    if (kind == Kind::Ping || kind == Kind::BroadcastPing)
        return 11 + 3;
    return kind == Kind::SyncWrite || kind == Kind::BulkWrite ? 0 : 11;
}

std::size_t allRepliesSize(Kind kind, int target)
{
    if (isGroupRead(kind) || kind == Kind::BroadcastPing)
        return replySize(kind, 1) + replySize(kind, 2) + replySize(kind, 3);
    return replySize(kind, target);
}

std::size_t requestSize(Kind kind, int target)
{
    return encode(requestOf(kind, target).packet).size();
}

} // namespace faultmatrix
