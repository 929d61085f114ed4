// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/moverun.h"

#include <QAbstractListModel>

namespace dynascope {

/// The steps of a plan in words, what becomes unreachable with each, and how far it is.
class MoveStepsModel : public QAbstractListModel
{
    Q_OBJECT

public:
    enum class Progress { ToCome, Present, Done, Failed };

    using QAbstractListModel::QAbstractListModel;

    /// `workingBaud`: where the line works. `problem`: what the step `plan.next` ended with, if it did.
    void setPlan(const MovePlan &plan, int workingBaud, MoveRun::State state, const QString &problem);

    int rowCount(const QModelIndex &parent = {}) const override;
    QVariant data(const QModelIndex &index, int role) const override;
    Progress progress(int row) const;

private:
    QString text(const MoveStep &step) const;

    MovePlan m_plan;
    int m_workingBaud = 0;
    MoveRun::State m_state = MoveRun::State::Idle;
    QString m_problem;
};

} // namespace dynascope
