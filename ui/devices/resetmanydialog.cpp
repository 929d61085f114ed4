// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/devices/resetmanydialog.h"

#include "core/session/commands.h"
#include "core/session/resetplan.h"
#include "ui/common/icons.h"
#include "ui/common/texts.h"
#include "ui/common/theme.h"

#include <QButtonGroup>
#include <QDialogButtonBox>
#include <QEvent>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QRadioButton>
#include <QTreeWidget>
#include <QVBoxLayout>

#include <algorithm>
#include <set>

namespace dynascope {
namespace {

QString placeOnScreen(const DevicePlace &place)
{
    return ResetManyDialog::tr("ID %1 at %2").arg(place.id).arg(baudText(place.baudRate));
}

} // namespace

ResetManyDialog::ResetManyDialog(const std::vector<Device *> &devices, Session &session, Commands &commands,
                                 QWidget *parent)
    : QDialog(parent)
    , m_session(session)
    , m_commands(commands)
    , m_options(new QButtonGroup(this))
    , m_list(new QTreeWidget(this))
    , m_noteIcon(new QLabel(this))
    , m_note(new QLabel(this))
{
    setObjectName(QStringLiteral("resetManyDialog"));
    setWindowTitle(tr("Factory reset of %1 devices").arg(devices.size()));
    for (Device *device : devices) {
        m_keys.push_back(device->key());
        connect(device, &Device::attributesChanged, this, &ResetManyDialog::check);
        connect(device, &Device::fieldsChanged, this, [this, device](int first, int last) {
            const int torque = device->table().indexOf(Known::TorqueEnable);
            if (torque >= first && torque <= last)
                check();
        });
        connect(device, &QObject::destroyed, this, [this] { // on the way out of the session
            QMetaObject::invokeMethod(this, &ResetManyDialog::check, Qt::QueuedConnection);
        });
    }
    if (!devices.empty() && devices.front()->line())
        connect(devices.front()->line(), &LineSession::stateChanged, this, &ResetManyDialog::check);
    build();
    m_options->buttons().first()->setFocus();
    check();
}

QWidget *ResetManyDialog::makeOptions()
{
    auto *options = new QWidget(this);
    auto *layout = new QVBoxLayout(options);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(8);
    const auto add = [&](ResetOption option, const char *name, const QString &text) {
        auto *button = new QRadioButton(text, options);
        button->setObjectName(QLatin1String(name));
        m_options->addButton(button, static_cast<int>(option));
        layout->addWidget(button);
    };
    add(ResetOption::AllButIdAndBaud, "resetKeepIdAndBaud", tr("Keep ID and baud rate"));
    add(ResetOption::AllButId, "resetKeepId", tr("Keep the ID only"));
    add(ResetOption::All, "resetAll", tr("Everything"));
    m_options->buttons().first()->setChecked(true);
    connect(m_options, &QButtonGroup::idToggled, this, &ResetManyDialog::check);
    return options;
}

void ResetManyDialog::build()
{
    m_list->setObjectName(QStringLiteral("resetList"));
    m_list->setAccessibleName(tr("Devices, and where they will be"));
    m_list->setHeaderLabels({tr("Device"), tr("Now"), tr("Afterwards")});
    m_list->setRootIsDecorated(false);
    m_list->setUniformRowHeights(true);
    m_list->setSelectionMode(QAbstractItemView::NoSelection);
    m_list->setTextElideMode(Qt::ElideMiddle);
    m_list->header()->setStretchLastSection(false);
    m_list->header()->setSectionResizeMode(0, QHeaderView::Stretch);
    for (const int column : {1, 2})
        m_list->setColumnWidth(column, fontMetrics().horizontalAdvance(QStringLiteral("ID 252 at 115 200 bps")) + 24);
    m_note->setObjectName(QStringLiteral("note"));
    m_note->setWordWrap(true);
    m_note->setTextFormat(Qt::PlainText);
    m_note->setAlignment(Qt::AlignLeft | Qt::AlignTop);
    m_note->setMinimumHeight(4 * m_note->fontMetrics().lineSpacing()); // so that the dialog doesn't jump
    auto *note = new QHBoxLayout;
    note->setSpacing(8);
    note->addWidget(m_noteIcon, 0, Qt::AlignTop);
    note->addWidget(m_note, 1);
    auto *buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
    m_accept = buttons->addButton(tr("&Reset"), QDialogButtonBox::AcceptRole);
    m_accept->setObjectName(QStringLiteral("acceptButton"));
    buttons->button(QDialogButtonBox::Cancel)->setDefault(true); // Return overwrites nobody's EEPROM
    connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);

    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(24, 24, 24, 16);
    layout->setSpacing(16);
    layout->addWidget(makeOptions());
    layout->addWidget(m_list, 1);
    layout->addLayout(note);
    layout->addWidget(buttons);
    setMinimumSize(480, 400);
    resize(600, 480);
}

