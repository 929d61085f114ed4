// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/journal/undosequence.h"
#include "core/session/texts.h"

#include <algorithm>
#include <limits>

namespace dynascope {
namespace {

Error ofEntry(const UndoStep &step, Error error)
{
    const QString what = step.direction == Direction::Undo ? JournalText::tr("Undo of entry %1: %2")
                                                           : JournalText::tr("Redo of entry %1: %2");
    error.text = what.arg(QString::number(step.number), error.text);
    return error;
}

} // namespace

UndoSequence::UndoSequence(std::vector<qint64> numbers, Direction direction, const UndoOptions &options)
    : m_waiting(std::move(numbers)), m_direction(direction), m_options(options)
{
    std::ranges::sort(m_waiting);
    m_waiting.erase(std::unique(m_waiting.begin(), m_waiting.end()), m_waiting.end());
    if (direction == Direction::Redo)
        std::ranges::reverse(m_waiting);
}

std::optional<UndoStep> UndoSequence::next(const JournalEntries &entries, const Catalog &catalog)
{
    if (m_over)
        return std::nullopt;
    if (!m_waiting.empty()) {
        const qint64 number = m_waiting.back();
        m_waiting.pop_back();
        auto step = planUndo(entries, number, m_direction, catalog, m_options);
        if (step) {
            prepare(*step);
            return std::move(*step);
        }
        fail(step.error());
        return std::nullopt;
    }
    if (m_round.empty() && !beginRound()) {
        end();
        return std::nullopt;
    }
    const auto where = m_round.back();
    m_round.pop_back();
    return m_left.at(where).step;
}

/// As long as the last one brought something.
bool UndoSequence::beginRound()
{
    const std::size_t before = m_resting ? m_leftBefore : std::numeric_limits<std::size_t>::max();
    m_resting = true;
    m_leftBefore = m_left.size();
    if (m_left.empty() || m_left.size() >= before)
        return false;
    for (const auto &[where, left] : m_left)
        m_round.push_back(where);
    return true;
}

void UndoSequence::end()
{
    m_over = true;
    for (const auto &[where, left] : m_left) {
        if (left.isMain)
            m_outcome = tl::unexpected(ofEntry(left.step, {ErrorKind::NotConfirmed, left.why}));
    }
}

void UndoSequence::fail(const Error &error)
{
    m_over = true;
    m_outcome = tl::unexpected(error);
}

/// What waits is not what the journal expects.
void UndoSequence::prepare(UndoStep &step) const
{
    const Place place{step.place.baudRate, step.place.id};
    for (const auto &[where, left] : m_left) {
        if (where.first == place)
            step.registers.unchecked.insert(where.second);
    }
}

void UndoSequence::follow(const UndoStep &step, const Found &moved)
{
    const Place from{step.place.baudRate, step.place.id}, to{moved.baudRate, moved.id};
    std::map<std::pair<Place, std::uint16_t>, Left> all;
    for (auto &[where, left] : m_left) {
        const bool isIt = where.first == from;
        if (isIt) {
            left.step.place.id = moved.id;
            left.step.place.baudRate = moved.baudRate;
            left.step.registers.place = left.step.place;
            left.step.entry.device.id = moved.id;
            left.step.entry.device.baudRate = moved.baudRate;
        }
        all.insert_or_assign({isIt ? to : where.first, where.second}, left);
    }
    m_left = std::move(all);
}

void UndoSequence::take(const UndoStep &step, const Result<UndoResult> &result)
{
    if (!result)
        return fail(ofEntry(step, result.error()));
    if (result->registers.missing != Consent::None) {
        m_missing = result->registers.missing;
        return fail(ofEntry(step, {ErrorKind::InvalidArgument, result->registers.why}));
    }
    m_carriedOut += m_resting ? 0 : 1;
    if (result->moved)
        return follow(step, *result->moved);
    const Place place{step.place.baudRate, step.place.id};
    const std::uint16_t main = step.registers.registers.front().address;
    const auto former = m_left.find({place, main});
    const bool wasMain = former == m_left.end() || former->second.isMain;
    for (const RevertRegister &each : step.registers.registers)
        m_left.erase({place, each.address});
    for (const LeftRegister &each : result->registers.left) {
        Left left{step, each.why, each.what.address == main && (!m_resting || wasMain)};
        left.step.registers.registers = {each.what};
        left.step.registers.kept.clear();
        left.step.registers.unchecked = {each.what.address};
        std::erase_if(left.step.entry.changes,
                      [&](const RegisterChange &change) { return change.address != each.what.address; });
        if (left.step.entry.changes.empty()) // one only kept: the entry that is undone has no word of it
            left.step.entry.changes = {{each.what.name, each.what.address, false, {}, each.what.to, {}}};
        m_left.try_emplace({place, each.what.address}, std::move(left)); // one only kept replaces none that waits
    }
}

} // namespace dynascope
