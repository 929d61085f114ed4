// SPDX-License-Identifier: GPL-3.0-or-later
// A bus as a file: resources/buses/FORMAT.md.
#include "core/protocol/protocol_values.h"
#include "core/sim/busplan.h"
#include "core/sim/faulttext.h"
#include "core/yaml/yamltree.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace dynascope::sim {
namespace {

constexpr int FormatVersion = 1;
constexpr std::size_t MostRegisters = 500;
constexpr qsizetype LongestName = 64;

/// Reads one file; the first thing wrong ends it.
class Reader
{
public:
    Reader(QString name, const Catalog &catalog) : m_name(std::move(name)), m_catalog(catalog) { }

    Result<BusPlan> read(const YamlNode &root)
    {
        if (map(root, u"a bus", {u"format", u"seed", u"supply", u"temperature", u"faults", u"devices"})) {
            const YamlNode *format = root.find(u"format");
            if (!format || whole(*format, 1, 1'000'000) != FormatVersion)
                say(format ? *format : root, QStringLiteral("\"format\" must be %1").arg(FormatVersion));
            if (const YamlNode *seed = root.find(u"seed"))
                m_plan.seed = static_cast<std::uint64_t>(whole(*seed, 0, std::numeric_limits<std::int64_t>::max()));
            m_plan.supply = optional(root, u"supply", 0, 100);
            m_plan.temperature = optional(root, u"temperature", -100, 300);
            readFaults(root.find(u"faults"));
            readDevices(root);
        }
        if (m_wrong)
            return tl::unexpected(*m_wrong);
        return std::move(m_plan);
    }

private:
    void say(const YamlNode &where, const QString &what)
    {
        if (!m_wrong)
            m_wrong = yamlFailure(m_name, where, what).value();
    }

    /// Is it a map with none but these keys?
    bool map(const YamlNode &node, QStringView what, std::initializer_list<QStringView> keys)
    {
        if (!node.isMap()) {
            say(node, QStringLiteral("%1 is written as KEY: VALUE").arg(what.toString()));
            return false;
        }
        QStringList known;
        for (const QStringView key : keys)
            known.append(key.toString());
        for (std::size_t i = 0; i + 1 < node.children.size(); i += 2) {
            if (!known.contains(node.children[i].text))
                say(node.children[i], QStringLiteral("\"%1\" is no key of %2: %3")
                                          .arg(node.children[i].text, what.toString(), known.join(QStringLiteral(", "))));
        }
        return !m_wrong;
    }

    std::int64_t whole(const YamlNode &node, std::int64_t low, std::int64_t high)
    {
        bool ok = false;
        const qint64 number = node.text.toLongLong(&ok, node.text.startsWith(u"0x") ? 16 : 10);
        if (node.kind == YamlNode::Kind::Scalar && ok && number >= low && number <= high)
            return number;
        say(node, QStringLiteral("a whole number from %1 to %2 is wanted here").arg(low).arg(high));
        return low;
    }

    double number(const YamlNode &node, double low, double high)
    {
        bool ok = false;
        const double value = node.text.toDouble(&ok);
        if (node.kind == YamlNode::Kind::Scalar && ok && value >= low && value <= high)
            return value;
        say(node, QStringLiteral("a number from %1 to %2 is wanted here").arg(low).arg(high));
        return low;
    }

    std::optional<double> optional(const YamlNode &map, QStringView key, double low, double high)
    {
        const YamlNode *node = map.find(key);
        return node ? std::optional(number(*node, low, high)) : std::nullopt;
    }

    void readFaults(const YamlNode *node)
    {
        if (!node)
            return;
        std::vector<const YamlNode *> words;
        if (node->isList()) {
            for (const YamlNode &child : node->children)
                words.push_back(&child);
        } else {
            words.push_back(node);
        }
        for (const YamlNode *word : words) {
            auto faults = parseFaults(word->text, m_plan.faults);
            if (word->kind != YamlNode::Kind::Scalar)
                say(*word, QStringLiteral("a fault is a word, as --fault takes it"));
            else if (!faults)
                say(*word, faults.error().text);
            else
                m_plan.faults = std::move(*faults);
        }
    }

    void readDevices(const YamlNode &root)
    {
        const YamlNode *devices = root.find(u"devices");
        if (!devices || !devices->isList() || devices->children.empty())
            return say(devices ? *devices : root, QStringLiteral("\"devices\" must be a list of at least one"));
        if (static_cast<int>(devices->children.size()) > MostPlannedDevices)
            return say(*devices, QStringLiteral("more than %1 devices").arg(MostPlannedDevices));
        for (const YamlNode &device : devices->children) {
            if (!m_wrong)
                readDevice(device);
        }
    }

    void readDevice(const YamlNode &node)
    {
        if (!map(node, u"a device", {u"model", u"firmware", u"baud", u"id", u"name", u"supply", u"registers", u"load"}))
            return;
        BusPlan::Device device;
        const YamlNode *model = node.find(u"model");
        const YamlNode *id = node.find(u"id");
        if (!model || !id)
            return say(node, QStringLiteral("a device needs \"model\" and \"id\""));
        device.spec.model = model->text;
        if (const YamlNode *firmware = node.find(u"firmware"))
            device.spec.firmware = static_cast<int>(whole(*firmware, 0, 255));
        const YamlNode *baud = node.find(u"baud");
        device.spec.baudRate = baud ? static_cast<int>(whole(*baud, 1, HighestBaudRate)) : 57600;
        readIds(*id, device.spec);
        if (m_wrong)
            return;
        if (const auto good = checkServoSpec(device.spec, m_catalog); !good)
            return say(good.error().kind == ErrorKind::NotFound ? *model : baud ? *baud : node, good.error().text);
        device.supply = optional(node, u"supply", 0, 100);
        device.axes.resize(device.spec.secondId < 0 ? 1 : 2);
        readNames(node.find(u"name"), device);
        readLoads(node.find(u"load"), device);
        readRegisters(node.find(u"registers"), device);
        m_plan.devices.push_back(std::move(device));
    }

