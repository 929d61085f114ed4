// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/record/recordtexts.h"

#include "core/record/recorder.h"
#include "ui/common/texts.h"

#include <QCoreApplication>
#include <QDir>
#include <QStringList>

namespace dynascope {
namespace {

struct RecordTexts {
    Q_DECLARE_TR_FUNCTIONS(RecordTexts)
};

} // namespace

QString sizeText(qint64 bytes)
{
    const double megabytes = static_cast<double>(bytes) / 1e6;
    return megabytes < 10'000 ? QStringLiteral("%1 MB").arg(megabytes, 0, 'f', 1)
                              : QStringLiteral("%1 GB").arg(megabytes / 1000, 0, 'f', 1);
}

QString lengthText(std::chrono::seconds length)
{
    const auto seconds = length.count();
    return QStringLiteral("%1:%2:%3")
        .arg(seconds / 3600)
        .arg(seconds / 60 % 60, 2, 10, QLatin1Char('0'))
        .arg(seconds % 60, 2, 10, QLatin1Char('0'));
}

QString endText(const RecorderStatus &status, std::chrono::seconds length)
{
    const QString path = QDir::toNativeSeparators(status.path);
    QString text = status.error.text.isEmpty()
        ? RecordTexts::tr("Recorded %1 samples in %2, %3: %4")
              .arg(grouped(status.samples), lengthText(length), sizeText(status.bytes), path)
        : RecordTexts::tr("The recording ended: %1. %2 samples are in %3")
              .arg(status.error.text, grouped(status.samples), path);
    if (status.files > 1)
        text += RecordTexts::tr(" and %1 files before it").arg(status.files - 1);
    QStringList without;
    if (status.missed > 0)
        without << RecordTexts::tr("%1 replies did not come").arg(grouped(status.missed));
    if (status.lost > 0)
        without << RecordTexts::tr("%1 samples were lost, for the disk didn't take them").arg(grouped(status.lost));
    return without.isEmpty() ? text : text + QStringLiteral(". ") + without.join(QStringLiteral("; "));
}

} // namespace dynascope
