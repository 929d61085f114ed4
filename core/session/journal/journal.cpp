// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/journal/journal.h"

#include "core/session/journal/journalwrites.h"

#include <QRandomGenerator>
#include <QStandardPaths>

#include <algorithm>
#include <chrono>
#include <set>

namespace dynascope {
namespace {

using namespace std::chrono_literals;

constexpr auto DragPause = 1500ms;    ///< a goal written later than that is another order
constexpr qint64 LargestLeap = 1'000'000; ///< from one entry to the next
constexpr auto SaveInterval = 1000ms; ///< of a drag that goes on
constexpr auto SoonAgain = 20ms;      ///< another program takes less for its line
constexpr auto LaterAgain = 5000ms;   ///< what keeps the file from being written may pass
constexpr auto LongLocked = 1000ms;   ///< nobody needs it for so long
constexpr auto LastPatience = 300ms;  ///< at the end of the program

std::int64_t msecs(std::chrono::milliseconds time)
{
    return time.count();
}

bool isOneGoal(const JournalEntry &entry)
{
    return entry.kind == JournalKind::Write && !entry.changes.empty() && entry.undoes == 0 && entry.redoes == 0
           && isGoalName(entry.changes.front().name);
}

bool isSameRegister(const RegisterChange &one, const RegisterChange &other)
{
    return one.name == other.name && one.address == other.address && one.after.size() == other.after.size();
}

} // namespace

Journal::Journal(const QString &folder, Reading reading, const JournalFile::Bounds &bounds, QObject *parent)
    : QObject(parent)
    , m_now([] { return QDateTime::currentDateTimeUtc(); })
    , m_run(QString::number(QRandomGenerator::system()->generate64(), 36))
{
    if (!folder.isEmpty())
        m_file = std::make_unique<JournalFile>(folder, bounds);
    if (!folder.isEmpty()) {
        m_ahead = std::make_unique<JournalAheadFiles>(folder, m_run);
        m_over = m_ahead->left();
    }
    const bool isLeft = !m_over.paths.isEmpty(); // whether it was noted may be written anywhere
    if (m_file && reading == Reading::Newest && !isLeft)
        m_file->beginNearEnd(2 * LongestJournalLine);
    m_dragEnd.setSingleShot(true);
    m_dragEnd.setInterval(DragPause);
    connect(&m_dragEnd, &QTimer::timeout, this, &Journal::flush);
    m_retry.setSingleShot(true);
    connect(&m_retry, &QTimer::timeout, this, [this] { write(m_patience); });
    refresh();
    if (isLeft)
        write(m_patience);
}

Journal::~Journal()
{
    flush();
    if (m_ahead)
        m_over.paths += m_ahead->all().paths;
    if (!m_waiting.empty() || !m_over.paths.isEmpty())
        write(LastPatience);
}

QString Journal::usualFolder()
{
    const QString data = QStandardPaths::writableLocation(QStandardPaths::GenericDataLocation);
    return data.isEmpty() ? QString() : data + QStringLiteral("/dynascope/journal");
}

const JournalEntry *Journal::entry(qint64 number) const
{
    const auto at = std::ranges::lower_bound(m_entries, number, {}, &JournalEntry::number);
    return at == m_entries.end() || at->number != number ? nullptr : &*at;
}

JournalEntry *Journal::find(qint64 number)
{
    const auto at = std::ranges::lower_bound(m_entries, number, {}, &JournalEntry::number);
    return at == m_entries.end() || at->number != number ? nullptr : &*at;
}

void Journal::refresh()
{
    if (m_file && readOthers())
        emit entriesChanged();
}

void Journal::renumber(qint64 old, qint64 now)
{
    if (old == now)
        return;
    std::ranges::find(m_waiting, old, &Line::number)->number = now;
    if (auto drag = m_drags.extract(old); drag) {
        drag.key() = now;
        m_drags.insert(std::move(drag));
    }
    const auto given = std::ranges::find(m_renumbered, old, &std::pair<const qint64, qint64>::second);
    m_renumbered[given == m_renumbered.end() ? old : given->first] = now;
}

/// What no file holds yet stands aside meanwhile: others may have taken its numbers, and have written them.
bool Journal::readOthers()
{
    std::vector<JournalEntry> fresh;
    for (const Line &line : m_waiting) {
        const JournalEntry *known = line.isFresh ? entry(line.number) : nullptr;
        if (known)
            fresh.push_back(*known);
    }
    std::erase_if(m_entries, [&fresh](const JournalEntry &each) {
        return std::ranges::find(fresh, each.number, &JournalEntry::number) != fresh.end();
    });
    bool any = false;
    m_file->read([&](const QByteArray &line) {
        take(line);
        any = true;
    });
    std::map<qint64, qint64> now; ///< by what it was
    qint64 next = nextNumber();
    for (const JournalEntry &entry : fresh) {
        next = std::max(next, entry.number);
        now[entry.number] = next++;
    }
    const auto follow = [&now](qint64 &number) {
        const auto at = now.find(number);
        number = at == now.end() ? number : at->second;
    };
    for (auto each = now.rbegin(); each != now.rend(); ++each) // each to a place that is free by then
        renumber(each->first, each->second);
    for (JournalEntry &entry : fresh) {
        for (qint64 *number : {&entry.number, &entry.undoes, &entry.redoes})
            follow(*number);
        place(std::move(entry));
    }
    return any;
}

void Journal::take(const QByteArray &line)
{
    auto entry = journalEntryFromJson(line);
    if (!entry) // what is damaged says nothing
        return;
    const JournalEntry *known = entry->run == m_run ? find(entry->number) : nullptr;
    if (known && known->run == m_run) // our own line: what is in memory is newer
        return;
    // Numbers go up by ones: a leap is damage, and the next ones would soon be beyond what any reader takes.
    const qint64 last = m_entries.empty() ? LargestJournalNumber / 2 : m_entries.back().number;
    if (entry->number <= last + LargestLeap)
        place(std::move(*entry));
}

/// A later line of the same number replaces the earlier one.
void Journal::place(JournalEntry entry)
{
    const auto at = std::ranges::lower_bound(m_entries, entry.number, {}, &JournalEntry::number);
    if (at == m_entries.end() || at->number != entry.number) {
        m_entries.insert(at, std::move(entry));
        if (m_entries.size() > MostEntries)
            m_entries.pop_front();
    } else if (at->run == entry.run) {
        *at = std::move(entry);
    }
}

void Journal::store(JournalEntry &entry, bool isNew)
{
    if (isNew)
        entry.number = nextNumber();
    const qint64 given = entry.number;
    place(entry);
    if (!m_file)
        return;
    if (m_waiting.empty())
        m_waitingSince = m_now();
    if (std::ranges::find(m_waiting, given, &Line::number) == m_waiting.end())
        m_waiting.push_back({given, isNew});
    // Where it could not be written a moment ago, nobody waits for it again.
    if (m_problem.isEmpty() || m_triedAt.msecsTo(m_now()) >= msecs(LaterAgain))
        write(m_patience);
    entry.number = nowOf(given);
}

qint64 Journal::nowOf(qint64 number) const
{
    const auto now = m_renumbered.find(number);
    return now == m_renumbered.end() ? number : now->second;
}

/// What waits, under the lock. Nobody waits long for that: what can't be written now is tried again.
void Journal::write(std::chrono::milliseconds patience)
{
    m_triedAt = m_now();
    auto lock = m_file->lock(patience);
    if (lock) {
        if (readOthers())
            emit entriesChanged();
        m_over.paths += m_ahead->ended().paths;
        takeIn(m_over);
        writeWaiting();
        if (m_waiting.empty()) {
            JournalAheadFiles::remove(m_over);
            m_over = {};
        }
    } else if (lock.error().kind != ErrorKind::PortBusy || patience > 0ms
               || m_waitingSince.msecsTo(m_triedAt) >= msecs(LongLocked)) {
        complain(lock.error());
    }
    if (m_waiting.empty())
        m_problem.clear();
    else
        m_retry.start(m_problem.isEmpty() ? SoonAgain : LaterAgain);
}

/// What was about to be written and came no further: nobody will say what became of it.
void Journal::takeIn(const JournalAheadFiles::Over &over)
{
    if (over.paths.isEmpty())
        return;
    std::set<std::pair<QString, QString>> known;
    for (const JournalEntry &entry : m_entries) {
        if (!entry.ahead.isEmpty())
            known.insert({entry.run, entry.ahead});
    }
    JournalAheadFiles::read(over, [&](JournalEntry entry) {
        if (!known.insert({entry.run, entry.ahead}).second)
            return;
        entry.number = nextNumber();
        m_waiting.push_back({entry.number, true});
        place(std::move(entry));
        emit entriesChanged();
    });
}

void Journal::writeWaiting()
{
    std::size_t written = 0;
    for (const Line &line : m_waiting) {
        const JournalEntry *known = entry(line.number);
        const auto appended = known ? m_file->append(toJson(*known)) : Result<void>(); // of too many the oldest are gone
        if (!appended) {
            complain(appended.error());
            break;
        }
        ++written;
    }
    m_waiting.erase(m_waiting.begin(), m_waiting.begin() + static_cast<std::ptrdiff_t>(written));
}

/// Once, until it has been written again.
void Journal::complain(const Error &error)
{
    const bool isNew = m_problem.isEmpty();
    m_problem = error.text;
    if (isNew)
        emit failed(error.text);
}

bool Journal::isOpen(qint64 number) const
{
    const auto drag = m_drags.find(number);
    return drag != m_drags.end() && drag->second.at.msecsTo(m_now()) < msecs(DragPause);
}

/// Only the newest of a register can have nothing but drags behind it.
qint64 Journal::dragOf(const JournalDevice &device, const RegisterChange &change) const
{
    for (auto entry = m_entries.rbegin(); entry != m_entries.rend() && isOpen(entry->number); ++entry) {
        if (entry->device == device && isSameRegister(entry->changes.front(), change))
            return entry->movedTo ? 0 : entry->number;
    }
    return 0;
}

bool Journal::continues(const JournalDevice &device, const RegisterChange &change) const
{
    return dragOf(device, change) > 0;
}

void Journal::dropOldDrags()
{
    std::erase_if(m_drags, [this](const auto &drag) { return !drag.second.isUnsaved && !isOpen(drag.first); });
}

qint64 Journal::begin(JournalEntry entry)
{
    entry.run = m_run;
    entry.at = m_now();
    entry.state = JournalState::Begun;
    const bool isGoal = entry.ahead.isEmpty() && isOneGoal(entry); // each write of a job is an entry
    if (const qint64 number = isGoal ? dragOf(entry.device, entry.changes.front()) : 0; number > 0) {
        find(number)->changes.front().after = entry.changes.front().after;
        m_drags[number].isUnsaved = true;
        m_drags[number].at = entry.at;
        return number;
    }
    if (!isGoal) {
        flush();
        m_drags.clear();
    }
    dropOldDrags();
    store(entry, true);
    if (isGoal)
        m_drags[entry.number] = {entry.at, entry.at};
    emit entriesChanged();
    return entry.number;
}

void Journal::finish(qint64 number, const JournalEntry &outcome)
{
    number = nowOf(number);
    JournalEntry *known = find(number);
    if (!known)
        return;
    JournalEntry entry = *known;
    // Its first write has ended already: this is another one of the same drag, which may be over meanwhile.
    const bool isContinued = isOneGoal(entry) && known->state != JournalState::Begun;
    const auto drag = m_drags.find(number);
    const bool goesOn = drag != m_drags.end();
    entry.state = outcome.state;
    entry.movedTo = outcome.movedTo;
    entry.note = outcome.note;
    if (isContinued && outcome.state == JournalState::Failed) { // what was written before it stands
        entry.state = known->state;
        entry.changes.front().after =
            entry.changes.front().shown.empty() ? entry.changes.front().after : entry.changes.front().shown;
    } else if (isContinued) { // what was there at its beginning stays
        for (const RegisterChange &change : outcome.changes) {
            const auto same = std::ranges::find_if(
                entry.changes, [&](const RegisterChange &each) { return isSameRegister(each, change); });
            if (same == entry.changes.end()) {
                entry.changes.push_back(change);
                continue;
            }
            same->after = change.after;
            same->shown = change.shown;
        }
    } else {
        entry.changes = outcome.changes;
    }
    const QDateTime now = m_now();
    if (goesOn)
        drag->second.at = now;
    if (isContinued && goesOn && drag->second.saved.msecsTo(now) < msecs(SaveInterval)) {
        place(entry);
        drag->second.isUnsaved = true;
        m_dragEnd.start();
    } else {
        if (goesOn) {
            drag->second.saved = now;
            drag->second.isUnsaved = false;
        }
        store(entry, false);
    }
    emit entriesChanged();
    emit ended(number);
}

void Journal::flush()
{
    m_dragEnd.stop();
    std::vector<qint64> numbers;
    for (auto &[number, drag] : m_drags) {
        if (std::exchange(drag.isUnsaved, false))
            numbers.push_back(number);
    }
    for (const qint64 number : numbers) {
        if (const JournalEntry *drag = entry(number)) {
            JournalEntry copy = *drag;
            store(copy, false);
        }
    }
}

} // namespace dynascope
