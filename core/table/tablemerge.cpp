// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/tablemerge.h"

#include <QJsonArray>

namespace dynascope {
namespace {

QStringList keys(const char *list)
{
    return QString::fromLatin1(list).split(u' ');
}

const QStringList &fileKeys()
{
    static const QStringList list = keys(
        "format extends uses series resolution gearRatio modbusNumberOffset newestFirmware addressesOnly scales "
        "baudRates fastReadsSince backupSince clearSince clearsErrors resetByBroadcastUntil axes receiveBuffer "
        "torqueConstant doubt valueLists definitions registers indirect variants models");
    return list;
}

const QStringList &modelKeys()
{
    static const QStringList list = keys(
        "number alsoCalled manual replaces uses series resolution gearRatio modbusNumberOffset newestFirmware "
        "addressesOnly scales baudRates fastReadsSince backupSince clearSince clearsErrors resetByBroadcastUntil axes "
        "receiveBuffer torqueConstant doubt registers indirect");
    return list;
}

/// Not what the catalog wants to know of a model without reading everything.
const QStringList &variantKeys()
{
    static const QStringList list = keys("resolution scales baudRates torqueConstant doubt registers indirect");
    return list;
}

const QStringList &registerKeys()
{
    static const QStringList list =
        keys("address count stride size signed area access initial range unit scale directionBit values special bits "
             "alternates resets needs help doubt since until");
    return list;
}

/// "Goal Position: ": the names along a path, without those of sections.
QString spoken(const QStringList &path)
{
    static const QStringList silent =
        keys("models registers definitions variants values special bits alternates indirect blocks valueLists");
    QString text;
    for (const QString &key : path) {
        bool isIndex = false;
        (void)key.toInt(&isIndex);
        const bool indirect = key == u"indirect"; // the only list that has no name of its own
        if (indirect || (!isIndex && !silent.contains(key)))
            text += key + QStringLiteral(": ");
    }
    return text;
}

/// Checks one file from the outside in; stops at the first thing wrong.
class KeyCheck
{
public:
    TableFault file(const QJsonObject &json)
    {
        only(json, fileKeys(), {});
        registers(json, QStringLiteral("definitions"), {});
        settings(json, {});
        object(json, QStringLiteral("valueLists"), {});
        members(json, QStringLiteral("valueLists"), {}, nullptr);
        members(json, QStringLiteral("variants"), {}, &variantKeys());
        members(json, QStringLiteral("models"), {}, &modelKeys());
        return m_fault;
    }

private:
    /// The objects json[key], each of them settings with these keys; none: names for values.
    void members(const QJsonObject &json, const QString &key, const QStringList &path, const QStringList *allowed)
    {
        const QJsonObject all = object(json, key, path);
        for (auto it = all.begin(); it != all.end(); ++it) {
            const QStringList place = path + QStringList{key, it.key()};
            const QJsonObject member = object(all, it.key(), path + QStringList{key});
            if (!allowed)
                continue;
            only(member, *allowed, place);
            settings(member, place);
        }
    }

    void settings(const QJsonObject &json, const QStringList &path)
    {
        object(json, QStringLiteral("baudRates"), path);
        object(json, QStringLiteral("scales"), path);
        texts(json, QStringLiteral("uses"), path);
        texts(json, QStringLiteral("alsoCalled"), path);
        texts(json, QStringLiteral("gearRatio"), path);
        registers(json, QStringLiteral("registers"), path);
        const QString indirect = QStringLiteral("indirect"), blocks = QStringLiteral("blocks");
        int group = 0;
        for (const QJsonObject &entry : objects(json, indirect, path)) {
            const QStringList place = path + QStringList{indirect, QString::number(group++)};
            only(entry, keys("since until range blocks"), place);
            int number = 0;
            for (const QJsonObject &block : objects(entry, blocks, place))
                only(block, keys("count address dataAddress"), place + QStringList{blocks, QString::number(number++)});
        }
    }

    void registers(const QJsonObject &json, const QString &key, const QStringList &path)
    {
        const QJsonObject all = object(json, key, path);
        for (auto it = all.begin(); it != all.end(); ++it) {
            const QStringList place = path + QStringList{key, it.key()};
            const QJsonObject reg = object(all, it.key(), path + QStringList{key});
            only(reg, registerKeys(), place);
            if (!reg.value(u"values").isString())
                named(reg, QStringLiteral("values"), keys("text since until"), place);
            if (!reg.value(u"special").isString())
                named(reg, QStringLiteral("special"), keys("text since until"), place);
            named(reg, QStringLiteral("bits"), keys("bit bits values since until"), place);
            int number = 0;
            for (const QJsonObject &alternate : objects(reg, QStringLiteral("alternates"), place)) {
                only(alternate, keys("register bit values range unit scale directionBit"),
                     place + QStringList{QStringLiteral("alternates"), QString::number(number++)});
            }
        }
    }

    /// The objects among the members of reg[key].
    void named(const QJsonObject &reg, const QString &key, const QStringList &allowed, const QStringList &path)
    {
        const QJsonObject all = object(reg, key, path);
        for (auto it = all.begin(); it != all.end(); ++it) {
            if (!it->isObject())
                continue;
            const QStringList place = path + QStringList{key, it.key()};
            only(it->toObject(), allowed, place);
            if (key == u"bits")
                object(it->toObject(), QStringLiteral("values"), place);
        }
    }

