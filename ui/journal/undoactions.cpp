// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/journal/undoactions.h"

#include "core/session/journal/journaltexts.h"
#include "ui/common/present.h"
#include "ui/common/texts.h"
#include "ui/journal/journaldialog.h"

#include <QMessageBox>
#include <QPushButton>

namespace dynascope {

UndoActions::UndoActions(const Workbench &workbench, QWidget *window)
    : QObject(window)
    , m_workbench(workbench)
    , m_window(window)
    , m_undo(add("undoAction", tr("&Undo"), "Ctrl+Z"))
    , m_redo(add("redoAction", tr("&Redo"), "Ctrl+Shift+Z"))
    , m_show(add("journalAction", tr("&Journal…"), "Ctrl+J"))
{
    m_show->setToolTip(tr("What was written, by whom, and what it replaced"));
    connect(m_undo, &QAction::triggered, this,
            [this] { start({m_workbench.undo->nextToUndo()}, Direction::Undo, {}); });
    connect(m_redo, &QAction::triggered, this,
            [this] { start({m_workbench.undo->nextToRedo()}, Direction::Redo, {}); });
    connect(m_show, &QAction::triggered, this, &UndoActions::showJournal);
    connect(m_workbench.journal, &Journal::entriesChanged, this, &UndoActions::update);
    connect(m_workbench.undo, &Undo::busyChanged, this, &UndoActions::update);
    connect(m_workbench.journal, &Journal::failed, this,
            [this](const QString &why) { emit failed(tr("%1. What is written meanwhile is noted once that is over.").arg(why)); });
    update();
}

QAction *UndoActions::add(const char *name, const QString &text, const char *shortcut)
{
    auto *action = new QAction(text, this);
    action->setObjectName(QLatin1String(name));
    action->setShortcut(QKeySequence(QLatin1String(shortcut)));
    action->setAutoRepeat(false); // a key held down is one order
    return action;
}

/// The menu says what would be taken back.
void UndoActions::update()
{
    const auto offer = [this](QAction &action, qint64 number, const QString &plain, const QString &named) {
        const JournalEntry *entry = number > 0 ? m_workbench.journal->entry(number) : nullptr;
        action.setEnabled(entry && !m_workbench.undo->isBusy());
        action.setText(entry ? named.arg(plainLabel(whatText(*entry)), plainLabel(deviceText(entry->device))) : plain);
    };
    offer(*m_undo, m_workbench.undo->nextToUndo(), tr("&Undo"), tr("&Undo %1 of %2"));
    offer(*m_redo, m_workbench.undo->nextToRedo(), tr("&Redo"), tr("&Redo %1 of %2"));
}

void UndoActions::start(const std::vector<qint64> &numbers, Direction direction, const UndoOptions &options)
{
    m_workbench.undo->run(numbers, direction, options, [this, numbers, direction, options](const Result<void> &result) {
        if (result)
            return;
        const Consent missing = m_workbench.undo->missing();
        if (missing == Consent::None)
            return emit failed(result.error().text);
        UndoOptions more = options;
        (missing == Consent::Motion ? more.mayMove : more.mayTurnTorqueOff) = true;
        ask(numbers, direction, more, result.error().text);
    });
}

/// Those that were done meanwhile are no longer asked for.
void UndoActions::ask(const std::vector<qint64> &numbers, Direction direction, const UndoOptions &options,
                      const QString &why)
{
    auto *box = new QMessageBox(QMessageBox::Warning, direction == Direction::Undo ? tr("Undo") : tr("Redo"),
                                tr("%1.").arg(why), QMessageBox::Cancel, m_window);
    box->setObjectName(QStringLiteral("undoBox"));
    box->setTextFormat(Qt::PlainText); // names from a file are in it
    const bool moves = m_workbench.undo->missing() == Consent::Motion;
    QPushButton *accept = box->addButton(moves ? tr("Let it move") : tr("Turn torque off"), QMessageBox::AcceptRole);
    accept->setObjectName(QStringLiteral("undoAnywayButton"));
    box->setDefaultButton(QMessageBox::Cancel);
    connect(accept, &QPushButton::clicked, this, [this, numbers, direction, options] {
        const JournalEntries &entries = m_workbench.journal->entries();
        const std::set<qint64> undone = undoneEntries(entries);
        std::vector<qint64> left;
        for (const qint64 number : numbers) {
            if (whyNot(entries, undone, number, direction).isEmpty())
                left.push_back(number);
        }
        start(left, direction, options);
    });
    present(*box);
}

void UndoActions::showJournal()
{
    m_workbench.journal->refresh();
    if (raiseOpen(*m_window, QStringLiteral("journalDialog")))
        return;
    auto *dialog = new JournalDialog(m_workbench, m_window);
    connect(dialog, &JournalDialog::requested, this,
            [this](const std::vector<qint64> &numbers, Direction direction) { start(numbers, direction, {}); });
    present(*dialog);
}

} // namespace dynascope
