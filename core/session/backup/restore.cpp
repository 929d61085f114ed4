// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/backup/restore.h"

#include "core/session/texts.h"
#include "core/table/nearestnames.h"

#include <algorithm>
#include <array>

namespace dynascope {
namespace {

bool isAmong(const QStringList &names, const QString &name)
{
    return std::ranges::any_of(names, [&](const QString &one) { return normalizedName(one) == normalizedName(name); });
}

/// One backup on its way to one device.
class Planning
{
public:
    Planning(const Backup &backup, const Backup &now, const DevicePlace &place, const RestoreOptions &options)
        : m_backup(backup), m_now(now), m_place(place), m_options(options)
    {
        m_plan.isSameDevice = isSameFirmware() && backup.id == now.id;
    }

    Result<RestorePlan> run()
    {
        if (const auto fine = checkWhole(); !fine)
            return tl::unexpected(fine.error());
        for (const BackupRegister &one : m_backup.registers) {
            const Field &field = m_backup.fieldOf(one);
            if (field.access != Access::Read)
                addRow(one, field);
        }
        if (const auto fine = checkRanges(); !fine)
            return tl::unexpected(fine.error());
        for (const RestoreRow &row : m_plan.rows) {
            if (isCarried(row))
                m_plan.wanted.push_back({row.field, row.wanted});
        }
        SettingsOptions options = m_options.settings;
        options.keepResets = true;
        auto settings = planSettings(*m_now.table, m_place, m_now.firmware, m_plan.wanted, options);
        if (!settings)
            return tl::unexpected(settings.error());
        m_plan.settings = std::move(*settings);
        return std::move(m_plan);
    }

private:
    bool isSameFirmware() const { return m_backup.table == m_now.table; }
    static bool isCarried(const RestoreRow &row)
    {
        const bool isWanted = row.state == RestoreRow::State::Same || row.state == RestoreRow::State::Differs;
        return isWanted && row.field >= 0;
    }

    static tl::unexpected<Error> refuse(const QString &why)
    {
        return failure(ErrorKind::InvalidArgument, BackupText::tr("%1; nothing was written").arg(why));
    }

    Result<void> checkWhole() const
    {
        if (m_backup.modelNumber != m_now.modelNumber) {
            return refuse(
                BackupText::tr("%1 is the backup of a %2, and %3 is none")
                    .arg(m_backup.file.isEmpty() ? m_backup.name() : m_backup.file, m_backup.model, m_now.name()));
        }
        if (!m_now.isKnownModel() || !m_backup.isKnownModel())
            return refuse(BackupText::tr("%1: the registers of this model are not known").arg(m_now.name()));
        for (const QString &name : m_options.only + m_options.except) {
            if (m_backup.table->find(name) || m_now.table->find(name))
                continue;
            const QStringList near = namesNear(*m_now.table, name);
            return refuse(BackupText::tr("%1 has no register \"%2\"").arg(m_now.model, name)
                          + (near.isEmpty() ? QString() : BackupText::tr("; nearest: %1").arg(near.join(u", "))));
        }
        return {};
    }

    void addRow(const BackupRegister &one, const Field &field)
    {
        RestoreRow row;
        row.name = field.name;
        row.use = backupUse(*m_backup.table, field);
        row.wanted = one.raw;
        row.wantedText = m_backup.text(one);
        const Field *own = m_now.table->find(field.name);
        const BackupRegister *held = m_now.find(own);
        if (own)
            row.field = m_now.table->indexOf(own);
        if (held) {
            row.now = held->raw;
            row.nowText = m_now.text(*held);
        }
        row.why = whyLeft(row);
        if (!row.why.isEmpty()) {
            row.state = row.now == row.wanted ? RestoreRow::State::Same : RestoreRow::State::Left;
            row.field = -1; // not to be written, whatever it holds
        } else {
            row.why = own ? whyNotCarried(row, field, *own)
                          : BackupText::tr("firmware %1 has no such register").arg(m_now.firmware);
            row.state = !row.why.isEmpty()      ? RestoreRow::State::NotCarried
                        : row.now == row.wanted ? RestoreRow::State::Same
                                                : RestoreRow::State::Differs;
            const bool isOdd =
                row.state == RestoreRow::State::Same
                && !settingProblem(*m_now.table, m_place, {row.field, row.wanted}, m_options.settings).isEmpty();
            if (isOdd) // it may stay so, but nobody would write it
                row.field = -1;
        }
        m_plan.rows.push_back(std::move(row));
        m_sources.push_back(&one);
    }

    QString whyLeft(const RestoreRow &row) const
    {
        switch (row.use) {
        case BackupUse::Motion: return BackupText::tr("torque and goals are never restored");
        case BackupUse::Order: return BackupText::tr("it is an order or the protocol, no setting");
        case BackupUse::Place: return BackupText::tr("ID and baud rate are moved by themselves");
        case BackupUse::Calibration:
            if (!m_options.calibration.value_or(m_plan.isSameDevice))
                return BackupText::tr("it belongs to the single device that the backup was made of");
            break;
        case BackupUse::Setting:
        case BackupUse::Identity:
        case BackupUse::Reading: break;
        }
        const bool isChosen = m_options.only.isEmpty() || isAmong(m_options.only, row.name);
        return isChosen && !isAmong(m_options.except, row.name) ? QString() : BackupText::tr("it was not chosen");
    }

