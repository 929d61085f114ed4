// SPDX-License-Identifier: GPL-3.0-or-later
// Which groups of the grid are open, and what is said above them of the whole table.
#include "ui/common/elidedlabel.h"
#include "ui/common/icons.h"
#include "ui/table/fieldfiltermodel.h"
#include "ui/table/fieldtablemodel.h"
#include "ui/table/fieldwordsmodel.h"
#include "ui/table/helppanel.h"
#include "ui/table/tablenote.h"
#include "ui/table/tablepanel.h"
#include "ui/table/tableview.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QStackedLayout>

#include <algorithm>

namespace dynascope {

void TablePanel::buildNote(QWidget *parent)
{
    m_note = new QWidget(parent);
    m_note->setObjectName(QStringLiteral("tableNote"));
    auto *sign = new QLabel(m_note);
    sign->setPixmap(icon(QStringLiteral("help"), IconTint::Warning).pixmap(16, 16));
    m_noteText = new ElidedLabel(m_note);
    m_noteText->setObjectName(QStringLiteral("tableNoteText"));
    auto *layout = new QHBoxLayout(m_note);
    layout->setContentsMargins(12, 0, 12, 6);
    layout->setSpacing(6);
    layout->addWidget(sign);
    layout->addWidget(m_noteText, 1);
    m_note->hide();
    connect(m_noteText, &ElidedLabel::elidedChanged, this, &TablePanel::spellOutNote);
}

/// Below only what the strip above has no room for: nobody reads the same twice.
void TablePanel::spellOutNote()
{
    m_help->setNotes(m_noteText->isElided() ? tableNotes(m_model->devices()) : QStringList());
    m_help->showCell(valueCell());
}

void TablePanel::showNote()
{
    const QStringList notes = tableNotes(m_model->devices());
    m_noteText->setText(notes.join(u' '));
    m_note->setVisible(!notes.isEmpty());
    spellOutNote();
    m_pages->setCurrentIndex(m_model->devices().empty() ? 0 : 1);
}

/// Long runs are polled only as far as somebody sees them.
void TablePanel::tellUnfolded()
{
    if (m_arranging || !m_actions.setUnfolded)
        return;
    QModelIndexList shown;
    for (int row = 0; row < m_filter->rowCount(); ++row) {
        const QModelIndex group = m_filter->index(row, 0);
        if (group.data(GroupHintRole).toString().isEmpty() || !m_view->isExpanded(group))
            continue;
        for (int child = 0; child < m_filter->rowCount(group); ++child)
            shown << m_words->mapToSource(m_filter->mapToSource(m_filter->index(child, 0, group)));
    }
    const std::vector<Watch> fields = m_model->watches(shown);
    m_actions.setUnfolded({fields.begin(), fields.end()});
}

void TablePanel::updateGroups()
{
    m_arranging = true;
    for (int row = 0; row < m_filter->rowCount(); ++row) {
        const QModelIndex group = m_filter->index(row, 0);
        const QString title = group.data(GroupRole).toString();
        const auto known = std::ranges::find(m_model->groups(), title, &FieldGroup::title);
        const auto kept = m_folded.find(title);
        const bool folded = kept != m_folded.end() ? kept->second : known != m_model->groups().end() && known->folded;
        m_view->setFirstColumnSpanned(row, {}, true);
        m_view->setExpanded(group, m_filter->isFiltering() || !folded);
    }
    m_arranging = false;
    tellUnfolded();
}

} // namespace dynascope
