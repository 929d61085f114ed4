// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/profile/profilereading.h"

#include "core/bus/operations.h"
#include "core/session/deviceplace.h"
#include "core/session/journal/journalwrites.h"
#include "core/session/procedures/atbaud.h"
#include "core/session/profile/profilevalues.h"

#include <algorithm>
#include <set>
#include <utility>

namespace dynascope {
namespace {

constexpr LineTime Stall = std::chrono::milliseconds(40); // of a busy host or adapter
constexpr std::uint16_t ModelNumberAt = 0;                // of every device of Protocol 2.0: "Model Number"

QString nameOf(const ProfileJoint &joint)
{
    return QStringLiteral("%1 (%2, ID %3)").arg(joint.name, joint.model).arg(joint.id);
}

/// What the profile says of the joint, and what decides on the meaning of that.
std::vector<const Field *> wantedFields(const ProfileJoint &joint, const ControlTable &table)
{
    std::set<const Field *> fields;
    const auto add = [&](QStringView name) {
        if (const Field *field = table.find(name))
            fields.insert(field);
    };
    for (const ProfileRegister &each : joint.registers) {
        const Field *field = table.find(each.name);
        if (!field)
            continue;
        fields.insert(field);
        for (const QString &name : deciders(*field))
            add(name);
    }
    if (const Field *torque = table.find(Known::TorqueEnable); torque && !fields.empty())
        fields.insert(torque); // it locks the EEPROM
    return {fields.begin(), fields.end()};
}

bool isOfProfile(const ControlTable &table, const Field &field)
{
    return mayBeInProfile(profileUse(table, field));
}

ProfileTarget targetOf(const ProfileJoint &joint, const Catalog &catalog, const Profile &profile, bool readsAll)
{
    ProfileTarget target;
    const auto id = static_cast<std::uint8_t>(joint.id);
    for (const int step : catalog.firmwareSteps(joint.modelNumber)) {
        const ControlTablePtr table = catalog.find(joint.modelNumber, step);
        const std::vector<const Field *> wanted = wantedFields(joint, *table);
        const auto isWanted = [&](const Field &field) {
            return std::ranges::find(wanted, &field) != wanted.end() || (readsAll && isOfProfile(*table, field));
        };
        target.variants.push_back(
            {step, spansOf(*table, id, isWanted), table->description().fastReadsFrom, table->receiveBuffer()});
        Found found;
        found.id = id;
        found.baudRate = joint.baudRate;
        found.modelNumber = static_cast<std::uint16_t>(joint.modelNumber);
        target.place = placeOf(found, *table, nameOf(joint));
        if (const Field *firmware = table->find(u"Firmware Version"))
            target.firmwareAt = firmware->address;
        target.otherRates.clear();
        for (const BaudCode &code : table->description().baudCodes) {
            if (code.rate != joint.baudRate && !profile.at(code.rate, joint.id))
                target.otherRates.push_back(code.rate);
        }
    }
    const auto length = static_cast<std::uint16_t>(target.firmwareAt + 1 - ModelNumberAt);
    target.identity = {{id, ModelNumberAt, length}};
    return target;
}

class ProfileJob
{
public:
    ProfileJob(JobContext &context, const ProfileReadPlan &plan, const ProfileProgress &progress)
        : m_context(context), m_bus(context.bus()), m_plan(plan), m_progress(progress)
    {
        m_reading.joints.resize(plan.targets.size());
    }

    Result<ProfileReading> run()
    {
        for (const auto step : {&ProfileJob::identify, &ProfileJob::readRegisters, &ProfileJob::lookElsewhere,
                                &ProfileJob::lookForOthers}) {
            if (const Result<void> done = (this->*step)(); !done)
                return tl::unexpected(done.error());
        }
        tell(1);
        return std::move(m_reading);
    }

private:
    void tell(double done) const
    {
        if (m_progress)
            m_progress(done);
    }

    Result<void> identify()
    {
        std::vector<ReadSpansPlan> asked;
        for (const ProfileTarget &target : m_plan.targets)
            asked.push_back({target.place, target.identity});
        const auto images = readImages(m_context, asked);
        if (!images)
            return tl::unexpected(images.error());
        std::vector<std::size_t> unknown;
        for (std::size_t i = 0; i < m_plan.targets.size(); ++i) {
            const ProfileTarget &target = m_plan.targets[i];
            const auto &image = (*images)[i];
            const Bytes model = image ? image->bytes(ModelNumberAt, 2) : Bytes();
            const Bytes firmware = image ? image->bytes(target.firmwareAt, 1) : Bytes();
            if (!model.empty() && littleEndian(model, 2) == target.place.modelNumber && !firmware.empty())
                m_reading.joints[i].found = Found{
                    target.place.id, target.place.baudRate, target.place.modelNumber, firmware.front(), false, {}};
            else
                unknown.push_back(i);
        }
        tell(0.1);
        return askAlone(unknown);
    }

