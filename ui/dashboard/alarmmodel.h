// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/alarmwatch.h"

#include <QAbstractTableModel>

namespace dynascope {

enum class AlarmColumn { Time, Device, Kind, Cause, Cleared };
constexpr int AlarmColumns = 5;

/// The list of alarms, the newest first. Follows the watch.
class AlarmModel : public QAbstractTableModel
{
    Q_OBJECT

public:
    enum Role { ActiveRole = Qt::UserRole }; ///< does it last?

    explicit AlarmModel(const AlarmWatch &watch, QObject *parent = nullptr); ///< `watch` outlives this

    const Alarm *alarm(int row) const; ///< nullptr: there is none
    std::size_t active() const;        ///< how many last

    int rowCount(const QModelIndex &parent = {}) const override;
    int columnCount(const QModelIndex &parent = {}) const override;
    QVariant data(const QModelIndex &index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

private:
    void refresh();
    QString text(const Alarm &alarm, AlarmColumn column) const;

    const AlarmWatch &m_watch;
    std::vector<Alarm> m_alarms; ///< as of the last refresh, the newest first
};

} // namespace dynascope
