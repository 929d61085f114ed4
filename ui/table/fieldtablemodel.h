// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/table/changetracker.h"
#include "ui/table/fieldgroups.h"
#include "ui/table/tableactions.h"
#include "ui/table/tableroles.h"

#include <QAbstractItemModel>
#include <QTimer>

namespace dynascope {

/// The control tables of devices of one model: groups, and in them one row per register. Raw values only;
/// FieldWordsModel says them in words. One device: a column for its raw value and one for what it means; several: one
/// column each. GUI thread.
///
/// What devices report is collected and told once a frame, as a few ranges; while not live not at all, until
/// setLive(true).
class FieldTableModel : public QAbstractItemModel
{
    Q_OBJECT

public:
    static constexpr int FrameMs = 33;

    struct Column {
        ColumnKind kind = ColumnKind::Name;
        int device = 0; ///< of value columns
    };

    explicit FieldTableModel(TableActions actions, ChangeTracker::Clock clock = {}, QObject *parent = nullptr);

    void setDevices(const std::vector<Device *> &devices); ///< of one model; they may die
    const std::vector<Device *> &devices() const { return m_devices; }
    const std::vector<FieldGroup> &groups() const { return m_groups; }
    void setLive(bool live);
    /// An edit goes to all devices, not only to that of the column.
    void setEditsAll(bool all) { m_editsAll = all; }
    bool editsAll() const { return m_editsAll; }
    /// The devices an edit in this column writes to.
    std::vector<Device *> targets(int column) const;
    void refreshWatches(); ///< what isWatched says may have changed
    void refreshMarks();   ///< what ramState says may have changed

    Column columnAt(int section) const { return m_columns[static_cast<std::size_t>(section)]; }
    int columnOf(ColumnKind kind, int device = 0) const; ///< −1 where there is none
    QModelIndex indexOf(int field, int column) const;
    std::vector<Watch> watches(const QModelIndexList &rows) const; ///< of all devices; groups count for nothing

    QModelIndex index(int row, int column, const QModelIndex &parent = {}) const override;
    QModelIndex parent(const QModelIndex &child) const override;
    int rowCount(const QModelIndex &parent = {}) const override;
    int columnCount(const QModelIndex &parent = {}) const override;
    QVariant data(const QModelIndex &index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override; ///< KindRole
    Qt::ItemFlags flags(const QModelIndex &index) const override;
    /// EditRole: a raw value, which is written, not shown: the servo's answer is. Nothing is sent to a device that has
    /// it already. CheckStateRole in the plot's column: plotRequested() or unplotRequested().
    bool setData(const QModelIndex &index, const QVariant &value, int role) override;
    QStringList mimeTypes() const override;
    QMimeData *mimeData(const QModelIndexList &indexes) const override;
    Qt::DropActions supportedDragActions() const override { return Qt::CopyAction; }

signals:
    void plotRequested(const dynascope::Watch &watch);
    void unplotRequested(const dynascope::Watch &watch);
    void updated(); ///< once after each frame's changes
    /// An edit of a register that only may be tried (Field::mayBeTried): nothing is written unless a person insists.
    void confirmationWanted(const std::vector<dynascope::Device *> &devices, int field, qint64 raw);
    /// An edit of which a person should know more first (TableActions::writeSafely).
    void consequencesWanted(const std::vector<dynascope::Device *> &devices, int field, qint64 raw);

private:
    int fieldOf(const QModelIndex &index) const; ///< −1 for groups
    const Field &field(int index) const { return m_devices.front()->table().fields()[static_cast<std::size_t>(index)]; }
    QVariant fieldData(int field, const Column &column, int role) const;
    QVariant valueData(int field, int device, int role) const;
    std::optional<std::int64_t> pointsAt(int field, const Device &device) const;
    bool differs(int field, int device) const;
    bool isChangedFromDefault(int field, int device) const;
    bool isToBeAsked(const Device &device, int field, std::int64_t raw) const;
    Qt::CheckState watched(int field) const;
    RamState ramState(int field, const Column &column) const;
    void refreshColumn(ColumnKind kind);
    void note(int device, int first, int last);
    void flush();
    void emitRows(int group, const std::vector<char> &dirty, int firstColumn, int lastColumn);
    void emitEverything();
    void deviceGone(QObject *device);

    TableActions m_actions;
    ChangeTracker m_tracker;
    QTimer m_frame;
    std::vector<Device *> m_devices;
    std::vector<Column> m_columns;
    std::vector<FieldGroup> m_groups;
    std::set<int> m_deciding;
    std::vector<char> m_dirty; ///< by field
    bool m_live = true;
    bool m_editsAll = false;
};

} // namespace dynascope
