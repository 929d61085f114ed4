// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plot/deriveddialog.h"

#include "ui/plot/tracemodel.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>

#include <algorithm>

namespace dynascope {

namespace {

constexpr int LongestUnit = 12;
constexpr int LongestSpan = static_cast<int>(std::chrono::duration_cast<std::chrono::milliseconds>(Derivation::LongestSpan).count());

} // namespace

DerivedDialog::DerivedDialog(const TraceModel &model, int row, QWidget *parent)
    : QDialog(parent)
    , m_model(model)
    , m_form(new QFormLayout)
    , m_source(new QComboBox(this))
    , m_kind(new QComboBox(this))
    , m_other(new QComboBox(this))
    , m_span(new QSpinBox(this))
    , m_factor(new QDoubleSpinBox(this))
    , m_offset(new QDoubleSpinBox(this))
    , m_unit(new QLineEdit(this))
    , m_meaning(new QLabel(this))
{
    setObjectName(QStringLiteral("derivedDialog"));
    setWindowTitle(tr("Add derived trace"));
    for (int i = 0; i < model.rowCount(); ++i) {
        if (model.key(i).isDerived())
            continue;
        m_sources.push_back(model.watch(i));
        m_source->addItem(model.index(i).data().toString());
        if (i == row)
            m_source->setCurrentIndex(m_source->count() - 1);
    }
    m_kind->addItem(tr("Difference of two"), static_cast<int>(Derivation::Kind::Difference));
    m_kind->addItem(tr("Derivative"), static_cast<int>(Derivation::Kind::Derivative));
    m_kind->addItem(tr("Moving average"), static_cast<int>(Derivation::Kind::Average));
    m_kind->addItem(tr("Scale and offset"), static_cast<int>(Derivation::Kind::Scaled));
    m_span->setRange(0, LongestSpan);
    m_span->setSuffix(tr(" ms"));
    m_span->setValue(50);
    for (QDoubleSpinBox *box : {m_factor, m_offset}) {
        box->setDecimals(6);
        box->setRange(-1e9, 1e9);
        box->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
    }
    m_factor->setValue(1);
    m_unit->setMaxLength(LongestUnit);
    m_unit->setPlaceholderText(tr("as the trace"));
    m_meaning->setWordWrap(true);
    m_meaning->setMinimumHeight(3 * fontMetrics().lineSpacing()); // its words change, the rest stays in place
    m_meaning->setAlignment(Qt::AlignTop | Qt::AlignLeft);
    m_form->addRow(tr("&Kind"), m_kind);
    m_form->addRow(tr("&Trace"), m_source);
    m_form->addRow(tr("&Less"), m_other);
    m_form->addRow(tr("&Over"), m_span);
    m_form->addRow(tr("&Factor"), m_factor);
    m_form->addRow(tr("O&ffset"), m_offset);
    m_form->addRow(tr("&Unit"), m_unit);
    auto *buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
    m_add = buttons->addButton(tr("Add"), QDialogButtonBox::AcceptRole);
    m_add->setDefault(true);
    auto *layout = new QVBoxLayout(this);
    layout->addLayout(m_form);
    layout->addWidget(m_meaning);
    layout->addStretch();
    layout->addWidget(buttons);
    connect(m_kind, &QComboBox::currentIndexChanged, this, &DerivedDialog::showKind);
    connect(m_source, &QComboBox::currentIndexChanged, this, [this] {
        fillOthers();
        showKind();
    });
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    connect(buttons, &QDialogButtonBox::accepted, this, [this] {
        emit chosen(result());
        accept();
    });
    fillOthers();
    if (m_other->count() == 0) // no difference to be had
        m_kind->setCurrentIndex(1);
    showKind();
    setMinimumWidth(420);
}

Derivation::Kind DerivedDialog::kind() const
{
    return static_cast<Derivation::Kind>(m_kind->currentData().toInt());
}

void DerivedDialog::fillOthers()
{
    m_other->clear();
    const int source = m_source->currentIndex();
    for (int i = 0; i < m_source->count(); ++i) {
        const Watch &other = m_sources[static_cast<std::size_t>(i)];
        if (m_model.areComparable(m_sources[static_cast<std::size_t>(source)], other))
            m_other->addItem(m_source->itemText(i), i);
    }
}

void DerivedDialog::showKind()
{
    using Kind = Derivation::Kind;
    const auto show = [this](QWidget *field, bool on) {
        field->setVisible(on);
        m_form->labelForField(field)->setVisible(on);
    };
    show(m_other, kind() == Kind::Difference);
    show(m_span, kind() == Kind::Derivative || kind() == Kind::Average);
    for (QWidget *field : {static_cast<QWidget *>(m_factor), static_cast<QWidget *>(m_offset), static_cast<QWidget *>(m_unit)})
        show(field, kind() == Kind::Scaled);
    m_add->setEnabled(!m_sources.empty() && (kind() != Kind::Difference || m_other->count() > 0));
    switch (kind()) {
    case Kind::Difference:
        m_meaning->setText(m_other->count() > 0
                ? tr("At each sample of the trace, less the other's value that held then.")
                : tr("No other trace of this panel has the same unit. Add one first."));
        break;
    case Kind::Derivative:
        m_meaning->setText(tr("Change per second, from the newest sample that is at least so old; 0 ms: from sample to "
                              "sample. A longer time is calmer, and late by half of it."));
        break;
    case Kind::Average:
        m_meaning->setText(tr("Mean of the samples of this time, up to each sample. It is late by half of it."));
        break;
    case Kind::Scaled:
        m_meaning->setText(tr("Value × factor + offset, in the units shown now. With a unit of its own it no longer "
                              "follows the choice of units."));
        break;
    case Kind::None: break;
    }
}

TraceKey DerivedDialog::result() const
{
    const Watch source = m_sources.at(static_cast<std::size_t>(std::max(0, m_source->currentIndex())));
    Derivation how;
    how.kind = kind();
    if (how.kind == Derivation::Kind::Difference)
        how.other = m_sources.at(static_cast<std::size_t>(m_other->currentData().toInt()));
    if (how.kind == Derivation::Kind::Derivative || how.kind == Derivation::Kind::Average)
        how.span = std::chrono::milliseconds(m_span->value());
    if (how.kind == Derivation::Kind::Scaled) {
        const int row = m_model.indexOf(source);
        const TraceModel::Linear unit = row < 0 ? TraceModel::Linear{} : m_model.sourceScale(row);
        how.unit = m_unit->text().simplified();
        const double factor = m_factor->value();
        const double offset = m_offset->value();
        // Kept of raw values, so that it means the same in other units.
        how.factor = how.unit.isEmpty() ? factor : factor * unit.scale;
        how.offset = how.unit.isEmpty() ? (unit.scale != 0 ? offset / unit.scale : 0) : factor * unit.offset + offset;
    }
    return {source, how};
}

} // namespace dynascope
