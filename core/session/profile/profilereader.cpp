// SPDX-License-Identifier: GPL-3.0-or-later
// From the text of a profile to its values, every fault with its line and column.
#include "core/protocol/protocol_values.h"
#include "core/session/profile/profilevalues.h"
#include "core/session/texts.h"
#include "core/table/nearestnames.h"
#include "core/yaml/yamlfaults.h"

#include <algorithm>
#include <map>

namespace dynascope {
namespace {

constexpr qsizetype LongestValue = 200; ///< of a register's value

/// A register as it stands in the file, before it is known which table it is for.
struct Entry {
    const YamlNode *name = nullptr, *value = nullptr;
};
using Entries = std::vector<Entry>;

class ProfileReader : private YamlFaults
{
public:
    ProfileReader(const QString &name, const Catalog &catalog) : YamlFaults(name), m_catalog(catalog)
    {
        m_profile.file = name;
    }

    Result<Profile> read(const YamlNode &root)
    {
        if (map(root, ProfileText::tr("a profile"), {u"profile", u"name", u"defaults", u"joints"})) {
            const YamlNode *version = root.find(u"profile");
            if (!version)
                say(root,
                    ProfileText::tr("\"profile: %1\" is missing, which says that this is one").arg(Profile::Version));
            else
                whole(*version, "profile", Profile::Version, Profile::Version);
            if (const YamlNode *name = root.find(u"name"))
                m_profile.name = word(*name, "name");
            readDefaults(root.find(u"defaults"));
            readJoints(root);
            checkPlaces();
            checkDefaults();
        }
        if (const Result<void> sound = asResult(); !sound)
            return tl::unexpected(sound.error());
        return std::move(m_profile);
    }

private:
    bool map(const YamlNode &node, const QString &what, std::initializer_list<QStringView> keys)
    {
        if (!node.isMap()) {
            say(node, ProfileText::tr("%1 is made of \"key: value\" lines").arg(what));
            return false;
        }
        for (std::size_t i = 0; i < node.children.size(); i += 2) {
            const YamlNode &key = node.children[i];
            if (std::ranges::find(keys, QStringView(key.text)) != keys.end())
                continue;
            QStringList known;
            for (const QStringView each : keys)
                known << each.toString();
            say(key,
                ProfileText::tr("\"%1\" is no key of %2, which has %3").arg(cut(key.text), what, known.join(u", ")));
        }
        return true;
    }

    int whole(const YamlNode &node, const char *key, int low, int high)
    {
        bool ok = false;
        const int number = node.text.toInt(&ok);
        if (node.kind == YamlNode::Kind::Scalar && ok && number >= low && number <= high)
            return number;
        say(node,
            low == high
                ? ProfileText::tr("%1 is %2 here, not \"%3\"").arg(QLatin1String(key)).arg(low).arg(cut(node.text))
                : ProfileText::tr("%1 is a whole number from %2 to %3, not \"%4\"")
                      .arg(QLatin1String(key))
                      .arg(low)
                      .arg(high)
                      .arg(cut(node.text)));
        return -1;
    }

    /// One line of text; empty where that was said to be wrong.
    QString word(const YamlNode &node, const char *key)
    {
        const bool isPrintable = std::ranges::all_of(node.text, [](QChar c) { return c.isPrint() || c.isSurrogate(); });
        if (node.kind == YamlNode::Kind::Scalar && !node.text.trimmed().isEmpty() && isPrintable
            && node.text.size() <= Profile::LongestName)
            return node.text;
        say(node, ProfileText::tr("%1 is a text of one line, up to %2 characters")
                      .arg(QLatin1String(key))
                      .arg(Profile::LongestName));
        return {};
    }

