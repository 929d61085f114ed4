// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/commissioning/fromprofile.h"

#include "core/session/profile/profilevalues.h"
#include "core/session/texts.h"

#include <algorithm>

namespace dynascope {
namespace {

tl::unexpected<Error> wrong(const QString &file, const ProfileRegister &setting, const QString &why)
{
    return failure(ErrorKind::InvalidArgument,
                   QStringLiteral("%1:%2:%3: %4").arg(file).arg(setting.line).arg(setting.column).arg(why));
}

Result<CommissionJoint> jointOf(const Profile &profile, const ProfileJoint &from, const Catalog &catalog)
{
    CommissionJoint joint;
    joint.name = from.name;
    joint.modelNumber = from.modelNumber;
    joint.minimumFirmware = std::max(0, from.firmware);
    joint.place = {from.baudRate, from.id};
    const Catalog::ModelInfo *model = catalog.model(from.modelNumber);
    const ControlTablePtr table
        = model ? catalog.find(from.modelNumber, std::max(model->newestFirmware, joint.minimumFirmware)) : nullptr;
    if (!table)
        return joint; // the list says so
    const auto fresh = [&table](QStringView name) -> std::optional<std::int64_t> {
        const Field *field = table->find(name);
        return field ? field->initial : std::nullopt;
    };
    const std::vector<WantedValue> wanted = wantedValues(from, *table, fresh);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        const ProfileRegister &setting = from.registers[i];
        if (!wanted[i].field)
            return wrong(profile.file, setting,
                         CommissioningText::tr("%1 has no register %2").arg(table->model(), setting.name));
        if (!wanted[i].raw)
            return wrong(profile.file, setting, wanted[i].raw.error().text);
        joint.settings.push_back({wanted[i].field->name, *wanted[i].raw});
    }
    return joint;
}

} // namespace

Result<CommissionList> commissionList(const Profile &profile, const Catalog &catalog)
{
    std::vector<CommissionJoint> joints;
    for (const ProfileJoint &from : profile.joints) {
        auto joint = jointOf(profile, from, catalog);
        if (!joint)
            return tl::unexpected(joint.error());
        joints.push_back(std::move(*joint));
    }
    return CommissionList::make(catalog, std::move(joints));
}

Result<CommissionList> commissionList(const Catalog &catalog, const QString &model, const std::vector<int> &ids,
                                      int baudRate, const QStringList &names, int minimumFirmware)
{
    const Catalog::ModelInfo *info = catalog.model(model);
    if (!info)
        return failure(ErrorKind::InvalidArgument, CommissioningText::tr("There is no model %1").arg(model));
    if (!names.isEmpty() && names.size() != static_cast<qsizetype>(ids.size()))
        return failure(ErrorKind::InvalidArgument,
                       CommissioningText::tr("There are %1 names for %2 IDs").arg(names.size()).arg(ids.size()));
    std::vector<CommissionJoint> joints;
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const QString name = names.isEmpty() ? QString() : names[static_cast<qsizetype>(i)];
        joints.push_back({name, info->modelNumber, minimumFirmware, {baudRate, ids[i]}, {}});
    }
    return CommissionList::make(catalog, std::move(joints));
}

} // namespace dynascope
