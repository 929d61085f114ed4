// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/profile/profilesave.h"

#include "core/session/profile/profilevalues.h"
#include "core/session/texts.h"
#include "core/yaml/yamledit.h"

#include <algorithm>
#include <set>

namespace dynascope {
namespace {

/// A register to be written into the file.
struct NewValue {
    QString name, text;
};

/// How deep a file's lines stand.
struct Layout {
    int dash = 2, key = 4; ///< columns of a joint's '-' and of its keys
    int step = 2;          ///< from there to its registers
};

QByteArray lineOf(const char *key, const QString &value)
{
    return key + QByteArrayLiteral(": ") + yamlScalar(value);
}

class Saver
{
public:
    Saver(const QByteArray &text, const Profile &profile, const YamlNode &root, const Catalog &catalog,
          const ProfileSaveOptions &options)
        : m_text(text), m_profile(profile), m_root(root), m_catalog(catalog), m_options(options), m_edits(text)
    {
        for (const ProfileJoint &joint : profile.joints)
            m_names.insert(joint.name);
    }

    SavedProfile save(const std::vector<SavedDevice> &devices)
    {
        std::set<const ProfileJoint *> seen;
        std::vector<const SavedDevice *> strangers;
        for (const SavedDevice &device : devices) {
            const ProfileJoint *joint = m_profile.at(device.found.baudRate, device.found.id);
            if (joint && seen.insert(joint).second)
                update(*joint, device);
            else if (!joint)
                strangers.push_back(&device);
        }
        for (const ProfileJoint &joint : m_profile.joints) {
            if (!seen.contains(&joint))
                m_saved.notes << ProfileText::tr("%1 was not read and stays as it is in the file").arg(joint.name);
        }
        addJoints(strangers);
        m_saved.text = m_edits.isEmpty() ? m_text : m_edits.result();
        return std::move(m_saved);
    }

private:
    const YamlNode &jointNode(const ProfileJoint &joint) const
    {
        const auto index = static_cast<std::size_t>(&joint - m_profile.joints.data());
        return m_root.find(u"joints")->children[index];
    }

    void update(const ProfileJoint &joint, const SavedDevice &device)
    {
        const ControlTablePtr table = m_catalog.find(device.found.modelNumber, device.found.firmware);
        if (!table || device.found.modelNumber != joint.modelNumber) {
            m_saved.notes << ProfileText::tr(
                                 "%1 is a %2 in the file, but a %3 answers there; it stays as it is in the file")
                                 .arg(joint.name, joint.model, modelName(m_catalog, device.found.modelNumber));
            return;
        }
        const RegisterLookup held = lookupIn(*table, device.image);
        std::vector<NewValue> added;
        for (const Field &field : table->fields()) {
            const auto raw = held(field.name);
            if (!raw || !mayBeInProfile(profileUse(*table, field)))
                continue;
            const ProfileRegister *known = joint.find(field.name);
            if (known ? means(*table, field, known->text, held) == raw : !isWanted(*table, field, *raw))
                continue;
            const auto text = sound(joint.name, *table, field, *raw, held, known ? known->text : QString());
            if (text && known && !known->isShared)
                change(joint, field, *text);
            else if (text)
                added.push_back({field.name, *text});
        }
        if (!added.empty())
            addRegisters(joint, added);
    }

    /// Nothing where the register holds what its own table doesn't allow: reading the file would refuse it.
    std::optional<QString> sound(const QString &joint, const ControlTable &table, const Field &field, std::int64_t raw,
                                 const RegisterLookup &held, const QString &like = {})
    {
        QString text = textOfValue(table, field, raw, held, like);
        if (means(table, field, text, held) == raw)
            return text;
        m_saved.notes << ProfileText::tr("%1: %2 holds %3, which is out of its range; it was left out")
                             .arg(joint, field.name)
                             .arg(raw);
        return std::nullopt;
    }

    static std::optional<std::int64_t> means(const ControlTable &table, const Field &field, const QString &text,
                                             const RegisterLookup &held)
    {
        const auto raw = parseValue(field, effective(field, held), table.resolution(), text);
        return raw ? std::optional(*raw) : std::nullopt;
    }

    bool isWanted(const ControlTable &table, const Field &field, std::int64_t raw) const
    {
        switch (profileUse(table, field)) {
        case ProfileUse::Setting: return m_options.all || field.initial != raw;
        case ProfileUse::Calibration: return m_options.calibration && (m_options.all || field.initial != raw);
        case ProfileUse::State: return m_options.all;
        default: return false;
        }
    }

    void change(const ProfileJoint &joint, const Field &field, const QString &text)
    {
        const YamlNode *registers = jointNode(joint).find(u"registers");
        for (std::size_t i = 0; registers && i + 1 < registers->children.size(); i += 2) {
            if (normalizedName(registers->children[i].text) != normalizedName(field.name))
                continue;
            m_edits.replace(registers->children[i + 1], text, registers->isFlow || jointNode(joint).isFlow);
            ++m_saved.changedValues;
        }
    }