    Entries entries(const YamlNode &node)
    {
        Entries found;
        if (node.kind == YamlNode::Kind::Null)
            return found; // "registers:" and nothing behind it
        if (!node.isMap()) {
            say(node, ProfileText::tr("registers are \"Name: value\" lines"));
            return found;
        }
        std::map<QString, int> lines;
        for (std::size_t i = 0; i + 1 < node.children.size(); i += 2) {
            const YamlNode &name = node.children[i];
            const YamlNode &value = node.children[i + 1];
            const auto [at, isNew] = lines.emplace(normalizedName(name.text), name.line);
            if (!isNew)
                say(name, ProfileText::tr("%1 stands in line %2 already").arg(cut(name.text)).arg(at->second));
            else if (value.kind != YamlNode::Kind::Scalar)
                say(value,
                    ProfileText::tr("%1 needs one value: a number, one with its unit, or a name").arg(cut(name.text)));
            else if (value.style == YamlNode::Style::Spread)
                say(value, ProfileText::tr("the value of %1 stands in one line").arg(cut(name.text)));
            else if (value.text.size() > LongestValue)
                say(value, ProfileText::tr("the value of %1 is too long").arg(cut(name.text)));
            else
                found.push_back({&name, &value});
        }
        return found;
    }

    void readDefaults(const YamlNode *defaults)
    {
        if (!defaults || defaults->kind == YamlNode::Kind::Null)
            return;
        if (!defaults->isMap())
            return say(*defaults, ProfileText::tr("defaults have a model's name, or \"all\", and registers below it"));
        for (std::size_t i = 0; i + 1 < defaults->children.size(); i += 2) {
            const YamlNode &key = defaults->children[i];
            if (key.text == u"all") {
                m_forAll = entries(defaults->children[i + 1]);
                continue;
            }
            const Catalog::ModelInfo *model = modelNamed(key);
            if (!model)
                continue;
            if (m_forModel.contains(model->modelNumber))
                say(key, ProfileText::tr("the defaults of %1 stand twice").arg(model->model));
            m_forModel[model->modelNumber] = entries(defaults->children[i + 1]);
            m_defaultsAt[model->modelNumber] = &key;
        }
        const auto keep = [this](int model, const Entries &of) {
            for (const Entry &entry : of)
                m_profile.defaults.push_back({model, entry.name->text, entry.value->text});
        };
        for (const auto &[model, of] : m_forModel)
            keep(model, of);
        keep(-1, m_forAll);
    }

    const Catalog::ModelInfo *modelNamed(const YamlNode &node)
    {
        const Catalog::ModelInfo *model =
            node.kind == YamlNode::Kind::Scalar ? m_catalog.model(QStringView(node.text)) : nullptr;
        if (!model)
            say(node, ProfileText::tr("no model is called %1; dxl models lists them").arg(cut(node.text)));
        return model;
    }

    void readJoints(const YamlNode &root)
    {
        const YamlNode *joints = root.find(u"joints");
        if (!joints)
            return say(root, ProfileText::tr("\"joints\" are missing"));
        if (!joints->isList())
            return say(*joints, ProfileText::tr("joints are a list: a line \"- name: ...\" begins each"));
        if (joints->children.size() > Profile::MostJoints)
            return say(*joints, ProfileText::tr("more than %1 joints").arg(Profile::MostJoints));
        for (const YamlNode &joint : joints->children)
            readJoint(joint);
    }

    void readJoint(const YamlNode &node)
    {
        if (!map(node, ProfileText::tr("a joint"), {u"name", u"model", u"id", u"baud", u"firmware", u"registers"}))
            return;
        ProfileJoint joint;
        joint.line = node.line;
        joint.column = node.column;
        const std::array<const YamlNode *, 4> needed{node.find(u"name"), node.find(u"model"), node.find(u"id"),
                                                     node.find(u"baud")};
        constexpr std::array Keys{"name", "model", "id", "baud"};
        for (std::size_t i = 0; i < needed.size(); ++i) {
            if (!needed[i])
                say(node, ProfileText::tr("\"%1\" of this joint is missing").arg(QLatin1String(Keys[i])));
        }
        if (needed[0]) {
            joint.name = word(*needed[0], "name");
            checkName(*needed[0], joint.name);
        }
        if (needed[2])
            joint.id = whole(*needed[2], "id", 0, 252);
        if (const YamlNode *firmware = node.find(u"firmware"))
            joint.firmware = whole(*firmware, "firmware", 0, 255);
        const Catalog::ModelInfo *model = needed[1] ? modelNamed(*needed[1]) : nullptr;
        if (!model)
            return; // then nothing is known of its registers
        joint.modelNumber = model->modelNumber;
        joint.model = model->model;
        if (needed[3])
            readBaud(*needed[3], joint);
        readRegisters(node.find(u"registers"), joint);
        if (needed[2])
            m_profile.joints.push_back(std::move(joint));
    }

