// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/result.h"
#include "core/table/controltable.h"

#include <QByteArray>

namespace dynascope {

/// Which table a device has, by model number and firmware. Immutable after loading; may be shared between threads.
class Catalog
{
public:
    struct ModelInfo {
        std::uint16_t modelNumber = 0;
        QString model;
        QString series;
        int newestFirmware = 0; ///< of those known: what a simulated device gets unless told otherwise
    };

    Catalog() = default;

    /// The tables that come with the program (":/controltables"), loaded once by the caller and handed around.
    static Result<Catalog> builtIn();

    /// Adds the tables of one file (resources/controltables/FORMAT.md). `name` is for messages.
    Result<void> add(const QByteArray &json, const QString &name);

    /// The table of this model at this firmware; the newest where the firmware is newer than known; nullptr where the
    /// model is unknown.
    ControlTablePtr find(int modelNumber, int firmware) const;
    /// By name, ignoring case, spaces, '-' and '_'.
    const ModelInfo *model(QStringView name) const;
    const ModelInfo *model(int modelNumber) const;
    std::vector<ModelInfo> models() const { return m_models; }

private:
    std::vector<ModelInfo> m_models;
    std::vector<ControlTablePtr> m_tables;
};

/// "XM430-W350", or "unknown model 1234".
QString modelName(const Catalog &catalog, int modelNumber);

} // namespace dynascope