    void addRegisters(const ProfileJoint &joint, const std::vector<NewValue> &values)
    {
        m_saved.newRegisters += static_cast<int>(values.size());
        const YamlNode &node = jointNode(joint);
        const YamlNode *registers = node.find(u"registers");
        if (node.isFlow || (registers && registers->isFlow))
            return addInBrackets(node, registers, values);
        const Layout layout = this->layout();
        if (registers && registers->isMap())
            return m_edits.insertLines(yamlEnd(m_text, *registers), registers->column - 1, linesOf(values));
        if (registers) { // the key alone, or with a "~"
            const auto key = std::ranges::find(node.children, QStringLiteral("registers"), &YamlNode::text);
            const qsizetype colon = behindColon(*key);
            if (const qsizetype tilde = behindSpaces(colon); isNull(tilde))
                m_edits.remove(tilde, tilde + (m_text[tilde] == '~' ? 1 : 4)); // or "null"
            return m_edits.insertLines(colon, key->column - 1 + layout.step, linesOf(values));
        }
        m_edits.insertLines(yamlEnd(m_text, node), node.column - 1,
                            QByteArrayList{QByteArrayLiteral("registers:")} + linesOf(values, layout.step));
    }

    /// As the last word of a file a key may stand without one.
    qsizetype behindColon(const YamlNode &key)
    {
        const qsizetype colon = behindSpaces(key.end);
        if (colon < m_text.size() && m_text[colon] == ':')
            return colon + 1;
        m_edits.insert(key.end, ":");
        return key.end;
    }
    bool isNull(qsizetype at) const { return at < m_text.size() && QByteArrayView("~nN").contains(m_text[at]); }
    qsizetype behindSpaces(qsizetype at) const
    {
        while (at < m_text.size() && m_text[at] == ' ')
            ++at;
        return at;
    }

    void addInBrackets(const YamlNode &node, const YamlNode *registers, const std::vector<NewValue> &values)
    {
        const YamlNode &into = registers && registers->isFlow ? *registers : node;
        QByteArray text = wordsOf(values).join(", ");
        if (&into == &node)
            text = (registers ? QByteArrayLiteral("{ ") : QByteArrayLiteral("registers: { ")) + text + " }";
        if (&into == &node && registers) { // "registers: ~" in brackets: behind the colon
            const auto key = std::ranges::find(node.children, QStringLiteral("registers"), &YamlNode::text);
            const qsizetype colon = behindColon(*key);
            const qsizetype tilde = behindSpaces(colon);
            if (isNull(tilde))
                m_edits.remove(tilde, tilde + (m_text[tilde] == '~' ? 1 : 4));
            return m_edits.insert(colon, ' ' + text);
        }
        if (into.children.empty())
            return m_edits.insert(into.begin + 1, ' ' + text + ' ');
        m_edits.insert(yamlEnd(m_text, into.children.back()), ", " + text);
    }

    static QByteArrayList wordsOf(const std::vector<NewValue> &values)
    {
        QByteArrayList words;
        for (const NewValue &value : values)
            words << yamlScalar(value.name, YamlNode::Style::Plain, true) + ": "
                         + yamlScalar(value.text, YamlNode::Style::Plain, true);
        return words;
    }

    static QByteArrayList linesOf(const std::vector<NewValue> &values, int indentation = 0)
    {
        QByteArrayList lines;
        for (const NewValue &value : values)
            lines << QByteArray(indentation, ' ') + yamlScalar(value.name) + ": " + yamlScalar(value.text);
        return lines;
    }

    /// As the file's first joints have it.
    Layout layout() const
    {
        Layout layout;
        const YamlNode *joints = m_root.find(u"joints");
        if (!joints || joints->isFlow || joints->children.empty())
            return layout;
        layout.dash = joints->column - 1;
        layout.key = layout.dash + 2;
        for (const YamlNode &joint : joints->children) {
            if (joint.isFlow)
                continue;
            layout.key = std::max(layout.key, joint.column - 1);
            const YamlNode *registers = joint.find(u"registers");
            if (!registers || !registers->isMap() || registers->isFlow)
                continue;
            layout.step = std::max(1, registers->column - joint.column);
            break;
        }
        return layout;
    }

    QString freeName(const SavedDevice &device)
    {
        const QString wanted = device.name.left(Profile::LongestName - 10).simplified();
        const QString base = wanted.isEmpty() ? ProfileText::tr("joint %1").arg(device.found.id) : wanted;
        QString name = base;
        for (int i = 2; m_names.contains(name); ++i)
            name = QStringLiteral("%1 %2").arg(base).arg(i);
        m_names.insert(name);
        return name;
    }

