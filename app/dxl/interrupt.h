// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <memory>

namespace dynascope::dxl {

/// @name Ctrl-C, SIGTERM and a closed terminal, where a command works on a line
/// @{
/// From now on they set the flag that interrupted() shows; a second one ends the program at once. A closed pipe is told
/// by the write to it.
void heedSignals();
const std::atomic<bool> &interrupted();
/// @}

/// Turns the same signals into an orderly end where a thread does nothing but wait for it. Made before any other
/// thread, which then leave those signals to wait() and came().
class Interrupt
{
public:
    Interrupt();
    ~Interrupt(); ///< the signals do again what they did

    void wait(); ///< until one comes
    static void request(); ///< as if one had come; from any thread
    bool came(); ///< has one come? From then on: yes

private:
    struct Signals;
    std::unique_ptr<Signals> m_signals;
    bool m_came = false;
};

} // namespace dynascope::dxl
