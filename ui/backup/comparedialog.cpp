// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/backup/comparedialog.h"

#include "ui/backup/comparemodel.h"
#include "ui/common/texts.h"

#include <QCheckBox>
#include <QDialogButtonBox>
#include <QFileInfo>
#include <QGridLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTreeView>
#include <QVBoxLayout>

#include <algorithm>

namespace dynascope {

CompareDialog::CompareDialog(Device *device, const Workbench &workbench, BackupCommands &commands, QWidget *window)
    : QDialog(window)
    , m_model(new CompareModel(this))
    , m_view(new QTreeView(this))
    , m_of(new CompareSource(workbench, commands, this))
    , m_with(new CompareSource(workbench, commands, this))
    , m_onlyDifferences(new QCheckBox(tr("&Only differences"), this))
    , m_summary(new QLabel(this))
    , m_restore(new QPushButton(tr("&Restore selected…"), this))
{
    setObjectName(QStringLiteral("compareDialog"));
    setWindowTitle(device ? tr("Compare %1").arg(device->displayName()) : tr("Compare"));
    m_of->setObjectName(QStringLiteral("compareOf"));
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
    auto *ofLabel = new QLabel(tr("&Here:"), this);
    ofLabel->setBuddy(m_of);
    auto *withLabel = new QLabel(tr("&There:"), this);
    withLabel->setBuddy(m_with);
    auto *top = new QGridLayout;
    top->addWidget(ofLabel, 0, 0);
    top->addWidget(m_of, 0, 1);
    top->addWidget(withLabel, 0, 2);
    top->addWidget(m_with, 0, 3);
    top->addWidget(filter, 1, 0, 1, 3);
    top->addWidget(m_onlyDifferences, 1, 3);
    top->setColumnStretch(1, 1);
    top->setColumnStretch(3, 1);
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
    for (CompareSource *source : {m_of, m_with}) {
        connect(source, &CompareSource::chosen, this, &CompareDialog::onChosen);
        connect(source, &CompareSource::failed, this, &CompareDialog::onFailed);
    }
    if (device)
        m_of->setDevice(*device);
    (device ? m_with : m_of)->setFocus();
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

void CompareDialog::onFailed(const QString &why)
{
    ++m_reads;
    m_here.reset();
    m_there.reset();
    m_model->setRows({});
    say(why);
}

/// Both sides are read anew, so that what is shown was so at about one time.
void CompareDialog::onChosen()
{
    ++m_reads;
    m_here.reset();
    m_there.reset();
    if (!m_of->isChosen() || !m_with->isChosen())
        return m_model->setRows({});
    say(tr("Being read…"));
    readSide(*m_of, m_here);
}

/// `source` into `side`, one of this dialog's, then what is still to be read, then the rows.
void CompareDialog::readSide(CompareSource &source, std::optional<Backup> &side)
{
    if (!source.isChosen()) // it went meanwhile
        return onFailed(tr("That device is gone."));
    source.read([here = QPointer<CompareDialog>(this), &side, number = m_reads](const Result<Backup> &backup) {
        if (!here || number != here->m_reads)
            return;
        if (!backup)
            return here->onFailed(backup.error().text);
        side = *backup;
        if (here->m_there)
            here->showRows();
        else
            here->readSide(*here->m_with, here->m_there);
    });
}

void CompareDialog::showRows()
{
    const auto title = [](const Backup &side) {
        return side.file.isEmpty() ? side.name() : QFileInfo(side.file).fileName();
    };
    m_model->setTitles(tr("Here: %1").arg(title(*m_here)), tr("There: %1").arg(title(*m_there)));
    m_model->setRows(compareBackups(*m_here, *m_there));
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
        m_restore->setToolTip(tr("Choose first what to compare"));
        m_summary->setText(tr("Choose two: devices, or backups' files."));
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
    const QString why = !m_of->device()             ? tr("Only a device can be restored to; choose one under Here")
                        : isOther                   ? tr("They are of different models")
                        : selectedNames().isEmpty() ? tr("Select registers first")
                                                    : QString();
    m_restore->setEnabled(why.isEmpty());
    m_restore->setToolTip(why);
}

void CompareDialog::restoreSelected()
{
    if (m_of->device() && m_there)
        emit restoreRequested(m_of->device()->key(), *m_there, selectedNames());
}

} // namespace dynascope
