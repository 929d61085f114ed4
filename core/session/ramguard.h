// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/commands.h"
#include "core/session/monitor.h"
#include "core/session/rammarks.h"

#include <set>

namespace dynascope {

/// How a restart was noticed.
enum class RestartSign {
    Tick,         ///< Realtime Tick began anew
    Values,       ///< torque is off, and what was set is back at its initial value
    Reboot,       ///< by us
    FactoryReset, ///< by us. Nothing is offered again: factory values are what was asked for
};

/// A device that has restarted and whose lost settings nobody has set again yet.
struct Restart {
    DeviceKey device = 0;
    RestartSign sign = RestartSign::Tick;
    int lost = 0; ///< registers
};

/// Knows what was set in this session and goes with a device's power, from the journal; notices when a device has
/// restarted, and offers those settings again: each is written only by setAgain(), never a goal, never torque. Has the
/// monitor read each such device's Realtime Tick, or without one a register that was set, and looks itself when a device
/// is back. GUI thread; owned by app.
class RamGuard : public QObject
{
    Q_OBJECT

public:
    using Done = std::function<void(Result<void>)>;

    /// All outlive this.
    RamGuard(Session &session, Monitor &monitor, Commands &commands, Journal &journal, QObject *parent = nullptr);

    RamState stateOf(DeviceKey device, int field) const;
    std::optional<std::int64_t> setValue(DeviceKey device, int field) const; ///< raw; what was set, lost or not
    std::vector<Restart> restarts() const; ///< also of a device that doesn't answer now
    /// Writes what was lost, in the order in which it was set, each read back and in the journal. What holds its value
    /// already is not written. Ends at the first write that fails; those before it are set. NotConfirmed where a device
    /// made another value of one.
    void setAgain(const std::vector<DeviceKey> &devices, Done done = {});
    void dismiss(const std::vector<DeviceKey> &devices); ///< nobody wants that back
    /// Reads now whether it has restarted. Nothing where nothing was set.
    void look(DeviceKey device);

signals:
    void changed(); ///< marks or restarts()
    void restarted(dynascope::DeviceKey device); ///< and something was lost

private:
    struct Guarded {
        RamMarks marks;
        TickSign tick;
        std::optional<RestartSign> expected; ///< by what is known already: the next look says what it took
        std::optional<RestartSign> last;     ///< of what is lost
        Device::State state = Device::State::Present;
        bool isUnclear = false; ///< the tick couldn't tell: values have to
        bool isLooking = false;
        bool looksAgain = false; ///< at the next sign of life
    };

    void follow(LineSession *line);
    void onEnded(qint64 number);
    void onBatch(const Batch &batch);
    void onDevice(Device *device);
    void onLine(LineSession *line);
    void seen(Guarded &guarded, const Device &device, const PollValue &value);
    void takeLook(DeviceKey key, const Result<std::vector<PollValue>> &values);
    void settle(DeviceKey key);
    struct Setting {
        std::vector<DeviceKey> devices; ///< still to be done
        std::set<Watch> tried;          ///< were written: what became something else is not written once more
        QString problem;                ///< a sentence; empty: none
        Done done;
    };
    void setNext(Setting setting);
    QString setProblem(const Device &device, int field, std::int64_t wanted) const;

    Session &m_session;
    Monitor &m_monitor;
    Commands &m_commands;
    Journal &m_journal;
    std::map<DeviceKey, Guarded> m_devices; ///< stay for a device that comes back
};

} // namespace dynascope