    void checkName(const YamlNode &node, const QString &name)
    {
        const auto [at, isNew] = m_names.emplace(name, node.line);
        if (!isNew && !name.isEmpty())
            say(node, ProfileText::tr("the joint of line %1 is called %2, too").arg(at->second).arg(name));
    }

    void readBaud(const YamlNode &node, ProfileJoint &joint)
    {
        joint.baudRate = whole(node, "baud", 1, HighestBaudRate);
        const ControlTablePtr table = m_catalog.find(joint.modelNumber, joint.firmware < 0 ? 255 : joint.firmware);
        if (joint.baudRate < 0 || !table || table->baudCode(joint.baudRate))
            return;
        QStringList rates;
        for (const BaudCode &code : table->description().baudCodes)
            rates << QString::number(code.rate);
        say(node, ProfileText::tr("%1 has no baud rate of %2; its rates are %3")
                      .arg(joint.model)
                      .arg(joint.baudRate)
                      .arg(rates.join(u", ")));
    }

    /// The tables that the joint may have, the likeliest first.
    std::vector<ControlTablePtr> tablesOf(const ProfileJoint &joint) const
    {
        std::vector<ControlTablePtr> tables;
        const auto add = [&](int firmware) {
            const ControlTablePtr table = m_catalog.find(joint.modelNumber, firmware);
            if (table && std::ranges::find(tables, table) == tables.end())
                tables.push_back(table);
        };
        add(joint.firmware < 0 ? 255 : joint.firmware);
        for (const int step : m_catalog.firmwareSteps(joint.modelNumber)) {
            if (step >= joint.firmware)
                add(step);
        }
        return tables;
    }

    void readRegisters(const YamlNode *node, ProfileJoint &joint)
    {
        const std::vector<ControlTablePtr> tables = tablesOf(joint);
        if (tables.empty())
            return;
        for (const Entry &entry : node ? entries(*node) : Entries())
            addRegister(entry, tables, joint, false);
        const auto forModel = m_forModel.find(joint.modelNumber);
        if (forModel != m_forModel.end()) {
            m_defaultsAt.erase(joint.modelNumber); // somebody uses them
            for (const Entry &entry : forModel->second) {
                if (!joint.find(entry.name->text))
                    addRegister(entry, tables, joint, true);
            }
        }
        for (const Entry &entry : m_forAll) {
            const bool isThere = std::ranges::any_of(
                tables, [&](const ControlTablePtr &table) { return table->find(entry.name->text) != nullptr; });
            if (!isThere)
                continue;
            m_used.insert_or_assign(entry.name, true);
            if (!joint.find(entry.name->text))
                addRegister(entry, tables, joint, true);
        }
        checkValues(tables, joint);
    }

    void addRegister(const Entry &entry, const std::vector<ControlTablePtr> &tables, ProfileJoint &joint, bool isShared)
    {
        for (const ControlTablePtr &table : tables) {
            const Field *field = table->find(entry.name->text);
            if (!field)
                continue;
            if (const QString why = whyNotInProfile(profileUse(*table, *field), *field); !why.isEmpty())
                return sayOnce(*entry.name, why);
            joint.registers.push_back(
                {field->name, entry.value->text, entry.value->line, entry.value->column, isShared});
            return;
        }
        const QStringList near = namesNear(*tables.front(), entry.name->text);
        QString what = ProfileText::tr("%1 has no register \"%2\"").arg(joint.model, cut(entry.name->text));
        if (joint.firmware >= 0)
            what += ProfileText::tr(" at firmware %1 or newer").arg(joint.firmware);
        sayOnce(*entry.name, near.isEmpty() ? what : what + ProfileText::tr("; nearest: %1").arg(near.join(u", ")));
    }

