// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/historymark.h"

#include <optional>

namespace dynascope {

/// When a trigger fires, and what is shown of it.
struct TriggerSettings {
    enum class Kind { Rising, Falling, Either, Event };
    enum class Mode {
        Auto,   ///< live where nothing has fired for a while
        Normal, ///< the last one stands until the next
        Single, ///< the first one stands
    };
    Kind kind = Kind::Rising;
    Mode mode = Mode::Normal;
    double level = 0;      ///< raw
    double hysteresis = 0; ///< raw; the signal must have been so far beyond the level on the other side before
    LineTime before = std::chrono::milliseconds(500);
    LineTime after = std::chrono::milliseconds(1500);

    friend bool operator==(const TriggerSettings &, const TriggerSettings &) = default;
};

/// Watches the samples of one history as they come, or events, and says which moment is to be shown. Where a signal
/// crosses the level is found between two samples; nothing crosses a gap. Until `after` has passed since one it fires
/// not again. Any one thread.
class Trigger
{
public:
    enum class State {
        Off,
        Armed,
        Filling, ///< fired; what follows is still to come
        Done,    ///< Single: arm() begins anew
    };

    void set(const TriggerSettings &settings); ///< armed anew where they are others
    const TriggerSettings &settings() const { return m_settings; }
    void arm(LineTime now); ///< what came before `now` doesn't fire
    void disarm();
    State state() const { return m_state; }

    /// Looks at no more than `budget` of the samples that have come, and takes from it what it used. `now`: the newest
    /// sample of all. True: shown() has changed.
    bool advance(const History *source, LineTime now, std::size_t &budget);
    void event(LineTime at);
    /// The moment to be shown, with what is before and after it; nothing: the view is live.
    std::optional<LineTime> shown() const { return m_shown; }

    /// Auto: so long after what was shown, or being armed, the view is live again.
    static constexpr LineTime Patience = std::chrono::seconds(2);

private:
    void take(const History::Sample &before, const History::Sample &now, bool isKnown);
    void fire(LineTime at);

    TriggerSettings m_settings;
    State m_state = State::Off;
    HistoryMark m_mark;
    std::uint64_t m_next = 0;
    LineTime m_from{};  ///< earlier ones don't fire
    LineTime m_since{}; ///< armed or shown then
    bool m_wasBelow = false, m_wasAbove = false; ///< beyond the hysteresis
    std::optional<LineTime> m_fired;
    std::optional<LineTime> m_shown;
};

} // namespace dynascope
