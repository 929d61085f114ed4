// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/journal/journaldialog.h"

#include "core/session/journal/journaltexts.h"
#include "ui/common/filedialogs.h"
#include "ui/journal/journalmodel.h"

#include <QDialogButtonBox>
#include <QDir>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QSaveFile>
#include <QTreeView>
#include <QVBoxLayout>

#include <algorithm>

namespace dynascope {

JournalDialog::JournalDialog(const Workbench &workbench, QWidget *window)
    : QDialog(window)
    , m_workbench(workbench)
    , m_model(new JournalModel(*workbench.journal, workbench.session.catalog(), this))
    , m_view(new QTreeView(this))
    , m_undo(new QPushButton(tr("&Undo"), this))
    , m_redo(new QPushButton(tr("&Redo"), this))
    , m_script(new QPushButton(tr("Save as &script…"), this))
    , m_empty(new QLabel(tr("Nothing has been written yet"), m_view->viewport()))
    , m_said(new QLabel(this))
{
    setObjectName(QStringLiteral("journalDialog"));
    setWindowTitle(tr("Journal"));
    makeView();
    m_undo->setObjectName(QStringLiteral("journalUndoButton"));
    m_redo->setObjectName(QStringLiteral("journalRedoButton"));
    m_script->setObjectName(QStringLiteral("journalScriptButton"));
    m_said->setObjectName(QStringLiteral("journalSaid"));
    m_said->setTextFormat(Qt::PlainText);
    m_said->setWordWrap(true);
    m_said->hide();
    for (QPushButton *button : {m_undo, m_redo, m_script})
        button->setAutoDefault(false);
    auto *buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
    buttons->addButton(m_undo, QDialogButtonBox::ActionRole);
    buttons->addButton(m_redo, QDialogButtonBox::ActionRole);
    buttons->addButton(m_script, QDialogButtonBox::ResetRole);
    connect(m_script, &QPushButton::clicked, this, &JournalDialog::saveScript);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    connect(m_undo, &QPushButton::clicked, this, [this] { emit requested(selected(), Direction::Undo); });
    connect(m_redo, &QPushButton::clicked, this, [this] { emit requested(selected(), Direction::Redo); });
    m_empty->setObjectName(QStringLiteral("journalEmpty"));
    m_empty->setEnabled(false); // as quiet as that
    auto *middle = new QVBoxLayout(m_view->viewport());
    middle->addWidget(m_empty, 0, Qt::AlignCenter);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(24, 24, 24, 16);
    layout->setSpacing(12);
    layout->addWidget(m_view, 1);
    layout->addWidget(m_said);
    layout->addWidget(buttons);
    connect(m_workbench.undo, &Undo::busyChanged, this, &JournalDialog::update);
    resize(1080, 560);
    update();
}

void JournalDialog::makeView()
{
    m_view->setObjectName(QStringLiteral("journalView"));
    m_view->setAccessibleName(tr("Journal"));
    m_view->setRootIsDecorated(false);
    m_view->setUniformRowHeights(true);
    m_view->setSelectionMode(QAbstractItemView::ExtendedSelection);
    m_view->setModel(m_model);
    m_view->header()->setSectionResizeMode(static_cast<int>(JournalColumn::Change), QHeaderView::Stretch);
    m_view->header()->setStretchLastSection(false);
    for (const auto &[column, widest] :
         {std::pair{JournalColumn::Number, "00000"}, std::pair{JournalColumn::Time, "0000-00-00 00:00:00"},
          std::pair{JournalColumn::By, "windoww"}, std::pair{JournalColumn::Device, "XM430-W350-T #252"},
          std::pair{JournalColumn::Register, "Operating Mode and 10 more"},
          std::pair{JournalColumn::State, "undo of 0000"}}) {
        m_view->setColumnWidth(static_cast<int>(column), fontMetrics().horizontalAdvance(QLatin1String(widest)) + 16);
    }
    connect(m_view->selectionModel(), &QItemSelectionModel::selectionChanged, this, &JournalDialog::update);
    connect(m_model, &QAbstractItemModel::modelAboutToBeReset, this, [this] {
        m_selected = selected();
        const QModelIndex at = m_view->currentIndex();
        m_current = at.isValid() ? m_model->numberAt(at.row()) : 0;
    });
    connect(m_model, &QAbstractItemModel::dataChanged, this, &JournalDialog::update);
    connect(m_model, &QAbstractItemModel::modelReset, this, &JournalDialog::restoreSelection);
}

std::vector<qint64> JournalDialog::selected() const
{
    std::vector<qint64> numbers;
    for (const QModelIndex &index : m_view->selectionModel()->selectedRows())
        numbers.push_back(m_model->numberAt(index.row()));
    return numbers;
}

void JournalDialog::restoreSelection()
{
    QItemSelection selection;
    for (const qint64 number : m_selected) {
        if (const int row = m_model->rowOf(number); row >= 0)
            selection.select(m_model->index(row, 0), m_model->index(row, JournalColumns - 1));
    }
    if (const int row = m_model->rowOf(m_current); row >= 0)
        m_view->selectionModel()->setCurrentIndex(m_model->index(row, 0), QItemSelectionModel::NoUpdate);
    m_view->selectionModel()->select(selection, QItemSelectionModel::ClearAndSelect);
    update();
}

/// In the order of the journal; of all where none is selected.
void JournalDialog::saveScript()
{
    const std::vector<qint64> numbers = selected();
    std::vector<JournalEntry> entries;
    for (const JournalEntry &entry : m_workbench.journal->entries()) {
        if (numbers.empty() || std::ranges::find(numbers, entry.number) != numbers.end())
            entries.push_back(entry);
    }
    askWhereToSave(this, tr("Save as a script of dxl"), QStringLiteral("sh"), QStringLiteral("journal.sh"),
                   [this, script = scriptOf(entries)](const QString &path) {
                       QSaveFile file(path);
                       const bool isSaved = file.open(QIODevice::WriteOnly) && file.write(script.toUtf8()) >= 0
                                            && file.commit();
                       m_said->setText(isSaved ? tr("The script is in %1").arg(QDir::toNativeSeparators(path))
                                               : tr("%1: %2").arg(QDir::toNativeSeparators(path), file.errorString()));
                       m_said->show();
                   });
}

/// A button says why it can't be pressed.
void JournalDialog::update()
{
    const std::vector<qint64> numbers = selected();
    const JournalEntries &entries = m_workbench.journal->entries();
    const std::set<qint64> undone = undoneEntries(entries);
    const auto offer = [&](QPushButton &button, Direction direction) {
        QString why = numbers.empty() ? tr("Select entries first") : QString();
        for (const qint64 number : numbers) {
            if (why.isEmpty())
                why = whyNot(entries, undone, number, direction);
        }
        button.setEnabled(why.isEmpty() && !m_workbench.undo->isBusy());
        button.setToolTip(why);
    };
    m_empty->setVisible(entries.empty());
    offer(*m_undo, Direction::Undo);
    offer(*m_redo, Direction::Redo);
    m_script->setEnabled(!entries.empty());
    m_script->setToolTip(numbers.empty() ? tr("All entries, as a shell script that writes the same with dxl")
                                         : tr("The selected entries, as a shell script that writes the same with dxl"));
}

} // namespace dynascope
