// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/journal/journal.h"

#include "core/session/journal/journalwrites.h"

#include <QRandomGenerator>
#include <QStandardPaths>

#include <algorithm>
#include <chrono>

namespace dynascope {
namespace {

using namespace std::chrono_literals;

constexpr auto DragPause = 1500ms;    ///< a goal written later than that is another order
constexpr qint64 LargestLeap = 1'000'000; ///< from one entry to the next
constexpr auto SaveInterval = 1000ms; ///< of a drag that goes on

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
    if (m_file && reading == Reading::Newest)
        m_file->beginNearEnd(2 * LongestJournalLine);
    m_dragEnd.setSingleShot(true);
    m_dragEnd.setInterval(DragPause);
    connect(&m_dragEnd, &QTimer::timeout, this, &Journal::flush);
    refresh();
}

Journal::~Journal()
{
    flush();
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
    if (!m_file)
        return;
    bool any = false;
    m_file->read([&](const QByteArray &line) {
        take(line);
        any = true;
    });
    if (any)
        emit entriesChanged();
}

void Journal::take(const QByteArray &line)
{
    auto entry = journalEntryFromJson(line);
    if (!entry) // what is damaged says nothing
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
    std::unique_ptr<QLockFile> lock;
    if (m_file && m_problem.isEmpty()) {
        auto held = m_file->lock();
        if (held)
            lock = std::move(*held);
        else
            complain(held.error());
    }
    if (lock)
        m_file->read([this](const QByteArray &line) { take(line); }); // others' numbers
    if (isNew)
        entry.number = nextNumber();
    place(entry);
    if (lock) {
        if (const auto written = m_file->append(toJson(entry)); !written)
            complain(written.error());
    }
}

void Journal::complain(const Error &error)
{
    m_problem = error.text;
    emit failed(error.text);
}

bool Journal::continues(const JournalDevice &device, const RegisterChange &change) const
{
    const JournalEntry *drag = m_drag > 0 ? entry(m_drag) : nullptr;
    return drag && drag == &m_entries.back() && drag->device == device && !drag->movedTo
           && isSameRegister(drag->changes.front(), change)
           && m_dragAt.msecsTo(m_now()) < std::chrono::milliseconds(DragPause).count();
}

qint64 Journal::begin(JournalEntry entry)
{
    entry.run = m_run;
    entry.at = m_now();
    entry.state = JournalState::Begun;
    if (isOneGoal(entry)) {
        if (continues(entry.device, entry.changes.front())) {
            JournalEntry &drag = *find(m_drag);
            drag.changes.front().after = entry.changes.front().after;
            m_dragUnsaved = true;
            m_dragAt = entry.at;
            return m_drag;
        }
    }
    flush();
    m_drag = 0;
    store(entry, true);
    if (isOneGoal(entry)) {
        m_drag = entry.number;
        m_dragAt = m_dragSaved = entry.at;
    }
    emit entriesChanged();
    return entry.number;
}

void Journal::finish(qint64 number, const JournalEntry &outcome)
{
    JournalEntry *known = find(number);
    if (!known)
        return;
    JournalEntry entry = *known;
    // Its first write has ended already: this is another one of the same drag, which may be over meanwhile.
    const bool isContinued = isOneGoal(entry) && known->state != JournalState::Begun;
    const bool goesOn = m_drag == number;
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
        m_dragAt = now;
    if (isContinued && goesOn && m_dragSaved.msecsTo(now) < std::chrono::milliseconds(SaveInterval).count()) {
        place(entry);
        m_dragUnsaved = true;
        m_dragEnd.start();
    } else {
        store(entry, false);
        if (goesOn) {
            m_dragSaved = now;
            m_dragUnsaved = false;
        }
    }
    emit entriesChanged();
    emit ended(number);
}

void Journal::flush()
{
    m_dragEnd.stop();
    if (!std::exchange(m_dragUnsaved, false))
        return;
    if (const JournalEntry *drag = entry(m_drag)) {
        JournalEntry copy = *drag;
        store(copy, false);
    }
}

} // namespace dynascope
