// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/result.h"
#include "core/table/controltable.h"

#include <QByteArray>
#include <QJsonObject>

#include <map>

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

    /// Adds the tables of one file (resources/controltables/FORMAT.md). `name` is for messages, and without folder and
    /// ".json" it is what other files extend. A file that is refused leaves the catalog as it was.
    Result<void> add(const QByteArray &json, const QString &name);

    /// The table of this model at this firmware; the newest where the firmware is newer than known, the oldest where
    /// it is older; nullptr where the model is unknown.
    ControlTablePtr find(int modelNumber, int firmware) const;
    /// By name, ignoring case, spaces, '-' and '_'.
    const ModelInfo *model(QStringView name) const;
    const ModelInfo *model(int modelNumber) const;
    std::vector<ModelInfo> models() const { return m_models; }

private:
    QString addModel(const QString &name, const QJsonObject &settings, const QJsonObject &changes);

    std::vector<ModelInfo> m_models;       ///< by number
    std::vector<ControlTablePtr> m_tables; ///< by number, then firmware
    std::map<QString, QJsonObject> m_files; ///< what each file says, with what it extends; by name
};

/// "XM430-W350", or "unknown model 1234".
QString modelName(const Catalog &catalog, int modelNumber);

} // namespace dynascope
