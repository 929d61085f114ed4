// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/device.h"

#include "core/session/linesession.h"

#include <QCoreApplication>

#include <algorithm>
#include <chrono>

namespace dynascope {

Device::Device(DeviceKey key, LineSession *line, ControlTablePtr table, const Found &found)
    : m_key(key)
    , m_line(line)
    , m_table(std::move(table))
    , m_found(found)
    , m_values(m_table->fields().size())
{
}

QString Device::displayName() const
{
    return m_nickname.isEmpty() ? QStringLiteral("%1 #%2").arg(model()).arg(id()) : m_nickname;
}

Traits Device::traits() const
{
    Traits traits;
    traits.id = m_found.id;
    traits.baudRate = m_found.baudRate;
    if (const auto delay = raw(Known::ReturnDelayTime)) {
        traits.returnDelay = std::chrono::microseconds(*delay * 2 + 8);
        traits.returnDelayKnown = true;
    }
    if (const auto level = raw(Known::StatusReturnLevel))
        traits.statusReturnLevel = static_cast<std::uint8_t>(*level);
    traits.firmware = m_found.firmware;
    traits.fastReads = m_table->hasFastReads(m_found.firmware);
    traits.receiveBuffer = m_table->receiveBuffer();
    return traits;
}

std::optional<std::int64_t> Device::raw(QStringView fieldName) const
{
    const int index = m_table->indexOf(fieldName);
    return index < 0 ? std::nullopt : value(index).raw;
}

std::optional<std::int64_t> Device::raw(Known field) const
{
    const int index = m_table->indexOf(field);
    return index < 0 ? std::nullopt : value(index).raw;
}

EffectiveField Device::effective(int fieldIndex) const
{
    return dynascope::effective(m_table->fields()[static_cast<std::size_t>(fieldIndex)],
                                [this](QStringView name) { return raw(name); });
}

bool Device::mayHaveTorqueOn() const
{
    const int torque = m_table->indexOf(Known::TorqueEnable);
    return isTorqueOn() || (torque >= 0 && value(torque).unconfirmed);
}

bool Device::goalTurnsTorqueOn() const
{
    constexpr int Bit = 3;
    const int mode = m_table->indexOf(u"Drive Mode");
    if (mode < 0)
        return false;
    const std::vector<BitField> &bits = m_table->fields()[static_cast<std::size_t>(mode)].bits;
    return std::ranges::find(bits, Bit, &BitField::first) != bits.end() && (value(mode).raw.value_or(0) >> Bit & 1) != 0;
}

QString Device::lockReason(int fieldIndex, bool insisting) const
{
    const Field &field = m_table->fields()[static_cast<std::size_t>(fieldIndex)];
    if (field.mayBeTried() && !insisting)
        return tr("Whether %1 may be written is not known.").arg(field.name);
    if (!field.isWritable() && !field.mayBeTried())
        return tr("%1 is read-only.").arg(field.name);
    if (m_line && m_line->isRecorded())
        return tr("This is a recording: it shows what was.");
    const bool isGone = m_line
        && (m_line->state() == BusThread::State::Lost || m_line->state() == BusThread::State::Closed);
    if (isGone) // while it opens an order waits
        return tr("%1 is not connected.").arg(displayName());
    if (m_state == State::Rebooting)
        return tr("%1 is rebooting.").arg(displayName());
    if (field.needsTorqueOff() && isTorqueOn())
        return (field.torqueOff ? tr("%1 can be written only while the servo's torque is off.")
                                : tr("%1 is in the EEPROM area, which the servo locks while its torque is on."))
            .arg(field.name);
    return {};
}

void Device::setNickname(const QString &name)
{
    if (m_nickname == name)
        return;
    m_nickname = name;
    emit attributesChanged();
}

void Device::setFound(const Found &found)
{
    if (m_found == found)
        return;
    m_found = found;
    emit attributesChanged();
}

void Device::setState(State state)
{
    if (m_state == state)
        return;
    m_state = state;
    if (state != State::Present) // not polled: what is shown is from before
        setAllStale();
    emit attributesChanged();
}

void Device::setAlert(bool alert)
{
    if (m_alert == alert)
        return;
    m_alert = alert;
    emit attributesChanged();
}

void Device::setAnswersOnlyPing(bool onlyPing)
{
    if (m_answersOnlyPing == onlyPing)
        return;
    m_answersOnlyPing = onlyPing;
    emit attributesChanged();
}

void Device::setHeard(LineTime at)
{
    m_lastHeard = std::max(m_lastHeard, at);
}

void Device::take(const PollValue &value, FieldState as)
{
    const int begin = value.address;
    const int end = begin + static_cast<int>(value.data.size());
    const ByteView bytes = value.data;
    const auto covers = [&](Known known) {
        const Field *field = m_table->find(known);
        return field && field->address >= begin && field->end() <= end;
    };
    const bool saysHowItAnswers = covers(Known::ReturnDelayTime) || covers(Known::StatusReturnLevel);
    const Traits before = saysHowItAnswers ? traits() : Traits();
    int first = -1;
    int last = -1;
    const std::span<const Field> fields = m_table->fields();
    auto field = std::ranges::lower_bound(fields, begin, {}, &Field::address);
    for (; field != fields.end() && field->end() <= end; ++field) {
        const auto index = static_cast<int>(field - fields.begin());
        FieldValue &now = m_values[static_cast<std::size_t>(index)];
        const bool mayBeOlder = now.state == FieldState::Stale && as == FieldState::Fresh; // another line's clock
        if (now.raw && !mayBeOlder && value.at < now.at)
            continue; // overtaken: a batch that was polled before a read-back
        const std::int64_t raw = rawFromBytes(*field, bytes.subspan(static_cast<std::size_t>(field->address - begin)));
        // A failed write stays to be seen until the value moves or somebody tries again.
        const bool keeps = now.state == FieldState::Pending || (now.state == FieldState::Failed && now.raw == raw);
        const FieldState state = keeps ? now.state : as;
        const bool confirms = as == FieldState::Fresh && now.unconfirmed;
        const bool changed = now.raw != raw || now.state != state || confirms;
        if (confirms)
            now.unconfirmed.reset();
        now.raw = raw;
        now.at = value.at;
        now.state = state;
        if (!keeps)
            now.error.clear();
        if (!changed)
            continue;
        first = first < 0 ? index : first;
        last = index;
    }
    setHeard(value.at);
    if (first >= 0)
        emit fieldsChanged(first, last);
    if (saysHowItAnswers && traits() != before)
        emit attributesChanged();
}

void Device::takeReadBack(int fieldIndex, std::int64_t raw)
{
    const Field &field = m_table->fields()[static_cast<std::size_t>(fieldIndex)];
    PollValue value;
    value.address = field.address;
    value.length = field.size;
    value.data = bytesFromRaw(field, raw);
    value.at = std::chrono::steady_clock::now().time_since_epoch(); // what was polled before it is older news
    take(value);
}

void Device::setPending(int fieldIndex, std::int64_t raw)
{
    FieldValue &value = m_values[static_cast<std::size_t>(fieldIndex)];
    value.pending = raw;
    value.state = FieldState::Pending;
    value.error.clear();
    emit fieldsChanged(fieldIndex, fieldIndex);
}

void Device::clearPending(int fieldIndex)
{
    FieldValue &value = m_values[static_cast<std::size_t>(fieldIndex)];
    value.pending.reset();
    value.error.clear();
    if (value.state == FieldState::Pending || value.state == FieldState::Failed)
        value.state = value.raw ? FieldState::Fresh : FieldState::Unknown;
    emit fieldsChanged(fieldIndex, fieldIndex);
}

void Device::setFailed(int fieldIndex, const QString &error)
{
    FieldValue &value = m_values[static_cast<std::size_t>(fieldIndex)];
    value.pending.reset();
    value.state = FieldState::Failed;
    value.error = error;
    emit fieldsChanged(fieldIndex, fieldIndex);
}

void Device::setUnconfirmed(int fieldIndex, std::int64_t sent, const QString &error)
{
    FieldValue &value = m_values[static_cast<std::size_t>(fieldIndex)];
    value.unconfirmed = sent;
    value.at = std::chrono::steady_clock::now().time_since_epoch(); // what was polled before it is older news
    setFailed(fieldIndex, error);
}

void Device::clearFailures()
{
    for (int i = 0; i < static_cast<int>(m_values.size()); ++i) {
        if (value(i).state == FieldState::Failed)
            clearPending(i);
    }
}

void Device::setAllStale()
{
    for (FieldValue &value : m_values) {
        if (value.state == FieldState::Fresh)
            value.state = FieldState::Stale;
    }
    if (!m_values.empty())
        emit fieldsChanged(0, static_cast<int>(m_values.size()) - 1);
}

} // namespace dynascope