    void readIds(const YamlNode &node, ServoSpec &spec)
    {
        if (!node.isList()) {
            spec.id = static_cast<int>(whole(node, 0, MaximumId));
            return;
        }
        if (node.children.size() != 2)
            return say(node, QStringLiteral("one ID, or [ID, ID] for a model with two axes"));
        spec.id = static_cast<int>(whole(node.children[0], 0, MaximumId));
        spec.secondId = static_cast<int>(whole(node.children[1], 0, MaximumId));
    }

    /// What is said once or, as a list, for each axis.
    const YamlNode &ofAxis(const YamlNode &node, std::size_t axis, std::size_t axes)
    {
        if (!node.isList())
            return node;
        if (node.children.size() == axes)
            return node.children[axis];
        say(node, QStringLiteral("one for each axis is wanted here"));
        return node;
    }

    void readNames(const YamlNode *node, BusPlan::Device &device)
    {
        for (std::size_t i = 0; node && i < device.axes.size(); ++i) {
            const YamlNode &name = ofAxis(*node, i, device.axes.size());
            const auto odd = [](QChar c) { return c.isSpace() || !c.isPrint() || c == u'@' || c == u'#'; };
            bool isId = false;
            (void)name.text.toInt(&isId);
            if (name.kind != YamlNode::Kind::Scalar || name.text.isEmpty() || name.text.size() > LongestName || isId
                || name.text == u"all" || name.text == u"adapter" || std::ranges::any_of(name.text, odd))
                return say(name, QStringLiteral("a name is one word that is no number, without @ and #"));
            if (!m_names.insert(name.text).second)
                return say(name, QStringLiteral("the name %1 stands twice").arg(name.text));
            device.axes[i].name = name.text;
        }
    }

    void readLoads(const YamlNode *node, BusPlan::Device &device)
    {
        for (std::size_t i = 0; node && i < device.axes.size(); ++i) {
            const YamlNode &load = ofAxis(*node, i, device.axes.size());
            if (!map(load, u"a load", {u"inertia", u"gravity", u"torque", u"angle", u"stops"}))
                return;
            BusPlan::Axis &axis = device.axes[i];
            axis.inertia = optional(load, u"inertia", 0, 1000);
            axis.gravity = optional(load, u"gravity", -1000, 1000);
            axis.torque = optional(load, u"torque", -1000, 1000);
            axis.angle = optional(load, u"angle", -1e6, 1e6);
            const YamlNode *stops = load.find(u"stops");
            if (!stops)
                continue;
            if (!stops->isList() || stops->children.size() != 2)
                return say(*stops, QStringLiteral("hard stops are [LOWEST, HIGHEST] in degrees"));
            axis.stops.emplace(number(stops->children[0], -1e6, 1e6), number(stops->children[1], -1e6, 1e6));
            if (axis.stops->first >= axis.stops->second)
                say(*stops, QStringLiteral("the lowest stop lies below the highest"));
        }
    }

    void readRegisters(const YamlNode *node, BusPlan::Device &device)
    {
        if (!node || m_wrong)
            return;
        const Catalog::ModelInfo *info = m_catalog.model(QStringView(device.spec.model));
        const int firmware = device.spec.firmware < 0 ? info->newestFirmware : device.spec.firmware;
        const ControlTablePtr table = m_catalog.find(info->modelNumber, firmware);
        if (!node->isMap() || node->children.size() / 2 > MostRegisters)
            return say(*node, QStringLiteral("registers are written REGISTER: VALUE"));
        for (std::size_t i = 0; i + 1 < node->children.size(); i += 2) {
            const YamlNode &name = node->children[i], &value = node->children[i + 1];
            const Field *field = table->find(name.text);
            if (!field)
                return say(name, QStringLiteral("%1 has no register %2").arg(info->model, name.text));
            if (field == table->find(Known::Id) || field == table->find(Known::BaudRate))
                return say(name, QStringLiteral("%1 is said by \"id\" and \"baud\"").arg(field->name));
            const std::int64_t raw = whole(value, smallestRaw(*field), largestRaw(*field));
            device.registers.push_back(
                {field->name, raw, QStringLiteral("%1:%2:%3").arg(m_name).arg(value.line).arg(value.column)});
        }
    }

    const QString m_name;
    const Catalog &m_catalog;
    BusPlan m_plan;
    std::set<QString> m_names;
    std::optional<Error> m_wrong;
};

} // namespace

Result<BusPlan> readBusPlan(const QByteArray &yaml, const QString &name, const Catalog &catalog)
{
    const auto root = readYaml(yaml, name);
    if (!root)
        return tl::unexpected(root.error());
    return Reader(name, catalog).read(*root);
}

} // namespace dynascope::sim
