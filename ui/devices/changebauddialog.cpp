// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/devices/changebauddialog.h"

#include "core/session/commands.h"
#include "ui/common/texts.h"

#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QSignalBlocker>

#include <algorithm>

namespace dynascope {

ChangeBaudDialog::ChangeBaudDialog(Device &device, Commands &commands, QWidget *parent)
    : DeviceDialog(device, tr("Change baud rate"), tr("Change baud rate"), parent)
    , m_commands(commands)
    , m_baud(new QComboBox(this))
    , m_present(new QLabel(this))
{
    setObjectName(QStringLiteral("changeBaudDialog"));
    m_baud->setObjectName(QStringLiteral("newBaud"));
    m_baud->setAccessibleName(tr("New baud rate"));
    fill();
    form()->addRow(tr("Present baud rate"), m_present);
    form()->addRow(tr("New baud rate"), m_baud);
    beginWith(m_baud);
    connect(m_baud, &QComboBox::currentIndexChanged, this, [this] { check(); });
    ChangeBaudDialog::check();
}

/// Again where the device has moved meanwhile: what was chosen stays, if it still can be.
void ChangeBaudDialog::fill()
{
    if (m_filledFor == device()->baudRate())
        return;
    m_filledFor = device()->baudRate();
    const QSignalBlocker blocker(m_baud);
    const int chosen = m_baud->currentData().toInt();
    m_baud->clear();
    for (const BaudCode &code : device()->table().description().baudCodes) {
        if (code.rate != m_filledFor)
            m_baud->addItem(baudText(code.rate), code.rate);
    }
    const int again = m_baud->findData(chosen);
    m_baud->setCurrentIndex(again >= 0 ? again : mostLikely(*device()));
    m_present->setText(baudText(m_filledFor));
}

/// To where the line works, else to what is new from the factory, else anywhere: but not to where its ID is taken.
int ChangeBaudDialog::mostLikely(const Device &device) const
{
    const LineSession *line = device.line();
    std::vector<int> rates{line ? line->baudRate() : 0, 57600, 1000000};
    for (int i = 0; i < m_baud->count(); ++i)
        rates.push_back(m_baud->itemData(i).toInt());
    for (const int rate : rates) {
        const int index = m_baud->findData(rate);
        if (index >= 0 && !(line && line->deviceAt(device.id(), rate)))
            return index;
    }
    return 0;
}

bool ChangeBaudDialog::isAlone() const
{
    const LineSession *line = device()->line();
    return line && std::ranges::none_of(line->devices(), [this](const auto &other) {
        return other.get() != device() && other->state() == Device::State::Present;
    });
}

void ChangeBaudDialog::check()
{
    if (!device())
        return;
    fill();
    const int baud = m_baud->currentData().toInt();
    const LineSession *line = device()->line();
    const Device *other = line ? line->deviceAt(device()->id(), baud) : nullptr;
    const bool joins = line && line->baudRate() == baud;
    if (m_baud->count() == 0)
        setNote(MessageKind::Error, tr("%1 offers no other baud rate.").arg(device()->model()));
    else if (other)
        setNote(MessageKind::Error, tr("ID %1 at %2 is taken by %3. Change the ID of one of them first.")
                                        .arg(device()->id()).arg(baudText(baud), other->displayName()));
    else if (!torqueAllows())
        setNote(MessageKind::Error, tr("The servo keeps its baud rate locked while its torque is on."));
    else if (joins)
        setNote(MessageKind::Info, tr("That is the rate the line works at: the device joins the others."));
    else if (isAlone())
        setNote(MessageKind::Info,
            tr("It is the only device that works here: the line follows it to %1.").arg(baudText(baud)));
    else
        setNote(MessageKind::Warning,
            tr("The line goes on at %1: this device will be parked, and isn't polled or plotted "
               "until the line works at %2.")
                .arg(line ? baudText(line->baudRate()) : QString(), baudText(baud)));
}

void ChangeBaudDialog::accept()
{
    if (device())
        m_commands.changeBaud(*device(), m_baud->currentData().toInt(), turnsTorqueOff());
    DeviceDialog::accept();
}

} // namespace dynascope
