// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

namespace dynascope {

/// How a person wants recordings; kept from one start of the program to the next.
struct RecordWishes {
    QString format = QStringLiteral("mcap"); ///< or "csv"
    QString folder;                          ///< is made where it isn't there
    int splitMinutes = 0;                    ///< a new file after that long; 0: never
    int splitMegabytes = 0;                  ///< a new file from this size on; 0: never
    QString note;

    static RecordWishes saved();
    void save() const;
    static QString usualFolder(); ///< "Dynascope" among the person's documents
};

/// Where samples are streamed to. That they are isn't kept: each start of the program begins without.
struct StreamWishes {
    static constexpr int UsualPort = 9870; ///< PlotJuggler's

    QString host = QStringLiteral("127.0.0.1"); ///< an IP address
    int port = UsualPort;

    static StreamWishes saved();
    void save() const;
    QString place() const; ///< "127.0.0.1:9870"
    bool isThisMachine() const;
};

} // namespace dynascope
