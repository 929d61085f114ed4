// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QByteArray>
#include <QString>
#include <QStringList>

#include <optional>
#include <vector>

namespace dynascope {

/// What the catalog wants to know of a table file before anybody asks for one of its models: seen in one quick pass
/// over the bytes, without parsing them.
struct TableOutline {
    /// What a file says of all its models, or one model of itself; nothing where it says nothing.
    struct Facts {
        std::optional<QString> series;
        std::optional<int> newestFirmware; ///< −1: removed
        std::optional<int> modbusNumberOffset;
        std::optional<bool> addressesOnly;

        void lay(const Facts &over); ///< what `over` says replaces what stands here
    };
    struct Model {
        QString name;
        int number = -1;
        int replaces = -1;
        QStringList alsoCalled;
        Facts own;
    };

    QString extends;
    Facts shared;
    std::vector<Model> models;
};

TableOutline outlineOf(QByteArrayView json);

} // namespace dynascope