    /// What defaults say wrong is wrong for many joints.
    void sayOnce(const YamlNode &where, const QString &what)
    {
        if (m_said.emplace(&where, true).second)
            say(where, what);
    }

    /// As far as that goes without the device: of another register it may hold anything.
    void checkValues(const std::vector<ControlTablePtr> &tables, const ProfileJoint &joint)
    {
        const std::vector<WantedValue> wanted = wantedValues(joint, *tables.front(), {});
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            const ProfileRegister &each = joint.registers[i];
            const ControlTablePtr *table = &tables.front();
            Result<std::int64_t> raw = wanted[i].raw;
            for (std::size_t other = 1; !wanted[i].field && other < tables.size() && !(*table)->find(each.name);
                 ++other) {
                table = &tables[other];
                raw = wantedValues(joint, **table, {})[i].raw;
            }
            const Field *field = (*table)->find(each.name);
            if (!field)
                continue;
            if (raw && *raw == 0 && field == (*table)->find(Known::StatusReturnLevel))
                raw = failure(ErrorKind::InvalidArgument,
                              ProfileText::tr(
                                  "at Status Return Level 0 nothing can be read, so nothing could be looked at again"));
            if (raw || mayBeRight(*field, joint))
                continue;
            if (m_saidAt.emplace(std::pair(each.line, each.column), true).second)
                say(each.line, each.column, raw.error().text);
        }
    }

    /// Might it be right once it is known what the device holds?
    static bool mayBeRight(const Field &field, const ProfileJoint &joint)
    {
        QStringList units;
        for (const Alternate &alternate : field.alternates)
            units << alternate.reg;
        return std::ranges::any_of(units, [&](const QString &name) { return !joint.find(name); });
    }

    void checkPlaces()
    {
        std::map<std::pair<int, int>, const ProfileJoint *> places;
        for (const ProfileJoint &joint : m_profile.joints) {
            if (joint.id < 0 || joint.baudRate <= 0)
                continue;
            const auto [at, isNew] = places.emplace(std::pair(joint.baudRate, joint.id), &joint);
            if (!isNew)
                say(joint.line, joint.column,
                    ProfileText::tr("ID %1 at %2 bps is that of %3 (line %4), too")
                        .arg(joint.id)
                        .arg(joint.baudRate)
                        .arg(at->second->name)
                        .arg(at->second->line));
        }
    }

    void checkDefaults()
    {
        for (const auto &[model, key] : m_defaultsAt)
            say(*key, ProfileText::tr("no joint is a %1").arg(cut(key->text)));
        for (const Entry &entry : m_forAll) {
            if (!m_used.contains(entry.name))
                say(*entry.name, ProfileText::tr("no joint's model has a register \"%1\"").arg(cut(entry.name->text)));
        }
    }

    const Catalog &m_catalog;
    Profile m_profile;
    Entries m_forAll;
    std::map<int, Entries> m_forModel;
    std::map<int, const YamlNode *> m_defaultsAt;
    std::map<const YamlNode *, bool> m_said, m_used;
    std::map<std::pair<int, int>, bool> m_saidAt;
    std::map<QString, int> m_names;
};

} // namespace

Result<Profile> profileFromYaml(const QByteArray &yaml, const QString &name, const Catalog &catalog)
{
    const auto root = readYaml(yaml, name);
    if (!root)
        return tl::unexpected(root.error());
    return ProfileReader(name, catalog).read(*root);
}

} // namespace dynascope