std::vector<Device *> ResetManyDialog::devices() const
{
    std::vector<Device *> devices;
    for (const DeviceKey key : m_keys) {
        if (Device *device = m_session.device(key))
            devices.push_back(device);
    }
    return devices;
}

ResetOption ResetManyDialog::option() const
{
    return static_cast<ResetOption>(m_options->checkedId());
}

void ResetManyDialog::check()
{
    const std::vector<Device *> devices = this->devices();
    if (devices.empty())
        return reject();
    const LineSession *line = devices.front()->line();
    m_list->clear();
    bool parks = false;
    std::set<int> rates;
    for (const Device *device : devices) {
        const DevicePlace after = placeAfterReset(*device, option());
        auto *row =
            new QTreeWidgetItem(m_list, {device->displayName(), placeOnScreen(placeOf(*device)), placeOnScreen(after)});
        row->setToolTip(0, plainToolTip(device->displayName()));
        parks = parks || (line && after.baudRate != line->baudRate() && device->baudRate() == line->baudRate());
        rates.insert(after.baudRate);
    }
    const auto order = resetOrder(devices, option());
    const bool isOpen = line && line->state() == BusThread::State::Open;
    if (!isOpen)
        return setNote(MessageKind::Error, tr("The line isn't open now."));
    if (!order)
        return setNote(MessageKind::Error, asSentence(order.error().text));
    QString text =
        tr("Limits, gains, modes and offsets go back to the factory's values; they can't be brought back. "
           "Back up first what you may want again. One after the other restarts with torque off, "
           "and is looked for at its new place.");
    const auto held = std::ranges::count_if(devices, &Device::isTorqueOn);
    if (held > 0)
        text += QLatin1Char(' ') + tr("%1 are under torque now: what they hold may fall.").arg(held);
    const bool areAll = line && !rates.contains(line->baudRate())
                        && std::ranges::none_of(line->devices(), [&devices](const auto &each) {
                               return each->state() == Device::State::Present
                                      && std::ranges::find(devices, each.get()) == devices.end();
                           });
    if (areAll && rates.size() == 1)
        text += QLatin1Char(' ') + tr("At the end the line follows to %1.").arg(baudText(*rates.begin()));
    else if (parks)
        text += QLatin1Char(' ') + tr("The line works at %1, so some will be parked.").arg(baudText(line->baudRate()));
    setNote(MessageKind::Warning, text);
}

void ResetManyDialog::accept()
{
    m_commands.factoryReset(devices(), option());
    QDialog::accept();
}

void ResetManyDialog::setNote(MessageKind kind, const QString &text)
{
    m_noteKind = kind;
    m_note->setText(text);
    m_accept->setEnabled(kind != MessageKind::Error);
    drawNote();
}

void ResetManyDialog::drawNote()
{
    const bool isError = m_noteKind == MessageKind::Error;
    QPalette palette = this->palette();
    if (isError)
        palette.setColor(QPalette::WindowText, colors(palette).bad);
    m_note->setPalette(palette);
    const QIcon picture =
        isError ? icon(QStringLiteral("error"), IconTint::Bad) : icon(QStringLiteral("warning"), IconTint::Warning);
    m_noteIcon->setPixmap(picture.pixmap(QSize(20, 20), devicePixelRatioF()));
}

void ResetManyDialog::changeEvent(QEvent *event)
{
    if (event->type() == QEvent::PaletteChange)
        drawNote();
    QDialog::changeEvent(event);
}

} // namespace dynascope
