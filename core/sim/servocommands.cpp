// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/servo.h"

#include <algorithm>

namespace dynascope::sim {
namespace {

constexpr int FirstDisabledSecondaryId = 253;
constexpr int BroadcastResetIgnoredFrom = 42; ///< firmware
constexpr int ClearFrom = 42;                 ///< firmware of X and MX(2.0)
constexpr std::int64_t OurProtocol = 2;
constexpr LineTime ReturnDelayUnit = std::chrono::microseconds(2);
constexpr std::size_t IdAt = 4;

} // namespace

Servo::Address Servo::addressed(std::uint8_t id) const
{
    if (id == BroadcastId)
        return Address::Everyone;
    if (id == m_registers.get(Reg::Id))
        return Address::Own;
    const bool secondary = m_registers.has(Reg::SecondaryId) && id < FirstDisabledSecondaryId
                           && id == m_registers.get(Reg::SecondaryId);
    return secondary ? Address::Secondary : Address::Other;
}

/// Manual: "Status Return Level".
bool Servo::answers(Instruction instruction) const
{
    const std::int64_t level = m_registers.has(Reg::StatusReturnLevel) ? m_registers.get(Reg::StatusReturnLevel) : 2;
    switch (instruction) {
    case Instruction::Ping: return true;
    case Instruction::Read:
    case Instruction::SyncRead:
    case Instruction::FastSyncRead:
    case Instruction::BulkRead:
    case Instruction::FastBulkRead: return level >= 1;
    default: return level >= 2;
    }
}

LineTime Servo::returnDelay() const
{
    return m_settings.processing + m_registers.get(Reg::ReturnDelayTime) * ReturnDelayUnit;
}

bool Servo::supports(const Command &command) const
{
    if (std::holds_alternative<BackupCommand>(command))
        return table().hasBackup(firmware());
    if (std::holds_alternative<ClearCommand>(command)) {
        const QString &series = table().description().series;
        const bool counted = series == u"X" || series == u"MX(2.0)"; // they count firmware alike
        return (counted && firmware() >= ClearFrom) || series == u"P" || series == u"Y";
    }
    return true;
}

void Servo::obey(const InstructionPacket &packet, LineTime heardAt, std::vector<Reaction> &reactions)
{
    if (m_registers.has(Reg::ProtocolType) && m_registers.get(Reg::ProtocolType) != OurProtocol)
        return;
    advanceTo(heardAt);
    m_instructedLast = heardAt;
    const auto command = decodeCommand(packet);
    const auto *group = command ? std::get_if<GroupReadCommand>(&*command) : nullptr;
    const auto *writes = command ? std::get_if<GroupWriteCommand>(&*command) : nullptr;
    const Address how = addressed(packet.id);
    if (how == Address::Other || ((group || writes) && how != Address::Everyone))
        return;
    if (group)
        return obeyGroup(*group, heardAt, reactions);
    if (packet.instruction == Instruction::Reboot && !packet.parameters.empty())
        return; // users report that such a Reboot is ignored
    Reaction reaction;
    reaction.heardAt = heardAt;
    reaction.baudRate = m_baudRate;
    reaction.delay = returnDelay();
    reaction.status.id = static_cast<std::uint8_t>(id());
    Outcome outcome;
    if (!command)
        outcome.error = command.error();
    else if (!supports(*command))
        outcome.error = DeviceError::Instruction;
    else
        outcome = carryOut(*command, how);
    const bool broadcastPing = how == Address::Everyone && packet.instruction == Instruction::Ping;
    const bool toUs = how == Address::Own || broadcastPing;
    if (toUs && !outcome.silent && answers(packet.instruction)) {
        if (m_settings.idChangeAnswersWithNewId)
            reaction.status.id = static_cast<std::uint8_t>(id());
        reaction.turn = broadcastPing ? Reaction::Turn::Slot : Reaction::Turn::Direct;
        reaction.delay += outcome.extra;
        reaction.status.error = outcome.error;
        reaction.status.alert = hasAlert();
        reaction.status.parameters = std::move(outcome.data);
        reactions.push_back(std::move(reaction));
    }
    if (m_restart)
        boot(heardAt);
}

void Servo::obeyGroup(const GroupReadCommand &command, LineTime heardAt, std::vector<Reaction> &reactions)
{
    const auto ours = std::ranges::find(command.spans, id(), &Span::id);
    if (ours == command.spans.end() || !answers(Instruction::Read))
        return;
    if (command.fast && !table().hasFastReads(firmware()))
        return; // such firmware stays silent
    Reaction reaction;
    reaction.turn = Reaction::Turn::Chain;
    reaction.heardAt = heardAt;
    reaction.baudRate = m_baudRate;
    reaction.group = command;
    reaction.index = static_cast<std::size_t>(ours - command.spans.begin());
    // In the fast reads the delay is paid once, by the first device listed.
    reaction.delay = command.fast && reaction.index > 0 ? m_settings.fastGap : returnDelay();
    Outcome outcome = readOut(ours->address, ours->length);
    if (command.fast)
        outcome.data.resize(ours->length); // the packet's length was promised by the first device
    reaction.status = {ours->id, outcome.error, hasAlert(), std::move(outcome.data)};
    reactions.push_back(std::move(reaction));
}

void Servo::complain(const Parser::Damaged &damaged, LineTime heardAt, std::vector<Reaction> &reactions)
{
    if (!m_settings.answersDamagedRequests || damaged.raw[IdAt] != id())
        return;
    Reaction reaction;
    reaction.heardAt = heardAt;
    reaction.baudRate = m_baudRate;
    reaction.delay = returnDelay();
    reaction.status = {damaged.raw[IdAt], DeviceError::Crc, hasAlert(), {}};
    reactions.push_back(std::move(reaction));
}

Servo::Outcome Servo::carryOut(const Command &command, Address how)
{
    if (std::holds_alternative<PingCommand>(command)) {
        Outcome outcome;
        appendLittleEndian(outcome.data, static_cast<std::uint32_t>(m_registers.get(Reg::ModelNumber)), 2);
        outcome.data.push_back(static_cast<std::uint8_t>(firmware()));
        return outcome;
    }
    if (const auto *read = std::get_if<ReadCommand>(&command))
        return readOut(read->address, read->length);
    if (const auto *write = std::get_if<WriteCommand>(&command))
        return takeWrite(*write, how);
    if (const auto *writes = std::get_if<GroupWriteCommand>(&command)) {
        for (const SpanData &entry : writes->writes) {
            const Address entryHow = addressed(entry.id);
            if (entryHow == Address::Own || entryHow == Address::Secondary)
                takeWrite({entry.address, entry.data, false}, entryHow);
        }
        return {};
    }
    if (std::holds_alternative<ActionCommand>(command))
        return actOnRegistered();
    if (const auto *reset = std::get_if<FactoryResetCommand>(&command))
        return carryOut(*reset, how);
    if (const auto *clear = std::get_if<ClearCommand>(&command))
        return carryOut(*clear);
    if (const auto *backup = std::get_if<BackupCommand>(&command))
        return how == Address::Secondary ? Outcome() : carryOut(*backup);
    m_restart = true; // Reboot
    Outcome outcome;
    outcome.silent = !m_settings.answersReboot;
    return outcome;
}

Servo::Outcome Servo::readOut(int address, int length)
{
    Outcome outcome;
    if (length == 0)
        outcome.error = DeviceError::DataLength;
    else if (!m_registers.isInside(address, length))
        outcome.error = DeviceError::Access;
    if (outcome.error != DeviceError::None)
        return outcome;
    refresh();
    outcome.data = m_registers.read(address, length);
    return outcome;
}

Servo::Outcome Servo::takeWrite(const WriteCommand &command, Address how)
{
    Outcome outcome;
    outcome.error = checkWrite(command.address, command.data, how);
    if (outcome.error != DeviceError::None)
        return outcome;
    if (command.registered) {
        m_registered = command;
        return outcome;
    }
    const std::vector<const Field *> eeprom = eepromIn(command.address, command.data);
    applyWrite(command.address, command.data);
    if (!eeprom.empty()) {
        outcome.extra = m_settings.eepromWrite;
        m_eeprom.begin(m_registers, eeprom, m_now, m_settings.eepromWrite);
    }
    if (m_observer)
        m_observer(*this, command.address, command.data);
    return outcome;
}

Servo::Outcome Servo::actOnRegistered()
{
    Outcome outcome;
    if (!m_registered) {
        outcome.error = DeviceError::Instruction;
        return outcome;
    }
    WriteCommand command = *std::exchange(m_registered, std::nullopt);
    command.registered = false;
    return takeWrite(command, Address::Own);
}

Servo::Outcome Servo::carryOut(const FactoryResetCommand &command, Address how)
{
    Outcome outcome;
    if (how == Address::Secondary
        || (how == Address::Everyone && command.option == ResetOption::All && firmware() >= BroadcastResetIgnoredFrom))
        return outcome;
    const std::int64_t keptId = m_registers.get(Reg::Id);
    const std::int64_t keptBaud = m_registers.get(Reg::BaudRate);
    m_registers.resetEeprom();
    if (m_settings.factoryId >= 0)
        m_registers.set(Reg::Id, m_settings.factoryId);
    if (command.option != ResetOption::All)
        m_registers.set(Reg::Id, keptId);
    if (command.option == ResetOption::AllButIdAndBaud)
        m_registers.set(Reg::BaudRate, keptBaud);
    storeEverything();
    outcome.extra = m_settings.eepromWrite;
    m_restart = true;
    return outcome;
}

/// After all of the EEPROM was written.
void Servo::storeEverything()
{
    std::vector<const Field *> eeprom;
    for (const Field &field : table().fields()) {
        if (field.area == Area::Eeprom)
            eeprom.push_back(&field);
        else
            m_registers.keep(field, m_registers.bytes(field));
    }
    m_eeprom.begin(m_registers, eeprom, m_now, m_settings.eepromWrite);
}

Servo::Outcome Servo::carryOut(const ClearCommand &command)
{
    Outcome outcome;
    if (command.option == ClearOption::Error)
        return clearError();
    if (m_motion.joint().state().moving)
        outcome.error = DeviceError::ResultFail;
    if (outcome.error != DeviceError::None)
        return outcome;
    m_motion.bringIntoOneTurn();
    m_registers.set(Reg::GoalPosition, m_motion.presentPosition());
    if (m_motion.joint().torque())
        m_motion.takeGoalPosition();
    outcome.extra = m_settings.clearTime;
    return outcome;
}

/// The Y series alone has it; an error whose cause lasts comes back.
Servo::Outcome Servo::clearError()
{
    Outcome outcome;
    if (!m_registers.has(Reg::ErrorCode)) {
        outcome.error = DeviceError::DataRange;
        return outcome;
    }
    m_errors.clear();
    m_shutDown = false;
    outcome.extra = m_settings.clearTime;
    return outcome;
}

Servo::Outcome Servo::carryOut(const BackupCommand &command)
{
    Outcome outcome;
    outcome.extra = m_settings.eepromWrite;
    const bool restore = command.option == BackupOption::Restore;
    if (m_motion.joint().torque() || (restore && !m_backup)) {
        outcome.error = DeviceError::ResultFail;
        return outcome;
    }
    if (restore) {
        m_registers.setImage(*m_backup);
        storeEverything();
        m_restart = true;
    } else {
        m_backup = m_registers.image();
    }
    m_registers.set(Reg::BackupReady, 1);
    return outcome;
}

} // namespace dynascope::sim
