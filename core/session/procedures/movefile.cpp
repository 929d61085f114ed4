// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/procedures/movefile.h"
#include "core/session/texts.h"

#include <QCryptographicHash>
#include <QDir>
#include <QFile>
#include <QSaveFile>
#include <QStandardPaths>

#include <set>

namespace dynascope {
namespace {

constexpr qint64 LargestPlan = 1024 * 1024;

} // namespace

MoveFile::MoveFile(const QString &folder, const QString &line, const QString &adapter)
{
    if (folder.isEmpty())
        return;
    // An adapter keeps its plan wherever it is plugged in.
    const QByteArray name = (adapter.isEmpty() ? line : adapter).toUtf8();
    const QByteArray hash = QCryptographicHash::hash(name, QCryptographicHash::Sha1).toHex().left(16);
    m_path = QStringLiteral("%1/moves-%2.json").arg(folder, QString::fromLatin1(hash));
}

QString MoveFile::usualFolder()
{
    const QString data = QStandardPaths::writableLocation(QStandardPaths::GenericDataLocation);
    return data.isEmpty() ? QString() : data + QStringLiteral("/dynascope/moves");
}

bool MoveFile::exists() const
{
    return !m_path.isEmpty() && QFile::exists(m_path);
}

Result<MovePlan> MoveFile::load() const
{
    QFile file(m_path);
    if (m_path.isEmpty() || !file.open(QIODevice::ReadOnly))
        return failure(ErrorKind::NotFound, ProcedureText::tr("No moves were left half done on this line"));
    return movePlanFromJson(file.read(LargestPlan + 1));
}

Result<void> MoveFile::save(const MovePlan &plan) const
{
    if (m_path.isEmpty())
        return {};
    if (plan.isOver()) {
        remove();
        return {};
    }
    QSaveFile file(m_path);
    const QByteArray json = toJson(plan);
    QDir().mkpath(QFileInfo(m_path).path());
    if (!file.open(QIODevice::WriteOnly) || file.write(json) != json.size() || !file.commit()) {
        return failure(ErrorKind::BadFile,
                       ProcedureText::tr("the plan can't be kept in %1 (%2), and without it nothing is moved")
                           .arg(m_path, file.errorString()));
    }
    return {};
}

void MoveFile::remove() const
{
    if (!m_path.isEmpty())
        QFile::remove(m_path);
}

QString unfinishedText(const MovePlan &plan)
{
    if (plan.isOver())
        return {};
    const MoveStep &step = plan.steps[plan.next];
    std::set<std::size_t> movers;
    for (const MoveStep &each : plan.steps)
        movers.insert(each.device);
    const QString &name = plan.devices[step.device].place.name;
    const QString where = ProcedureText::tr("%1 or at %2").arg(placeText(step.from), placeText(step.to));
    const QString what = movers.size() == 1 ? ProcedureText::tr("a move of a device")
                                            : ProcedureText::tr("a move of %1 devices").arg(movers.size());
    if (plan.next == 0)
        return ProcedureText::tr("%1 was interrupted at the first of %2 steps: %3 is at %4")
            .arg(what)
            .arg(plan.steps.size())
            .arg(name, where);
    return ProcedureText::tr("%1 was interrupted after step %2 of %3: %4 is at %5")
        .arg(what)
        .arg(plan.next)
        .arg(plan.steps.size())
        .arg(name, where);
}

} // namespace dynascope
