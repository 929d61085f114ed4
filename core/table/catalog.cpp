// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/catalog.h"

#include "core/table/jsonguard.h"
#include "core/table/tablebuilder.h"
#include "core/table/tablemerge.h"

#include <QDir>
#include <QFile>

#include <algorithm>

namespace dynascope {
namespace {

constexpr int FormatVersion = 1;
constexpr int MostModels = 64; ///< in one file

tl::unexpected<Error> bad(const QString &name, const QString &text)
{
    return failure(ErrorKind::BadFile, QStringLiteral("%1: %2").arg(name, text));
}

/// "xm430" of "/folder/xm430.json".
QString stem(const QString &name)
{
    QString file = name.mid(name.lastIndexOf(u'/') + 1);
    if (file.endsWith(u".json"))
        file.chop(5);
    return file;
}

/// The files of a folder, ordered so that each comes after what it extends.
Result<std::vector<std::pair<QString, QByteArray>>> readFolder(const QString &path)
{
    struct Pending {
        QString name;
        QByteArray json;
        QString extends;
    };
    std::vector<Pending> pending;
    const QStringList names = QDir(path).entryList({QStringLiteral("*.json")}, QDir::Files, QDir::Name);
    for (const QString &name : names) {
        QFile file(path + u'/' + name);
        if (!file.open(QIODevice::ReadOnly))
            return bad(name, file.errorString());
        const QByteArray json = file.readAll();
        const Result<QJsonObject> object = readJsonObject(json, name);
        if (!object)
            return tl::unexpected<Error>(object.error());
        pending.push_back({name, json, object->value(u"extends").toString()});
    }
    std::vector<std::pair<QString, QByteArray>> ordered;
    QStringList done{QString()};
    while (!pending.empty()) {
        auto next =
            std::find_if(pending.begin(), pending.end(), [&](const Pending &p) { return done.contains(p.extends); });
        if (next == pending.end())
            next = pending.begin(); // adding it will say what is missing
        done.append(stem(next->name));
        ordered.emplace_back(next->name, next->json);
        pending.erase(next);
    }
    return ordered;
}

} // namespace

Result<Catalog> Catalog::builtIn()
{
    const auto files = readFolder(QStringLiteral(":/controltables"));
    if (!files)
        return tl::unexpected<Error>(files.error());
    Catalog catalog;
    for (const auto &file : *files) {
        const Result<void> added = catalog.add(file.second, file.first);
        if (!added)
            return tl::unexpected<Error>(added.error());
    }
    return catalog;
}

Result<void> Catalog::add(const QByteArray &json, const QString &name)
{
    const Result<QJsonObject> read = readJsonObject(json, name);
    if (!read)
        return tl::unexpected<Error>(read.error());
    QJsonObject file = *read;
    if (wholeNumber(file.value(u"format")) != FormatVersion)
        return bad(name, QStringLiteral("\"format\" must be %1").arg(FormatVersion));
    QString wrong = wrongKeys(file);
    if (!wrong.isEmpty())
        return bad(name, wrong);
    if (m_files.count(stem(name)) > 0)
        return bad(name, QStringLiteral("a file of this name has been read already"));

    QJsonObject base;
    if (file.contains(u"extends")) {
        const auto found = m_files.find(file.value(u"extends").toString());
        if (found == m_files.end())
            return bad(
                name, QStringLiteral("extends \"%1\", which is not there").arg(file.value(u"extends").toString()));
        base = found->second;
    }
    const QJsonObject models = file.value(u"models").toObject();
    if (models.size() > MostModels)
        return bad(name, QStringLiteral("more than %1 models").arg(MostModels));
    for (const char16_t *key : {u"format", u"extends", u"models"})
        file.remove(QStringView(key));
    const QJsonObject settings = merged(base, file, &wrong);
    if (!wrong.isEmpty())
        return bad(name, wrong);

    Catalog next = *this;
    next.m_files.emplace(stem(name), settings);
    for (auto it = models.begin(); it != models.end() && wrong.isEmpty(); ++it)
        wrong = next.addModel(it.key(), settings, it->toObject());
    if (!wrong.isEmpty())
        return bad(name, wrong);
    *this = std::move(next);
    return {};
}

QString Catalog::addModel(const QString &name, const QJsonObject &settings, const QJsonObject &changes)
{
    QString wrong;
    const QJsonObject all = merged(settings, changes, &wrong);
    if (!wrong.isEmpty())
        return name + QStringLiteral(": ") + wrong;
    TableBuilder builder(name, all);
    const std::vector<ControlTablePtr> tables = builder.build();
    if (!builder.wrong().isEmpty())
        return builder.wrong();
    const ControlTable::Description &built = builder.description();
    if (model(name) || model(static_cast<int>(built.modelNumber)))
        return QStringLiteral("%1: this name or the number %2 is taken").arg(name).arg(built.modelNumber);
    m_models.push_back({built.modelNumber, built.model, built.series, builder.newestFirmware()});
    std::sort(m_models.begin(), m_models.end(),
        [](const ModelInfo &a, const ModelInfo &b) { return a.modelNumber < b.modelNumber; });
    m_tables.insert(m_tables.end(), tables.begin(), tables.end());
    std::stable_sort(m_tables.begin(), m_tables.end(),
        [](const ControlTablePtr &a, const ControlTablePtr &b) { return a->modelNumber() < b->modelNumber(); });
    return {};
}

ControlTablePtr Catalog::find(int modelNumber, int firmware) const
{
    ControlTablePtr best;
    for (const ControlTablePtr &table : m_tables) {
        if (table->modelNumber() == modelNumber && (!best || table->description().firmwareFrom <= firmware))
            best = table;
    }
    return best;
}

const Catalog::ModelInfo *Catalog::model(QStringView name) const
{
    const QString wanted = normalizedName(name);
    const auto found = std::find_if(
        m_models.begin(), m_models.end(), [&](const ModelInfo &info) { return normalizedName(info.model) == wanted; });
    return found == m_models.end() ? nullptr : &*found;
}

const Catalog::ModelInfo *Catalog::model(int modelNumber) const
{
    const auto found = std::find_if(
        m_models.begin(), m_models.end(), [&](const ModelInfo &info) { return info.modelNumber == modelNumber; });
    return found == m_models.end() ? nullptr : &*found;
}

QString modelName(const Catalog &catalog, int modelNumber)
{
    const Catalog::ModelInfo *known = catalog.model(modelNumber);
    return known ? known->model : QStringLiteral("unknown model %1").arg(modelNumber);
}

} // namespace dynascope
