// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/devices/devicedialog.h"

#include "ui/common/icons.h"
#include "ui/common/texts.h"
#include "ui/common/theme.h"

#include <QCheckBox>
#include <QDialogButtonBox>
#include <QEvent>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

namespace dynascope {

DeviceDialog::DeviceDialog(Device &device, const QString &title, const QString &accept, QWidget *parent)
    : QDialog(parent)
    , m_device(&device)
    , m_title(title)
    , m_who(new QLabel(this))
    , m_form(new QFormLayout)
    , m_noteIcon(new QLabel(this))
    , m_note(new QLabel(this))
    , m_torqueOff(new QCheckBox(tr("Turn torque off first"), this))
{
    setMinimumWidth(440);
    m_note->setObjectName(QStringLiteral("note"));
    m_note->setWordWrap(true);
    m_note->setTextFormat(Qt::PlainText);
    m_note->setAlignment(Qt::AlignLeft | Qt::AlignTop);
    m_note->setMinimumHeight(3 * m_note->fontMetrics().lineSpacing()); // so that the dialog doesn't jump
    m_torqueOff->setObjectName(QStringLiteral("turnTorqueOff"));
    m_torqueOff->setToolTip(tr("What the servo holds may fall"));

    m_who->setObjectName(QStringLiteral("who"));
    m_who->setWordWrap(true);
    m_who->setTextFormat(Qt::PlainText);
    m_who->setFont(boldened(m_who->font()));
    m_form->setHorizontalSpacing(16);
    m_form->setVerticalSpacing(8);

    auto *note = new QHBoxLayout;
    note->setSpacing(8);
    note->addWidget(m_noteIcon, 0, Qt::AlignTop);
    note->addWidget(m_note, 1);
    m_buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
    m_accept = m_buttons->addButton(accept, QDialogButtonBox::AcceptRole);
    m_accept->setObjectName(QStringLiteral("acceptButton"));
    m_accept->setDefault(true);

    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(24, 24, 24, 16);
    layout->setSpacing(16);
    layout->addWidget(m_who);
    layout->addLayout(m_form);
    layout->addWidget(m_torqueOff);
    layout->addLayout(note);
    layout->addStretch(1);
    layout->addWidget(m_buttons);

    connect(m_buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
    connect(m_buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    if (device.line())
        connect(device.line(), &LineSession::stateChanged, this, [this] { check(); });
    connect(m_torqueOff, &QCheckBox::toggled, this, [this] { check(); });
    connect(&device, &QObject::destroyed, this, &QDialog::reject);
    connect(&device, &Device::attributesChanged, this, [this] {
        showWho();
        check();
    });
    connect(&device, &Device::fieldsChanged, this, [this](int first, int last) {
        const int torque = m_device ? m_device->table().indexOf(u"Torque Enable") : -1;
        if (torque < first || torque > last)
            return;
        showTorque();
        check();
    });
    showWho();
    showTorque();
}

void DeviceDialog::showWho()
{
    if (!m_device)
        return;
    m_who->setText(tr("%1, ID %2 at %3").arg(m_device->displayName()).arg(m_device->id()).arg(
        baudText(m_device->baudRate())));
    setWindowTitle(tr("%1 – %2, ID %3").arg(m_title, m_device->model()).arg(m_device->id()));
}

void DeviceDialog::beginWith(QWidget *widget)
{
    setTabOrder(widget, m_torqueOff);
    QWidget *last = m_torqueOff;
    for (QAbstractButton *button : m_buttons->buttons()) {
        setTabOrder(last, button);
        last = button;
    }
    widget->setFocus();
}

void DeviceDialog::showTorque()
{
    m_torqueOff->setVisible(!m_leavesTorque && m_device && m_device->isTorqueOn());
}

void DeviceDialog::leaveTorque()
{
    m_leavesTorque = true;
    showTorque();
}

bool DeviceDialog::turnsTorqueOff() const
{
    return m_torqueOff->isChecked();
}

bool DeviceDialog::torqueAllows() const
{
    return !m_device || !m_device->isTorqueOn() || m_torqueOff->isChecked();
}

void DeviceDialog::setNote(MessageKind kind, const QString &text, bool mayAccept)
{
    const LineSession *line = m_device ? m_device->line() : nullptr;
    const bool reachable = !line || line->state() == BusThread::State::Open;
    m_noteKind = reachable ? kind : MessageKind::Error;
    m_note->setText(reachable ? text : tr("%1 isn't open now.").arg(portText(line->name())));
    m_accept->setEnabled(mayAccept && m_noteKind != MessageKind::Error);
    drawNote();
}

void DeviceDialog::drawNote()
{
    const bool error = m_noteKind == MessageKind::Error;
    const bool warning = m_noteKind == MessageKind::Warning;
    const QIcon picture = error ? icon(QStringLiteral("error"), IconTint::Bad)
        : warning              ? icon(QStringLiteral("warning"), IconTint::Warning)
                               : icon(QStringLiteral("info"), IconTint::Accent);
    m_noteIcon->setPixmap(m_note->text().isEmpty() ? QPixmap() : picture.pixmap(QSize(20, 20), devicePixelRatioF()));
}

void DeviceDialog::changeEvent(QEvent *event)
{
    if (event->type() == QEvent::PaletteChange)
        drawNote();
    QDialog::changeEvent(event);
}

} // namespace dynascope
