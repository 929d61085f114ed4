// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/consequencesdialog.h"

#include "core/session/linesession.h"
#include "ui/common/icons.h"
#include "ui/common/present.h"
#include "ui/common/texts.h"
#include "ui/common/theme.h"

#include <QCheckBox>
#include <QDialogButtonBox>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include <algorithm>

namespace dynascope {
namespace {

constexpr std::size_t MostShown = 3; ///< devices whose consequences are listed one by one
constexpr int SignSize = 20, TextWidth = 460;

RegisterLookup lookupOf(const Device &device)
{
    return [&device](QStringView name) { return device.raw(name); };
}

QLabel *makeText(const QString &text, QWidget *parent)
{
    auto *label = new QLabel(text, parent);
    label->setWordWrap(true);
    label->setTextFormat(Qt::PlainText); // nicknames are in it
    label->setMinimumWidth(TextWidth);
    return label;
}

QLabel *makeBold(const QString &text, QWidget *parent)
{
    QLabel *label = makeText(text, parent);
    label->setFont(boldened(label->font()));
    return label;
}

} // namespace

std::vector<Consequence> consequencesOf(const Device &device, int field, std::int64_t raw, const UnitPreferences &units)
{
    return consequencesOf(device.table(), lookupOf(device), device.table().fields()[static_cast<std::size_t>(field)], raw,
                          units);
}

QString jumpsText(const std::vector<Device *> &devices, const UnitPreferences &units)
{
    QString text;
    for (const Device *device : devices) {
        const int torque = device->table().indexOf(Known::TorqueEnable);
        for (const Consequence &one :
             torque < 0 ? std::vector<Consequence>() : consequencesOf(*device, torque, 1, units)) {
            if (one.isSerious())
                text += QStringLiteral("\n\n") + ConsequencesDialog::tr("%1: %2").arg(device->displayName(), one.text);
        }
    }
    return text;
}

bool isLockedByTorqueAlone(const Device &device, int field)
{
    const Field &of = device.table().fields()[static_cast<std::size_t>(field)];
    const bool isThere = !device.line() || device.line()->state() == BusThread::State::Open;
    return of.needsTorqueOff() && device.isTorqueOn() && isThere && device.state() != Device::State::Rebooting;
}

ConsequencesDialog::ConsequencesDialog(AskedWrite write, QWidget *parent)
    : QDialog(parent), m_write(std::move(write)), m_table(m_write.devices.front()->sharedTable())
{
    setObjectName(QStringLiteral("consequencesDialog"));
    setWindowTitle(tr("Before %1 is written").arg(field().name));
    m_isTorque = m_table->find(Known::TorqueEnable) == &field();
    for (Device *device : m_write.devices) {
        m_devices.emplace_back(device);
        m_hadTorque = m_hadTorque || device->isTorqueOn();
        for (const Consequence &one : consequencesOf(*device, m_write.field, m_write.raw)) {
            m_resets = m_resets || one.kind == ConsequenceKind::Resets;
            m_changesProtocol = m_changesProtocol || one.kind == ConsequenceKind::ChangesProtocol;
        }
        connect(device, &QObject::destroyed, this, &QDialog::reject);
        connect(device, &Device::fieldsChanged, this, &ConsequencesDialog::check);
        connect(device, &Device::attributesChanged, this, &ConsequencesDialog::check);
    }
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(24, 24, 24, 16);
    layout->setSpacing(16);
    layout->setSizeConstraint(QLayout::SetMinAndMaxSize);
    addHeading(*layout);
    addConsequences(*layout);
    if (m_write.writeSafely && !m_changesProtocol)
        addSteps(*layout);
    addButtons(*layout);
    check();
}

const Field &ConsequencesDialog::field() const
{
    return m_table->fields()[static_cast<std::size_t>(m_write.field)];
}

void ConsequencesDialog::addHeading(QVBoxLayout &layout)
{
    QStringList names;
    for (const Device *device : m_write.devices)
        names << device->displayName();
    const Device &first = *m_write.devices.front();
    const ExpectedChange change{field().name, first.value(m_write.field).raw, m_write.raw};
    const QString who = names.join(QStringLiteral(", "));
    const QString what = withBaudTexts(changeText(*m_table, lookupOf(first), change, m_write.units));
    QLabel *label = makeBold(tr("%1 – %2").arg(who, what), this);
    if (m_write.devices.size() > 1)
        label->setText(tr("%1 of %2 devices: %3").arg(field().name).arg(m_write.devices.size()).arg(who));
    label->setObjectName(QStringLiteral("consequencesHeading"));
    layout.addWidget(label);
}

void ConsequencesDialog::addConsequences(QVBoxLayout &layout)
{
    auto *grid = new QGridLayout;
    grid->setHorizontalSpacing(8);
    grid->setVerticalSpacing(8);
    grid->setColumnStretch(1, 1);
    int row = 0;
    QStringList all;
    for (std::size_t i = 0; i < std::min(MostShown, m_write.devices.size()); ++i) {
        const Device &device = *m_write.devices[i];
        for (const Consequence &one : consequencesOf(device, m_write.field, m_write.raw, m_write.units)) {
            QString text =
                m_write.devices.size() > 1 ? tr("%1: %2").arg(device.displayName(), one.text) : one.text;
            for (const ExpectedChange &change :
                 one.kind == ConsequenceKind::Resets ? one.registers : std::vector<ExpectedChange>())
                text += QStringLiteral("\n    ") + changeText(*m_table, lookupOf(device), change, m_write.units);
            text = withBaudTexts(text);
            auto *sign = new QLabel(this);
            sign->setPixmap((one.isSerious() ? icon(QStringLiteral("warning"), IconTint::Warning)
                                             : icon(QStringLiteral("info"), IconTint::Accent))
                                .pixmap(QSize(SignSize, SignSize), devicePixelRatioF()));
            grid->addWidget(sign, row, 0, Qt::AlignTop);
            QLabel *label = makeText(text, this);
            label->setObjectName(QStringLiteral("consequence"));
            grid->addWidget(label, row++, 1);
            all << text;
        }
    }
    if (m_write.devices.size() > MostShown)
        grid->addWidget(makeText(tr("And alike for the others."), this), row, 1);
    setAccessibleDescription(all.join(u'\n'));
    layout.addLayout(grid);
}

QStringList ConsequencesDialog::steps() const
{
    QStringList steps;
    if (m_isTorque) {
        steps << tr("make the goal what lets the joint rest: its Present Position, or 0 where it would run")
              << tr("turn torque on, and read it back");
        return steps;
    }
    if (m_resets)
        steps << tr("keep the values of the registers that will be reset");
    if (m_hadTorque)
        steps << tr("turn torque off");
    steps << tr("write %1, and read it back").arg(field().name);
    if (m_resets)
        steps << tr("put the kept values back");
    return steps;
}

void ConsequencesDialog::addSteps(QVBoxLayout &layout)
{
    layout.addWidget(makeBold(tr("The safe way"), this));
    QStringList lines;
    const QStringList all = steps();
    for (qsizetype i = 0; i < all.size(); ++i)
        lines << tr("%1. %2").arg(i + 1).arg(all[i]);
    QLabel *label = makeText(lines.join(u'\n'), this);
    label->setObjectName(QStringLiteral("safeSteps"));
    layout.addWidget(label);
    if (m_isTorque || !m_hadTorque)
        return;
    m_torqueBack = new QCheckBox(tr("Then turn torque &on again, with the goal at the present position"), this);
    m_torqueBack->setObjectName(QStringLiteral("torqueBack"));
    m_torqueBack->setToolTip(tr("Otherwise torque stays off. It stays off, too, where something could not be written"));
    layout.addWidget(m_torqueBack);
}

void ConsequencesDialog::addButtons(QVBoxLayout &layout)
{
    auto *buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
    m_only = buttons->addButton(m_isTorque ? tr("Torque on, &as it is") : tr("Write &only"), QDialogButtonBox::ActionRole);
    m_only->setObjectName(QStringLiteral("writeOnly"));
    m_only->setAutoDefault(false);
    connect(m_only, &QPushButton::clicked, this, [this] { carryOut(false); });
    if (m_write.writeSafely && !m_changesProtocol) {
        m_safe = buttons->addButton(m_isTorque ? tr("Torque on, at &rest") : tr("Write the &safe way"),
                                    QDialogButtonBox::AcceptRole);
        m_safe->setObjectName(QStringLiteral("writeSafely"));
        m_safe->setDefault(true);
        m_safe->setFocus();
        connect(m_safe, &QPushButton::clicked, this, [this] { carryOut(true); });
    } else {
        buttons->button(QDialogButtonBox::Cancel)->setDefault(true);
        buttons->button(QDialogButtonBox::Cancel)->setFocus();
    }
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    layout.addWidget(buttons);
}

/// While it is open torque may go, or the line.
void ConsequencesDialog::check()
{
    bool isFree = true, isThere = true;
    for (const QPointer<Device> &device : m_devices) {
        if (!device)
            return;
        isFree = isFree && device->lockReason(m_write.field).isEmpty();
        isThere = isThere && (device->lockReason(m_write.field).isEmpty() || isLockedByTorqueAlone(*device, m_write.field));
    }
    m_only->setEnabled(isFree);
    m_only->setToolTip(isFree    ? tr("Nothing but this one write")
                       : isThere ? tr("The device refuses it while its torque is on")
                                 : tr("The device can't be written to now"));
    if (m_safe)
        m_safe->setEnabled(isThere);
}

void ConsequencesDialog::carryOut(bool safely)
{
    const bool torqueBack = m_torqueBack && m_torqueBack->isChecked();
    const std::vector<QPointer<Device>> devices = m_devices;
    const AskedWrite write = m_write;
    accept();
    for (const QPointer<Device> &device : devices) {
        if (!device)
            continue;
        if (safely)
            write.writeSafely(*device, torqueBack);
        else
            write.writeOnly(*device);
    }
}

void askAboutConsequences(AskedWrite write, QWidget *parent)
{
    if (write.devices.empty())
        return;
    QStringList keys;
    for (const Device *device : write.devices)
        keys << QString::number(device->key());
    const QString subject = QStringLiteral("%1 %2 %3").arg(keys.join(u',')).arg(write.field).arg(write.raw);
    if (!raiseOpen(*parent->window(), QStringLiteral("consequencesDialog"), subject))
        present(*new ConsequencesDialog(std::move(write), parent), subject);
}

} // namespace dynascope
