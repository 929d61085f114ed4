// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/tablebuilder.h"

#include <QJsonArray>

#include <algorithm>

using namespace Qt::StringLiterals; // keys of JSON are found quicker by them

namespace dynascope {
namespace {

constexpr int MostRegisters = 2000;
constexpr int LeastBuffer = 64, MostBuffer = 65535; ///< bytes; a Sync Write of one register must fit
constexpr int MostTables = 16;    ///< of one model
constexpr int MostNumbered = 512; ///< registers made from one entry
constexpr std::size_t UsualNumbered = 128; ///< of all entries; more is made room for

const QString Indirect = QStringLiteral("indirect");
const QString IndirectAddress = QStringLiteral("Indirect Address #");
const QString IndirectData = QStringLiteral("Indirect Data #");

QString numbered(const QString &name, int number)
{
    const qsizetype place = name.indexOf(u'#');
    QString text;
    text.reserve(name.size() + 3);
    text.append(QStringView(name).first(place));
    text.append(QString::number(number));
    text.append(QStringView(name).sliced(place + 1));
    return text;
}

/// A field is large: each is moved once.
std::vector<Field> byAddress(std::vector<Field> fields)
{
    std::vector<std::pair<int, std::size_t>> order;
    for (std::size_t i = 0; i < fields.size(); ++i)
        order.emplace_back(fields[i].address, i);
    std::sort(order.begin(), order.end());
    std::vector<Field> sorted;
    sorted.reserve(fields.size());
    for (const auto &place : order)
        sorted.push_back(std::move(fields[place.second]));
    return sorted;
}

/// Registers that this model doesn't have are not reset.
void dropResetsWithout(std::vector<Field> &fields)
{
    for (Field &field : fields) {
        if (field.resets.isEmpty())
            continue;
        field.resets.removeIf([&](const QString &reset) {
            return std::none_of(
                fields.begin(), fields.end(), [&](const Field &other) { return other.name == reset; });
        });
    }
}

} // namespace

TableBuilder::TableBuilder(QString model, QJsonObject settings)
    : m_model(std::move(model)), m_settings(std::move(settings))
{
    readModel();
    readGear();
    readBaudRates();
    readSteps();
}

void TableBuilder::readModel()
{
    const auto text = [this](const char16_t *key) { return m_settings.value(QStringView(key)).toString(); };
    if (normalizedName(m_model).isEmpty() || m_model.size() > 40)
        say({}, QStringLiteral("not a name for a model"));
    m_common.model = m_model;
    m_common.modelNumber = static_cast<std::uint16_t>(numberIn(m_settings, QStringLiteral("number"), 0, 65535, {}));
    for (const QJsonValue &name : m_settings.value("alsoCalled"_L1).toArray())
        m_common.alsoCalled.append(name.toString());
    m_common.series = text(u"series");
    if (m_common.series.isEmpty())
        say({}, QStringLiteral("\"series\" is missing"));
    m_common.addressesOnly = m_settings.value("addressesOnly"_L1).toBool();
    m_common.newestFirmware = readFirmware(QStringLiteral("newestFirmware"));
    if (m_settings.contains("modbusNumberOffset"_L1))
        m_common.modbusNumber =
            m_common.modelNumber
            + static_cast<int>(numberIn(m_settings, QStringLiteral("modbusNumberOffset"), 1, 1000, {}));
    if (!m_common.addressesOnly)
        readAbilities();
    if (m_settings.contains("axes"_L1))
        m_common.axes = static_cast<int>(numberIn(m_settings, QStringLiteral("axes"), 1, 8, {}));
    if (m_settings.contains("receiveBuffer"_L1))
        m_common.receiveBuffer
            = static_cast<int>(numberIn(m_settings, QStringLiteral("receiveBuffer"), LeastBuffer, MostBuffer, {}));
    m_common.manualPage = text(u"manual");
    if (!m_common.manualPage.isEmpty() && !m_common.manualPage.startsWith(u"https://"))
        say({QStringLiteral("manual")}, QStringLiteral("\"manual\" must be an https address"));
    m_common.doubt = text(u"doubt");
    m_context.modelNumber = m_common.modelNumber;
    m_context.addressesOnly = m_common.addressesOnly;
    m_context.registers = m_settings.value(RegistersKey).toObject();
    m_context.baudRates = m_settings.value("baudRates"_L1).toObject();
    m_context.scales = m_settings.value("scales"_L1).toObject();
    m_context.valueLists = m_settings.value("valueLists"_L1).toObject();
}

void TableBuilder::readAbilities()
{
    m_common.fastReadsFrom = readFirmware(QStringLiteral("fastReadsSince"));
    m_common.backupFrom = readFirmware(QStringLiteral("backupSince"));
    m_common.clearFrom = readFirmware(QStringLiteral("clearSince"));
    m_common.clearsErrors = m_settings.value("clearsErrors"_L1).toBool();
    m_common.resetByBroadcastUntil = readFirmware(QStringLiteral("resetByBroadcastUntil"));
}

void TableBuilder::readGear()
{
    m_common.resolution = m_settings.contains("resolution"_L1)
                              ? static_cast<int>(numberIn(m_settings, QStringLiteral("resolution"), 1, 100'000'000, {}))
                              : 0;
    const QString torque = QStringLiteral("torqueConstant"), gear = QStringLiteral("gearRatio");
    if (m_settings.contains(torque)) {
        m_context.torqueConstant = m_settings.value(torque).toDouble();
        if (!(m_context.torqueConstant >= 1e-9 && m_context.torqueConstant <= 1e9))
            say({torque}, QStringLiteral("\"torqueConstant\" must be a number above 0"));
    }
    if (!m_settings.contains(gear))
        return;
    const QJsonArray both = m_settings.value(gear).toArray();
    GearRatio &ratio = m_context.gearRatio;
    ratio.numerator = both.at(0).toString();
    ratio.denominator = both.at(1).toString();
    const QJsonObject numerator = m_context.registers.value(ratio.numerator).toObject();
    const QJsonObject denominator = m_context.registers.value(ratio.denominator).toObject();
    if (both.size() != 2 || numerator.isEmpty() || denominator.isEmpty())
        return say({gear}, QStringLiteral("\"gearRatio\" must be two registers"));
    const double above = numerator.value("initial"_L1).toDouble(), below = denominator.value("initial"_L1).toDouble();
    ratio.initialTurns = above >= 1 && below >= 1 ? below / above : 1.0;
}

void TableBuilder::readBaudRates()
{
    const QJsonObject &rates = m_context.baudRates;
    for (auto it = rates.begin(); it != rates.end() && !m_common.addressesOnly; ++it) {
        bool isNumber = false;
        const int code = it.key().toInt(&isNumber);
        const std::int64_t rate = wholeNumber(it.value()).value_or(0);
        if (!isNumber || code < 0 || code > 255 || QString::number(code) != it.key() || rate < 1
            || rate > 100'000'000) {
            return say({QStringLiteral("baudRates"), it.key()},
                       QStringLiteral("\"baudRates\" must be codes from 0 to 255 and rates in bits per second"));
        }
        m_common.baudCodes.push_back({static_cast<std::uint8_t>(code), static_cast<int>(rate)});
    }
    std::sort(m_common.baudCodes.begin(), m_common.baudCodes.end(),
              [](const BaudCode &a, const BaudCode &b) { return a.code < b.code; });
}

int TableBuilder::readFirmware(const QString &key)
{
    return m_settings.contains(key) ? static_cast<int>(numberIn(m_settings, key, 0, NewestFirmware, {})) : -1;
}

void TableBuilder::readSteps()
{
    m_steps = {0, NewestFirmware + 1};
    if (m_common.addressesOnly)
        return; // of no known firmware
    for (auto it = m_context.registers.constBegin(); it != m_context.registers.constEnd(); ++it)
        collectSteps(it->toObject(), it, m_steps);
    for (const QJsonValue &group : m_settings.value(Indirect).toArray())
        collectSteps(group.toObject(), m_context.registers.constEnd(), m_steps);
    std::sort(m_steps.begin(), m_steps.end());
    m_steps.erase(std::unique(m_steps.begin(), m_steps.end()), m_steps.end());
    if (static_cast<int>(m_steps.size()) > MostTables)
        say({}, QStringLiteral("more than %1 kinds of firmware").arg(MostTables));
}

/// "since" and "until" of a register, or where it is none of a group, and of the values and bits within.
void TableBuilder::collectSteps(const QJsonObject &json, QJsonObject::const_iterator reg, std::vector<int> &steps)
{
    const QJsonValue since = json.value("since"_L1), until = json.value("until"_L1);
    if (!since.isUndefined() || !until.isUndefined()) {
        QStringList path{Indirect};
        if (reg != m_context.registers.constEnd())
            path = QStringList{RegistersKey, reg.key()};
        if (!since.isUndefined())
            steps.push_back(static_cast<int>(numberIn(json, QStringLiteral("since"), 0, NewestFirmware, path)));
        if (!until.isUndefined())
            steps.push_back(static_cast<int>(numberIn(json, QStringLiteral("until"), 0, NewestFirmware, path)) + 1);
        if (since.toInt(0) > until.toInt(NewestFirmware))
            say(path, QStringLiteral("%1: \"since\" is later than \"until\"").arg(path.last()));
    }
    for (const QLatin1StringView key : {"bits"_L1, "values"_L1, "special"_L1}) {
        const QJsonValue members = json.value(key);
        if (!members.isObject())
            continue;
        const QJsonObject all = members.toObject();
        for (auto it = all.begin(); it != all.end(); ++it) {
            if (it->isObject())
                collectSteps(it->toObject(), reg, steps);
        }
    }
}

ControlTablePtr TableBuilder::build(int from, int to, bool isKnownSound)
{
    ControlTable::Description table = m_common;
    m_context.firmware = from;
    m_context.isKnownSound = isKnownSound;
    table.firmwareFrom = from;
    table.firmwareTo = to;
    table.fields.reserve(static_cast<std::size_t>(m_context.registers.size()) + UsualNumbered);
    readRegisters(table.fields);
    readIndirect(table.fields);
    table.fields = byAddress(std::move(table.fields));
    if (!m_fault.isSet() && !isKnownSound)
        checkTogether(table.fields);
    dropResetsWithout(table.fields);
    if (m_fault.isSet())
        return nullptr;
    for (const Field &field : table.fields) {
        if (field.name == u"Operating Mode" || field.name == u"Control Mode") {
            for (const EnumValue &mode : field.values)
                table.operatingModes.push_back(static_cast<int>(mode.value));
        }
        // Positions in degrees are steps as well, as many as make a turn.
        if (field.unit == Unit::Degree && table.resolution == 0)
            table.resolution = static_cast<int>(std::clamp(360.0 / field.scale + 0.5, 1.0, 1e8));
        if (field.unit == Unit::Pulse && table.resolution == 0)
            sayOf(field, QStringLiteral("counts in pulses, but \"resolution\" is missing"));
    }
    return m_fault.isSet() ? nullptr : std::make_shared<const ControlTable>(std::move(table));
}

bool TableBuilder::exists(const QJsonObject &json) const
{
    return m_common.addressesOnly || holdsFor(json, m_context.firmware);
}

std::int64_t TableBuilder::numberIn(const QJsonObject &json, const QString &key, std::int64_t low, std::int64_t high,
                                    const QStringList &path)
{
    const std::optional<std::int64_t> number = wholeNumber(json.value(key));
    if (number && *number >= low && *number <= high)
        return *number;
    const QString place = path.isEmpty() ? QString() : path.last() + QStringLiteral(": ");
    say(path + QStringList{key},
        QStringLiteral("%1\"%2\" must be a whole number from %3 to %4").arg(place, key).arg(low).arg(high));
    return low;
}

void TableBuilder::say(const QStringList &path, const QString &what, const QStringList &elsewhere)
{
    if (!m_fault.isSet())
        m_fault = {m_model + QStringLiteral(": ") + what, path, elsewhere};
}

QStringList TableBuilder::pathOf(const Field &field) const
{
    static const QString block = QStringLiteral("Indirect ");
    const bool generated = field.name.startsWith(block) && !m_context.registers.contains(field.name)
                           && !m_context.registers.contains(IndirectAddress);
    return generated ? QStringList{Indirect} : QStringList{RegistersKey, field.name};
}

void TableBuilder::sayOf(const Field &field, const QString &what, const Field *other)
{
    say(pathOf(field), QStringLiteral("%1: %2").arg(field.name, what), other ? pathOf(*other) : QStringList());
}

// --- Registers ------------------------------------------------------------------------------------------------------

void TableBuilder::readRegisters(std::vector<Field> &fields)
{
    const QJsonObject &registers = m_context.registers;
    for (auto it = registers.begin(); it != registers.end() && !m_fault.isSet(); ++it) {
        const QJsonObject json = it->toObject();
        if (!exists(json))
            continue;
        if (it.key().contains(u'#')) {
            readNumbered(it.key(), json, fields);
        } else if (json.contains("count"_L1)) {
            say({RegistersKey, it.key()},
                QStringLiteral("%1: \"count\" needs a # in the name, for the number").arg(it.key()));
        } else {
            add(it.key(), it.key(), json, fields);
        }
    }
}

void TableBuilder::readNumbered(const QString &name, const QJsonObject &json, std::vector<Field> &fields)
{
    const QStringList path{RegistersKey, name};
    const auto count = static_cast<int>(numberIn(json, QStringLiteral("count"), 1, MostNumbered, path));
    int stride = json.value("size"_L1).toInt();
    if (json.contains("stride"_L1))
        stride = static_cast<int>(numberIn(json, QStringLiteral("stride"), 1, 256, path));
    add(numbered(name, 1), name, json, fields);
    if (!m_fault.isSet())
        addCopies(fields.back(), name, 2, count - 1, stride, 0, fields);
}

/// Registers that differ from `first` in number, address and initial value only.
void TableBuilder::addCopies(const Field &first, const QString &name, int from, int count, int stride, int initialStep,
                             std::vector<Field> &fields)
{
    Field copy = first; // `first` may be one of `fields`
    if (static_cast<int>(fields.size()) + count > MostRegisters)
        return say({}, QStringLiteral("more than %1 registers").arg(MostRegisters));
    for (int i = 0; i < count; ++i) {
        if (copy.end() + stride > 0x10000)
            return sayOf(copy, QStringLiteral("is followed by more than the address space holds"));
        copy.name = numbered(name, from + i);
        copy.address = static_cast<std::uint16_t>(copy.address + stride);
        if (copy.initial)
            copy.initial = *copy.initial + initialStep;
        fields.push_back(copy);
    }
}

void TableBuilder::readIndirect(std::vector<Field> &fields)
{
    int number = 1;
    for (const QJsonValue &entry : m_settings.value(Indirect).toArray()) {
        const QJsonObject group = entry.toObject();
        if (!exists(group))
            continue;
        for (const QJsonValue &block : group.value("blocks"_L1).toArray())
            readIndirectBlock(block.toObject(), group.value("range"_L1), number, fields);
    }
}

void TableBuilder::readIndirectBlock(const QJsonObject &block, const QJsonValue &range, int &number,
                                     std::vector<Field> &fields)
{
    const QStringList path{Indirect};
    const auto count = static_cast<int>(numberIn(block, QStringLiteral("count"), 1, MostNumbered, path));
    const std::int64_t address = numberIn(block, QStringLiteral("address"), 0, 65535, path);
    const std::int64_t dataAddress = numberIn(block, QStringLiteral("dataAddress"), 0, 65535, path);
    const QJsonObject definitions = m_settings.value("definitions"_L1).toObject();
    QJsonObject pointer = definitions.value(IndirectAddress).toObject();
    QJsonObject data = definitions.value(IndirectData).toObject();
    if (range.isUndefined() || pointer.isEmpty() || data.isEmpty())
        return say(path, QStringLiteral("indirect: needs \"range\", and definitions of the two registers"));
    pointer.insert(QStringLiteral("range"), range);
    pointer.insert(QStringLiteral("address"), static_cast<qint64>(address));
    pointer.insert(QStringLiteral("initial"), static_cast<qint64>(dataAddress));
    data.insert(QStringLiteral("address"), static_cast<qint64>(dataAddress));
    add(numbered(IndirectAddress, number), Indirect, pointer, fields);
    add(numbered(IndirectData, number), Indirect, data, fields);
    if (m_fault.isSet())
        return;
    const Field first = fields[fields.size() - 2], shown = fields.back();
    addCopies(first, IndirectAddress, number + 1, count - 1, first.size, 1, fields);
    addCopies(shown, IndirectData, number + 1, count - 1, shown.size, 0, fields);
    const std::int64_t last = dataAddress + count - 1;
    if (last > first.maximum.number.value_or(last))
        say(path, QStringLiteral("indirect: initial value %1 lies outside the range").arg(last));
    number += count;
}

void TableBuilder::add(const QString &name, const QString &key, const QJsonObject &json, std::vector<Field> &fields)
{
    if (static_cast<int>(fields.size()) >= MostRegisters)
        return say({}, QStringLiteral("more than %1 registers").arg(MostRegisters));
    FieldReader reader(m_context);
    fields.push_back(reader.read(name, json));
    if (reader.wrong().isEmpty())
        return;
    say(key == Indirect ? QStringList{Indirect} : QStringList{RegistersKey, key} + reader.wrongPath(), reader.wrong());
}

} // namespace dynascope
