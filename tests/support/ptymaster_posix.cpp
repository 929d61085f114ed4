// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/ptymaster.h"

#include "core/bus/serialport_posix.h"

#include <cstdlib>
#include <utility>

#include <fcntl.h>
#include <grp.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

using namespace dynascope;

PtyMaster::PtyMaster() : m_master(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC))
{
    if (m_master < 0 || ::grantpt(m_master) != 0 || ::unlockpt(m_master) != 0)
        qFatal("no pseudo-terminal");
    m_path = QString::fromLocal8Bit(::ptsname(m_master));
    termios settings{};
    ::tcgetattr(m_master, &settings);
    ::cfmakeraw(&settings);
    ::tcsetattr(m_master, TCSANOW, &settings);
}

void PtyMaster::write(const Bytes &bytes)
{
    if (::write(m_master, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()))
        qFatal("the pseudo-terminal is full");
}

Bytes PtyMaster::read(std::size_t bytes)
{
    Bytes all;
    pollfd entry{m_master, POLLIN, 0};
    while (all.size() < bytes && ::poll(&entry, 1, 5000) == 1) {
        std::uint8_t buffer[256];
        const ssize_t got = ::read(m_master, buffer, sizeof buffer);
        if (got <= 0)
            break;
        all.insert(all.end(), buffer, buffer + got);
    }
    return all;
}

int PtyMaster::baudRate() const
{
    return posix::actualBaudRate(m_master).value_or(0);
}

void PtyMaster::close()
{
    for (int *descriptor : {&m_slave, &m_master}) {
        if (*descriptor >= 0)
            ::close(std::exchange(*descriptor, -1));
    }
}

int PtyMaster::openAsNobody() const
{
    constexpr int Nobody = 65534;
    constexpr int Fine = 100;
    const pid_t child = ::fork();
    if (child == 0) {
        if (::setgroups(0, nullptr) != 0 || ::setgid(Nobody) != 0 || ::setuid(Nobody) != 0)
            ::_exit(Fine + 1);
        const auto guard = posix::PortGuard::take(m_path);
        ::_exit(guard ? Fine : static_cast<int>(guard.error().kind));
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WEXITSTATUS(status) == Fine ? -1 : WEXITSTATUS(status);
}

void PtyMaster::letEverybodyIn()
{
    ::chmod(qPrintable(m_path), 0666);
}

void PtyMaster::markExclusive()
{
    m_slave = ::open(qPrintable(m_path), O_RDWR | O_NOCTTY | O_CLOEXEC);
    ::ioctl(m_slave, TIOCEXCL);
}

bool PtyMaster::isRoot()
{
    return ::geteuid() == 0;
}
