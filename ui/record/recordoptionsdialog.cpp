// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/record/recordoptionsdialog.h"

#include "ui/common/filedialogs.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QDir>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QPointer>
#include <QPushButton>
#include <QSpinBox>

namespace dynascope {
namespace {

constexpr int MostMinutes = 24 * 60;
constexpr int MostMegabytes = 100'000;
constexpr int NoteLines = 4;

QSpinBox *limitSpin(const QString &name, const QString &suffix, int most, int step, QWidget *parent)
{
    auto *spin = new QSpinBox(parent);
    spin->setObjectName(name);
    spin->setRange(0, most);
    spin->setSingleStep(step);
    spin->setSuffix(suffix);
    spin->setSpecialValueText(RecordOptionsDialog::tr("never"));
    return spin;
}

} // namespace

RecordOptionsDialog::RecordOptionsDialog(QWidget *parent)
    : QDialog(parent)
    , m_format(new QComboBox(this))
    , m_folder(new QLineEdit(this))
    , m_minutes(limitSpin(QStringLiteral("splitMinutes"), tr(" min"), MostMinutes, 10, this))
    , m_megabytes(limitSpin(QStringLiteral("splitMegabytes"), tr(" MB"), MostMegabytes, 100, this))
    , m_note(new QPlainTextEdit(this))
{
    setObjectName(QStringLiteral("recordOptionsDialog"));
    setWindowTitle(tr("Recording options"));
    m_format->setObjectName(QStringLiteral("recordFormat"));
    m_format->addItem(tr("MCAP: compact, with control tables (PlotJuggler, Foxglove)"), QStringLiteral("mcap"));
    m_format->addItem(tr("CSV: text (PlotJuggler, pandas, spreadsheets)"), QStringLiteral("csv"));
    m_folder->setObjectName(QStringLiteral("recordFolder"));
    m_folder->setMinimumWidth(fontMetrics().averageCharWidth() * 44);
    m_note->setObjectName(QStringLiteral("recordNote"));
    m_note->setPlaceholderText(tr("Stands in each recording (not in CSV)"));
    m_note->setTabChangesFocus(true);
    m_note->setFixedHeight(fontMetrics().lineSpacing() * NoteLines + 12);
    const RecordWishes wishes = RecordWishes::saved();
    m_format->setCurrentIndex(m_format->findData(wishes.format));
    m_folder->setText(QDir::toNativeSeparators(wishes.folder));
    m_minutes->setValue(wishes.splitMinutes);
    m_megabytes->setValue(wishes.splitMegabytes);
    m_note->setPlainText(wishes.note);
    build();
}

void RecordOptionsDialog::build()
{
    auto *browse = new QPushButton(tr("&Browse…"), this);
    browse->setObjectName(QStringLiteral("recordBrowse"));
    browse->setAutoDefault(false);
    connect(browse, &QPushButton::clicked, this, &RecordOptionsDialog::chooseFolder);
    auto *folder = new QHBoxLayout;
    folder->addWidget(m_folder, 1);
    folder->addWidget(browse);
    auto *form = new QFormLayout(this);
    form->addRow(tr("&Format"), m_format);
    form->addRow(tr("F&older"), folder);
    static_cast<QLabel *>(form->labelForField(folder))->setBuddy(m_folder);
    form->addRow(tr("New file after each"), m_minutes);
    form->addRow(tr("or each"), m_megabytes);
    m_minutes->setAccessibleName(tr("New file after that many minutes"));
    m_megabytes->setAccessibleName(tr("New file after that many megabytes"));
    form->addRow(tr("&Note"), m_note);
    auto *hint = new QLabel(tr("Names are made of port, date and time. What is set here is for the next recording."), this);
    hint->setForegroundRole(QPalette::PlaceholderText);
    hint->setWordWrap(true);
    form->addRow(hint);
    auto *buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
    connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    form->addRow(buttons);
}

void RecordOptionsDialog::chooseFolder()
{
    askForFolder(this, tr("Folder for recordings"),
                 [this](const QString &path) { m_folder->setText(QDir::toNativeSeparators(path)); });
}

void RecordOptionsDialog::accept()
{
    RecordWishes wishes;
    wishes.format = m_format->currentData().toString();
    wishes.folder = QDir::fromNativeSeparators(m_folder->text().trimmed());
    wishes.splitMinutes = m_minutes->value();
    wishes.splitMegabytes = m_megabytes->value();
    wishes.note = m_note->toPlainText();
    wishes.save();
    QDialog::accept();
}

} // namespace dynascope
