// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/profilerun.h"

#include <QAbstractItemModel>

namespace dynascope {

/// A profile's joints with their registers below, as wanted and as found; behind them the devices that no joint names.
/// Keeps values of its own, so that it is sound whatever the run does meanwhile.
class ProfileModel : public QAbstractItemModel
{
    Q_OBJECT

public:
    enum Column { Name, Wanted, Held, State, Columns };
    enum Role { KindRole = Qt::UserRole + 1 };
    enum class Kind {
        Unknown, ///< not compared
        Same,
        Differs,
        Problem, ///< it can't be made as wanted as it is
        Waiting,
        Writing,
        Written, ///< in this run, and read back
        Failed,
        Other, ///< a device that no joint names
    };

    explicit ProfileModel(const Catalog &catalog, QObject *parent = nullptr);

    /// Brings it up to date; rows stay where the profile is the same.
    void show(const ProfileRun &run);
    void setUnits(const UnitPreferences &units);
    std::set<std::size_t> chosen() const; ///< joints that are ticked
    void setChosen(std::size_t joint, bool isChosen);

    QModelIndex index(int row, int column, const QModelIndex &parent = {}) const override;
    QModelIndex parent(const QModelIndex &index) const override;
    int rowCount(const QModelIndex &parent = {}) const override;
    int columnCount(const QModelIndex &parent = {}) const override;
    QVariant data(const QModelIndex &index, int role) const override;
    bool setData(const QModelIndex &index, const QVariant &value, int role) override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
    Qt::ItemFlags flags(const QModelIndex &index) const override;
    Kind kind(const QModelIndex &index) const;

signals:
    void chosenChanged();

private:
    struct Joint {
        ProfileJoint wanted;
        std::optional<JointComparison> found;
        JointProgress progress;
        std::set<int> written; ///< rows, in this run
        bool isChosen = true;
    };
    static bool isJoint(const QModelIndex &index) { return index.internalId() == 0; }
    const Joint *jointOf(const QModelIndex &index) const;
    const RegisterComparison *rowOf(const QModelIndex &index) const;
    bool isSameProfile(const ProfileRun &run) const;
    void updateJoint(std::size_t at, const ProfileRun &run);
    void setOthers(const std::vector<Found> &others);
    Kind kindOf(const Joint &joint) const;
    QString heldText(const Found &found, const ProfileJoint &wanted) const;
    QString jointText(const Joint &joint, int column) const;
    QString registerText(const Joint &joint, int row, int column) const;
    QString otherText(const Found &found, int column) const;
    QString stateText(const Joint &joint) const;
    QString text(const QModelIndex &index) const;
    QString toolTip(const QModelIndex &index) const;

    const Catalog &m_catalog;
    std::vector<Joint> m_joints;
    std::vector<Found> m_others;
    UnitPreferences m_units;
};

} // namespace dynascope
