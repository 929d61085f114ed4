// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QSortFilterProxyModel>

namespace dynascope {

/// Leaves the registers that match every word of the search and every filter that is on; groups stay with what is left
/// of them.
class FieldFilterModel : public QSortFilterProxyModel
{
    Q_OBJECT

public:
    explicit FieldFilterModel(QObject *parent = nullptr);

    void setSearch(const QString &text); ///< in name and help; a number is an address, too
    void setOnlyChanged(bool on);        ///< from default, on any device
    void setOnlyWritable(bool on);
    void setOnlyWatched(bool on);
    void setOnlyDifferent(bool on);      ///< between the devices
    void setOnlySetHere(bool on);        ///< in this session, and gone with the power
    bool isFiltering() const;

protected:
    bool filterAcceptsRow(int row, const QModelIndex &parent) const override;

private:
    QStringList m_words;
    bool m_changed = false;
    bool m_writable = false;
    bool m_watched = false;
    bool m_different = false;
    bool m_setHere = false;
};

} // namespace dynascope
