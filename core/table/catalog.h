// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/result.h"
#include "core/table/controltable.h"

#include <QByteArray>

#include <map>

namespace dynascope {

/// Which table a device has, by model number and firmware. A value that never changes but by add(); may be shared
/// between threads. Tables are read from their files when somebody first asks for them.
class Catalog
{
public:
    struct ModelInfo {
        std::uint16_t modelNumber = 0;
        QString model;
        QStringList alsoCalled;  ///< models that have the same number and table
        int modbusNumber = -1;   ///< what it says of itself in Modbus mode; −1: the same
        QString series;
        int newestFirmware = -1; ///< of those known: what a simulated device gets unless told otherwise; −1: none is
        bool addressesOnly = false;
        QString file;            ///< where its table stands, without folder and ".json"
        bool isBuiltIn = false;
    };

    Catalog() = default;

    /// The tables that come with the program (":/controltables"). Only looks which models there are.
    static Result<Catalog> builtIn();

    /// Adds the tables of one file (resources/controltables/FORMAT.md), all of them read and checked. `name` is for
    /// messages, and without folder and ".json" it is what other files extend. A file that is refused leaves the
    /// catalog as it was. Models that are there already are refused, unless the file says that it replaces them.
    Result<void> add(const QByteArray &json, const QString &name);

    /// The table of this model at this firmware; the newest where the firmware is newer than known, the oldest where
    /// it is older; nullptr where the model is unknown.
    ControlTablePtr find(int modelNumber, int firmware) const;
    /// The same; of an unknown model a table of bare bytes, with what its neighbours suggest (rawtable.h).
    ControlTablePtr findOrRaw(int modelNumber, int firmware) const;
    /// From which firmware on each of the model's tables is.
    std::vector<int> firmwareSteps(int modelNumber) const;

    /// By name, ignoring case, spaces, '-' and '_'.
    const ModelInfo *model(QStringView name) const;
    const ModelInfo *model(int modelNumber) const;
    std::vector<ModelInfo> models() const; ///< by number

private:
    struct File;
    struct Model;
    using FilePtr = std::shared_ptr<const File>;
    using ModelPtr = std::shared_ptr<const Model>;

    ModelPtr modelOf(int modelNumber) const;
    QString insert(const ModelPtr &model, int replaces);

    std::vector<ModelPtr> m_models; ///< by number
    std::map<QString, FilePtr> m_files; ///< by name
};

/// "XM430-W350", or "unknown model 1234".
QString modelName(const Catalog &catalog, int modelNumber);

} // namespace dynascope
