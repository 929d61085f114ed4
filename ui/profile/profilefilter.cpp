// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/profile/profilefilter.h"

#include "ui/profile/profilemodel.h"

namespace dynascope {

ProfileFilter::ProfileFilter(ProfileModel &model, QObject *parent) : QSortFilterProxyModel(parent)
{
    setDynamicSortFilter(true);
    setSourceModel(&model);
}

void ProfileFilter::setOnlyDifferences(bool only)
{
    m_isOnlyDifferences = only;
    invalidateFilter();
}

bool ProfileFilter::filterAcceptsRow(int row, const QModelIndex &parent) const
{
    if (!parent.isValid() || !m_isOnlyDifferences)
        return true;
    const auto *model = static_cast<const ProfileModel *>(sourceModel());
    using Kind = ProfileModel::Kind;
    const Kind kind = model->kind(model->index(row, 0, parent));
    const Kind joint = model->kind(parent);
    // Of a joint that can't be read nothing is known, and nothing to be seen.
    return kind != Kind::Same && !(kind == Kind::Unknown && joint == Kind::Problem);
}

} // namespace dynascope
