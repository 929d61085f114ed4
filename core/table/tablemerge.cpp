// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/tablemerge.h"

#include <QJsonArray>
#include <QStringList>

namespace dynascope {
namespace {

QStringList keys(const char *list)
{
    return QString::fromLatin1(list).split(u' ');
}

const QStringList &fileKeys()
{
    static const QStringList list = keys("format extends series resolution newestFirmware baudRates fastReadsSince "
                                         "backupSince receiveBuffer axes definitions registers indirect models");
    return list;
}

const QStringList &modelKeys()
{
    static const QStringList list = keys("number manual series resolution newestFirmware baudRates fastReadsSince "
                                         "backupSince receiveBuffer axes registers indirect");
    return list;
}

const QStringList &registerKeys()
{
    static const QStringList list =
        keys("address count size signed area access initial range unit scale values special "
             "bits alternates resets help since until");
    return list;
}

/// Checks one file from the outside in; stops at the first thing wrong.
class KeyCheck
{
public:
    QString file(const QJsonObject &json)
    {
        only(json, fileKeys(), {});
        registers(json, QStringLiteral("definitions"), {});
        settings(json, {});
        const QJsonObject models = object(json, QStringLiteral("models"), {});
        for (auto it = models.begin(); it != models.end(); ++it) {
            const QJsonObject model = object(models, it.key(), {});
            only(model, modelKeys(), it.key());
            settings(model, it.key());
        }
        return m_wrong;
    }

private:
    void settings(const QJsonObject &json, const QString &where)
    {
        object(json, QStringLiteral("baudRates"), where);
        registers(json, QStringLiteral("registers"), where);
        const QString indirect = QStringLiteral("indirect");
        for (const QJsonObject &group : objects(json, indirect, where)) {
            only(group, keys("since until range blocks"), within(where, indirect));
            for (const QJsonObject &block : objects(group, QStringLiteral("blocks"), within(where, indirect)))
                only(block, keys("count address dataAddress"), within(where, indirect));
        }
    }

    void registers(const QJsonObject &json, const QString &key, const QString &where)
    {
        const QJsonObject all = object(json, key, where);
        for (auto it = all.begin(); it != all.end(); ++it) {
            const QString place = within(where, it.key());
            const QJsonObject reg = object(all, it.key(), where);
            only(reg, registerKeys(), place);
            if (!reg.value(u"values").isString())
                named(reg, QStringLiteral("values"), keys("text since until"), place);
            named(reg, QStringLiteral("special"), keys("text since until"), place);
            named(reg, QStringLiteral("bits"), keys("bit bits values since until"), place);
            for (const QJsonObject &alternate : objects(reg, QStringLiteral("alternates"), place))
                only(alternate, keys("register bit values range unit scale"), place);
        }
    }

    /// The objects among the members of reg[key].
    void named(const QJsonObject &reg, const QString &key, const QStringList &allowed, const QString &place)
    {
        const QJsonObject members = object(reg, key, place);
        for (auto it = members.begin(); it != members.end(); ++it) {
            if (!it->isObject())
                continue;
            only(it->toObject(), allowed, within(place, it.key()));
            if (key == u"bits")
                object(it->toObject(), QStringLiteral("values"), within(place, it.key()));
        }
    }

    void only(const QJsonObject &json, const QStringList &allowed, const QString &where)
    {
        for (auto it = json.begin(); it != json.end(); ++it) {
            if (!allowed.contains(it.key()))
                say(within(where, QStringLiteral("unknown key \"%1\"").arg(it.key())));
        }
    }

    /// An object, or nothing, or null, which removes.
    QJsonObject object(const QJsonObject &json, const QString &key, const QString &where)
    {
        const QJsonValue value = json.value(key);
        if (!value.isUndefined() && !value.isNull() && !value.isObject())
            say(within(where, QStringLiteral("\"%1\" must be an object").arg(key)));
        return value.toObject();
    }

    QList<QJsonObject> objects(const QJsonObject &json, const QString &key, const QString &where)
    {
        const QJsonValue value = json.value(key);
        if (!value.isUndefined() && !value.isNull() && !value.isArray())
            say(within(where, QStringLiteral("\"%1\" must be a list").arg(key)));
        QList<QJsonObject> list;
        for (const QJsonValue &entry : value.toArray()) {
            if (!entry.isObject())
                say(within(where, QStringLiteral("\"%1\" must be a list of objects").arg(key)));
            list.append(entry.toObject());
        }
        return list;
    }

    static QString within(const QString &where, const QString &what)
    {
        return where.isEmpty() ? what : where + QStringLiteral(": ") + what;
    }

    void say(const QString &what)
    {
        if (m_wrong.isEmpty())
            m_wrong = what;
    }

    QString m_wrong;
};

void patch(QJsonObject &target, const QJsonObject &changes, const QString &where, const QJsonObject *definitions,
    QString *wrong)
{
    for (auto it = changes.begin(); it != changes.end(); ++it) {
        const QString place = where.isEmpty() ? it.key() : where + QStringLiteral(": ") + it.key();
        if (it->isNull()) {
            if (!target.contains(it.key()) && wrong->isEmpty())
                *wrong = QStringLiteral("%1 is removed, but isn't there").arg(place);
            target.remove(it.key());
        } else if (it->isObject()) {
            // The names of the sections add nothing to a message: "Goal Position: …" is enough.
            const bool section = where.isEmpty() && (it.key() == u"registers" || it.key() == u"definitions");
            QJsonObject member = target.value(it.key()).toObject();
            if (definitions && !target.contains(it.key()))
                member = definitions->value(it.key()).toObject();
            const QJsonObject known = target.value(u"definitions").toObject();
            const bool registers = section && it.key() == u"registers";
            patch(member, it->toObject(), section ? QString() : place, registers ? &known : nullptr, wrong);
            target.insert(it.key(), member);
        } else {
            target.insert(it.key(), it.value());
        }
    }
}

} // namespace

QString wrongKeys(const QJsonObject &file)
{
    return KeyCheck().file(file);
}

QJsonObject merged(const QJsonObject &base, const QJsonObject &changes, QString *wrong)
{
    // "definitions" comes before "registers" in a QJsonObject, which is sorted by key, and must: registers start from
    // them.
    QJsonObject result = base;
    patch(result, changes, {}, nullptr, wrong);
    return result;
}

} // namespace dynascope
