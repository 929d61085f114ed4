// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QSortFilterProxyModel>

namespace dynascope {

class ProfileModel;

/// All joints, and of their registers those that are not as wanted, or were not before.
class ProfileFilter : public QSortFilterProxyModel
{
    Q_OBJECT

public:
    explicit ProfileFilter(ProfileModel &model, QObject *parent = nullptr);
    void setOnlyDifferences(bool only);

protected:
    bool filterAcceptsRow(int row, const QModelIndex &parent) const override;

private:
    bool m_isOnlyDifferences = true;
};

} // namespace dynascope
