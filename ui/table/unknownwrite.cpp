// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/unknownwrite.h"

#include "ui/common/present.h"

#include <QCoreApplication>
#include <QMessageBox>
#include <QPointer>
#include <QPushButton>

namespace dynascope {

namespace {

struct UnknownWrite {
    Q_DECLARE_TR_FUNCTIONS(UnknownWrite)
};

QString bytesText(const Field &field, std::int64_t raw)
{
    QStringList bytes;
    for (const std::uint8_t byte : bytesFromRaw(field, raw))
        bytes << QStringLiteral("%1").arg(byte, 2, 16, QLatin1Char('0')).toUpper();
    return bytes.join(u' ');
}

QString question(const std::vector<Device *> &devices, const Field &field, std::int64_t raw)
{
    QStringList names;
    for (const Device *device : devices)
        names << device->displayName();
    const QString what =
        field.size == 1
            ? UnknownWrite::tr("Write the byte %1 (%2) to address %3 of %4?").arg(bytesText(field, raw)).arg(raw)
            : UnknownWrite::tr("Write the bytes %1 (%2) from address %3 on to %4?").arg(bytesText(field, raw)).arg(raw);
    return what.arg(field.address).arg(names.join(QStringLiteral(", ")));
}

QString warning(const Device &device, const Field &field)
{
    QString text =
        device.isKnownModel()
            ? UnknownWrite::tr(
                  "Only name, address and size of %1 are public. Whether it may be written, and what it does "
                  "then, isn't known.")
                  .arg(field.name)
            : UnknownWrite::tr("Nothing is known of this model. What this byte does isn't known.");
    if (!field.suggested.isEmpty())
        text += QLatin1Char(' ') + UnknownWrite::tr("Models numbered next to it have %1 here.").arg(field.suggested);
    return text + QLatin1Char(' ')
           + UnknownWrite::tr("It may move the motor, change ID or baud rate, or stay after power-off.");
}

} // namespace

void askToWriteUnknown(const std::vector<Device *> &devices, int field, std::int64_t raw,
                       const std::function<void(Device &, int, std::int64_t)> &write, QWidget *parent)
{
    if (devices.empty() || !write)
        return;
    const Device &first = *devices.front();
    const Field &of = first.table().fields()[static_cast<std::size_t>(field)];
    auto *box = new QMessageBox(QMessageBox::Warning, UnknownWrite::tr("Write an unknown register"),
                                question(devices, of, raw), QMessageBox::Cancel, parent);
    box->setObjectName(QStringLiteral("unknownWriteBox"));
    box->setTextFormat(Qt::PlainText); // nicknames are in it
    box->setInformativeText(warning(first, of));
    QPushButton *accept = box->addButton(UnknownWrite::tr("Write it"), QMessageBox::AcceptRole);
    accept->setObjectName(QStringLiteral("unknownWriteButton"));
    box->setDefaultButton(QMessageBox::Cancel);
    std::vector<QPointer<Device>> targets;
    for (Device *device : devices) {
        targets.emplace_back(device);
        QObject::connect(device, &QObject::destroyed, box, &QDialog::reject);
    }
    QObject::connect(accept, &QPushButton::clicked, box, [targets, field, raw, write] {
        for (const QPointer<Device> &device : targets) {
            if (device)
                write(*device, field, raw);
        }
    });
    present(*box, QStringLiteral("%1 %2").arg(first.key()).arg(field));
}

} // namespace dynascope
