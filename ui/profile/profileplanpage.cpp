// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/profile/profileplanpage.h"

#include "ui/common/texts.h"
#include "ui/common/theme.h"
#include "ui/profile/profiletexts.h"

#include <QCheckBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QTreeWidget>
#include <QVBoxLayout>

#include <algorithm>

namespace dynascope {
namespace {

enum Column { What, Now, Then, Where, Columns };
constexpr int Gap = 16;           ///< behind the widest text of a column
constexpr int PlanRowHeight = 22; ///< as of the joints and registers
constexpr int Widest = 280;       ///< of a column: what is wider is whole in its tool tip

} // namespace

ProfilePlanPage::ProfilePlanPage(QWidget *parent)
    : QWidget(parent)
    , m_steps(new QTreeWidget(this))
    , m_move(addOption("moveJoints", tr("&Move joints that are at another baud rate"),
                       tr("One after the other, each found again at its new rate before the next")))
    , m_torqueOff(addOption("turnTorqueOff", tr("Turn &torque off where it locks what is written"),
                            tr("What these servos hold may fall")))
    , m_torqueBack(addOption("putTorqueBack", tr("Torque &back on afterwards"),
                             tr("Where it was turned off for this and all went well, with the goal where the joint "
                                "then is")))
{
    auto *title = new QLabel(tr("What will be &written, in this order"), this);
    title->setBuddy(m_steps);
    m_steps->setObjectName(QStringLiteral("profileSteps"));
    m_steps->setAccessibleName(tr("What will be written"));
    m_steps->setColumnCount(Columns);
    m_steps->setHeaderLabels({tr("Step"), tr("Now"), tr("Will be"), tr("Kept in")});
    m_steps->setSelectionMode(QAbstractItemView::NoSelection);
    m_steps->setUniformRowHeights(true);
    m_steps->setTextElideMode(Qt::ElideRight);
    auto *options = new QHBoxLayout;
    options->setSpacing(24);
    options->addWidget(m_move);
    options->addWidget(m_torqueOff);
    options->addWidget(m_torqueBack);
    options->addStretch(1);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(8);
    layout->addWidget(title);
    layout->addWidget(m_steps, 1);
    layout->addSpacing(4);
    layout->addLayout(options);
}

QCheckBox *ProfilePlanPage::addOption(const char *name, const QString &text, const QString &toolTip)
{
    auto *box = new QCheckBox(text, this);
    box->setObjectName(QLatin1String(name));
    box->setToolTip(toolTip);
    connect(box, &QCheckBox::toggled, this, &ProfilePlanPage::changed);
    return box;
}

ProfileApplyOptions ProfilePlanPage::options() const
{
    ProfileApplyOptions options;
    options.mayTurnTorqueOff = m_torqueOff->isChecked();
    options.putTorqueBack = options.mayTurnTorqueOff && m_torqueBack->isChecked();
    options.joints = m_joints;
    return options;
}

bool ProfilePlanPage::moves() const
{
    return m_move->isChecked() && !m_away.empty();
}

void ProfilePlanPage::show(const ProfileRun &run, const std::set<std::size_t> &joints)
{
    m_joints = joints;
    m_away.clear();
    if (run.comparison()) {
        for (const JointComparison &joint : run.comparison()->joints) {
            if (joint.state == JointComparison::State::AtOtherBaud && joints.contains(joint.joint))
                m_away.insert(joint.joint);
        }
    }
    m_planned = run.planFor(options(), moves());
    m_writes = m_planned ? m_planned->writes.differences() : 0;
    const bool isTorqueAsked = (m_planned && m_planned->writes.needsTorqueOff()) || moves();
    m_move->setVisible(!m_away.empty());
    m_torqueOff->setVisible(isTorqueAsked || m_torqueOff->isChecked());
    m_torqueBack->setVisible(m_torqueOff->isVisibleTo(this));
    m_torqueBack->setEnabled(m_torqueOff->isChecked());
    fill(run);
}

void ProfilePlanPage::fill(const ProfileRun &run)
{
    m_steps->clear();
    if (!m_planned || !run.comparison())
        return;
    addMoves(m_planned->moves);
    for (const JointApply &joint : m_planned->writes.joints)
        addJoint(joint, run.comparison()->joints[joint.joint]);
    m_steps->expandAll();
    for (const int column : {What, Now, Then}) {
        m_steps->resizeColumnToContents(column);
        m_steps->setColumnWidth(column, std::min(m_steps->columnWidth(column) + Gap, Widest));
    }
}

void ProfilePlanPage::addMoves(const MovePlan &plan)
{
    for (const MoveStep &step : plan.steps) {
        auto *item = new QTreeWidgetItem(m_steps); // which owns it
        item->setText(What, tr("Move %1").arg(plan.devices[step.device].place.name));
        item->setFont(What, boldened(font()));
        item->setSizeHint(Where, QSize(0, PlanRowHeight));
        item->setText(Now, step.isBaud() ? baudText(step.from.baudRate) : tr("ID %1").arg(step.from.id));
        item->setText(Then, step.isBaud() ? baudText(step.to.baudRate) : tr("ID %1").arg(step.to.id));
        item->setText(Where, tr("EEPROM; then what differs there"));
        item->setToolTip(Where, tr("Its registers are read once it is there, and those that are not as wanted written"));
    }
}

void ProfilePlanPage::addJoint(const JointApply &joint, const JointComparison &comparison)
{
    auto *item = new QTreeWidgetItem(m_steps); // which owns it
    item->setText(What, joint.name);
    item->setText(Now, profilePlaceText(joint.table->model(), joint.found.id, joint.found.baudRate));
    item->setFont(What, boldened(font()));
    item->setSizeHint(Where, QSize(0, PlanRowHeight));
    if (joint.needsTorqueOff)
        addStep(*item, tr("Torque off"), tr("On"), tr("Off"), {});
    addWrites(*item, joint, comparison);
    if (!joint.resets.isEmpty())
        addStep(*item, joint.resets.size() == 1 ? tr("1 more is reset") : tr("%1 more are reset").arg(joint.resets.size()),
                joint.resets.join(tr(", ")), tr("their defaults"), {});
    if (joint.needsTorqueOff && options().putTorqueBack)
        addStep(*item, tr("Goal where it is, torque on"), tr("Off"), tr("On"), {});
}

void ProfilePlanPage::addWrites(QTreeWidgetItem &under, const JointApply &joint, const JointComparison &comparison)
{
    QMap<QString, QString> resetBy;
    for (const SettingsStep &step : joint.settings.steps) {
        const Field *field = joint.table->at(step.where.address);
        const auto row = std::ranges::find(comparison.rows, field ? joint.table->indexOf(field) : -1,
                                           &RegisterComparison::field);
        if (row == comparison.rows.end() || !row->wanted || !row->held)
            continue;
        const auto text = [&](const ProfileValue &value, const EffectiveField &as) {
            return profileValueText(*joint.table, *field, as, value.raw, m_units);
        };
        const QString where = field->area == Area::Eeprom ? tr("EEPROM") : tr("RAM, until power-off");
        const bool differs = row->state == RegisterComparison::State::Differs;
        if (differs)
            addStep(under, field->name, text(*row->held, row->heldAs), text(*row->wanted, row->wantedAs), where);
        else if (resetBy.contains(field->name))
            addStep(under, field->name, tr("as %1 leaves it").arg(resetBy[field->name]),
                    text(*row->wanted, row->wantedAs), where);
        for (const QString &name : differs ? field->resets : QStringList())
            resetBy[name] = field->name;
    }
}

void ProfilePlanPage::addStep(QTreeWidgetItem &under, const QString &what, const QString &now, const QString &then,
                              const QString &where)
{
    auto *item = new QTreeWidgetItem(&under); // which owns it
    const QStringList texts{what, now, then, where};
    item->setSizeHint(Where, QSize(0, PlanRowHeight));
    for (int column = 0; column < Columns; ++column) {
        item->setText(column, texts[column]);
        item->setToolTip(column, plainToolTip(texts[column]));
    }
}

QStringList ProfilePlanPage::underTorque() const
{
    QStringList names;
    if (!m_planned || m_torqueOff->isChecked())
        return names;
    for (const JointApply &joint : m_planned->writes.joints) {
        if (joint.needsTorqueOff)
            names << joint.name;
    }
    return names;
}

QStringList ProfilePlanPage::obstacles() const
{
    QStringList texts;
    if (!m_planned)
        return texts;
    for (const JointObstacle &obstacle : m_planned->writes.obstacles) {
        if (!moves() || !m_away.contains(obstacle.joint))
            texts << tr("%1: %2").arg(obstacle.name, obstacle.why);
    }
    return texts;
}

} // namespace dynascope