    QString whyNotCarried(const RestoreRow &row, const Field &from, const Field &to) const
    {
        if (!row.now)
            return BackupText::tr("%1 lets it not be read").arg(m_now.name());
        if (const QString other = otherMeaning(*m_backup.table, from, *m_now.table, to, row.wanted, m_backup.lookup());
            !other.isEmpty())
            return other;
        if (row.now == row.wanted)
            return {};
        const bool isNamed =
            to.values.empty() || std::ranges::find(to.values, row.wanted, &EnumValue::value) != to.values.end();
        if (!isSameFirmware() || isNamed) // else it is wrong in the file, and checkRanges() says where
            return settingProblem(*m_now.table, m_place, {row.field, row.wanted}, m_options.settings);
        return {};
    }

    /// As registers will be once all of it is written.
    RegisterLookup afterwards() const
    {
        return [this](QStringView name) -> std::optional<std::int64_t> {
            const int field = m_now.table->indexOf(name);
            const auto row = std::ranges::find(m_plan.rows, field, &RestoreRow::field);
            if (row != m_plan.rows.end() && isCarried(*row))
                return row->wanted;
            const BackupRegister *held = m_now.find(name);
            return held ? std::optional(held->raw) : std::nullopt;
        };
    }

    Result<void> checkRanges()
    {
        for (std::size_t i = 0; i < m_plan.rows.size(); ++i) {
            RestoreRow &row = m_plan.rows[i];
            if (!isCarried(row))
                continue;
            const Field &field = m_now.table->fields()[static_cast<std::size_t>(row.field)];
            const auto inRange =
                checkRange(field, effective(field, afterwards()), row.wanted, m_now.table->resolution());
            if (inRange)
                continue;
            if (row.state == RestoreRow::State::Same) { // the device itself has it so
                row.field = -1;
                continue;
            }
            // One register beyond what another one allows may be so in a device, which then takes neither anew.
            const RegisterLookup nobody = [](QStringView) { return std::optional<std::int64_t>(); };
            const bool isEverWrong = !checkRange(field, effective(field, nobody), row.wanted);
            if (isSameFirmware() && isEverWrong) {
                const QString where = m_backup.file.isEmpty() ? m_backup.name()
                                                              : QStringLiteral("%1:%2:%3")
                                                                    .arg(m_backup.file)
                                                                    .arg(m_sources[i]->line)
                                                                    .arg(m_sources[i]->column);
                return refuse(QStringLiteral("%1: %2").arg(where, inRange.error().text));
            }
            row.state = RestoreRow::State::NotCarried;
            row.why = inRange.error().text;
        }
        return {};
    }

    const Backup &m_backup, &m_now;
    const DevicePlace &m_place;
    const RestoreOptions &m_options;
    RestorePlan m_plan;
    std::vector<const BackupRegister *> m_sources; ///< of each row
};

} // namespace

std::size_t RestorePlan::count(RestoreRow::State state) const
{
    return static_cast<std::size_t>(std::ranges::count(rows, state, &RestoreRow::state));
}

Result<RestorePlan> planRestore(const Backup &backup, const Backup &now, const DevicePlace &place,
                                const RestoreOptions &options)
{
    return Planning(backup, now, place, options).run();
}

QString wordOf(RestoreRow::State state)
{
    constexpr std::array Words{"same", "differs", "left", "not-carried"};
    return QLatin1String(Words[static_cast<std::size_t>(state)]);
}

QString inServoConditions()
{
    return BackupText::tr(
        "The device keeps one backup of its own control table, in its own memory, and the next one replaces it. "
        "Torque must be off. Restoring overwrites the whole EEPROM, ID and baud rate with it, and restarts the "
        "device. Of the RAM it brings values back where Startup Configuration says that they are restored at "
        "power-up. Torque, goals and readings are no part of it. Models without it need a backup to a file.");
}

QString inServoProblem(const ControlTable &table, int firmware, bool restore, std::optional<std::int64_t> torque,
                       std::optional<std::int64_t> ready)
{
    if (table.description().isRaw)
        return {}; // let it say so itself
    if (!table.hasBackup(firmware)) {
        const int from = table.description().backupFrom;
        return from < 0
                   ? BackupText::tr(
                       "this model has no backup of its own (Control Table Backup); a backup to a file does it, too")
                   : BackupText::tr("its firmware %1 has no backup of its own (Control Table Backup), which came with "
                                    "firmware %2; a backup to a file does it, too")
                         .arg(firmware)
                         .arg(from);
    }
    if (torque.value_or(0) != 0)
        return BackupText::tr("its torque is on, and it makes and restores a backup of its own only with torque off");
    if (restore && ready == 0)
        return BackupText::tr("it holds no backup of its own: Backup Ready is 0");
    return {};
}

} // namespace dynascope
