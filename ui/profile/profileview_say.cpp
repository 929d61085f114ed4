// SPDX-License-Identifier: GPL-3.0-or-later
// What the view says below its page, and of a button that can't be pressed.
#include "core/session/commands.h"
#include "ui/common/texts.h"
#include "ui/profile/profilemodel.h"
#include "ui/profile/profilenote.h"
#include "ui/profile/profileplanpage.h"
#include "ui/profile/profiletexts.h"
#include "ui/profile/profileview.h"

#include <QProgressBar>

#include <algorithm>

namespace dynascope {

QString ProfileView::whyNotCompare() const
{
    if (m_run.path().isEmpty())
        return tr("Open a robot's profile first.");
    return isOpen() ? QString() : tr("No line is open: connect first.");
}

/// What Apply would do is seen on the next page; here only whether there is anything.
QString ProfileView::whyNotApply() const
{
    if (!m_run.comparison())
        return tr("Compare first: only what differs is written.");
    if (!isOpen())
        return tr("No line is open: connect first.");
    const std::set<std::size_t> chosen = m_model->chosen();
    const auto isToDo = [&chosen](const JointComparison &joint) {
        const bool may = joint.state == JointComparison::State::Differs
                         || joint.state == JointComparison::State::AtOtherBaud;
        return may && chosen.contains(joint.joint);
    };
    if (std::ranges::any_of(m_run.comparison()->joints, isToDo))
        return {};
    return m_run.comparison()->count(JointComparison::State::AsWanted) == m_run.comparison()->joints.size()
               ? tr("Everything is as wanted already.")
               : tr("No joint that is ticked has anything to be written.");
}

QString ProfileView::whyNotWrite() const
{
    const auto &planned = m_plan->planned();
    if (!planned)
        return asSentence(planned.error().text);
    if (!isOpen())
        return tr("The line isn't open now.");
    if (m_workbench.commands.isStopped())
        return tr("STOP is held: release it before a profile is applied.");
    if (const QStringList names = m_plan->underTorque(); !names.isEmpty())
        return tr("Torque of %1 is on and locks what has to be written.").arg(names.join(tr(", ")));
    return planned->isNothing() ? tr("Nothing has to be written.") : QString();
}

void ProfileView::say()
{
    m_progress->setVisible(isBusy());
    const double progress = m_saver.isBusy() ? m_saver.progress() : m_run.progress();
    // Nobody knows how long moves take: it runs to and fro.
    m_progress->setRange(0, m_run.state() == ProfileRun::State::Moving ? 0 : 100);
    m_progress->setValue(static_cast<int>(progress * 100));
    if (isBusy())
        return sayBusy();
    if (m_said)
        return m_note->say(m_said->first, m_said->second);
    m_isPlanning ? sayPlan() : sayCompared();
}

void ProfileView::sayBusy()
{
    QString text = tr("Reading the devices…");
    switch (m_run.state()) {
    case ProfileRun::State::Idle: break;
    case ProfileRun::State::Comparing: text = tr("Comparing: looking for the joints and reading them…"); break;
    case ProfileRun::State::Moving: text = tr("Moving joints to their baud rate. STOP ends it at any time."); break;
    case ProfileRun::State::Applying:
        text = tr("Writing, each value read back. STOP ends it at any time; End Here ends it before the next joint.");
        break;
    }
    m_note->say(MessageKind::Info, text);
}

void ProfileView::sayPlan()
{
    const QString why = whyNotWrite();
    QStringList sentences;
    if (!why.isEmpty())
        sentences << why;
    else
        sentences << (m_plan->moves() ? tr("Joints are moved first, then what differs is written, each value read back.")
                                      : tr("Only these are written, each value read back."));
    for (const QString &obstacle : m_plan->obstacles())
        sentences << tr("Not done: %1.").arg(obstacle);
    m_note->say(!why.isEmpty()                 ? MessageKind::Error
                : m_plan->obstacles().isEmpty() ? MessageKind::Info
                                                : MessageKind::Warning,
                sentences.join(u' '));
}

void ProfileView::sayCompared()
{
    if (m_run.fault())
        return m_note->say(MessageKind::Error, tr("Nothing was written. Put right what is listed, then compare: the "
                                                  "file is read again."));
    if (!m_run.problem().isEmpty())
        return m_note->say(MessageKind::Error, asSentence(m_run.problem()));
    if (!m_run.profile())
        return m_note->say(MessageKind::Info, isOpen() ? QString() : whyNotCompare());
    if (!m_run.comparison())
        return m_note->say(MessageKind::Info, isOpen() ? tr("Compare reads the joints and shows what differs. It writes "
                                                            "nothing.")
                                                       : whyNotCompare());
    const QString outcome = outcomeText(m_run);
    const bool isWell = m_run.comparison()->isAsWanted();
    const QString text = (outcome.isEmpty() ? outcome : outcome + u' ') + comparisonText(*m_run.comparison());
    m_note->say(isWell ? MessageKind::Success : outcome.isEmpty() ? MessageKind::Info : MessageKind::Warning, text);
}

} // namespace dynascope
