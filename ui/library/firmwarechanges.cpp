// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/library/firmwarechanges.h"

#include "core/table/fieldchanges.h"
#include "ui/common/fieldtexts.h"
#include "ui/library/librarytexts.h"

#include <QCoreApplication>

#include <algorithm>

namespace dynascope {
namespace {

constexpr int Newest = 255;

class FirmwareChanges
{
    Q_DECLARE_TR_FUNCTIONS(FirmwareChanges)
};

/// What is said of one range of firmware.
struct Said {
    int from = 0, to = Newest;
    QString text;
};

/// Ranges that follow one another and say the same are one.
void append(std::vector<Said> &all, Said next)
{
    if (!all.empty() && all.back().text == next.text && all.back().to + 1 == next.from)
        all.back().to = next.to;
    else
        all.push_back(std::move(next));
}

/// Registers that follow one another and differ in their number only.
struct Run {
    QString name, stem; ///< "Indirect Data 21", "Indirect Data "
    int first = -1, last = -1;
    int address = 0;
    QString firmware;
};

void append(std::vector<Run> &runs, const QString &name, int address, const QString &firmware)
{
    qsizetype digits = 0;
    while (digits < std::min<qsizetype>(name.size(), 6) && name.at(name.size() - 1 - digits).isDigit())
        ++digits;
    const QString stem = name.chopped(digits);
    const int number = digits > 0 ? name.last(digits).toInt() : -1;
    if (!runs.empty() && number >= 0 && runs.back().stem == stem && runs.back().last + 1 == number
        && runs.back().firmware == firmware)
        runs.back().last = number;
    else
        runs.push_back({name, stem, number, number, address, firmware});
}

/// "without Torque on by goal", "with Overload": what `there` has less and more than `here`.
QStringList lessAndMore(const QStringList &here, const QStringList &there)
{
    QStringList less, more, parts;
    std::ranges::copy_if(here, std::back_inserter(less), [&](const QString &name) { return !there.contains(name); });
    std::ranges::copy_if(there, std::back_inserter(more), [&](const QString &name) { return !here.contains(name); });
    if (!less.isEmpty())
        parts << FirmwareChanges::tr("without “%1”").arg(less.join(QStringLiteral("”, “")));
    if (!more.isEmpty())
        parts << FirmwareChanges::tr("with “%1”").arg(more.join(QStringLiteral("”, “")));
    return parts;
}

template <typename Named>
QStringList namesOf(const std::vector<Named> &all, QString Named::*name)
{
    QStringList names;
    for (const Named &one : all)
        names << one.*name;
    return names;
}

QStringList changesIn(FieldAspect aspect, const Field &here, const Field &there)
{
    switch (aspect) {
    case FieldAspect::Address: return {FirmwareChanges::tr("address %1").arg(there.address)};
    case FieldAspect::Size: return {sizeText(there)};
    case FieldAspect::Area: return {areaText(there.area)};
    case FieldAspect::Access: return {accessText(there)};
    case FieldAspect::Initial:
        return {there.initial ? FirmwareChanges::tr("default %1").arg(numberText(*there.initial))
                              : FirmwareChanges::tr("no default")};
    case FieldAspect::Range: return {FirmwareChanges::tr("range %1").arg(boundsText(there))};
    case FieldAspect::Unit: return {FirmwareChanges::tr("in %1").arg(stepText(there))};
    case FieldAspect::Values:
        return lessAndMore(namesOf(here.values, &EnumValue::text) + namesOf(here.special, &EnumValue::text),
                           namesOf(there.values, &EnumValue::text) + namesOf(there.special, &EnumValue::text));
    case FieldAspect::Bits:
        return lessAndMore(namesOf(here.bits, &BitField::name), namesOf(there.bits, &BitField::name));
    case FieldAspect::Alternates: return {FirmwareChanges::tr("follows other registers in another way")};
    case FieldAspect::Resets: return {FirmwareChanges::tr("resets other registers")};
    }
    return {};
}

} // namespace

QString firmwareText(int from, int to)
{
    if (from <= 0 && to >= Newest)
        return FirmwareChanges::tr("any firmware");
    if (to >= Newest)
        return FirmwareChanges::tr("firmware %1 and newer").arg(from);
    if (from <= 0)
        return FirmwareChanges::tr("firmware %1 and older").arg(to);
    return from == to ? FirmwareChanges::tr("firmware %1").arg(from)
                      : FirmwareChanges::tr("firmware %1 to %2").arg(from).arg(to);
}

QStringList firmwareChanges(const Field &field, const ControlTable &own, const std::vector<ControlTablePtr> &all)
{
    std::vector<Said> said;
    for (const ControlTablePtr &table : all) {
        if (table.get() == &own)
            continue;
        const int from = table->description().firmwareFrom, to = table->description().firmwareTo;
        const Field *there = table->find(field.name);
        if (!there) {
            append(said, {from, to, {}});
            continue;
        }
        QStringList parts;
        for (const FieldAspect aspect : changedAspects(field, *there))
            parts += changesIn(aspect, field, *there);
        if (!parts.isEmpty())
            append(said, {from, to, parts.join(QStringLiteral(", "))});
    }
    QStringList sentences;
    for (const Said &one : said) {
        const QString firmware = firmwareText(one.from, one.to);
        sentences << (one.text.isEmpty() ? FirmwareChanges::tr("Not in %1.").arg(firmware)
                                         : FirmwareChanges::tr("In %1: %2.").arg(firmware, one.text));
    }
    return sentences;
}

QString firmwareMark(const Field &field, const ControlTable &own, const std::vector<ControlTablePtr> &all)
{
    int from = own.description().firmwareFrom, to = own.description().firmwareTo;
    bool differs = false;
    for (const ControlTablePtr &table : all) {
        const Field *there = table->find(field.name);
        if (!there)
            continue;
        from = std::min(from, table->description().firmwareFrom);
        to = std::max(to, table->description().firmwareTo);
        differs = differs || !changedAspects(field, *there).empty();
    }
    if (differs)
        return FirmwareChanges::tr("differs");
    const int first = all.empty() ? from : all.front()->description().firmwareFrom;
    const int last = all.empty() ? to : all.back()->description().firmwareTo;
    if (from > first)
        return FirmwareChanges::tr("since %1").arg(from);
    return to < last ? FirmwareChanges::tr("until %1").arg(to) : QString();
}

QStringList onlyInOtherFirmware(const ControlTable &own, const std::vector<ControlTablePtr> &all)
{
    std::map<int, std::vector<Said>> missing; // by address
    for (const ControlTablePtr &table : all) {
        for (const Field &field : table->fields()) {
            if (own.indexOf(field.name) < 0)
                append(missing[field.address],
                       {table->description().firmwareFrom, table->description().firmwareTo, field.name});
        }
    }
    std::vector<Run> runs;
    for (const auto &[address, ranges] : missing) {
        for (const Said &one : ranges)
            append(runs, one.text, address, firmwareText(one.from, one.to));
    }
    QStringList lines;
    for (const Run &run : runs) {
        const QString name = run.first == run.last
                                 ? run.name
                                 : FirmwareChanges::tr("%1%2 to %3").arg(run.stem).arg(run.first).arg(run.last);
        lines << FirmwareChanges::tr("%1 (%2): %3").arg(name).arg(run.address).arg(run.firmware);
    }
    return lines;
}

} // namespace dynascope
