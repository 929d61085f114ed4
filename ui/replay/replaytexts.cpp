// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/replay/replaytexts.h"

#include "core/replay/replayer.h"
#include "ui/common/texts.h"
#include "ui/record/recordtexts.h"

#include <QCoreApplication>
#include <QLocale>

namespace dynascope {
namespace {

struct ReplayTexts {
    Q_DECLARE_TR_FUNCTIONS(ReplayTexts)
};

} // namespace

QString replayTimeText(LineTime time)
{
    const qint64 all = std::max<qint64>(0, std::chrono::duration_cast<std::chrono::milliseconds>(time).count());
    const QLatin1Char zero('0');
    const QString behind = QStringLiteral("%1.%2").arg(all / 1000 % 60, 2, 10, zero).arg(all % 1000, 3, 10, zero);
    const qint64 minutes = all / 60'000;
    if (minutes < 60)
        return QStringLiteral("%1:%2").arg(minutes).arg(behind);
    return QStringLiteral("%1:%2:%3").arg(minutes / 60).arg(minutes % 60, 2, 10, zero).arg(behind);
}

QString speedText(double speed)
{
    if (speed == 0.5)
        return QStringLiteral("½×");
    if (speed == 0.25)
        return QStringLiteral("¼×");
    return QStringLiteral("%1×").arg(speed);
}

QString recordingText(const Replayer &replayer)
{
    const RecordingHeader &header = replayer.header();
    QStringList parts;
    if (!header.name.isEmpty())
        parts << header.name;
    parts << QLocale().toString(replayer.wallTime(replayer.clock().begin()), QLocale::ShortFormat);
    parts << (header.devices.size() == 1 ? ReplayTexts::tr("1 device")
                                         : ReplayTexts::tr("%1 devices").arg(header.devices.size()));
    if (replayer.isLoaded())
        parts << ReplayTexts::tr("%1 samples").arg(grouped(replayer.samples()));
    else
        parts << ReplayTexts::tr("reading, %1 %").arg(replayer.percentLoaded());
    if (!header.notes.isEmpty())
        parts << header.notes.simplified();
    if (!replayer.isWhole())
        parts << ReplayTexts::tr("it was cut off: all up to there is here");
    if (replayer.damagedParts() > 0)
        parts << ReplayTexts::tr("damaged parts left out: %1").arg(replayer.damagedParts());
    if (replayer.devices().unplaced > 0)
        parts << ReplayTexts::tr("registers left out that no table here has: %1").arg(replayer.devices().unplaced);
    return parts.join(QStringLiteral("  ·  "));
}

} // namespace dynascope
