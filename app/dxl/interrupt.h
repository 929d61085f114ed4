// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

namespace dynascope::dxl {

/// Turns Ctrl-C, SIGTERM and a closed terminal into an orderly end. Made before any other thread, which then leave those
/// signals to wait() and came().
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