    void addJoints(const std::vector<const SavedDevice *> &devices)
    {
        const YamlNode *joints = m_root.find(u"joints");
        const Layout layout = this->layout();
        QByteArrayList lines, words;
        for (const SavedDevice *device : devices) {
            const ControlTablePtr table = m_catalog.find(device->found.modelNumber, device->found.firmware);
            if (!table) {
                m_saved.notes
                    << ProfileText::tr("ID %1 is of an unknown model and is not in the file").arg(device->found.id);
                continue;
            }
            ++m_saved.newJoints;
            const QString name = freeName(*device);
            const std::vector<NewValue> values = valuesOf(*device, *table, name);
            const QByteArrayList own = jointLines(*device, *table, name, values, layout.step);
            for (qsizetype i = 0; i < own.size(); ++i)
                lines << (i == 0 ? '-' + QByteArray(layout.key - layout.dash - 1, ' ')
                                 : QByteArray(layout.key - layout.dash, ' '))
                             + own[i];
            words << inBrackets(*device, *table, name, values);
        }
        if (lines.isEmpty())
            return;
        if (!joints->isList()) // a new file
            return m_edits.insertLines(m_text.size() - 1, layout.dash, lines);
        if (!joints->isFlow)
            return m_edits.insertLines(yamlEnd(m_text, *joints), layout.dash, lines);
        const QByteArray text = words.join(", ");
        if (joints->children.empty())
            m_edits.insert(joints->begin + 1, ' ' + text + ' ');
        else
            m_edits.insert(yamlEnd(m_text, joints->children.back()), ", " + text);
    }

    std::vector<NewValue> valuesOf(const SavedDevice &device, const ControlTable &table, const QString &name)
    {
        const RegisterLookup held = lookupIn(table, device.image);
        std::vector<NewValue> values;
        for (const Field &field : table.fields()) {
            const auto raw = held(field.name);
            if (!raw || !mayBeInProfile(profileUse(table, field)))
                continue;
            const Profile::Default *known = m_profile.defaultOf(table.modelNumber(), field.name);
            if (known ? means(table, field, known->text, held) == raw : !isWanted(table, field, *raw))
                continue;
            if (const auto text = sound(name, table, field, *raw, held))
                values.push_back({field.name, *text});
        }
        return values;
    }

    static QByteArrayList jointLines(const SavedDevice &device, const ControlTable &table, const QString &name,
                                     const std::vector<NewValue> &values, int step)
    {
        QByteArrayList lines{lineOf("name", name), lineOf("model", table.model()),
                             lineOf("id", QString::number(device.found.id)),
                             lineOf("baud", QString::number(device.found.baudRate)),
                             lineOf("firmware", QString::number(device.found.firmware))};
        if (!values.empty())
            lines << QByteArrayLiteral("registers:") << linesOf(values, step);
        return lines;
    }

    static QByteArray inBrackets(const SavedDevice &device, const ControlTable &table, const QString &name,
                                 const std::vector<NewValue> &values)
    {
        const QByteArrayList words = wordsOf(values);
        const QByteArray registers = words.isEmpty() ? QByteArray() : ", registers: { " + words.join(", ") + " }";
        const QString place = QStringLiteral("id: %1, baud: %2, firmware: %3")
                                  .arg(device.found.id)
                                  .arg(device.found.baudRate)
                                  .arg(device.found.firmware);
        return "{ name: " + yamlScalar(name, YamlNode::Style::Plain, true) + ", model: "
               + yamlScalar(table.model(), YamlNode::Style::Plain, true) + ", " + place.toUtf8() + registers + " }";
    }

    const QByteArray &m_text;
    const Profile &m_profile;
    const YamlNode &m_root;
    const Catalog &m_catalog;
    const ProfileSaveOptions &m_options;
    YamlEdits m_edits;
    SavedProfile m_saved;
    std::set<QString> m_names;
};

} // namespace

Result<SavedProfile> saveProfile(const QByteArray &text, const QString &file, const std::vector<SavedDevice> &devices,
                                 const Catalog &catalog, const ProfileSaveOptions &options)
{
    const bool isNew = text.trimmed().isEmpty();
    QByteArray base = text;
    Profile profile;
    if (isNew) {
        base = "profile: " + QByteArray::number(Profile::Version) + '\n';
        if (const QString name = options.name.left(Profile::LongestName).simplified(); !name.isEmpty())
            base += lineOf("name", name) + '\n';
        base += "joints:\n";
    } else {
        auto known = profileFromYaml(text, file, catalog);
        if (!known)
            return tl::unexpected(known.error());
        profile = std::move(*known);
    }
    const auto root = readYaml(base, file);
    if (!root)
        return tl::unexpected(root.error());
    SavedProfile saved = Saver(base, profile, *root, catalog, options).save(devices);
    if (isNew && saved.newJoints == 0)
        return failure(ErrorKind::NotFound, ProfileText::tr("there is no device that a profile could be made of"));
    if (const auto again = profileFromYaml(saved.text, file, catalog); !again) {
        return failure(
            ErrorKind::BadFile,
            ProfileText::tr("What would be written can't be read again, so nothing was: %1").arg(again.error().text));
    }
    return saved;
}

} // namespace dynascope
