// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/tablenote.h"

#include <QCoreApplication>

#include <algorithm>

namespace dynascope {

namespace {

struct TableNote {
    Q_DECLARE_TR_FUNCTIONS(TableNote)
};

} // namespace

QStringList tableNotes(const std::vector<Device *> &devices)
{
    QStringList notes;
    const auto newer = std::ranges::find_if(devices, &Device::isFirmwareNewerThanKnown);
    if (newer != devices.end()) {
        notes << TableNote::tr("Firmware %1 is newer than this program knows: the table of firmware %2 is shown.")
                     .arg((*newer)->firmware())
                     .arg((*newer)->table().description().newestFirmware);
    }
    if (!devices.empty() && !devices.front()->table().description().doubt.isEmpty())
        notes << devices.front()->table().description().doubt;
    return notes;
}

} // namespace dynascope
