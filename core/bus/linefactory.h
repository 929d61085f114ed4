// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bus/line.h"

#include <QStringList>

#include <atomic>
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
    /// Are its lines a recording's? Nobody can be asked anything on them. Any thread.
    virtual bool isRecorded() const { return false; }
    /// On the GUI thread, before a line of this name is opened: what must be started there.
    virtual void prepare(const QString &name) { Q_UNUSED(name) }
    /// On the thread that will use the line. Fails with PortNotFound, PortForbidden, PortBusy, PortUnsuitable.
    virtual Result<std::unique_ptr<Line>> open(const QString &name, int baudRate) = 0;
    /// The same for lines that may take seconds to open: fails with Cancelled soon after `cancel` is set.
    virtual Result<std::unique_ptr<Line>> openUnless(const std::atomic<bool> &cancel, const QString &name, int baudRate)
    {
        Q_UNUSED(cancel)
        return open(name, baudRate);
    }
};

/// A port that could be opened.
struct PortInfo {
    QString name;        ///< what LineFactory::open takes
    QString description; ///< what a person recognises: "FT232H (ROBOTIS U2D2)"
    QString serialNumber;
    /// The adapter itself, wherever it is plugged in: maker, model, serial number, which of its ports. Empty where it
    /// has no serial number, and so can't be told from another of its kind.
    QString identity = {};

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
