// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/ptyclient.h"

#include <QDeadlineTimer>
#include <QFile>

#include <array>
#include <asm/termbits.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

PtyClient::PtyClient(const QString &path, int baudRate)
    : m_descriptor(::open(QFile::encodeName(path).constData(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC))
{
    termios2 settings{};
    ioctl(m_descriptor, TCGETS2, &settings);
    settings.c_iflag = settings.c_oflag = settings.c_lflag = 0;
    settings.c_cflag = CS8 | CREAD | CLOCAL | BOTHER;
    settings.c_ispeed = settings.c_ospeed = static_cast<unsigned>(baudRate);
    ioctl(m_descriptor, TCSETS2, &settings);
}

void PtyClient::close()
{
    if (m_descriptor >= 0)
        ::close(m_descriptor);
    m_descriptor = -1;
}

void PtyClient::write(const dynascope::Bytes &bytes)
{
    [[maybe_unused]] const ssize_t count = ::write(m_descriptor, bytes.data(), bytes.size());
}

dynascope::Bytes PtyClient::readAtLeast(std::size_t bytes, int milliseconds)
{
    dynascope::Bytes all;
    const QDeadlineTimer deadline(milliseconds);
    while (all.size() < bytes && !deadline.hasExpired()) {
        pollfd waited{m_descriptor, POLLIN, 0};
        if (poll(&waited, 1, static_cast<int>(deadline.remainingTime())) <= 0)
            continue;
        std::array<std::uint8_t, 1024> chunk{};
        const ssize_t count = ::read(m_descriptor, chunk.data(), chunk.size());
        if (count <= 0)
            break;
        all.insert(all.end(), chunk.begin(), chunk.begin() + count);
    }
    return all;
}

bool PtyClient::seesTheEnd(int milliseconds)
{
    pollfd waited{m_descriptor, POLLIN, 0};
    std::uint8_t byte = 0;
    return poll(&waited, 1, milliseconds) == 1 && (waited.revents & POLLHUP) && ::read(m_descriptor, &byte, 1) <= 0;
}

void PtyClient::makeExclusive()
{
    ioctl(m_descriptor, TIOCEXCL);
}

bool PtyClient::isExclusive(const QString &path)
{
    const int descriptor = ::open(QFile::encodeName(path).constData(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    int exclusive = 1;
    ioctl(descriptor, TIOCGEXCL, &exclusive);
    ::close(descriptor);
    return exclusive != 0;
}
