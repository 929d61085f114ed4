// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/devices/factoryresetdialog.h"

#include "core/session/commands.h"
#include "ui/common/texts.h"

#include <QButtonGroup>
#include <QFormLayout>
#include <QLabel>
#include <QRadioButton>

#include <algorithm>

namespace dynascope {

FactoryResetDialog::FactoryResetDialog(Device &device, Commands &commands, QWidget *parent)
    : DeviceDialog(device, tr("Factory reset"), tr("Reset"), parent)
    , m_commands(commands)
    , m_options(new QButtonGroup(this))
{
    setObjectName(QStringLiteral("factoryResetDialog"));
    leaveTorque();
    addOption(ResetOption::AllButIdAndBaud, QStringLiteral("resetKeepIdAndBaud"), tr("Keep ID and baud rate"));
    addOption(ResetOption::AllButId, QStringLiteral("resetKeepId"), tr("Keep the ID only"));
    addOption(ResetOption::All, QStringLiteral("resetAll"), tr("Everything"));
    m_options->buttons().first()->setChecked(true);
    beginWith(m_options->buttons().last());
    m_options->buttons().first()->setFocus();
    connect(m_options, &QButtonGroup::idToggled, this, [this] { check(); });
    FactoryResetDialog::check();
}

void FactoryResetDialog::addOption(ResetOption option, const QString &name, const QString &title)
{
    auto *button = new QRadioButton(title, this);
    button->setObjectName(name);
    auto *label = new QLabel(this);
    label->setWordWrap(true);
    label->setIndent(24);
    label->setForegroundRole(QPalette::PlaceholderText);
    m_options->addButton(button, static_cast<int>(option));
    m_places.push_back(label);
    form()->addRow(button);
    form()->addRow(label);
}

ResetOption FactoryResetDialog::option() const
{
    return static_cast<ResetOption>(m_options->checkedId());
}

void FactoryResetDialog::showPlaces()
{
    for (std::size_t i = 0; i < m_places.size(); ++i) {
        QAbstractButton *button = m_options->buttons().at(static_cast<qsizetype>(i));
        const DevicePlace place = placeAfterReset(*device(), static_cast<ResetOption>(m_options->id(button)));
        const QString where = tr("Afterwards: ID %1 at %2.").arg(place.id).arg(baudText(place.baudRate));
        m_places[i]->setText(where);
        button->setAccessibleDescription(where);
    }
}

void FactoryResetDialog::check()
{
    if (!device())
        return;
    showPlaces();
    const DevicePlace place = placeAfterReset(*device(), option());
    const LineSession *line = device()->line();
    const Device *other = line ? line->deviceAt(place.id, place.baudRate) : nullptr;
    if (other && other != device()) {
        setNote(MessageKind::Error, tr("%1 has ID %2 at %3 already: two devices would share one ID.")
                                        .arg(other->displayName()).arg(place.id).arg(baudText(place.baudRate)));
        return;
    }
    QString text = tr("Limits, gains, modes and offsets go back to the factory's values; they can't be brought back. "
                      "The device restarts with torque off.");
    if (device()->isTorqueOn())
        text += QLatin1Char(' ') + tr("It is under torque now: what it holds may fall.");
    const bool isAlone = line && std::ranges::none_of(line->devices(), [this](const auto &each) {
        return each.get() != device() && each->state() == Device::State::Present;
    });
    if (isAlone && place.baudRate != line->baudRate())
        text += QLatin1Char(' ') + tr("The line follows it to %1.").arg(baudText(place.baudRate));
    else if (line && place.baudRate != line->baudRate())
        text += QLatin1Char(' ') + tr("The line works at %1, so it will be parked.").arg(baudText(line->baudRate()));
    setNote(MessageKind::Warning, text);
}

void FactoryResetDialog::accept()
{
    if (device())
        m_commands.factoryReset(*device(), option());
    DeviceDialog::accept();
}

} // namespace dynascope
