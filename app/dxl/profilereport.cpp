// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/profilereport.h"

#include "app/dxl/showvalue.h"
#include "core/table/catalog.h"

namespace dynascope::dxl {
namespace {

/// "4000 (351.56 °)", or "800" where that is all.
QString both(const ProfileValue &value)
{
    const QString raw = QString::number(value.raw);
    return value.text == raw ? raw : QStringLiteral("%1 (%2)").arg(raw, value.text);
}

Document valueDocument(const ProfileValue &value)
{
    Document document;
    document.add("raw", qint64(value.raw));
    if (value.unit.isEmpty())
        document.add("value", qint64(value.raw));
    else
        document.add("value", value.value);
    return document.add("unit", value.unit).add("text", value.text);
}

QString rowText(const RegisterComparison &row)
{
    if (row.state == RegisterComparison::State::Differs)
        return QStringLiteral("%1: %2 -> %3").arg(row.name, both(*row.held), both(*row.wanted));
    return QStringLiteral("%1: %2").arg(row.name, row.why);
}

Document rowDocument(const RegisterComparison &row)
{
    Document document;
    document.add("field", row.name)
        .add("state", wordOf(row.state))
        .add("line", qint64(row.line))
        .add("column", qint64(row.column));
    if (row.wanted)
        document.add("wanted", valueDocument(*row.wanted));
    if (row.held)
        document.add("held", valueDocument(*row.held));
    if (!row.why.isEmpty())
        document.add("why", row.why);
    return document;
}

QString plural(std::size_t count, const char *one, const char *many)
{
    return QStringLiteral("%1 %2").arg(count).arg(QLatin1String(count == 1 ? one : many));
}

QString summaryOf(const JointComparison &joint)
{
    using State = JointComparison::State;
    const std::size_t same = joint.count(RegisterComparison::State::Same);
    if (joint.state == State::AsWanted)
        return joint.rows.empty() ? QStringLiteral("as wanted")
                                  : QStringLiteral("as wanted, %1").arg(plural(same, "register", "registers"));
    if (joint.state == State::Differs) {
        return QStringLiteral("%1 of %2 not as wanted")
            .arg(joint.rows.size() - same)
            .arg(plural(joint.rows.size(), "register", "registers"));
    }
    return joint.why;
}

} // namespace

void showJoint(Output &output, const Profile &profile, const JointComparison &joint, bool namesRegisters, bool all)
{
    const ProfileJoint &wanted = profile.joints[joint.joint];
    Document document;
    document.add("joint", joint.name)
        .add("id", qint64(wanted.id))
        .add("baud", qint64(wanted.baudRate))
        .add("model", wanted.model)
        .add("state", wordOf(joint.state));
    if (joint.found)
        document.add("found_baud", qint64(joint.found->baudRate))
            .add("found_model_number", qint64(joint.found->modelNumber))
            .add("firmware", qint64(joint.found->firmware));
    if (!joint.why.isEmpty())
        document.add("why", joint.why);
    QStringList lines;
    std::vector<Document> rows;
    for (const RegisterComparison &row : joint.rows) {
        const bool isSame = row.state == RegisterComparison::State::Same;
        if (all || !isSame)
            rows.push_back(rowDocument(row));
        if (!isSame)
            lines << joint.name + QStringLiteral(": ") + rowText(row);
    }
    document.add("registers", rows);
    const bool isNamed = namesRegisters && !lines.isEmpty();
    output.result(
        isNamed
            ? lines.join(u'\n')
            : QStringLiteral("%1 (%2, ID %3): %4").arg(joint.name, wanted.model).arg(wanted.id).arg(summaryOf(joint)),
        document);
}

void showOther(Output &output, const Catalog &catalog, const Found &found)
{
    const QString model = modelName(catalog, found.modelNumber);
    Document document;
    document.add("state", QStringLiteral("other"))
        .add("id", qint64(found.id))
        .add("baud", qint64(found.baudRate))
        .add("model", model)
        .add("model_number", qint64(found.modelNumber))
        .add("firmware", qint64(found.firmware));
    output.result(
        QStringLiteral("%1 (ID %2 at %3 bps): no joint names it").arg(model).arg(found.id).arg(found.baudRate),
        document);
}

void showPlanned(Output &output, const JointApply &joint, const JointComparison &comparison)
{
    QStringList lines;
    std::vector<Document> rows;
    for (const RegisterComparison &row : comparison.rows) {
        if (row.state != RegisterComparison::State::Differs)
            continue;
        lines << joint.name + QStringLiteral(": ") + rowText(row);
        rows.push_back(rowDocument(row));
    }
    if (!joint.resets.isEmpty())
        lines << joint.name + QStringLiteral(": this resets %1").arg(joint.resets.join(QStringLiteral(", ")));
    if (joint.needsTorqueOff)
        lines << joint.name + QStringLiteral(": torque is on and would go off first");
    Document document;
    document.add("joint", joint.name)
        .add("id", qint64(joint.found.id))
        .add("baud", qint64(joint.found.baudRate))
        .addFlag("needs_torque_off", joint.needsTorqueOff)
        .add("resets", joint.resets)
        .add("registers", rows);
    output.result(lines.join(u'\n'), document);
}

void showApplied(Output &output, const JointApply &joint, const Result<SettingsOutcome> &outcome)
{
    Document document;
    document.add("joint", joint.name).add("id", qint64(joint.found.id)).add("baud", qint64(joint.found.baudRate));
    if (!outcome) {
        output.failedResult(document.add("error", outcome.error().text));
        output.fail({outcome.error().kind, joint.name + QStringLiteral(": ") + outcome.error().text});
        return;
    }
    std::vector<Document> rows;
    QStringList problems;
    for (std::size_t i = 0; i < outcome->results.size(); ++i) {
        const SettingResult &result = outcome->results[i];
        const SettingsStep &step = joint.settings.steps[i];
        if (result.state == SettingState::Same)
            continue;
        Document row;
        row.add("field", step.name).add("address", qint64(step.where.address));
        if (!result.before.empty())
            row.add("old", qint64(RegisterImage::numberOf(step.where, result.before)));
        row.add("new", qint64(RegisterImage::numberOf(step.where, step.to)));
        row.addFlag("written", result.state == SettingState::Written);
        if (!result.why.isEmpty())
            row.add("why", result.why);
        rows.push_back(row);
        if (!result.why.isEmpty())
            problems << QStringLiteral("%1: %2: %3").arg(joint.name, step.name, result.why);
    }
    document.add("registers", rows)
        .addFlag("torque_turned_off", outcome->torqueTurnedOff)
        .addFlag("torque_is_back", outcome->torqueIsBack);
    const std::size_t written = outcome->count(SettingState::Written);
    QString text = QStringLiteral("%1 (ID %2): %3 written and read back")
                       .arg(joint.name)
                       .arg(joint.found.id)
                       .arg(plural(written, "register", "registers"));
    if (outcome->torqueTurnedOff)
        text += outcome->torqueIsBack ? QStringLiteral("; torque is on again") : QStringLiteral("; torque is off now");
    output.result(text, document);
    if (!outcome->torqueNote.isEmpty())
        problems << joint.name + QStringLiteral(": ") + outcome->torqueNote;
    if (outcome->missing != Consent::None)
        problems << joint.name + QStringLiteral(": ") + outcome->why;
    if (outcome->ended)
        problems << joint.name + QStringLiteral(": ") + outcome->ended->text;
    for (const QString &problem : problems)
        output.fail({ErrorKind::NotConfirmed, problem});
}

} // namespace dynascope::dxl
