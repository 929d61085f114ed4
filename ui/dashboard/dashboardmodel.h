// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/alarmwatch.h"
#include "ui/dashboard/dashboardrow.h"

#include <QAbstractTableModel>

namespace dynascope {

/// All devices, a row each, the worst first. Rows change places at most once a second, and only when a device becomes
/// better or worse by a class (Severity); within a class they stand by line, baud rate and ID. Holds copies.
class DashboardModel : public QAbstractTableModel
{
    Q_OBJECT

public:
    enum Role {
        NumberRole = Qt::UserRole,
        UnitRole,
        PartRole,     ///< 0..1 between the limits; invalid: not known
        LevelRole,    ///< int of AlarmLevel
        SeverityRole, ///< int of Severity, of the row
    };

    /// Both outlive this.
    DashboardModel(const Session &session, const AlarmWatch &watch, QObject *parent = nullptr);

    /// What the devices say now. `now` is of any clock that goes on: by it the order is kept for a second.
    void refresh(LineTime now);
    void setUnits(const UnitPreferences &units) { m_units = units; } ///< from the next refresh on
    const DashboardRow *row(int row) const;                          ///< nullptr: there is none
    int rowOf(DeviceKey key) const;                                  ///< −1: there is none
    bool isChangingRows() const { return m_isChanging; }             ///< the view moves its cursor, no person does
    QString summary() const;                                         ///< "6 devices, 1 with a hardware error"
    QString limitsSummary() const;                                   ///< whose limits those are

    int rowCount(const QModelIndex &parent = {}) const override;
    int columnCount(const QModelIndex &parent = {}) const override;
    QVariant data(const QModelIndex &index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

private:
    std::vector<DashboardRow> makeRows() const;
    void removeOthers(const std::vector<DashboardRow> &wanted);
    void insertMissing(const std::vector<DashboardRow> &wanted);
    void update(std::vector<DashboardRow> wanted);
    void order(std::vector<DeviceKey> wanted);

    const Session &m_session;
    const AlarmWatch &m_watch;
    UnitPreferences m_units;
    std::vector<DashboardRow> m_rows;
    std::optional<LineTime> m_ordered; ///< when the order was made
    bool m_isChanging = false;
};

} // namespace dynascope