    /// Another model, one that answers no Read, or nobody: twice, for an adapter that held bytes back.
    Result<void> askAlone(const std::vector<std::size_t> &unknown)
    {
        for (const bool isAgain : {false, true}) {
            bool hasWaited = !isAgain;
            for (const std::size_t i : unknown) {
                JointReading &joint = m_reading.joints[i];
                if (joint.found)
                    continue;
                if (const auto go = m_context.checkpoint(); !go)
                    return go;
                if (const auto waited = std::exchange(hasWaited, true) ? Result<void>() : m_bus.wait(Stall); !waited)
                    return waited;
                const auto found = look(m_context, m_plan.targets[i].place);
                if (!found && endsAll(found.error()))
                    return tl::unexpected(found.error());
                joint.found = found ? std::optional(*found) : std::nullopt;
                joint.error = found ? std::nullopt : std::optional(found.error());
            }
        }
        return {};
    }

    static const ProfileVariant *variantOf(const ProfileTarget &target, const Found &found)
    {
        const ProfileVariant *fitting = target.variants.empty() ? nullptr : &target.variants.front();
        for (const ProfileVariant &variant : target.variants) {
            if (variant.fromFirmware <= found.firmware)
                fitting = &variant;
        }
        return fitting;
    }

    Result<void> readRegisters()
    {
        std::vector<std::size_t> joints;
        for (std::size_t i = 0; i < m_plan.targets.size(); ++i) {
            const JointReading &joint = m_reading.joints[i];
            const ProfileTarget &target = m_plan.targets[i];
            if (!joint.found || joint.found->modelNumber != target.place.modelNumber
                || !variantOf(target, *joint.found))
                continue;
            const ProfileVariant &variant = *variantOf(target, *joint.found);
            const Traits known = m_bus.traits(joint.found->id); // which may know more: delays, levels
            if (known.baudRate != joint.found->baudRate || known.firmware != joint.found->firmware)
                m_bus.addTraits(profileTraits(*joint.found, variant.fastReadsFrom, variant.receiveBuffer));
            joints.push_back(i);
        }
        auto left = readOf(joints);
        if (left && !left->empty()) {
            if (const auto waited = m_bus.wait(Stall); !waited)
                return waited;
            left = readOf(*left);
        }
        tell(0.3);
        return left ? Result<void>() : tl::unexpected(left.error());
    }

    /// Which of these joints could not be read.
    Result<std::vector<std::size_t>> readOf(const std::vector<std::size_t> &joints)
    {
        std::vector<ReadSpansPlan> asked;
        for (const std::size_t i : joints)
            asked.push_back({m_plan.targets[i].place, variantOf(m_plan.targets[i], *m_reading.joints[i].found)->spans});
        const auto images = readImages(m_context, asked);
        if (!images)
            return tl::unexpected(images.error());
        std::vector<std::size_t> left;
        for (std::size_t i = 0; i < joints.size(); ++i) {
            JointReading &joint = m_reading.joints[joints[i]];
            const auto &image = (*images)[i];
            joint.error = image ? std::nullopt : std::optional(image.error());
            if (image)
                joint.image = *image;
            else
                left.push_back(joints[i]);
        }
        return left;
    }

    /// One Ping each: who is there answers it, and else it costs the wait only.
    Result<void> lookElsewhere()
    {
        if (!m_bus.line().canSetBaudRate())
            return {};
        std::set<int> rates;
        for (std::size_t i = 0; i < m_plan.targets.size(); ++i) {
            if (!m_reading.joints[i].found)
                rates.insert(m_plan.targets[i].otherRates.begin(), m_plan.targets[i].otherRates.end());
        }
        for (const int rate : rates) {
            if (const auto go = m_context.checkpoint(); !go)
                return go;
            const AtBaud there(m_bus, rate);
            if (!there.entered() && endsAll(there.entered().error()))
                return there.entered();
            if (!there.entered())
                continue; // no device of this bus is at a rate that its port can't do
            if (const auto looked = lookAt(rate); !looked)
                return looked;
        }
        tell(0.5);
        return {};
    }

