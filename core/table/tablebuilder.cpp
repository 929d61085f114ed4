// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/tablebuilder.h"

#include <QJsonArray>

#include <algorithm>

namespace dynascope {
namespace {

constexpr int MostRegisters = 2000;
constexpr int LeastBuffer = 64, MostBuffer = 65535; ///< bytes; a Sync Write of one register must fit
constexpr int MostTables = 16;    ///< of one model
constexpr int MostNumbered = 512; ///< registers made from one entry

const QString IndirectAddress = QStringLiteral("Indirect Address #");
const QString IndirectData = QStringLiteral("Indirect Data #");

} // namespace

TableBuilder::TableBuilder(QString model, QJsonObject settings)
    : m_model(std::move(model)), m_settings(std::move(settings))
{
}

std::vector<ControlTablePtr> TableBuilder::build()
{
    std::vector<ControlTablePtr> tables;
    readModel();
    const std::vector<int> steps = firmwareSteps();
    for (std::size_t i = 0; i + 1 < steps.size() && m_wrong.isEmpty(); ++i)
        tables.push_back(buildFor(steps[i], steps[i + 1] - 1));
    return m_wrong.isEmpty() ? tables : std::vector<ControlTablePtr>();
}

void TableBuilder::readModel()
{
    if (normalizedName(m_model).isEmpty() || m_model.size() > 40)
        say(QStringLiteral("not a name for a model"));
    m_common.model = m_model;
    m_common.modelNumber = static_cast<std::uint16_t>(numberIn(m_settings, QStringLiteral("number"), 0, 65535, {}));
    m_common.series = m_settings.value(u"series").toString();
    if (m_common.series.isEmpty())
        say(QStringLiteral("\"series\" is missing"));
    m_common.resolution = static_cast<int>(numberIn(m_settings, QStringLiteral("resolution"), 1, 100'000'000, {}));
    if (m_settings.contains(u"axes"))
        m_common.axes = static_cast<int>(numberIn(m_settings, QStringLiteral("axes"), 1, 2, {}));
    m_newestFirmware = static_cast<int>(numberIn(m_settings, QStringLiteral("newestFirmware"), 0, NewestFirmware, {}));
    m_common.fastReadsFrom = readFirmware(QStringLiteral("fastReadsSince"));
    m_common.backupFrom = readFirmware(QStringLiteral("backupSince"));
    if (m_settings.contains(u"receiveBuffer"))
        m_common.receiveBuffer
            = static_cast<int>(numberIn(m_settings, QStringLiteral("receiveBuffer"), LeastBuffer, MostBuffer, {}));
    m_common.manualPage = m_settings.value(u"manual").toString();
    if (!m_common.manualPage.startsWith(u"https://"))
        say(QStringLiteral("\"manual\" must be an https address"));
    readBaudRates();
    m_context.modelNumber = m_common.modelNumber;
    m_context.registers = m_settings.value(u"registers").toObject();
    m_context.baudRates = m_settings.value(u"baudRates").toObject();
}

void TableBuilder::readBaudRates()
{
    const QJsonObject rates = m_settings.value(u"baudRates").toObject();
    for (auto it = rates.begin(); it != rates.end(); ++it) {
        bool isNumber = false;
        const int code = it.key().toInt(&isNumber);
        const std::int64_t rate = wholeNumber(it.value()).value_or(0);
        if (!isNumber || code < 0 || code > 255 || QString::number(code) != it.key() || rate < 1 || rate > 100'000'000)
            return say(QStringLiteral("\"baudRates\" must be codes from 0 to 255 and rates in bits per second"));
        m_common.baudCodes.push_back({static_cast<std::uint8_t>(code), static_cast<int>(rate)});
    }
    std::sort(m_common.baudCodes.begin(), m_common.baudCodes.end(),
        [](const BaudCode &a, const BaudCode &b) { return a.code < b.code; });
}

int TableBuilder::readFirmware(const QString &key)
{
    return m_settings.contains(key) ? static_cast<int>(numberIn(m_settings, key, 0, NewestFirmware, {})) : -1;
}

/// Where the table changes: 0, each first firmware of something new or gone, and one past the newest.
std::vector<int> TableBuilder::firmwareSteps()
{
    std::vector<int> steps{0, NewestFirmware + 1};
    const QJsonObject registers = m_settings.value(u"registers").toObject();
    for (auto it = registers.begin(); it != registers.end(); ++it)
        collectSteps(it.value(), it.key(), steps);
    collectSteps(m_settings.value(u"indirect"), QStringLiteral("indirect"), steps);
    std::sort(steps.begin(), steps.end());
    steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
    if (static_cast<int>(steps.size()) > MostTables)
        say(QStringLiteral("more than %1 kinds of firmware").arg(MostTables));
    return steps;
}

void TableBuilder::collectSteps(const QJsonValue &value, const QString &where, std::vector<int> &steps)
{
    for (const QJsonValue &member : value.toArray())
        collectSteps(member, where, steps);
    const QJsonObject json = value.toObject();
    for (const QString &key : {QStringLiteral("since"), QStringLiteral("until")}) {
        if (!json.contains(key))
            continue;
        const auto firmware = static_cast<int>(numberIn(json, key, 0, NewestFirmware, where));
        steps.push_back(key == u"since" ? firmware : firmware + 1);
    }
    if (json.value(u"since").toInt(0) > json.value(u"until").toInt(NewestFirmware))
        say(QStringLiteral("%1: \"since\" is later than \"until\"").arg(where));
    for (const QJsonValue &member : json)
        collectSteps(member, where, steps);
}

ControlTablePtr TableBuilder::buildFor(int from, int to)
{
    ControlTable::Description table = m_common;
    m_context.firmware = from;
    table.firmwareFrom = from;
    table.firmwareTo = to;
    readRegisters(table.fields);
    readIndirect(table.fields);
    if (m_wrong.isEmpty())
        checkTogether(table.fields);
    for (const Field &field : table.fields) {
        if (field.name == u"Operating Mode") {
            for (const EnumValue &mode : field.values)
                table.operatingModes.push_back(static_cast<int>(mode.value));
        }
    }
    return std::make_shared<const ControlTable>(std::move(table));
}

void TableBuilder::readRegisters(std::vector<Field> &fields)
{
    const QJsonObject &registers = m_context.registers;
    for (auto it = registers.begin(); it != registers.end() && m_wrong.isEmpty(); ++it) {
        const QJsonObject json = it->toObject();
        if (!holdsFor(json, m_context.firmware))
            continue;
        if (it.key().contains(u'#'))
            readNumbered(it.key(), json, fields);
        else if (json.contains(u"count"))
            say(QStringLiteral("%1: \"count\" needs a # in the name, for the number").arg(it.key()));
        else
            add(it.key(), json, fields);
    }
}

void TableBuilder::readNumbered(const QString &name, const QJsonObject &json, std::vector<Field> &fields)
{
    const std::int64_t count = numberIn(json, QStringLiteral("count"), 1, MostNumbered, name);
    for (int i = 0; i < count && m_wrong.isEmpty(); ++i) {
        QJsonObject one = json;
        if (i > 0)
            one.insert(QStringLiteral("address"), json.value(u"address").toDouble() + i * json.value(u"size").toInt());
        add(QString(name).replace(u'#', QString::number(i + 1)), one, fields);
    }
}

void TableBuilder::readIndirect(std::vector<Field> &fields)
{
    int number = 1;
    for (const QJsonValue &entry : m_settings.value(u"indirect").toArray()) {
        const QJsonObject group = entry.toObject();
        if (!holdsFor(group, m_context.firmware))
            continue;
        for (const QJsonValue &block : group.value(u"blocks").toArray())
            readIndirectBlock(block.toObject(), group.value(u"range"), number, fields);
    }
}

void TableBuilder::readIndirectBlock(
    const QJsonObject &block, const QJsonValue &range, int &number, std::vector<Field> &fields)
{
    const QString where = QStringLiteral("indirect");
    const std::int64_t count = numberIn(block, QStringLiteral("count"), 1, MostNumbered, where);
    const std::int64_t address = numberIn(block, QStringLiteral("address"), 0, 65535, where);
    const std::int64_t dataAddress = numberIn(block, QStringLiteral("dataAddress"), 0, 65535, where);
    const QJsonObject definitions = m_settings.value(u"definitions").toObject();
    QJsonObject pointer = definitions.value(IndirectAddress).toObject();
    QJsonObject data = definitions.value(IndirectData).toObject();
    if (range.isUndefined() || pointer.isEmpty() || data.isEmpty())
        return say(QStringLiteral("%1: needs \"range\", and definitions of the two registers").arg(where));
    pointer.insert(QStringLiteral("range"), range);
    for (std::int64_t i = 0; i < count && m_wrong.isEmpty(); ++i, ++number) {
        pointer.insert(QStringLiteral("address"), static_cast<qint64>(address + i * pointer.value(u"size").toInt()));
        pointer.insert(QStringLiteral("initial"), static_cast<qint64>(dataAddress + i));
        data.insert(QStringLiteral("address"), static_cast<qint64>(dataAddress + i * data.value(u"size").toInt()));
        add(QString(IndirectAddress).replace(u'#', QString::number(number)), pointer, fields);
        add(QString(IndirectData).replace(u'#', QString::number(number)), data, fields);
    }
}

void TableBuilder::add(const QString &name, const QJsonObject &json, std::vector<Field> &fields)
{
    if (static_cast<int>(fields.size()) >= MostRegisters)
        return say(QStringLiteral("more than %1 registers").arg(MostRegisters));
    FieldReader reader(m_context);
    fields.push_back(reader.read(name, json));
    if (!reader.wrong().isEmpty())
        say(reader.wrong());
}

void TableBuilder::checkTogether(std::vector<Field> &fields)
{
    if (fields.empty())
        return say(QStringLiteral("no registers at firmware %1").arg(m_context.firmware));
    std::stable_sort(
        fields.begin(), fields.end(), [](const Field &a, const Field &b) { return a.address < b.address; });
    for (std::size_t i = 1; i < fields.size(); ++i) {
        if (fields[i].address < fields[i - 1].end())
            return say(QStringLiteral("%1: overlaps %2 at address %3")
                           .arg(fields[i].name, fields[i - 1].name)
                           .arg(fields[i].address));
    }
    checkNames(fields);
}

void TableBuilder::checkNames(std::vector<Field> &fields)
{
    QStringList names;
    std::vector<std::pair<QString, QString>> plain;
    for (const Field &field : fields) {
        names.append(field.name);
        plain.emplace_back(normalizedName(field.name), field.name);
    }
    std::sort(plain.begin(), plain.end());
    for (std::size_t i = 1; i < plain.size(); ++i) {
        if (plain[i].first == plain[i - 1].first)
            return say(QStringLiteral("%1 and %2 are one name").arg(plain[i - 1].second, plain[i].second));
    }
    const QJsonObject definitions = m_settings.value(u"definitions").toObject();
    for (Field &field : fields) {
        checkBound(field, field.minimum, names);
        checkBound(field, field.maximum, names);
        for (const Alternate &alternate : field.alternates) {
            checkBound(field, alternate.minimum, names);
            checkBound(field, alternate.maximum, names);
        }
        // What is defined but not in this model is no mistake; what nobody knows is.
        for (const QString &reset : field.resets) {
            if (!m_context.registers.contains(reset) && !definitions.contains(reset))
                say(QStringLiteral("%1: resets %2, which is no register").arg(field.name, reset));
        }
        field.resets.removeIf([&](const QString &reset) { return !names.contains(reset); });
    }
}

void TableBuilder::checkBound(const Field &field, const Bound &bound, const QStringList &names)
{
    if (!bound.reg.isEmpty() && (bound.reg == field.name || !names.contains(bound.reg)))
        say(QStringLiteral("%1: limited by %2, which is no other register").arg(field.name, bound.reg));
}

std::int64_t TableBuilder::numberIn(
    const QJsonObject &json, const QString &key, std::int64_t low, std::int64_t high, const QString &where)
{
    const std::optional<std::int64_t> number = wholeNumber(json.value(key));
    if (number && *number >= low && *number <= high)
        return *number;
    const QString place = where.isEmpty() ? QString() : where + QStringLiteral(": ");
    say(QStringLiteral("%1\"%2\" must be a whole number from %3 to %4").arg(place, key).arg(low).arg(high));
    return low;
}

void TableBuilder::say(const QString &what)
{
    if (m_wrong.isEmpty())
        m_wrong = m_model + QStringLiteral(": ") + what;
}

} // namespace dynascope