    void only(const QJsonObject &json, const QStringList &allowed, const QStringList &path)
    {
        for (auto it = json.begin(); it != json.end(); ++it) {
            if (!allowed.contains(it.key()))
                say(path, it.key(), QStringLiteral("unknown key \"%1\"").arg(it.key()));
        }
    }

    /// An object, or nothing, or null, which removes.
    QJsonObject object(const QJsonObject &json, const QString &key, const QStringList &path)
    {
        const QJsonValue value = json.value(key);
        if (!value.isUndefined() && !value.isNull() && !value.isObject())
            say(path, key, QStringLiteral("\"%1\" must be an object").arg(key));
        return value.toObject();
    }

    QList<QJsonObject> objects(const QJsonObject &json, const QString &key, const QStringList &path)
    {
        const QJsonValue value = json.value(key);
        if (!value.isUndefined() && !value.isNull() && !value.isArray())
            say(path, key, QStringLiteral("\"%1\" must be a list").arg(key));
        QList<QJsonObject> list;
        for (const QJsonValue &entry : value.toArray()) {
            if (!entry.isObject())
                say(path, key, QStringLiteral("\"%1\" must be a list of objects").arg(key));
            list.append(entry.toObject());
        }
        return list;
    }

    void texts(const QJsonObject &json, const QString &key, const QStringList &path)
    {
        const QJsonValue value = json.value(key);
        bool fits = value.isUndefined() || value.isNull() || value.isArray();
        for (const QJsonValue &entry : value.toArray())
            fits = fits && entry.isString();
        if (!fits)
            say(path, key, QStringLiteral("\"%1\" must be a list of texts").arg(key));
    }

    void say(const QStringList &path, const QString &key, const QString &what)
    {
        if (!m_fault.isSet())
            m_fault = {spoken(path) + what, path + QStringList{key}};
    }

    TableFault m_fault;
};

/// Where a patch is: as cheap as it can be, for it is asked for only when something is wrong.
struct Place {
    const Place *outer = nullptr;
    QString key;

    QStringList path() const { return outer ? outer->path() + QStringList{key} : QStringList(); }
};

struct Patch {
    const QStringList &root; ///< where the changes stand in their file
    TableFault *fault;

    void removed(const Place &where, const QString &key) const
    {
        if (!fault->isSet()) {
            const QStringList path = where.path();
            const QString text = spoken(path) + key + QStringLiteral(" is removed, but isn't there");
            *fault = {text, root + path + QStringList{key}};
        }
    }

    void apply(
        QJsonObject &target, const QJsonObject &changes, const Place &where, const QJsonObject *definitions) const
    {
        for (auto it = changes.begin(); it != changes.end(); ++it) {
            const QString key = it.key();
            if (it->isNull()) {
                if (!target.contains(key))
                    removed(where, key);
                target.remove(key);
            } else if (it->isObject()) {
                const QJsonValue there = target.value(key);
                QJsonObject member = there.toObject();
                if (definitions && there.isUndefined())
                    member = definitions->value(key).toObject();
                const bool registers = !where.outer && key == u"registers";
                const QJsonObject known = registers ? target.value(u"definitions").toObject() : QJsonObject();
                apply(member, it->toObject(), {&where, key}, registers ? &known : nullptr);
                target.insert(key, member);
            } else {
                target.insert(key, it.value());
            }
        }
    }
};

/// Variants are laid over each other as they stand: their nulls remove something only where a variant is used.
QJsonObject overlaid(QJsonObject target, const QJsonObject &changes)
{
    for (auto it = changes.begin(); it != changes.end(); ++it) {
        const QJsonValue there = target.value(it.key());
        const bool both = it->isObject() && there.isObject();
        target.insert(it.key(), both ? QJsonValue(overlaid(there.toObject(), it->toObject())) : it.value());
    }
    return target;
}

} // namespace

TableFault wrongKeys(const QJsonObject &file)
{
    return KeyCheck().file(file);
}

QJsonObject merged(const QJsonObject &base, const QJsonObject &changes, const QStringList &path, TableFault *fault)
{
    const QString uses = QStringLiteral("uses"), variants = QStringLiteral("variants");
    QJsonObject result = base;
    QJsonObject own = changes;
    const QJsonObject known = overlaid(result.value(variants).toObject(), own.take(variants).toObject());
    if (!known.isEmpty())
        result.insert(variants, known);
    for (const QJsonValue &name : own.take(uses).toArray()) {
        const QJsonValue variant = known.value(name.toString());
        const QStringList place{QStringLiteral("variants"), name.toString()};
        if (variant.isObject())
            Patch{place, fault}.apply(result, variant.toObject(), Place(), nullptr);
        else if (!fault->isSet())
            *fault = {QStringLiteral("uses \"%1\", which is no variant").arg(name.toString()),
                      path + QStringList{uses}};
    }
    // "definitions" comes before "registers" in a QJsonObject, which is sorted by key, and must: registers start from
    // them.
    Patch{path, fault}.apply(result, own, Place(), nullptr);
    return result;
}

} // namespace dynascope
