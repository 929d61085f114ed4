// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/session.h"
#include "ui/common/workbench.h"

#include <QHash>
#include <QObject>

namespace dynascope {

inline constexpr int MaximumNickname = 40; ///< characters
/// What somebody typed, or a settings file holds: one line, not too long.
QString asNickname(const QString &text);

/// Nicknames outlast the program: kept in the settings by where a device was and what it is. They follow it when its ID
/// or baud rate is changed here.
class Nicknames : public QObject
{
    Q_OBJECT

public:
    explicit Nicknames(const Workbench &workbench, QObject *parent = nullptr);

private:
    void follow(const LineSession *line);
    void recall(Device *device);
    void keep(const Device &device);
    QString keyOf(const Device &device);

    Workbench m_workbench;
    QHash<const LineSession *, QString> m_adapters; ///< what each line was opened on: see keyOf()
    QHash<DeviceKey, QString> m_keys;   ///< where each one's name stands now
};

} // namespace dynascope
