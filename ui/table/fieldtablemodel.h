// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/table/changetracker.h"
#include "ui/table/comparison.h"
#include "ui/table/registerrows.h"
#include "ui/table/tableactions.h"
#include "ui/table/tableroles.h"

#include <QAbstractItemModel>
#include <QTimer>

namespace dynascope {

/// The control tables of devices: groups, and in them one row per register, by its name. Raw values only;
/// FieldWordsModel says them in words. One device: a column for its raw value and one for what it means; several, of
/// any models: one column each, and in front of them one for all. GUI thread.
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

    void setDevices(const std::vector<Device *> &devices); ///< they may die
    const std::vector<Device *> &devices() const { return m_devices; }
    const std::vector<FieldGroup> &groups() const { return m_rows.groups(); }
    void setLive(bool live);
    /// The devices an edit in this column writes to: its own, or all of them.
    std::vector<Device *> targets(int column) const;
    /// What this cell's value is in the column for all, where something is known that means it there.
    std::optional<std::int64_t> forAll(const QModelIndex &cell) const;
    void refreshWatches(); ///< what isWatched says may have changed
    void refreshMarks();   ///< what ramState says may have changed

    Column columnAt(int section) const { return m_columns[static_cast<std::size_t>(section)]; }
    int columnOf(ColumnKind kind, int device = 0) const; ///< −1 where there is none
    int mainValueColumn() const; ///< the one device's value in words, or the first of several
    QModelIndex indexOf(int row, int column) const; ///< of RegisterRows
    int rowOf(const QString &name) const;           ///< −1 where no device has it
    std::vector<Watch> watches(const QModelIndexList &rows) const; ///< of all devices that have them

    QModelIndex index(int row, int column, const QModelIndex &parent = {}) const override;
    QModelIndex parent(const QModelIndex &child) const override;
    int rowCount(const QModelIndex &parent = {}) const override;
    int columnCount(const QModelIndex &parent = {}) const override;
    QVariant data(const QModelIndex &index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override; ///< KindRole
    Qt::ItemFlags flags(const QModelIndex &index) const override;
    /// EditRole: a raw value, which is written, not shown: the servo's answer is. Nothing is sent to a device that has
    /// it already. In the column for all it is what the first device that has the register calls it; each gets what
    /// means that, or, where one can't be written, none anything: refused(). CheckStateRole in the plot's column:
    /// plotRequested() or unplotRequested().
    bool setData(const QModelIndex &index, const QVariant &value, int role) override;
    QStringList mimeTypes() const override;
    QMimeData *mimeData(const QModelIndexList &indexes) const override;
    Qt::DropActions supportedDragActions() const override { return Qt::CopyAction; }

signals:
    void plotRequested(const dynascope::Watch &watch);
    void unplotRequested(const dynascope::Watch &watch);
    void updated(); ///< once after each frame's changes
    void refused(const QString &why); ///< an edit of all devices: nothing was written
    /// An edit of a register that only may be tried (Field::mayBeTried): nothing is written unless a person insists.
    void confirmationWanted(const std::vector<dynascope::Device *> &devices, int field, qint64 raw);
    /// An edit of which a person should know more first (TableActions::writeSafely).
    void consequencesWanted(const std::vector<dynascope::Device *> &devices, int field, qint64 raw);

private:
    int rowOf(const QModelIndex &index) const; ///< −1 for groups
    Device &deviceAt(int device) const { return *m_devices[static_cast<std::size_t>(device)]; }
    const Field &field(int row, int device) const; ///< another device's where it has none
    const FieldValue &value(int row, int device) const;
    ComparedCell compared(int row, int device) const;
    QVariant rowData(int row, const Column &column, int role) const;
    QVariant valueData(int row, int device, int role) const;
    QVariant allData(int row, int role) const;
    QString absence(int row, int device) const; ///< empty where the device has the register
    QString lockOfAll(int row) const;
    bool isMixed(int row) const;
    QStringList addresses(int row) const;
    std::optional<std::int64_t> pointsAt(int row, int device) const;
    RamState ramState(int row, const Column &column) const;
    bool differs(int row, int device) const;
    bool isChangedFromDefault(int row, int device) const;
    Qt::CheckState watched(int row) const;
    bool setPlotted(int row, bool on);
    bool write(int row, const std::vector<std::pair<int, std::int64_t>> &wanted);
    bool writeAll(int row, std::int64_t raw);
    bool isToBeAsked(int row, int device, std::int64_t raw) const;
    void refreshColumn(ColumnKind kind);
    int firstValueColumn() const;
    int lastValueColumn() const;
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
    RegisterRows m_rows;
    std::vector<char> m_dirty; ///< by row
    bool m_live = true;
};

} // namespace dynascope
