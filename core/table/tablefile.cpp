// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/tablefile.h"

#include "core/table/jsonguard.h"
#include "core/table/jsonscanner.h"
#include "core/table/tablemerge.h"

#include <QJsonDocument>
#include <QRegularExpression>

namespace dynascope {
namespace {

constexpr int MostModels = 64; ///< in one file

const QString Models = QStringLiteral("models");

/// The paths at which what holds for a model may stand in its file, the likeliest first.
QList<QStringList> placesOf(const QStringList &path, const QString &model, const QStringList &variants)
{
    QList<QStringList> places{QStringList{Models, model} + path, path};
    for (const QString &variant : variants)
        places.append(QStringList{QStringLiteral("variants"), variant} + path);
    if (path.value(0) == RegistersKey)
        places.append(QStringList{QStringLiteral("definitions")} + path.mid(1));
    return places;
}

/// "Port #" where the path leads to "Port 3".
QStringList unnumbered(QStringList path)
{
    static const QRegularExpression number(QStringLiteral("\\d+$"));
    if (path.value(0) == RegistersKey && path.size() > 1)
        path[1].replace(number, QStringLiteral("#"));
    return path;
}

/// The line of this or of the nearest that it is in; 0 where it isn't in the file.
int lineOf(const JsonPositions &positions, QStringList path)
{
    for (; !path.isEmpty(); path.removeLast()) {
        if (const int line = positions.line(path))
            return line;
    }
    return 0;
}

/// The same of what holds for a model, wherever in its file that stands.
int lineOf(const JsonPositions &positions, QStringList path, const QString &model, const QStringList &variants)
{
    const qsizetype fewest = path.value(0) == RegistersKey ? 2 : 1;
    for (; path.size() >= fewest; path.removeLast()) {
        for (const QStringList &one : {path, unnumbered(path)}) {
            for (const QStringList &place : placesOf(one, model, variants)) {
                if (const int line = positions.line(place))
                    return line;
            }
        }
    }
    return 0;
}

int lineFor(const QByteArray &json, const TableFault &fault, const QString &model)
{
    const JsonPositions positions(json);
    if (model.isEmpty())
        return lineOf(positions, fault.path);
    // Each place is a pass over the text: of a large file with many variants not all are looked through.
    constexpr qsizetype Large = 64 * 1024, Many = 64, Few = 4;
    const QStringList variants = QJsonDocument::fromJson(json)
                                     .object()
                                     .value(u"variants")
                                     .toObject()
                                     .keys()
                                     .mid(0, json.size() > Large ? Few : Many);
    for (const QStringList &path : {fault.path, fault.elsewhere}) {
        if (const int line = lineOf(positions, path, model, variants))
            return line;
    }
    return positions.line({Models, model});
}

} // namespace

TableFile::TableFile(QString name, QByteArray json, TableOutline outline, std::shared_ptr<const TableFile> base,
    bool isKnownSound)
    : m_name(std::move(name))
    , m_json(std::move(json))
    , m_base(std::move(base))
    , m_outline(std::move(outline))
    , m_isKnownSound(isKnownSound)
{
}

TableOutline::Facts TableFile::shared() const
{
    TableOutline::Facts facts = m_base ? m_base->shared() : TableOutline::Facts();
    facts.lay(m_outline.shared);
    return facts;
}

const TableFile::Parsed &TableFile::parsed() const
{
    return m_parsed.get([this] {
        Parsed parsed;
        QJsonObject file = QJsonDocument::fromJson(m_json).object();
        parsed.models = file.take(Models).toObject();
        file.remove(QStringLiteral("format"));
        file.remove(QStringLiteral("extends"));
        if (!m_base && m_isKnownSound) {
            parsed.settings = file; // nothing to lay it over, nothing that it could wrongly remove
            return parsed;
        }
        parsed.settings = merged(m_base ? m_base->settings() : QJsonObject(), file, {}, &parsed.fault);
        return parsed;
    });
}

Result<void> TableFile::check(const QByteArray &json, const QString &name)
{
    const Result<QJsonObject> read = readJsonObject(json, name);
    if (!read)
        return tl::unexpected<Error>(read.error());
    TableFault fault;
    const std::int64_t format = wholeNumber(read->value(u"format")).value_or(0);
    if (format < OldestTableFormat || format > TableFormat) {
        const QString which = QStringLiteral("\"format\" must be %1 or %2").arg(OldestTableFormat).arg(TableFormat);
        fault = {which, {QStringLiteral("format")}};
    }
    if (!fault.isSet())
        fault = wrongKeys(*read);
    if (!fault.isSet() && read->value(Models).toObject().size() > MostModels)
        fault = {QStringLiteral("more than %1 models").arg(MostModels), {Models}};
    if (fault.isSet())
        return tl::unexpected<Error>(TableFile(name, json, {}, nullptr, false).error(name, fault));
    return {};
}

Error TableFile::error(const QString &name, const TableFault &fault, const QString &model) const
{
    const int line = lineFor(m_json, fault, model);
    const QString place = line > 0 ? QStringLiteral("line %1: ").arg(line) : QString();
    return {ErrorKind::BadFile, QStringLiteral("%1: %2%3").arg(name, place, fault.text), 0};
}

TableBuilder ModelTables::builder(TableFault *fault) const
{
    const QStringList path{Models, m_model};
    return {m_model, merged(m_file->settings(), m_file->changes(m_model), path, fault)};
}

ControlTablePtr ModelTables::build(TableBuilder &from, const Step &step) const
{
    return from.build(step.from, step.to - 1, m_file->isKnownSound());
}

/// Of the firmware asked for first the table is made at once, with what finding the steps took.
const std::deque<ModelTables::Step> &ModelTables::steps(int firmware) const
{
    return m_steps.get([this, firmware] {
        std::deque<Step> made;
        TableFault ignored;
        TableBuilder known = builder(&ignored);
        const std::vector<int> steps = known.steps();
        for (std::size_t i = 0; i + 1 < steps.size(); ++i)
            made.emplace_back(steps[i], steps[i + 1]);
        if (const Step *first = stepAt(made, firmware))
            (void)first->table.get([&] { return build(known, *first); });
        return made;
    });
}

const ModelTables::Step *ModelTables::stepAt(const std::deque<Step> &steps, int firmware)
{
    const Step *best = nullptr;
    for (const Step &step : steps) {
        if (!best || step.from <= firmware)
            best = &step;
    }
    return best;
}

ControlTablePtr ModelTables::at(int firmware) const
{
    const Step *step = stepAt(steps(firmware), firmware);
    if (!step)
        return nullptr;
    return step->table.get([this, step] {
        TableFault ignored;
        TableBuilder one = builder(&ignored);
        return build(one, *step);
    });
}

std::vector<int> ModelTables::firmwareSteps() const
{
    std::vector<int> firmware;
    for (const Step &step : steps(NewestFirmware))
        firmware.push_back(step.from);
    return firmware;
}

TableFault ModelTables::check() const
{
    TableFault fault;
    TableBuilder all = builder(&fault);
    if (fault.isSet()) {
        fault.text = m_model + QStringLiteral(": ") + fault.text;
        return fault;
    }
    for (std::size_t i = 0; i + 1 < all.steps().size() && !all.fault().isSet(); ++i)
        (void)all.build(all.steps()[i], all.steps()[i + 1] - 1, false);
    return all.fault();
}

} // namespace dynascope
