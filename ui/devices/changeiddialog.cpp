// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/devices/changeiddialog.h"

#include "core/session/commands.h"
#include "ui/common/texts.h"

#include <QFormLayout>
#include <QLabel>
#include <QSpinBox>

#include <algorithm>

namespace dynascope {

namespace {

constexpr int LargestId = 252;

/// Secondary IDs too: a device answers to both.
QStringList takenIds(const Device &device)
{
    QStringList ids;
    for (int id = 0; id <= LargestId; ++id) {
        if (holderOf(device, id).device)
            ids << QString::number(id);
    }
    return ids;
}

} // namespace

ChangeIdDialog::ChangeIdDialog(Device &device, Commands &commands, QWidget *parent)
    : DeviceDialog(device, tr("Change ID"), tr("Change ID"), parent)
    , m_commands(commands)
    , m_id(new QSpinBox(this))
    , m_present(new QLabel(this))
    , m_takenAt(new QLabel(this))
    , m_taken(new QLabel(this))
{
    setObjectName(QStringLiteral("changeIdDialog"));
    m_id->setObjectName(QStringLiteral("newId"));
    m_id->setAccessibleName(tr("New ID"));
    m_id->setRange(0, LargestId);
    m_id->setValue(firstFree());
    m_id->selectAll();
    form()->addRow(tr("Present ID"), m_present);
    form()->addRow(tr("New ID"), m_id);
    m_taken->setObjectName(QStringLiteral("takenIds"));
    m_taken->setWordWrap(true);
    form()->addRow(m_takenAt, m_taken);
    beginWith(m_id);
    connect(m_id, &QSpinBox::valueChanged, this, [this] { check(); });
    ChangeIdDialog::check();
}

/// Free at every rate of the line, if there is one: devices at different rates may yet come together.
int ChangeIdDialog::firstFree() const
{
    const auto standsSomewhere = [line = device()->line()](int id) {
        return line && std::ranges::any_of(line->devices(), [id](const auto &other) { return other->id() == id; });
    };
    int fallback = device()->id();
    for (int id = 1; id <= LargestId; ++id) {
        if (id == device()->id() || holderOf(*device(), id).device)
            continue;
        if (!standsSomewhere(id))
            return id;
        if (fallback == device()->id())
            fallback = id;
    }
    return fallback;
}

/// Where it is, and who else is there: it and others may move while the dialog is open.
void ChangeIdDialog::showPlace()
{
    m_present->setText(QString::number(device()->id()));
    const QStringList taken = takenIds(*device());
    m_taken->setText(taken.isEmpty() ? tr("none") : taken.join(QStringLiteral(", ")));
    m_takenAt->setText(tr("Taken at %1").arg(baudText(device()->baudRate())));
}

void ChangeIdDialog::check()
{
    if (!device())
        return;
    showPlace();
    const int id = m_id->value();
    const Device *other = holderOf(*device(), id).device;
    if (id == device()->id())
        setNote(MessageKind::Error, tr("That is its ID now."));
    else if (other)
        setNote(MessageKind::Error,
            tr("ID %1 is taken by %2. Two devices with one ID can't be told apart.").arg(id).arg(other->displayName()));
    else if (!torqueAllows())
        setNote(MessageKind::Error, tr("The servo keeps its ID locked while its torque is on."));
    else
        setNote(MessageKind::Info, tr("The ID is written, then the device is looked for at its new ID. Its traces and "
                                      "nickname stay with it."));
}

void ChangeIdDialog::accept()
{
    if (device())
        m_commands.changeId(*device(), m_id->value(), turnsTorqueOff());
    DeviceDialog::accept();
}

} // namespace dynascope
