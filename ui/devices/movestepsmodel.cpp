// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/devices/movestepsmodel.h"

#include "ui/common/icons.h"
#include "ui/common/texts.h"

namespace dynascope {

void MoveStepsModel::setPlan(const MovePlan &plan, int workingBaud, MoveRun::State state, const QString &problem)
{
    const bool isSame = plan.steps.size() == m_plan.steps.size() && !plan.steps.empty();
    if (!isSame)
        beginResetModel();
    m_plan = plan;
    m_workingBaud = workingBaud;
    m_state = state;
    m_problem = problem;
    if (!isSame)
        endResetModel();
    else
        emit dataChanged(index(0), index(rowCount() - 1));
}

int MoveStepsModel::rowCount(const QModelIndex &parent) const
{
    return parent.isValid() ? 0 : static_cast<int>(m_plan.steps.size());
}

MoveStepsModel::Progress MoveStepsModel::progress(int row) const
{
    const auto step = static_cast<std::size_t>(row);
    if (step < m_plan.next)
        return Progress::Done;
    if (step > m_plan.next)
        return Progress::ToCome;
    if (m_state == MoveRun::State::Moving)
        return Progress::Present;
    return m_state == MoveRun::State::Halted && !m_problem.isEmpty() ? Progress::Failed : Progress::ToCome;
}

QString MoveStepsModel::text(const MoveStep &step) const
{
    const QString &name = m_plan.devices[step.device].place.name;
    if (step.isBaud()) {
        const QString from = baudText(step.from.baudRate), to = baudText(step.to.baudRate);
        if (step.to.baudRate == m_workingBaud)
            return tr("%1: %2 → %3, where the line works").arg(name, from, to);
        return tr("%1: %2 → %3. From here on %2 reaches it no more").arg(name, from, to);
    }
    if (step.isDetour) {
        return tr("%1: ID %2 → %3 for a while, so that ID %2 is free").arg(name).arg(step.from.id).arg(step.to.id);
    }
    return tr("%1: ID %2 → %3").arg(name).arg(step.from.id).arg(step.to.id);
}

QVariant MoveStepsModel::data(const QModelIndex &index, int role) const
{
    if (!index.isValid())
        return {};
    const QString step =
        QStringLiteral("%1. %2").arg(index.row() + 1).arg(text(m_plan.steps[static_cast<std::size_t>(index.row())]));
    const Progress how = progress(index.row());
    if (role == Qt::DisplayRole)
        return step;
    if (role == Qt::ToolTipRole)
        return plainToolTip(how == Progress::Failed ? asSentence(m_problem) : step);
    if (role == Qt::AccessibleTextRole) {
        switch (how) {
        case Progress::Done: return tr("%1, done").arg(step);
        case Progress::Present: return tr("%1, under way").arg(step);
        case Progress::Failed: return tr("%1, failed: %2").arg(step, m_problem);
        case Progress::ToCome: return step;
        }
    }
    if (role == Qt::DecorationRole) {
        switch (how) {
        case Progress::Done: return icon(QStringLiteral("success"), IconTint::Good);
        case Progress::Present: return icon(QStringLiteral("play"), IconTint::Accent);
        case Progress::Failed: return icon(QStringLiteral("error"), IconTint::Bad);
        case Progress::ToCome: return icon(QStringLiteral("minus"), IconTint::Dimmed);
        }
    }
    return {};
}

} // namespace dynascope
