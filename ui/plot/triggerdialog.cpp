// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/triggerdialog.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QPushButton>

#include <algorithm>
#include <cmath>

namespace dynascope {

namespace {

constexpr int LongestPart = 300'000; ///< ms before or after

int inMilliseconds(LineTime time)
{
    return static_cast<int>(std::chrono::duration_cast<std::chrono::milliseconds>(time).count());
}

} // namespace

TriggerDialog::TriggerDialog(const TriggerChoice &choice, std::vector<Source> sources, QWidget *parent)
    : QDialog(parent)
    , m_sources(std::move(sources))
    , m_form(new QFormLayout)
    , m_kind(new QComboBox(this))
    , m_source(new QComboBox(this))
    , m_level(new QDoubleSpinBox(this))
    , m_hysteresis(new QDoubleSpinBox(this))
    , m_before(new QSpinBox(this))
    , m_after(new QSpinBox(this))
    , m_mode(new QComboBox(this))
{
    using Kind = TriggerSettings::Kind;
    using Mode = TriggerSettings::Mode;
    setObjectName(QStringLiteral("triggerDialog"));
    setWindowTitle(tr("Trigger"));
    m_kind->addItem(tr("Rising through a level"), static_cast<int>(Kind::Rising));
    m_kind->addItem(tr("Falling through a level"), static_cast<int>(Kind::Falling));
    m_kind->addItem(tr("Crossing a level either way"), static_cast<int>(Kind::Either));
    m_kind->addItem(tr("Event: restart, alert, torque, write"), static_cast<int>(Kind::Event));
    m_kind->setCurrentIndex(m_kind->findData(static_cast<int>(choice.settings.kind)));
    for (const Source &source : m_sources)
        m_source->addItem(source.name);
    const auto known = std::ranges::find(m_sources, choice.trace, &Source::key);
    m_source->setCurrentIndex(known == m_sources.end() ? 0 : static_cast<int>(known - m_sources.begin()));
    for (QDoubleSpinBox *box : {m_level, m_hysteresis}) {
        box->setRange(box == m_level ? -1e9 : 0, 1e9);
        box->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
    }
    m_hysteresis->setToolTip(tr("So far beyond the level, on the other side, the signal must have been before"));
    for (QSpinBox *box : {m_before, m_after}) {
        box->setRange(box == m_before ? 0 : 1, LongestPart);
        box->setSuffix(tr(" ms"));
        box->setSingleStep(100);
    }
    m_before->setValue(inMilliseconds(choice.settings.before));
    m_after->setValue(inMilliseconds(choice.settings.after));
    m_mode->addItem(tr("Auto: live where nothing triggers"), static_cast<int>(Mode::Auto));
    m_mode->addItem(tr("Normal: the last one stands until the next"), static_cast<int>(Mode::Normal));
    m_mode->addItem(tr("Single: once"), static_cast<int>(Mode::Single));
    m_mode->setCurrentIndex(m_mode->findData(static_cast<int>(choice.settings.mode)));
    m_form->addRow(tr("&On"), m_kind);
    m_form->addRow(tr("&Trace"), m_source);
    m_form->addRow(tr("&Level"), m_level);
    m_form->addRow(tr("&Hysteresis"), m_hysteresis);
    m_form->addRow(tr("&Before"), m_before);
    m_form->addRow(tr("&After"), m_after);
    m_form->addRow(tr("&Mode"), m_mode);
    auto *buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
    auto *arm = buttons->addButton(tr("Arm"), QDialogButtonBox::AcceptRole);
    arm->setDefault(true);
    auto *layout = new QVBoxLayout(this);
    layout->addLayout(m_form);
    layout->addStretch();
    layout->addWidget(buttons);
    showUnit();
    if (known != m_sources.end()) {
        m_level->setValue(choice.level);
        m_hysteresis->setValue(choice.hysteresis);
    }
    showKind();
    connect(m_kind, &QComboBox::currentIndexChanged, this, &TriggerDialog::showKind);
    connect(m_source, &QComboBox::currentIndexChanged, this, &TriggerDialog::showUnit);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    connect(buttons, &QDialogButtonBox::accepted, this, [this] {
        emit chosen(result());
        accept();
    });
    setMinimumWidth(400);
}

/// Begins at the value that the trace has now.
void TriggerDialog::showUnit()
{
    if (m_source->currentIndex() < 0)
        return;
    const Source &source = m_sources[static_cast<std::size_t>(m_source->currentIndex())];
    for (QDoubleSpinBox *box : {m_level, m_hysteresis}) {
        box->setDecimals(std::clamp(source.decimals, 0, 6));
        box->setSuffix(source.unit.isEmpty() ? QString() : QStringLiteral(" ") + source.unit);
    }
    m_level->setValue(source.value);
    m_hysteresis->setValue(2 * std::pow(10.0, -source.decimals));
}

void TriggerDialog::showKind()
{
    const bool isEvent = m_kind->currentData().toInt() == static_cast<int>(TriggerSettings::Kind::Event);
    for (QWidget *field : {static_cast<QWidget *>(m_source), static_cast<QWidget *>(m_level), static_cast<QWidget *>(m_hysteresis)})
        field->setEnabled(!isEvent);
}

TriggerChoice TriggerDialog::result() const
{
    TriggerChoice choice;
    if (m_source->currentIndex() >= 0)
        choice.trace = m_sources[static_cast<std::size_t>(m_source->currentIndex())].key;
    choice.level = m_level->value();
    choice.hysteresis = m_hysteresis->value();
    choice.settings.kind = static_cast<TriggerSettings::Kind>(m_kind->currentData().toInt());
    choice.settings.mode = static_cast<TriggerSettings::Mode>(m_mode->currentData().toInt());
    choice.settings.before = std::chrono::milliseconds(m_before->value());
    choice.settings.after = std::chrono::milliseconds(m_after->value());
    return choice;
}

} // namespace dynascope
