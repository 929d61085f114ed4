// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/backup/comparedialog.h"

#include "core/session/session.h"
#include "ui/backup/comparemodel.h"
#include "ui/common/filedialogs.h"
#include "ui/common/texts.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTreeView>
#include <QVBoxLayout>

#include <algorithm>

namespace dynascope {

CompareDialog::CompareDialog(Device &device, const Workbench &workbench, BackupCommands &commands, QWidget *window)
    : QDialog(window)
    , m_workbench(workbench)
    , m_commands(commands)
    , m_device(&device)
    , m_model(new CompareModel(this))
    , m_view(new QTreeView(this))
    , m_with(new QComboBox(this))
    , m_onlyDifferences(new QCheckBox(tr("&Only differences"), this))
    , m_summary(new QLabel(this))
    , m_restore(new QPushButton(tr("&Restore selected…"), this))
{
    setObjectName(QStringLiteral("compareDialog"));
    setWindowTitle(tr("Compare %1").arg(device.displayName()));
    m_with->setObjectName(QStringLiteral("compareWith"));
    m_onlyDifferences->setObjectName(QStringLiteral("onlyDifferences"));
    m_onlyDifferences->setChecked(true);
    m_summary->setObjectName(QStringLiteral("compareSummary"));
    m_summary->setTextFormat(Qt::PlainText);
    m_summary->setWordWrap(true);
    m_restore->setObjectName(QStringLiteral("restoreSelectedButton"));
    m_restore->setAutoDefault(false);
    makeView();
    auto *filter = new QLineEdit(this);
    filter->setObjectName(QStringLiteral("compareFilter"));
    filter->setPlaceholderText(tr("Filter registers"));
    filter->setAccessibleName(filter->placeholderText());
    filter->setClearButtonEnabled(true);
    auto *withLabel = new QLabel(tr("&With:"), this);
    withLabel->setBuddy(m_with);
    auto *top = new QHBoxLayout;
    top->addWidget(withLabel);
    top->addWidget(m_with, 1);
    top->addWidget(filter, 1);
    top->addWidget(m_onlyDifferences);
    auto *buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
    buttons->addButton(m_restore, QDialogButtonBox::ActionRole);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(24, 24, 24, 16);
    layout->setSpacing(12);
    top->setSpacing(8);
    layout->addLayout(top);
    layout->addWidget(m_view, 1);
    layout->addWidget(m_summary);
    layout->addWidget(buttons);
    resize(880, 560);

    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    connect(filter, &QLineEdit::textChanged, m_model, &CompareModel::setFilter);
    connect(m_onlyDifferences, &QCheckBox::toggled, m_model,
            [this](bool only) { m_model->setShow(only ? CompareModel::Show::Differences : CompareModel::Show::All); });
    connect(m_model, &QAbstractItemModel::modelReset, this, &CompareDialog::update);
    connect(m_restore, &QPushButton::clicked, this, &CompareDialog::restoreSelected);
    connect(&device, &QObject::destroyed, this, &QDialog::reject);
    connect(m_with, &QComboBox::activated, this, &CompareDialog::chosen);
    fillSources();
    update();
}

void CompareDialog::makeView()
{
    m_view->setObjectName(QStringLiteral("compareView"));
    m_view->setAccessibleName(tr("Registers compared"));
    m_view->setRootIsDecorated(false);
    m_view->setUniformRowHeights(true);
    m_view->setAlternatingRowColors(true);
    m_view->setSelectionMode(QAbstractItemView::ExtendedSelection);
    m_view->setModel(m_model);
    m_view->header()->setStretchLastSection(true);
    const auto width = [this](const char *widest) {
        return fontMetrics().horizontalAdvance(QLatin1String(widest)) + 16;
    };
    m_view->setColumnWidth(static_cast<int>(CompareColumn::Name), width("Position Trajectory Gain 10"));
    m_view->setColumnWidth(static_cast<int>(CompareColumn::Here), width("Extended position control"));
    m_view->setColumnWidth(static_cast<int>(CompareColumn::There), width("Extended position control"));
    connect(m_view->selectionModel(), &QItemSelectionModel::selectionChanged, this, &CompareDialog::update);
}

void CompareDialog::fillSources()
{
    m_with->addItem(tr("Choose…"));
    m_with->addItem(tr("A backup's file…"));
    for (const Device *other : m_workbench.session.devices()) {
        if (other != m_device)
            m_with->addItem(tr("%1, ID %2").arg(other->displayName()).arg(other->id()),
                            QVariant::fromValue(other->key()));
    }
}

void CompareDialog::chosen(int index)
{
    if (index == 1)
        askForFile();
    else if (index > 1)
        compareWithDevice(m_with->itemData(index).value<DeviceKey>());
}

void CompareDialog::askForFile()
{
    askWhatToOpen(this, tr("Compare with"), {QStringLiteral("yaml")},
                   [this](const QString &path) { compareWithFile(path); });
}

void CompareDialog::compareWithFile(const QString &path)
{
    ++m_reads;
    setThere(loadBackup(path, m_workbench.session.catalog()));
}

void CompareDialog::compareWithDevice(DeviceKey key)
{
    Device *other = m_workbench.session.device(key);
    if (!other)
        return say(tr("That device is gone."));
    const int number = ++m_reads;
    say(tr("%1 is being read…").arg(other->displayName()));
    m_commands.read(*other, [here = QPointer<CompareDialog>(this), number](const Result<Backup> &there) {
        if (here && number == here->m_reads)
            here->setThere(there);
    });
}

void CompareDialog::setThere(const Result<Backup> &there)
{
    if (!there) {
        m_there.reset();
        m_model->setRows({});
        return say(there.error().text);
    }
    m_there = *there;
    readHere();
}

void CompareDialog::readHere()
{
    if (!m_device)
        return;
    say(tr("%1 is being read…").arg(m_device->displayName()));
    m_commands.read(*m_device, [here = QPointer<CompareDialog>(this), number = m_reads](const Result<Backup> &now) {
        if (!here || number != here->m_reads)
            return;
        if (!now)
            return here->say(now.error().text);
        here->m_here = *now;
        const Backup &there = *here->m_there;
        here->m_model->setTitles(tr("Here: %1").arg(now->name()),
                                 there.file.isEmpty() ? tr("There: %1").arg(there.name())
                                                      : tr("There: %1").arg(QFileInfo(there.file).fileName()));
        here->m_model->setRows(compareBackups(*now, there));
    });
}

void CompareDialog::say(const QString &text)
{
    m_summary->setText(text);
    m_restore->setEnabled(false);
}

QStringList CompareDialog::selectedNames() const
{
    QStringList names;
    for (const QModelIndex &index : m_view->selectionModel()->selectedRows())
        names << m_model->at(index.row()).name;
    return names;
}

/// The button says why it can't be pressed.
void CompareDialog::update()
{
    if (!m_here || !m_there) {
        m_restore->setEnabled(false);
        m_restore->setToolTip(tr("Choose first what to compare with"));
        m_summary->setText(m_summary->text().isEmpty() ? tr("Choose what to compare it with: a backup's file, or another "
                                                            "device.")
                                                       : m_summary->text());
        return;
    }
    using State = ComparedRegister::State;
    const std::vector<ComparedRegister> &rows = m_model->rows();
    const auto say = [&rows](State state, const QString &text) {
        const auto count = countOf(rows, state);
        return count > 0 ? QStringList(text.arg(count)) : QStringList();
    };
    const QStringList parts = QStringList(tr("%1 registers are the same").arg(countOf(rows, State::Same)))
                              + say(State::Differs, tr("%1 differ")) + say(State::OnlyHere, tr("%1 are only here"))
                              + say(State::OnlyThere, tr("%1 are only there"))
                              + say(State::OtherMeaning, tr("%1 can't be compared"));
    m_summary->setText(asSentence(parts.join(tr(", "))));
    const bool isOther = m_here->modelNumber != m_there->modelNumber;
    const QString why = isOther                     ? tr("They are of different models")
                        : selectedNames().isEmpty() ? tr("Select registers first")
                                                    : QString();
    m_restore->setEnabled(why.isEmpty());
    m_restore->setToolTip(why);
}

void CompareDialog::restoreSelected()
{
    if (m_device && m_there)
        emit restoreRequested(m_device->key(), *m_there, selectedNames());
}

} // namespace dynascope
