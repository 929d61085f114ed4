// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"

#include <QStringList>

#include <memory>
#include <vector>

namespace dynascope {

/// Opens a line by the text that names it. One method runs on the bus thread, which then owns the line.
class LineFactory
{
public:
    virtual ~LineFactory() = default;

    /// Is this a name this factory knows how to open? Any thread.
    virtual bool knows(const QString &name) const = 0;
    /// On the GUI thread, before a line of this name is opened: what must be started there.
    virtual void prepare(const QString &name) { Q_UNUSED(name) }
    /// On the thread that will use the line. Fails with PortNotFound, PortForbidden, PortBusy, PortUnsuitable.
    virtual Result<std::unique_ptr<Line>> open(const QString &name, int baudRate) = 0;
};

/// A port that could be opened.
struct PortInfo {
    QString name;        ///< what LineFactory::open takes
    QString description; ///< what a person recognises: "FT232H (ROBOTIS U2D2)"
    QString serialNumber;

    friend bool operator==(const PortInfo &, const PortInfo &) = default;
};

/// Which ports there are now. GUI thread.
class PortList
{
public:
    virtual ~PortList() = default;
    virtual std::vector<PortInfo> ports() const = 0;
};

} // namespace dynascope
