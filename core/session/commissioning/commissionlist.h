// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/procedures/moveplan.h"
#include "core/session/settings/settingsplan.h"
#include "core/table/catalog.h"

#include <QDateTime>

/// New servos that become the joints of a robot, one after the other: which, and how far that is. Pure values.
namespace dynascope {

struct CommissionSetting {
    QString name; ///< of the register, as the manufacturer writes it
    std::int64_t raw = 0;
};

/// What one servo shall be.
struct CommissionJoint {
    QString name; ///< "shoulder"; may be empty
    int modelNumber = 0;
    int minimumFirmware = 0;
    MovePlace place; ///< the ID and baud rate that it gets
    std::vector<CommissionSetting> settings;
};
QString jointText(const CommissionJoint &joint); ///< "shoulder (ID 11)", or "ID 11"

/// A servo that was read back and ticked off.
struct CommissionFacts {
    int modelNumber = 0, firmware = 0;
    MovePlace foundAt, place;
    bool wasSo = false; ///< nothing had to be written
    QDateTime at;       ///< UTC
};

enum class CommissionState { Waiting, Done, Skipped };

/// The joints with what has become of each.
class CommissionList
{
public:
    CommissionList() = default;
    /// InvalidArgument, with the reason: a model that isn't known or doesn't offer the baud rate, an ID out of range, a
    /// place or a name wanted twice, a setting that such a servo doesn't take.
    static Result<CommissionList> make(const Catalog &catalog, std::vector<CommissionJoint> joints);

    std::size_t size() const { return m_joints.size(); }
    const CommissionJoint &joint(std::size_t index) const { return m_joints[index]; }
    CommissionState state(std::size_t index) const { return m_states[index]; }
    const CommissionFacts &facts(std::size_t index) const { return m_facts[index]; } ///< once it is Done

    /// Who is to be plugged in now: the first that waits. One whose place is where new ones answer comes last, or the
    /// next new one would answer together with it.
    std::optional<std::size_t> next() const;
    /// Is the joint's place the one that its model has from the factory? Whoever stands there is nobody yet.
    bool isWhereNewOnesAnswer(std::size_t index) const { return m_isFactory[index]; }
    bool isOver() const { return !next(); }
    std::size_t count(CommissionState state) const;

    void tick(std::size_t index, const CommissionFacts &facts);
    void skip(std::size_t index) { m_states[index] = CommissionState::Skipped; }
    void reopen(std::size_t index) { m_states[index] = CommissionState::Waiting; } ///< it is wanted again

    /// The joint of this model at this place, where it is in this state.
    std::optional<std::size_t> at(const MovePlace &place, int modelNumber, CommissionState state) const;
    /// Every rate at which one of the wanted servos may answer, most likely ones first.
    std::vector<int> rates(const Catalog &catalog) const;

private:
    std::vector<CommissionJoint> m_joints;
    std::vector<bool> m_isFactory;
    std::vector<CommissionState> m_states;
    std::vector<CommissionFacts> m_facts;
};

/// "elbow_1": what a file, a line of a label list or a message may hold.
constexpr int LongestJointName = 64;
constexpr std::size_t MostJoints = MaximumId + 1;

/// `joint`'s settings as fields of a table; InvalidArgument: it has no such register.
Result<std::vector<WantedSetting>> wantedSettings(const CommissionJoint &joint, const ControlTable &table);

/// Why a servo of this model and firmware is not the wanted one, a sentence without a stop; empty: it is.
QString unfitText(const CommissionJoint &joint, int modelNumber, int firmware, const Catalog &catalog);

/// @name The list of labels: who was ticked off, in the order of the joints
/// @{
QStringList labelHeads();
std::vector<QStringList> labelRows(const CommissionList &list, const Catalog &catalog);
QByteArray labelsCsv(const CommissionList &list, const Catalog &catalog); ///< UTF-8, one head line
/// @}

} // namespace dynascope
