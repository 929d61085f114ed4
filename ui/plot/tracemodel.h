// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/derived.h"
#include "core/session/monitor.h"
#include "core/table/units.h"
#include "ui/plot/tracecolors.h"
#include "ui/plot/tracedata.h"

#include <QAbstractListModel>

namespace dynascope {

/// The traces of one panel: a field of a device each, or what is derived from it, with colour and live value. Follows a device through changes of
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

    /// All outlive this.
    TraceModel(Session &session, const Monitor &monitor, TraceColors &colors, QObject *parent = nullptr);

    bool add(const TraceKey &key); ///< false if it is there already, or names nothing
    void remove(int row);
    int indexOf(const TraceKey &key) const; ///< row; −1 where it isn't here
    const TraceKey &key(int row) const { return m_traces[static_cast<std::size_t>(row)].key; }
    const Watch &watch(int row) const { return key(row).watch; }
    std::vector<TraceKey> keys() const;
    std::vector<Watch> watches() const; ///< of those that aren't derived
    std::set<Watch> needed() const;     ///< all that has to be watched for them
    /// A trace for which this one makes sense beside it: Goal for Present, and the other way round, of one device.
    std::optional<TraceKey> goalLessPresent(int row) const;
    /// May the second be taken from the first: are they in one unit?
    bool areComparable(const Watch &one, const Watch &other) const;
    /// How raw values of this row are counted in its source's unit: physical = raw × scale + offset.
    struct Linear {
        double scale = 1, offset = 0;
        int decimals = 0;
        QString unit;
    };
    Linear scaleOf(int row) const; ///< of its own raw values
    const Linear &sourceScale(int row) const { return m_traces[static_cast<std::size_t>(row)].source; }
    bool isVisible(int row) const { return m_traces[static_cast<std::size_t>(row)].visible; }
    void setVisible(int row, bool visible);
    int colorIndex(int row) const { return m_traces[static_cast<std::size_t>(row)].color; }
    void setColorIndex(int row, int color);

    void setUnits(const UnitPreferences &units);

    /// For drawing, in the order of rows.
    std::vector<TraceData> drawn(const QPalette &palette) const;
    /// Makes what is derived of the samples that have come. The time of the first that is new; nothing where none is.
    std::optional<LineTime> derive(std::size_t &budget);
    const History *history(int row) const { return historyOf(m_traces[static_cast<std::size_t>(row)]); }
    /// For who may outlive the row; nullptr: the monitor's is the one.
    std::shared_ptr<const DerivedHistory> derivedHistory(int row) const;
    /// Looks at the newest values, and announces those whose text changed.
    void refreshValues();

    int rowCount(const QModelIndex &parent = {}) const override;
    QVariant data(const QModelIndex &index, int role) const override;
    bool setData(const QModelIndex &index, const QVariant &value, int role) override;
    Qt::ItemFlags flags(const QModelIndex &index) const override;

private:
    struct Trace {
        TraceKey key;
        int color = 0;
        bool visible = true;
        QString device;
        QString field;
        bool gone = false;
        EffectiveField effective; ///< as it was last known: its device may be gone
        int resolution = 4096;
        Linear source; ///< what it is derived from, in the chosen units
        std::shared_ptr<DerivedHistory> derived; ///< none: it is drawn from the monitor's history
        double scale = 1;
        double offset = 0;
        int decimals = 0;
        QString unit;
        QString value; ///< as shown
    };

    void describe(Trace &trace) const;
    void measure(Trace &trace) const;
    void relate(Trace &trace) const;
    QString nameOf(const TraceKey &key) const;
    const History *historyOf(const Trace &trace) const;
    bool isSilent(const Trace &trace) const;
    void updateDevice(Device *device);
    void onDeviceGone(Device *device);
    void onDeviceBack(Device *device);
    void follow(Device *device);

    Session &m_session;
    const Monitor &m_monitor;
    TraceColors &m_colors;
    UnitPreferences m_units;
    std::vector<Trace> m_traces;
};

} // namespace dynascope
