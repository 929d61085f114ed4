// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/commission/commissionsetup.h"

#include "core/session/commissioning/fromprofile.h"
#include "core/session/linesession.h"
#include "ui/common/filedialogs.h"
#include "ui/common/icons.h"
#include "ui/common/texts.h"
#include "ui/connection/baudcombo.h"

#include <QCheckBox>
#include <QComboBox>
#include <QCompleter>
#include <QEvent>
#include <QFileInfo>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>
#include <QVBoxLayout>

#include <algorithm>

namespace dynascope {

namespace {

constexpr int FromProfile = 1; ///< index among the sources

QSpinBox *spin(QWidget *parent, const QString &name, const QString &accessible, int least, int most, int value)
{
    auto *box = new QSpinBox(parent);
    box->setObjectName(name);
    box->setAccessibleName(accessible);
    box->setRange(least, most);
    box->setValue(value);
    return box;
}

/// The first of so many IDs in a row that nobody here has; 1 where there is no such row.
int firstFreeId(const LineSession &line, int count)
{
    const auto isTaken = [&line](int id) {
        return std::ranges::any_of(line.devices(), [id](const auto &device) { return device->id() == id; });
    };
    int first = 1;
    for (int id = 1; id < first + count; ++id) {
        if (isTaken(id))
            first = id + 1;
    }
    return first + count - 1 <= MaximumId ? first : 1;
}

} // namespace

CommissionSetup::CommissionSetup(const LineSession &line, QWidget *parent)
    : QWidget(parent)
    , m_catalog(line.catalog())
    , m_source(new QComboBox(this))
    , m_model(new QComboBox(this))
    , m_first(spin(this, QStringLiteral("commissionFirstId"), tr("First ID"), 0, MaximumId, 1))
    , m_count(spin(this, QStringLiteral("commissionCount"), tr("How many"), 1, MaximumId + 1, 6))
    , m_firmware(spin(this, QStringLiteral("commissionFirmware"), tr("Oldest firmware"), 0, 255, 0))
    , m_baud(new BaudCombo(this))
    , m_names(new QLineEdit(this))
    , m_file(new QPushButton(tr("Choose a &profile…"), this))
    , m_torqueOff(new QCheckBox(tr("Turn &torque off where it locks the EEPROM"), this))
    , m_noteIcon(new QLabel(this))
    , m_note(new QLabel(this))
    , m_form(new QFormLayout)
    , m_fromProfile(failure(ErrorKind::InvalidArgument, tr("Choose the profile of a robot")))
    , m_list(m_fromProfile)
{
    build(line);
    for (QSpinBox *box : {m_first, m_count, m_firmware})
        connect(box, &QSpinBox::valueChanged, this, &CommissionSetup::update);
    connect(m_source, &QComboBox::currentIndexChanged, this, &CommissionSetup::update);
    connect(m_model, &QComboBox::currentTextChanged, this, &CommissionSetup::update);
    connect(m_baud, &QComboBox::currentTextChanged, this, &CommissionSetup::update);
    connect(m_names, &QLineEdit::textChanged, this, &CommissionSetup::update);
    connect(m_file, &QPushButton::clicked, this, &CommissionSetup::choose);
    update();
}

void CommissionSetup::build(const LineSession &line)
{
    m_source->setObjectName(QStringLiteral("commissionSource"));
    m_source->setAccessibleName(tr("What the new servos are to be"));
    m_source->addItems({tr("servos of one model, IDs in a row"), tr("the joints of a profile")});
    m_model->setObjectName(QStringLiteral("commissionModel"));
    m_model->setAccessibleName(tr("Model"));
    m_model->setEditable(true);
    m_model->setInsertPolicy(QComboBox::NoInsert);
    QStringList models;
    for (const Catalog::ModelInfo &model : m_catalog.models())
        models << model.model;
    models.sort();
    m_model->addItems(models);
    m_model->completer()->setFilterMode(Qt::MatchContains);
    m_model->completer()->setCompletionMode(QCompleter::PopupCompletion);
    m_first->setValue(firstFreeId(line, m_count->value()));
    m_model->setCurrentText(line.devices().empty() ? QStringLiteral("XM430-W350") : line.devices().front()->model());
    m_firmware->setSpecialValueText(tr("any"));
    m_baud->setObjectName(QStringLiteral("commissionBaud"));
    m_baud->setBaudRate(line.baudRate());
    m_names->setObjectName(QStringLiteral("commissionNames"));
    m_names->setAccessibleName(tr("Names"));
    m_names->setPlaceholderText(tr("shoulder, elbow, … or nothing"));
    m_names->setMaxLength(8192);
    m_file->setObjectName(QStringLiteral("commissionProfile"));
    m_file->setIcon(icon(QStringLiteral("folder")));
    m_file->setAutoDefault(false);
    m_torqueOff->setObjectName(QStringLiteral("commissionTorqueOff"));
    m_torqueOff->setToolTip(tr("A new servo has it off; what another one carries may fall"));
    m_form->setHorizontalSpacing(16);
    m_form->setVerticalSpacing(8);
    m_form->addRow(tr("W&anted"), m_source);
    m_form->addRow(tr("M&odel"), m_model);
    m_form->addRow(tr("&First ID"), m_first);
    m_form->addRow(tr("&How many"), m_count);
    m_form->addRow(tr("&Baud rate"), m_baud);
    m_form->addRow(tr("Oldest firm&ware"), m_firmware);
    m_form->addRow(tr("&Names"), m_names);
    m_form->addRow(tr("Profile"), m_file);
    m_note->setObjectName(QStringLiteral("commissionSetupNote"));
    m_note->setWordWrap(true);
    m_note->setTextFormat(Qt::PlainText);
    m_note->setAlignment(Qt::AlignLeft | Qt::AlignTop);
    m_note->setMinimumHeight(3 * m_note->fontMetrics().lineSpacing());
    auto *note = new QHBoxLayout;
    note->setSpacing(8);
    note->addWidget(m_noteIcon, 0, Qt::AlignTop);
    note->addWidget(m_note, 1);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(16);
    layout->addLayout(m_form);
    layout->addWidget(m_torqueOff);
    layout->addLayout(note);
    layout->addStretch(1);
}

void CommissionSetup::choose()
{
    askWhatToOpen(this, tr("Profile of a robot"), {QStringLiteral("yaml"), QStringLiteral("yml")},
                  [this](const QString &path) { loadProfile(path); });
}

void CommissionSetup::loadProfile(const QString &path)
{
    m_path = path;
    const auto profile = dynascope::loadProfile(path, m_catalog);
    m_fromProfile = profile ? commissionList(*profile, m_catalog)
                            : Result<CommissionList>(tl::unexpected(profile.error()));
    m_source->setCurrentIndex(FromProfile);
    update();
}

CommissionOptions CommissionSetup::options() const
{
    CommissionOptions options;
    options.mayTurnTorqueOff = m_torqueOff->isChecked();
    return options;
}

void CommissionSetup::update()
{
    const bool isProfile = m_source->currentIndex() == FromProfile;
    for (QWidget *field : {static_cast<QWidget *>(m_model), static_cast<QWidget *>(m_first),
                           static_cast<QWidget *>(m_count), static_cast<QWidget *>(m_baud),
                           static_cast<QWidget *>(m_firmware), static_cast<QWidget *>(m_names)}) {
        field->setVisible(!isProfile);
        m_form->labelForField(field)->setVisible(!isProfile);
    }
    m_file->setVisible(isProfile);
    m_form->labelForField(m_file)->setVisible(isProfile);
    m_file->setText(m_path.isEmpty() ? tr("Choose a &profile…") : plainLabel(QFileInfo(m_path).fileName()));
    if (isProfile) {
        m_list = m_fromProfile;
    } else {
        std::vector<int> ids;
        for (int id = m_first->value(); id < m_first->value() + m_count->value(); ++id)
            ids.push_back(id);
        QStringList names;
        for (const QString &name : m_names->text().split(u',', Qt::SkipEmptyParts))
            names << name.trimmed();
        m_list = m_baud->baudRate() > 0
                     ? commissionList(m_catalog, m_model->currentText(), ids, m_baud->baudRate(), names,
                                      m_firmware->value())
                     : failure(ErrorKind::InvalidArgument, tr("The baud rate is a number, such as 57600 or 1M"));
    }
    showNote();
    emit changed();
}

void CommissionSetup::showNote()
{
    const QIcon picture = m_list ? icon(QStringLiteral("info"), IconTint::Accent)
                                 : icon(QStringLiteral("error"), IconTint::Bad);
    m_noteIcon->setPixmap(picture.pixmap(QSize(20, 20), devicePixelRatioF()));
    if (!m_list) {
        m_note->setText(asSentence(m_list.error().text));
        return;
    }
    const std::size_t last = m_list->size() - 1;
    m_note->setText(tr("%1 servos, from %2 to %3. Leave them unplugged: it looks who is there already, then says which "
                       "one to plug in. The chain may grow, or each be unplugged before the next.")
                        .arg(m_list->size())
                        .arg(jointText(m_list->joint(0)), jointText(m_list->joint(last))));
}

void CommissionSetup::changeEvent(QEvent *event)
{
    if (event->type() == QEvent::PaletteChange)
        showNote();
    QWidget::changeEvent(event);
}

} // namespace dynascope
