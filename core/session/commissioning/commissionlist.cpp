// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/commissioning/commissionlist.h"
#include "core/session/texts.h"

#include <algorithm>
#include <set>

namespace dynascope {
namespace {

tl::unexpected<Error> wrong(const QString &text)
{
    return failure(ErrorKind::InvalidArgument, text);
}

ControlTablePtr tableOf(const CommissionJoint &joint, const Catalog &catalog)
{
    const Catalog::ModelInfo *model = catalog.model(joint.modelNumber);
    return model ? catalog.find(joint.modelNumber, std::max(model->newestFirmware, joint.minimumFirmware)) : nullptr;
}

MovePlace factoryPlace(const ControlTable &table)
{
    const Field *id = table.find(Known::Id);
    const Field *baud = table.find(Known::BaudRate);
    const auto code = static_cast<int>(baud ? baud->initial.value_or(1) : 1);
    return {table.baudRate(code).value_or(57600), static_cast<int>(id ? id->initial.value_or(1) : 1)};
}

/// Would such a servo take it?
Result<void> checkSettings(const CommissionJoint &joint, const ControlTable &table)
{
    DevicePlace place;
    place.id = static_cast<std::uint8_t>(joint.place.id);
    place.baudRate = joint.place.baudRate;
    place.modelNumber = static_cast<std::uint16_t>(joint.modelNumber);
    place.name = jointText(joint);
    const auto wanted = wantedSettings(joint, table);
    if (!wanted)
        return tl::unexpected(wanted.error());
    const auto plan = planSettings(table, place, -1, *wanted, {});
    return plan ? Result<void>() : tl::unexpected(plan.error());
}

Result<void> check(const CommissionJoint &joint, const Catalog &catalog)
{
    const QString who = jointText(joint);
    if (joint.name.size() > LongestJointName || joint.name.contains(u'\n'))
        return wrong(
            CommissioningText::tr("A joint's name is one line of at most %1 characters").arg(LongestJointName));
    if (joint.place.id < 0 || joint.place.id > MaximumId)
        return wrong(CommissioningText::tr("%1: an ID is 0 to %2").arg(who).arg(MaximumId));
    const ControlTablePtr table = tableOf(joint, catalog);
    if (!table)
        return wrong(CommissioningText::tr("%1: model %2 is not known").arg(who).arg(joint.modelNumber));
    if (!table->baudCode(joint.place.baudRate))
        return wrong(
            CommissioningText::tr("%1: %2 does not offer %3 bps").arg(who, table->model()).arg(joint.place.baudRate));
    if (!table->find(Known::Id) || table->axes() > 1)
        return wrong(
            CommissioningText::tr("%1: %2 can't be set up here: it has more than one ID, or none that is known")
                .arg(who, table->model()));
    return joint.settings.empty() ? Result<void>() : checkSettings(joint, *table);
}

QString timeText(const QDateTime &at)
{
    return at.toLocalTime().toString(QStringLiteral("yyyy-MM-dd HH:mm:ss"));
}

/// A cell as spreadsheets read it back: quoted where it has to be, and never taken for a formula.
QByteArray cell(QString text)
{
    if (!text.isEmpty() && QStringView(u"=+-@\t").contains(text.front()))
        text.prepend(u'\'');
    if (text.contains(u',') || text.contains(u'"') || text.contains(u'\r'))
        text = u'"' + text.replace(u'"', QStringLiteral("\"\"")) + u'"';
    return text.toUtf8();
}

QByteArray csvLine(const QStringList &cells)
{
    QByteArray line;
    for (const QString &text : cells)
        line += (line.isEmpty() ? "" : ",") + cell(text);
    return line + '\n';
}

} // namespace

QString jointText(const CommissionJoint &joint)
{
    return joint.name.isEmpty() ? CommissioningText::tr("ID %1").arg(joint.place.id)
                                : CommissioningText::tr("%1 (ID %2)").arg(joint.name).arg(joint.place.id);
}

Result<CommissionList> CommissionList::make(const Catalog &catalog, std::vector<CommissionJoint> joints)
{
    if (joints.empty() || joints.size() > MostJoints)
        return wrong(CommissioningText::tr("A list has 1 to %1 joints").arg(MostJoints));
    std::set<MovePlace> places;
    std::set<QString> names;
    for (const CommissionJoint &joint : joints) {
        if (const auto fine = check(joint, catalog); !fine)
            return tl::unexpected(fine.error());
        if (!places.insert(joint.place).second)
            return wrong(CommissioningText::tr("%1 is wanted twice").arg(placeText(joint.place)));
        if (!joint.name.isEmpty() && !names.insert(joint.name).second)
            return wrong(CommissioningText::tr("Two joints have the name %1").arg(joint.name));
    }
    CommissionList list;
    list.m_states.assign(joints.size(), CommissionState::Waiting);
    list.m_facts.resize(joints.size());
    for (const CommissionJoint &joint : joints)
        list.m_isFactory.push_back(joint.place == factoryPlace(*tableOf(joint, catalog)));
    list.m_joints = std::move(joints);
    return list;
}

std::optional<std::size_t> CommissionList::next() const
{
    std::optional<std::size_t> last;
    for (std::size_t i = 0; i < m_joints.size(); ++i) {
        if (m_states[i] != CommissionState::Waiting)
            continue;
        if (!m_isFactory[i])
            return i;
        last = i;
    }
    return last;
}

std::size_t CommissionList::count(CommissionState state) const
{
    return static_cast<std::size_t>(std::ranges::count(m_states, state));
}

void CommissionList::tick(std::size_t index, const CommissionFacts &facts)
{
    m_states[index] = CommissionState::Done;
    m_facts[index] = facts;
}

std::optional<std::size_t> CommissionList::at(const MovePlace &place, int modelNumber, CommissionState state) const
{
    for (std::size_t i = 0; i < m_joints.size(); ++i) {
        if (m_joints[i].place == place && m_joints[i].modelNumber == modelNumber && m_states[i] == state)
            return i;
    }
    return std::nullopt;
}

std::vector<int> CommissionList::rates(const Catalog &catalog) const
{
    std::vector<int> rates;
    const auto add = [&rates](int rate) {
        if (std::ranges::find(rates, rate) == rates.end())
            rates.push_back(rate);
    };
    add(57600);
    add(1'000'000);
    for (const CommissionJoint &joint : m_joints)
        add(joint.place.baudRate);
    for (const int rate : {115200, 2'000'000, 3'000'000, 4'000'000, 9600})
        add(rate);
    std::set<int> models;
    for (const CommissionJoint &joint : m_joints) {
        const ControlTablePtr table = models.insert(joint.modelNumber).second ? tableOf(joint, catalog) : nullptr;
        for (const BaudCode &code : table ? table->description().baudCodes : std::vector<BaudCode>())
            add(code.rate);
    }
    return rates;
}

Result<std::vector<WantedSetting>> wantedSettings(const CommissionJoint &joint, const ControlTable &table)
{
    std::vector<WantedSetting> wanted;
    for (const CommissionSetting &setting : joint.settings) {
        const int field = table.indexOf(setting.name);
        if (field < 0)
            return wrong(
                CommissioningText::tr("%1: %2 has no register %3").arg(jointText(joint), table.model(), setting.name));
        wanted.push_back({field, setting.raw});
    }
    return wanted;
}

QString unfitText(const CommissionJoint &joint, int modelNumber, int firmware, const Catalog &catalog)
{
    if (modelNumber != joint.modelNumber)
        return CommissioningText::tr("this is model %1, and %2 shall be model %3")
            .arg(modelName(catalog, modelNumber), jointText(joint), modelName(catalog, joint.modelNumber));
    if (firmware < joint.minimumFirmware)
        return CommissioningText::tr("this %1 has firmware %2, and %3 needs %4 at least")
            .arg(modelName(catalog, modelNumber), QString::number(firmware), jointText(joint),
                 QString::number(joint.minimumFirmware));
    return {};
}

QStringList labelHeads()
{
    return {CommissioningText::tr("Joint"),  CommissioningText::tr("ID"),           CommissioningText::tr("Baud rate"),
            CommissioningText::tr("Model"),  CommissioningText::tr("Model number"), CommissioningText::tr("Firmware"),
            CommissioningText::tr("Checked")};
}

std::vector<QStringList> labelRows(const CommissionList &list, const Catalog &catalog)
{
    std::vector<QStringList> rows;
    for (std::size_t i = 0; i < list.size(); ++i) {
        if (list.state(i) != CommissionState::Done)
            continue;
        const CommissionFacts &facts = list.facts(i);
        rows.push_back({list.joint(i).name, QString::number(facts.place.id), QString::number(facts.place.baudRate),
                        modelName(catalog, facts.modelNumber), QString::number(facts.modelNumber),
                        QString::number(facts.firmware), timeText(facts.at)});
    }
    return rows;
}

QByteArray labelsCsv(const CommissionList &list, const Catalog &catalog)
{
    QByteArray csv = csvLine(labelHeads());
    for (const QStringList &row : labelRows(list, catalog))
        csv += csvLine(row);
    return csv;
}

} // namespace dynascope
