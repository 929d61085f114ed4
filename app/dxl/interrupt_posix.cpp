// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/interrupt.h"

#include <csignal>
#include <unistd.h>

namespace dynascope::dxl {

struct Interrupt::Signals {
    sigset_t ending;
    sigset_t before;
};

Interrupt::Interrupt()
    : m_signals(std::make_unique<Signals>())
{
    sigemptyset(&m_signals->ending);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        sigaddset(&m_signals->ending, signal);
    pthread_sigmask(SIG_BLOCK, &m_signals->ending, &m_signals->before);
}

Interrupt::~Interrupt()
{
    pthread_sigmask(SIG_SETMASK, &m_signals->before, nullptr);
}

void Interrupt::wait()
{
    int signal = 0;
    sigwait(&m_signals->ending, &signal);
}

void Interrupt::request()
{
    kill(getpid(), SIGTERM); // to the process: the thread that asks has it blocked, and so have all
}

bool Interrupt::came()
{
    sigset_t pending;
    sigpending(&pending);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        if (!m_came && sigismember(&pending, signal) == 1) {
            wait(); // takes it: it must not end the program behind our back
            m_came = true;
        }
    }
    return m_came;
}

} // namespace dynascope::dxl
