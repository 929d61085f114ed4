// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/catalog.h"

#include "core/table/jsonguard.h"
#include "core/table/rawtable.h"
#include "core/table/tablefile.h"

#include <QDir>
#include <QResource>

#include <algorithm>

namespace dynascope {

struct Catalog::File : TableFile {
    using TableFile::TableFile;
};

struct Catalog::Model {
    Model(ModelInfo modelInfo, const FilePtr &file)
        : info(std::move(modelInfo))
        , tables(info.model, file)
    {
        names.append(normalizedName(info.model));
        for (const QString &name : info.alsoCalled)
            names.append(normalizedName(name));
    }

    ModelInfo info;
    QStringList names; ///< all that it is called, normalized
    ModelTables tables;
};

namespace {

/// "xm430" of "/folder/xm430.json".
QString fileStem(const QString &name)
{
    QString file = name.mid(name.lastIndexOf(u'/') + 1);
    if (file.endsWith(u".json"))
        file.chop(5);
    return file;
}

Catalog::ModelInfo infoOf(const TableOutline::Model &model, TableOutline::Facts facts)
{
    facts.lay(model.own);
    Catalog::ModelInfo info;
    info.modelNumber = static_cast<std::uint16_t>(model.number);
    info.model = model.name;
    info.alsoCalled = model.alsoCalled;
    info.series = facts.series.value_or(QString());
    info.newestFirmware = facts.newestFirmware.value_or(-1);
    info.addressesOnly = facts.addressesOnly.value_or(false);
    if (const int offset = facts.modbusNumberOffset.value_or(-1); offset > 0)
        info.modbusNumber = model.number + offset;
    return info;
}

bool hasNumber(const Catalog::ModelInfo &info, int number)
{
    return info.modelNumber == number || info.modbusNumber == number;
}

/// The tables among the program's resources, by name; the bytes stay where they are.
std::map<QString, QByteArray> builtInFiles()
{
    const QString folder = QStringLiteral(":/controltables/");
    std::map<QString, QByteArray> files;
    for (const QString &name : QDir(folder).entryList(QDir::Files, QDir::Unsorted)) {
        if (!name.endsWith(u".json")) // quicker than a pattern of QDir's, which takes as long as all the outlines
            continue;
        const QResource resource(folder + name);
        const bool plain = resource.compressionAlgorithm() == QResource::NoCompression;
        files[fileStem(name)] =
            plain ? QByteArray::fromRawData(reinterpret_cast<const char *>(resource.data()), resource.size())
                  : resource.uncompressedData();
    }
    return files;
}

} // namespace

Result<Catalog> Catalog::builtIn()
{
    const std::map<QString, QByteArray> files = builtInFiles();
    std::map<QString, TableOutline> waiting;
    for (const auto &file : files)
        waiting[file.first] = outlineOf(file.second);
    Catalog catalog;
    // Each comes after what it extends.
    while (!waiting.empty()) {
        const auto next = std::find_if(waiting.begin(), waiting.end(), [&](const auto &file) {
            return file.second.extends.isEmpty() || catalog.m_files.count(file.second.extends) > 0;
        });
        if (next == waiting.end())
            return badFile(waiting.begin()->first, QStringLiteral("extends what is not there"));
        const QString name = next->first;
        const FilePtr base = next->second.extends.isEmpty() ? nullptr : catalog.m_files[next->second.extends];
        const auto file = std::make_shared<const File>(name, files.at(name), std::move(next->second), base, true);
        waiting.erase(next);
        catalog.m_files[name] = file;
        for (const TableOutline::Model &model : file->outline().models) {
            ModelInfo info = infoOf(model, file->shared());
            info.file = name;
            info.isBuiltIn = true;
            const auto entry = std::make_shared<const Model>(std::move(info), file);
            if (const QString wrong = catalog.insert(entry, -1); !wrong.isEmpty())
                return badFile(name, wrong);
        }
    }
    return catalog;
}

Result<void> Catalog::add(const QByteArray &json, const QString &name)
{
    if (const Result<void> sound = TableFile::check(json, name); !sound)
        return sound;
    const TableOutline outline = outlineOf(json);
    FilePtr base;
    if (!outline.extends.isEmpty()) {
        const auto found = m_files.find(outline.extends);
        if (found != m_files.end())
            base = found->second;
    }
    const auto file = std::make_shared<const File>(fileStem(name), json, outline, base, false);
    const auto refuse = [&](const TableFault &fault, const QString &model = {}) {
        return tl::unexpected<Error>(file->error(name, fault, model));
    };
    if (!outline.extends.isEmpty() && !base) {
        return refuse(
            {QStringLiteral("extends \"%1\", which is not there").arg(outline.extends), {QStringLiteral("extends")}});
    }
    if (file->fault().isSet())
        return refuse(file->fault());

    // What is wrong in itself is said before what is there already.
    std::vector<ModelPtr> models;
    for (const TableOutline::Model &model : outline.models) {
        ModelInfo info = infoOf(model, file->shared());
        info.file = fileStem(name);
        models.push_back(std::make_shared<const Model>(std::move(info), file));
        if (const TableFault fault = models.back()->tables.check(); fault.isSet())
            return refuse(fault, model.name);
    }
    if (m_files.count(fileStem(name)) > 0)
        return badFile(name,
                       QStringLiteral("sound in itself, but there is a file of this name already; give it another"));
    Catalog next = *this;
    next.m_files.emplace(fileStem(name), file);
    for (std::size_t i = 0; i < models.size(); ++i) {
        if (const QString wrong = next.insert(models[i], outline.models[i].replaces); !wrong.isEmpty())
            return refuse({wrong, {QStringLiteral("number")}}, models[i]->info.model);
    }
    *this = std::move(next);
    return {};
}

/// What is wrong with that; empty where nothing is.
QString Catalog::insert(const ModelPtr &model, int replaces)
{
    const ModelInfo &info = model->info;
    if (replaces >= 0) {
        const auto old = std::find_if(m_models.begin(), m_models.end(),
                                      [&](const ModelPtr &other) { return other->info.modelNumber == replaces; });
        if (old == m_models.end() || info.modelNumber != replaces) {
            return QStringLiteral("%1: \"replaces\" must be the number of this model and of one that is there")
                .arg(info.model);
        }
        m_models.erase(old);
    }
    for (const ModelPtr &other : m_models) {
        const bool named = std::any_of(model->names.begin(), model->names.end(),
            [&](const QString &name) { return other->names.contains(name); });
        const bool numbered = hasNumber(other->info, info.modelNumber)
                              || (info.modbusNumber >= 0 && hasNumber(other->info, info.modbusNumber));
        // "replaces" would not help: the number isn't this one's.
        if (named && !numbered) {
            return QStringLiteral("%1: this name is taken by %2 (number %3); give another name")
                .arg(info.model, other->info.model)
                .arg(other->info.modelNumber);
        }
        if (numbered) {
            return QStringLiteral("%1: this name or the number %2 is taken by %3; \"replaces\": %2 takes its place")
                .arg(info.model)
                .arg(info.modelNumber)
                .arg(other->info.model);
        }
    }
    const auto place =
        std::lower_bound(m_models.begin(), m_models.end(), info.modelNumber,
                         [](const ModelPtr &other, int number) { return other->info.modelNumber < number; });
    m_models.insert(place, model);
    return {};
}

Catalog::ModelPtr Catalog::modelOf(int modelNumber) const
{
    const auto found = std::find_if(m_models.begin(), m_models.end(),
                                    [&](const ModelPtr &model) { return hasNumber(model->info, modelNumber); });
    return found == m_models.end() ? nullptr : *found;
}

ControlTablePtr Catalog::find(int modelNumber, int firmware) const
{
    const ModelPtr model = modelOf(modelNumber);
    return model ? model->tables.at(firmware) : nullptr;
}

ControlTablePtr Catalog::findOrRaw(int modelNumber, int firmware) const
{
    if (ControlTablePtr table = find(modelNumber, firmware))
        return table;
    // Model numbers were given in rows: between two of one series is likely another of it.
    const auto above = std::find_if(m_models.begin(), m_models.end(),
                                    [&](const ModelPtr &model) { return model->info.modelNumber > modelNumber; });
    ControlTablePtr lower, upper;
    if (above != m_models.begin() && above != m_models.end() && (*above)->info.series == above[-1]->info.series) {
        lower = above[-1]->tables.at(NewestFirmware);
        upper = (*above)->tables.at(NewestFirmware);
    }
    return rawTable(modelNumber, modelName(*this, modelNumber), lower, upper);
}

std::vector<int> Catalog::firmwareSteps(int modelNumber) const
{
    const ModelPtr model = modelOf(modelNumber);
    return model ? model->tables.firmwareSteps() : std::vector<int>();
}

const Catalog::ModelInfo *Catalog::model(QStringView name) const
{
    const QString wanted = normalizedName(name);
    const auto found = std::find_if(
        m_models.begin(), m_models.end(), [&](const ModelPtr &model) { return model->names.contains(wanted); });
    return found == m_models.end() ? nullptr : &(*found)->info;
}

const Catalog::ModelInfo *Catalog::model(int modelNumber) const
{
    const ModelPtr found = modelOf(modelNumber);
    return found ? &found->info : nullptr;
}

std::vector<Catalog::ModelInfo> Catalog::models() const
{
    std::vector<ModelInfo> all;
    for (const ModelPtr &model : m_models)
        all.push_back(model->info);
    return all;
}

QString modelName(const Catalog &catalog, int modelNumber)
{
    const Catalog::ModelInfo *known = catalog.model(modelNumber);
    return known ? known->model : QStringLiteral("unknown model %1").arg(modelNumber);
}

} // namespace dynascope
