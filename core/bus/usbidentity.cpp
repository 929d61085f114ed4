// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/usbidentity.h"

#include <QDir>
#include <QFile>

namespace dynascope {
namespace {

constexpr qint64 LongestAttribute = 256;

QString attribute(const QDir &folder, const QString &name)
{
    QFile file(folder.filePath(name));
    return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.read(LongestAttribute)).trimmed() : QString();
}

} // namespace

/// The port's device stands below its USB interface, and that below the USB device: .../1-2/1-2:1.0/ttyUSB0.
UsbIdentity usbIdentity(const QString &portName, const QString &ports)
{
    constexpr int Levels = 4;
    QDir folder(QDir(QStringLiteral("%1/%2/device").arg(ports, portName)).canonicalPath());
    if (folder.path().isEmpty() || folder.path() == QLatin1String("."))
        return {};
    QString place;
    for (int level = 0; level < Levels;
         ++level, folder.setPath(QDir::cleanPath(folder.filePath(QStringLiteral(".."))))) {
        // One adapter may have several ports: several interfaces, or several ports of one interface.
        for (const QLatin1String name : {QLatin1String("port_number"), QLatin1String("bInterfaceNumber")}) {
            const QString number = attribute(folder, name);
            if (!number.isEmpty())
                place = place.isEmpty() ? number : number + QLatin1Char('.') + place;
        }
        const QString vendor = attribute(folder, QStringLiteral("idVendor"));
        if (vendor.isEmpty())
            continue;
        UsbIdentity usb;
        usb.plug = attribute(folder, QStringLiteral("busnum")) + QLatin1Char('-')
                   + attribute(folder, QStringLiteral("devnum"));
        const QString serial = attribute(folder, QStringLiteral("serial"));
        if (!serial.isEmpty()) {
            const QStringList parts{vendor, attribute(folder, QStringLiteral("idProduct")), serial, place};
            usb.identity = parts.join(QLatin1Char(':'));
        }
        return usb;
    }
    return {};
}

} // namespace dynascope
