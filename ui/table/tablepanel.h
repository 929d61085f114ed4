// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/session/monitor.h"
#include "core/table/units.h"
#include "ui/common/workbench.h"
#include "ui/table/tableactions.h"

#include <QWidget>

#include <functional>
#include <map>

class QStackedLayout;

namespace dynascope {

class EditFlow;
class ElidedLabel;
class FieldDelegate;
class FieldFilterModel;
class FieldTableModel;
class FieldWordsModel;
class GoalBar;
class HelpPanel;
class LockBar;
class TableEmpty;
class TableTools;
class TableView;
struct TableMenuActions;

/// The control table of the selected devices: search, filters, grid with editors, goal sliders, why a field is locked.
class TablePanel : public QWidget
{
    Q_OBJECT

public:
    explicit TablePanel(const Workbench &workbench, QWidget *parent = nullptr);
    /// For who has no session. `clock`: milliseconds, for what fades.
    explicit TablePanel(TableActions actions, std::function<qint64()> clock = {}, QWidget *parent = nullptr);
    ~TablePanel() override;

    void setDevices(const std::vector<Device *> &devices); ///< empty shows what belongs here
    void setSelected(std::size_t count); ///< where that is more than the table shows, it says so
    void refreshWatches();                                 ///< what is plotted has changed
    void refreshMarks(); ///< what was set in this session has
    void showSetHere();  ///< nothing but that
    void setUnits(const UnitPreferences &units);

    QByteArray saveState() const; ///< column widths, what is folded
    void restoreState(const QByteArray &state);

signals:
    void plotRequested(const dynascope::Watch &watch); ///< ticked, or from the menu
    void unplotRequested(const dynascope::Watch &watch);
    void changeIdRequested(dynascope::Device *device); ///< the register is changed by a procedure, not by a write
    void changeBaudRequested(dynascope::Device *device);
    void notWritten(const QString &text); ///< what was typed, and why; for the message bar

protected:
    void showEvent(QShowEvent *event) override;
    void resizeEvent(QResizeEvent *event) override;
    void hideEvent(QHideEvent *event) override;

private:
    void build();
    void buildNote(QWidget *parent);
    void connectParts();
    void addShortcuts();
    QModelIndex valueCell() const; ///< of the current row, in the view's model
    void updateGroups();
    void currentChanged();
    void togglePlot(const QModelIndex &cell);
    void showMenu(const QPoint &at);
    void addSettingAll(TableMenuActions &actions, const QPersistentModelIndex &cell);
    void copyValue();
    void setLostAgain();
    void showNote();
    void spellOutNote();
    void tellUnfolded();
    void tellConsequences(const std::vector<Device *> &devices, int field, qint64 raw);
    void selectField(const QString &name);

    TableActions m_actions;
    FieldTableModel *m_model;
    FieldWordsModel *m_words;
    FieldFilterModel *m_filter;
    TableTools *m_tools;
    ElidedLabel *m_others; ///< what is selected, but not shown
    QWidget *m_note;       ///< what is uncertain about the whole table
    ElidedLabel *m_noteText;
    TableView *m_view;
    FieldDelegate *m_delegate;
    LockBar *m_lockBar;
    GoalBar *m_goals;
    HelpPanel *m_help;
    TableEmpty *m_empty;
    QStackedLayout *m_pages;
    EditFlow *m_flow;
    std::map<QString, bool> m_folded; ///< groups that a person folded or opened, by title
    UnitPreferences m_units;
    bool m_arranging = false;
};

} // namespace dynascope
