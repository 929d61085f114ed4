// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/profile/profiletexts.h"

#include "ui/common/texts.h"

#include <QCoreApplication>
#include <QFileInfo>

namespace dynascope {
namespace {

/// The context of what is translated here.
class Texts
{
    Q_DECLARE_TR_FUNCTIONS(Profile)
};

QString jointsText(std::size_t count)
{
    return count == 1 ? Texts::tr("1 joint") : Texts::tr("%1 joints").arg(count);
}

QString registersText(std::size_t count)
{
    return count == 1 ? Texts::tr("1 register") : Texts::tr("%1 registers").arg(count);
}

QString differencesText(std::size_t count)
{
    return count == 1 ? Texts::tr("1 difference") : Texts::tr("%1 differences").arg(count);
}

} // namespace

QString profileValueText(const ControlTable &table, const Field &field, const EffectiveField &as, std::int64_t raw,
                         const UnitPreferences &units)
{
    const QString number = QString::number(raw);
    QString text = withBaudTexts(valueText(field, as, table.resolution(), raw, units));
    if (text == number || units.raw)
        return withMinus(number);
    if (text.startsWith(u'-')) // names keep their hyphens
        text.replace(0, 1, QChar(0x2212));
    return Texts::tr("%1 (%2)").arg(text, withMinus(number));
}

QString profilePlaceText(const QString &model, int id, int baudRate)
{
    return Texts::tr("%1, ID %2, %3").arg(model).arg(id).arg(baudText(baudRate));
}

QString jointStateText(const ProfileJoint &wanted, const JointComparison &joint)
{
    using State = JointComparison::State;
    const std::size_t others = joint.rows.size() - joint.count(RegisterComparison::State::Same);
    switch (joint.state) {
    case State::AsWanted: return Texts::tr("As wanted");
    case State::Differs: return differencesText(others);
    case State::Missing: return Texts::tr("Not found");
    case State::AtOtherBaud:
        return Texts::tr("Found at %1, wants %2")
            .arg(baudText(joint.found ? joint.found->baudRate : 0), baudText(wanted.baudRate));
    case State::OtherModel: return Texts::tr("Wrong model");
    case State::OldFirmware:
        return Texts::tr("Firmware %1, needs %2").arg(joint.found ? joint.found->firmware : 0).arg(wanted.firmware);
    case State::Unreadable: return Texts::tr("Can't be read");
    case State::Doubtful: return Texts::tr("Two at one ID?");
    }
    return {};
}

QString registerStateText(const RegisterComparison &row)
{
    switch (row.state) {
    case RegisterComparison::State::Same: return Texts::tr("As wanted");
    case RegisterComparison::State::Differs: return Texts::tr("Differs");
    case RegisterComparison::State::NotThere: return Texts::tr("Not in this firmware");
    case RegisterComparison::State::Wrong: return Texts::tr("Can't be so");
    case RegisterComparison::State::Unread: return Texts::tr("Not shown by the device");
    }
    return {};
}

QString comparisonText(const ProfileComparison &comparison)
{
    const std::size_t joints = comparison.joints.size();
    const std::size_t right = comparison.count(JointComparison::State::AsWanted);
    const std::size_t same = comparison.count(RegisterComparison::State::Same);
    const std::size_t differing = comparison.count(RegisterComparison::State::Differs);
    QStringList sentences;
    if (right == joints)
        sentences << Texts::tr("Everything is as wanted: %1, %2.").arg(jointsText(joints), registersText(same));
    else
        sentences << Texts::tr("%1 of %2 as wanted%3.")
                         .arg(right)
                         .arg(jointsText(joints), differing > 0 ? Texts::tr("; %1 in registers").arg(differencesText(differing))
                                                                : QString());
    std::size_t away = 0;
    for (const JointComparison &joint : comparison.joints)
        away += joint.isReadable() && joint.state != JointComparison::State::OldFirmware ? 0 : 1;
    if (away > 0)
        sentences << Texts::tr("%1 can't be set up as they are.").arg(jointsText(away));
    if (!comparison.others.empty())
        sentences << (comparison.others.size() == 1
                          ? Texts::tr("One device is there that no joint names.")
                          : Texts::tr("%1 devices are there that no joint names.").arg(comparison.others.size()));
    for (const QString &note : comparison.notes)
        sentences << asSentence(note);
    return sentences.join(u' ');
}

QString outcomeText(const ProfileRun &run)
{
    if (!run.outcome() || !run.profile())
        return {};
    QStringList sentences, torque;
    std::size_t joints = 0;
    for (std::size_t i = 0; i < run.profile()->joints.size(); ++i) {
        const JointProgress progress = run.jointProgress(i);
        const QString &name = run.profile()->joints[i].name;
        joints += progress.written > 0 ? 1 : 0;
        if (progress.state == JointProgress::State::Failed && !run.outcome()->ended)
            sentences << Texts::tr("%1: %2").arg(name, asSentence(progress.why));
        if (progress.torqueStaysOff)
            torque << name;
    }
    QString first = Texts::tr("%1 of %2 written and read back.")
                        .arg(registersText(run.outcome()->written()), jointsText(joints));
    if (run.moved() > 0)
        first += u' ' + Texts::tr("%1 moved.").arg(jointsText(run.moved()));
    sentences.prepend(first);
    if (!torque.isEmpty())
        sentences << Texts::tr("Torque stays off: %1.").arg(torque.join(Texts::tr(", ")));
    return sentences.join(u' ');
}

QString savedText(const QString &path, const SavedProfile &saved)
{
    QStringList sentences;
    const QString name = QFileInfo(path).fileName();
    QStringList changes;
    if (saved.changedValues > 0)
        changes << (saved.changedValues == 1 ? Texts::tr("1 value changed")
                                             : Texts::tr("%1 values changed").arg(saved.changedValues));
    if (saved.newJoints > 0)
        changes << Texts::tr("%1 added").arg(jointsText(std::size_t(saved.newJoints)));
    if (saved.newRegisters > 0)
        changes << Texts::tr("%1 added").arg(registersText(std::size_t(saved.newRegisters)));
    if (saved.isChanged())
        sentences << Texts::tr("%1 is saved: %2.").arg(name, changes.join(Texts::tr(", ")));
    else
        sentences << Texts::tr("%1 says so already.").arg(name);
    for (const QString &note : saved.notes)
        sentences << asSentence(note);
    return sentences.join(u' ');
}

} // namespace dynascope
