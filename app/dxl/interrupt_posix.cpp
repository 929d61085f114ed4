// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/dxl/interrupt.h"

#include <csignal>
#include <unistd.h>

namespace dynascope::dxl {

namespace {

/// The one thing that a signal handler can reach.
std::atomic<bool> interruptedFlag{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may touch nothing else");

void noteSignal(int)
{
    interruptedFlag.store(true, std::memory_order_release);
}

} // namespace

void heedSignals()
{
    struct sigaction broken {};
    broken.sa_handler = SIG_IGN;
    sigaction(SIGPIPE, &broken, nullptr);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction before {};
        sigaction(signal, nullptr, &before);
        if (before.sa_handler == SIG_IGN) // as nohup and a shell's background jobs have it
            continue;
        struct sigaction ending {};
        ending.sa_handler = noteSignal;
        ending.sa_flags = SA_RESETHAND; // without SA_RESTART: a question that waits for its answer ends
        sigaction(signal, &ending, nullptr);
    }
}

const std::atomic<bool> &interrupted()
{
    return interruptedFlag;
}

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
