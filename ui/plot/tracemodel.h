// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/monitor.h"
#include "core/table/units.h"
#include "ui/plot/tracedata.h"

#include <QAbstractListModel>

namespace dynascope {

/// The traces of one panel: a field of a device each, with colour and live value. Follows a device through changes of
/// ID and baud rate; a trace whose device goes stays, dimmed, until a person removes it.
class TraceModel : public QAbstractListModel
{
    Q_OBJECT

public:
    enum Role {
        ColorIndexRole = Qt::UserRole, ///< int, for traceColor()
        FieldRole,                     ///< "Present Position"
        DeviceRole,                    ///< "XM430-W350 #1"
        ValueRole,                     ///< "180.00"; empty where nothing is known
        UnitRole,
        GoneRole, ///< its device doesn't answer
        NoteRole, ///< why, in a word or two
    };

    TraceModel(Session &session, const Monitor &monitor, QObject *parent = nullptr);

    bool add(const Watch &watch); ///< false if it is there already, or names nothing
    void remove(int row);
    int indexOf(const Watch &watch) const; ///< row; −1 where it isn't here
    const Watch &watch(int row) const { return m_traces[static_cast<std::size_t>(row)].watch; }
    std::vector<Watch> watches() const;
    bool isVisible(int row) const { return m_traces[static_cast<std::size_t>(row)].visible; }
    void setVisible(int row, bool visible);
    int colorIndex(int row) const { return m_traces[static_cast<std::size_t>(row)].color; }
    void setColorIndex(int row, int color);

    void setUnits(const UnitPreferences &units);

    /// For drawing, in the order of rows.
    std::vector<TraceData> drawn(const QPalette &palette) const;
    /// Looks at the newest values, and announces those whose text changed.
    void refreshValues();

    int rowCount(const QModelIndex &parent = {}) const override;
    QVariant data(const QModelIndex &index, int role) const override;
    bool setData(const QModelIndex &index, const QVariant &value, int role) override;
    Qt::ItemFlags flags(const QModelIndex &index) const override;

private:
    struct Trace {
        Watch watch;
        int color = 0;
        bool visible = true;
        QString device;
        QString field;
        bool gone = false;
        EffectiveField effective; ///< as it was last known: its device may be gone
        int resolution = 4096;
        double scale = 1;
        double offset = 0;
        int decimals = 0;
        QString unit;
        QString value; ///< as shown
    };

    void describe(Trace &trace) const;
    void measure(Trace &trace) const;
    bool isSilent(const Trace &trace) const;
    void updateDevice(Device *device);
    void onDeviceGone(Device *device);
    void onDeviceBack(Device *device);
    void follow(Device *device);
    int freeColor() const;

    Session &m_session;
    const Monitor &m_monitor;
    UnitPreferences m_units;
    std::vector<Trace> m_traces;
};

} // namespace dynascope
