// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/bytes.h"

#include <QString>

/// A program on a serial terminal that knows nothing of Dynascope: open, set the rate, read and write. POSIX.
class PtyClient
{
public:
    PtyClient(const QString &path, int baudRate);
    ~PtyClient() { close(); }
    PtyClient(const PtyClient &) = delete;
    PtyClient &operator=(const PtyClient &) = delete;

    bool isOpen() const { return m_descriptor >= 0; }
    void close();
    void write(const dynascope::Bytes &bytes);
    dynascope::Bytes readAtLeast(std::size_t bytes, int milliseconds); ///< less after that time
    bool seesTheEnd(int milliseconds);
    void makeExclusive();
    static bool isExclusive(const QString &path);

private:
    int m_descriptor = -1;
};
