// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/commission/commissiontexts.h"

#include "ui/common/texts.h"

#include <QBuffer>
#include <QCoreApplication>
#include <QPageLayout>
#include <QPageSize>
#include <QPdfWriter>
#include <QSaveFile>
#include <QTextDocument>

namespace dynascope {

namespace {

constexpr int PdfResolution = 300; ///< dots per inch

struct CommissionTexts {
    Q_DECLARE_TR_FUNCTIONS(CommissionTexts)
};

QString placeOf(int id, int baudRate)
{
    return CommissionTexts::tr("ID %1 at %2").arg(QString::number(id), baudText(baudRate));
}

QString jointOf(const CommissionJoint &joint)
{
    return joint.name.isEmpty() ? CommissionTexts::tr("ID %1").arg(joint.place.id)
                                : CommissionTexts::tr("%1, ID %2").arg(joint.name).arg(joint.place.id);
}

QString row(const QStringList &cells, const QString &tag)
{
    QString html;
    for (const QString &cell : cells)
        html += QStringLiteral("<%1 align=\"left\">%2</%1>").arg(tag, cell.toHtmlEscaped());
    return QStringLiteral("<tr>%1</tr>").arg(html);
}

Result<void> save(const QString &path, const QByteArray &bytes)
{
    QSaveFile file(path);
    if (file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size() && file.commit())
        return {};
    return failure(ErrorKind::BadFile, CommissionTexts::tr("%1 can't be written: %2").arg(path, file.errorString()));
}

} // namespace

QString commissionSentence(const Commissioning &commissioning)
{
    const CommissionList &list = commissioning.list();
    const auto next = list.next();
    const auto done = static_cast<int>(list.count(CommissionState::Done));
    if (!next) {
        const auto skipped = static_cast<int>(list.count(CommissionState::Skipped));
        return skipped == 0 ? CommissionTexts::tr("All %1 servos are done").arg(done)
                            : CommissionTexts::tr("%1 servos are done, %2 skipped").arg(done).arg(skipped);
    }
    const QString who = jointOf(list.joint(*next));
    if (commissioning.state() != Commissioning::State::Running)
        return CommissionTexts::tr("Paused before %1").arg(who);
    if (const auto settingUp = commissioning.settingUp())
        return CommissionTexts::tr("Setting up %1: leave it plugged in").arg(jointOf(list.joint(*settingUp)));
    if (!commissioning.problem().isEmpty())
        return commissioning.found() ? CommissionTexts::tr("This servo can't become %1").arg(who)
                                     : CommissionTexts::tr("Unplug one: one at a time");
    if (!commissioning.memory().hasLooked)
        return CommissionTexts::tr("Looking who is there already");
    return CommissionTexts::tr("Plug in the servo for %1").arg(who);
}

QString commissionDetail(const Commissioning &commissioning, const Catalog &catalog)
{
    const CommissionList &list = commissioning.list();
    const auto &found = commissioning.found();
    if (found && (commissioning.settingUp() || !commissioning.problem().isEmpty())) {
        return CommissionTexts::tr("Found: %1 with firmware %2, %3")
            .arg(modelName(catalog, found->modelNumber), QString::number(found->firmware),
                 placeOf(found->id, found->baudRate));
    }
    const auto next = list.next();
    if (!next)
        return CommissionTexts::tr("Save the list of labels, or print it from a PDF");
    const CommissionJoint &joint = list.joint(*next);
    const QString what = CommissionTexts::tr("It is to be model %1, and gets %2")
                             .arg(modelName(catalog, joint.modelNumber), baudText(joint.place.baudRate));
    if (commissioning.lookingAt() == 0)
        return what;
    return CommissionTexts::tr("%1. Looking at %2…").arg(what, baudText(commissioning.lookingAt()));
}

QString bystanderText(const Commissioning &commissioning, const Catalog &catalog)
{
    const auto &bystanders = commissioning.memory().bystanders;
    if (bystanders.empty())
        return {};
    QStringList who;
    for (const CommissionMemory::Device &device : bystanders)
        who << CommissionTexts::tr("%1 (%2)").arg(modelName(catalog, device.modelNumber),
                                                  placeOf(device.place.id, device.place.baudRate));
    if (who.size() > 3)
        return CommissionTexts::tr("%1 devices were there before; they are left alone.").arg(who.size());
    return CommissionTexts::tr("There before, and left alone: %1.").arg(who.join(QStringLiteral(", ")));
}

Result<void> saveLabelsPdf(const CommissionList &list, const Catalog &catalog, const QString &title,
                           const QString &path)
{
    QString rows = row(labelHeads(), QStringLiteral("th"));
    for (const QStringList &cells : labelRows(list, catalog))
        rows += row(cells, QStringLiteral("td"));
    QTextDocument document;
    document.setHtml(QStringLiteral("<h2>%1</h2><table border=\"1\" cellspacing=\"0\" cellpadding=\"4\" "
                                    "style=\"border-collapse:collapse\">%2</table>")
                         .arg(title.toHtmlEscaped(), rows));
    QBuffer buffer;
    buffer.open(QIODevice::WriteOnly);
    {
        QPdfWriter writer(&buffer);
        writer.setResolution(PdfResolution);
        writer.setPageSize(QPageSize(QPageSize::A4));
        writer.setTitle(title);
        document.print(&writer);
    }
    return save(path, buffer.data());
}

Result<void> saveLabelsCsv(const CommissionList &list, const Catalog &catalog, const QString &path)
{
    return save(path, labelsCsv(list, catalog));
}

} // namespace dynascope
