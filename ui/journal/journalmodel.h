// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/journal/journal.h"

#include <QAbstractTableModel>

#include <set>

namespace dynascope {

class Catalog;

enum class JournalColumn { Number, Time, By, Device, Register, Change, State };
constexpr int JournalColumns = 7;

/// The journal's newest entries, the newest first. Follows it a few times a second.
class JournalModel : public QAbstractTableModel
{
    Q_OBJECT

public:
    /// Both outlive this.
    JournalModel(const Journal &journal, const Catalog &catalog, QObject *parent = nullptr);

    int rowCount(const QModelIndex &parent = {}) const override;
    int columnCount(const QModelIndex &parent = {}) const override;
    QVariant data(const QModelIndex &index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

    qint64 numberAt(int row) const;
    int rowOf(qint64 number) const; ///< −1 where it isn't shown
    void refresh();

private:
    QString text(const JournalEntry &entry, JournalColumn column) const;
    QString stateText(const JournalEntry &entry) const;
    static QString authorText(JournalAuthor author);
    static QString kindText(JournalKind kind);
    void insertNewest(std::vector<JournalEntry> entries, int added);

    const Journal &m_journal;
    const Catalog &m_catalog;
    std::vector<JournalEntry> m_entries; ///< as of the last refresh, the newest first
    std::set<qint64> m_undone;
    QTimer m_timer;
};

} // namespace dynascope