    Result<void> lookAt(int rate)
    {
        for (std::size_t i = 0; i < m_plan.targets.size(); ++i) {
            JointReading &joint = m_reading.joints[i];
            const ProfileTarget &target = m_plan.targets[i];
            if (joint.found || joint.elsewhere || std::ranges::find(target.otherRates, rate) == target.otherRates.end())
                continue;
            const auto answer = m_bus.exchange(pingRequest(target.place.id), 0);
            if (!answer)
                return tl::unexpected(answer.error());
            const Result<Reply> &reply = answer->replies.front();
            if (!reply || reply->data.size() < 3)
                continue;
            const auto model = static_cast<std::uint16_t>(littleEndian(reply->data, 2));
            const Found found{target.place.id, rate, model, reply->data[2], reply->alert, {}};
            if (model == target.place.modelNumber)
                joint.elsewhere = found;
        }
        return {};
    }

    Result<void> lookForOthers()
    {
        double done = 0.5;
        for (const int rate : m_plan.scanned) {
            const AtBaud there(m_bus, rate);
            if (!there.entered())
                return there.entered();
            ScanHooks hooks;
            hooks.between = [this](double) { return m_context.checkpoint(); };
            const auto scan = scanBaud(m_bus, {}, hooks);
            if (!scan)
                return tl::unexpected(scan.error());
            for (const Found &found : scan->devices)
                take(found);
            if (!scan->unreadable.isEmpty())
                m_reading.notes << QStringLiteral("%1 bps: %2").arg(rate).arg(scan->unreadable);
            tell(done += 0.5 / static_cast<double>(m_plan.scanned.size()));
        }
        return {};
    }

    void take(const Found &found)
    {
        for (std::size_t i = 0; i < m_plan.targets.size(); ++i) {
            const DevicePlace &place = m_plan.targets[i].place;
            JointReading &joint = m_reading.joints[i];
            const auto isIt = [&found](const auto &at) { return at.id == found.id && at.baudRate == found.baudRate; };
            if (joint.elsewhere && isIt(*joint.elsewhere)) {
                joint.elsewhere->doubt = found.doubt;
                return;
            }
            if (!isIt(place))
                continue;
            if (joint.found)
                joint.found->doubt = found.doubt;
            return;
        }
        m_reading.others.push_back(found);
    }

    JobContext &m_context;
    Bus &m_bus;
    const ProfileReadPlan &m_plan;
    const ProfileProgress &m_progress;
    ProfileReading m_reading;
};

} // namespace

ProfileReadPlan planProfileReading(const Profile &profile, const Catalog &catalog, const ProfileReadOptions &options)
{
    ProfileReadPlan plan;
    for (const ProfileJoint &joint : profile.joints)
        plan.targets.push_back(targetOf(joint, catalog, profile, options.readsAll));
    if (options.looksForOthers)
        plan.scanned = profile.baudRates();
    return plan;
}

Result<ProfileReading> readForProfile(JobContext &context, const ProfileReadPlan &plan, const ProfileProgress &progress)
{
    return ProfileJob(context, plan, progress).run();
}

ReadSpansPlan planSaveReading(const Found &found, const ControlTable &table)
{
    const auto isWanted = [&table](const Field &field) { return isOfProfile(table, field); };
    const QString name = QStringLiteral("%1 (ID %2)").arg(table.model()).arg(found.id);
    return {placeOf(found, table, name), spansOf(table, found.id, isWanted)};
}

Traits profileTraits(const Found &found, int fastReadsFrom, int receiveBuffer)
{
    Traits traits;
    traits.id = found.id;
    traits.baudRate = found.baudRate;
    traits.firmware = found.firmware;
    traits.fastReads = fastReadsFrom >= 0 && found.firmware >= fastReadsFrom;
    traits.receiveBuffer = receiveBuffer;
    return traits;
}

RegisterLookup lookupIn(const ControlTable &table, const RegisterImage &image)
{
    return [&table, &image](QStringView name) -> std::optional<std::int64_t> {
        const Field *field = table.find(name);
        const Bytes bytes = field ? image.bytes(field->address, field->size) : Bytes();
        return bytes.empty() ? std::nullopt : std::optional(rawFromBytes(*field, bytes));
    };
}

} // namespace dynascope
