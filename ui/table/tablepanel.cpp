// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/table/tablepanel.h"

#include "ui/common/elidedlabel.h"
#include "ui/common/loweredge.h"
#include "ui/table/consequencesdialog.h"
#include "ui/table/editflow.h"
#include "ui/table/fielddelegate.h"
#include "ui/table/fieldfiltermodel.h"
#include "ui/table/fieldtablemodel.h"
#include "ui/table/fieldwordsmodel.h"
#include "ui/table/goalbar.h"
#include "ui/table/helppanel.h"
#include "ui/table/lockbar.h"
#include "ui/table/tableempty.h"
#include "ui/table/tablemenu.h"
#include "ui/table/tabletools.h"
#include "ui/table/tableview.h"
#include "ui/table/unknownwrite.h"

#include <QClipboard>
#include <QGuiApplication>
#include <QLineEdit>
#include <QPointer>
#include <QScrollBar>
#include <QShortcut>
#include <QStackedLayout>
#include <QToolButton>

#include <algorithm>

namespace dynascope {
namespace {

constexpr std::size_t MostDevices = 32; ///< columns beyond that nobody compares by eye
constexpr int LittleHeight = 460; ///< below this the rows need the room more than the help

/// A line between parts, in place of frames.
QFrame *makeRule(QWidget *parent)
{
    auto *rule = new QFrame(parent);
    rule->setFrameShape(QFrame::NoFrame);
    rule->setFixedHeight(1);
    rule->setAutoFillBackground(true);
    rule->setBackgroundRole(QPalette::Midlight);
    return rule;
}

} // namespace

TablePanel::TablePanel(TableActions actions, std::function<qint64()> clock, QWidget *parent)
    : QWidget(parent)
    , m_actions(std::move(actions))
    , m_model(new FieldTableModel(m_actions, std::move(clock), this))
    , m_words(new FieldWordsModel(this))
    , m_filter(new FieldFilterModel(this))
    , m_delegate(new FieldDelegate(this))
{
    m_words->setSourceModel(m_model);
    m_filter->setSourceModel(m_words);
    build();
    m_flow = new EditFlow(*m_model, *m_view, *m_lockBar, m_actions, this);
    connectParts();
    addShortcuts();
    setDevices({});
}

TablePanel::~TablePanel()
{
    // The view asks the flow while it is taken apart; both are children, in no order to rely on.
    m_view->setEditGate({});
}

void TablePanel::build()
{
    auto *grid = new QWidget(this);
    m_tools = new TableTools(*m_filter, grid);
    m_view = new TableView(grid);
    m_view->setModel(m_filter);
    m_view->setItemDelegate(m_delegate);
    m_others = new ElidedLabel(grid);
    m_others->setObjectName(QStringLiteral("othersLabel"));
    m_others->setContentsMargins(12, 0, 12, 6);
    m_others->hide();
    buildNote(grid);
    m_lockBar = new LockBar(grid);
    (new LowerEdge(*m_lockBar, *m_view->viewport()))->spare([view = m_view] {
        return view->visualRect(view->currentIndex());
    });
    m_goals = new GoalBar(m_actions.write, grid);
    m_help = new HelpPanel(grid);
    auto *layout = new QVBoxLayout(grid);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(m_tools);
    layout->addWidget(m_others);
    layout->addWidget(m_note);
    layout->addWidget(m_view, 1);
    layout->addWidget(makeRule(grid));
    m_goals->hide(); // until there is a goal that may be set
    layout->addWidget(m_goals);
    if (m_actions.write)
        layout->addWidget(makeRule(grid));
    layout->addWidget(m_help);
    m_empty = new TableEmpty(this);
    m_empty->setTexts(tr("No device selected"),
                      tr("Select a servo on the left to see its control table here: every register with its value, "
                         "what it means, and an editor where it can be changed."));
    m_pages = new QStackedLayout(this);
    m_pages->addWidget(m_empty);
    m_pages->addWidget(grid);
}

void TablePanel::connectParts()
{
    m_view->setEditGate([this](const QModelIndex &cell) { return m_flow->gate(cell); });
    connect(m_flow, &EditFlow::changeIdRequested, this, &TablePanel::changeIdRequested);
    connect(m_flow, &EditFlow::changeBaudRequested, this, &TablePanel::changeBaudRequested);
    connect(m_model, &FieldTableModel::plotRequested, this, &TablePanel::plotRequested);
    connect(m_model, &FieldTableModel::unplotRequested, this, &TablePanel::unplotRequested);
    connect(m_model, &FieldTableModel::updated, this, [this] { m_help->showCell(valueCell()); });
    connect(m_model, &QAbstractItemModel::modelReset, this, &TablePanel::showNote);
    connect(m_model, &FieldTableModel::confirmationWanted, this,
            [this](const std::vector<Device *> &devices, int field, qint64 raw) {
                askToWriteUnknown(devices, field, raw, m_actions.writeUnknown, this);
            });
    connect(m_model, &FieldTableModel::consequencesWanted, this, &TablePanel::tellConsequences);
    connect(m_model, &FieldTableModel::refused, this, &TablePanel::notWritten);
    connect(m_delegate, &FieldDelegate::notWritten, this, &TablePanel::notWritten);
    connect(m_view, &TableView::plotToggled, this, &TablePanel::togglePlot);
    connect(m_view, &QWidget::customContextMenuRequested, this, &TablePanel::showMenu);
    connect(m_view->selectionModel(), &QItemSelectionModel::currentChanged, this, &TablePanel::currentChanged);
    const auto keepFold = [this](const QModelIndex &group, bool folded) {
        if (!m_arranging && !m_filter->isFiltering())
            m_folded[group.data(GroupRole).toString()] = folded;
    };
    connect(m_view, &QTreeView::expanded, this, [keepFold](const QModelIndex &group) { keepFold(group, false); });
    connect(m_view, &QTreeView::collapsed, this, [keepFold](const QModelIndex &group) { keepFold(group, true); });
    for (const auto signal : {&QTreeView::expanded, &QTreeView::collapsed})
        connect(m_view, signal, this, &TablePanel::tellUnfolded);
    connect(m_filter, &QAbstractItemModel::rowsInserted, this, [this](const QModelIndex &parent) {
        if (!parent.isValid())
            updateGroups();
    });
    connect(m_tools, &TableTools::filterChanged, this, [this] {
        updateGroups();
        if (m_filter->isFiltering())
            m_view->scrollToTop(); // the first hit, not where one was before
        else if (m_view->currentIndex().isValid())
            m_view->scrollTo(m_view->currentIndex());
    });
    connect(m_tools, &TableTools::leaveSearch, this, [this] {
        m_view->setFocus();
        // What was current may have been filtered away: its successor is current, but not selected.
        const bool isField = valueCell().isValid();
        if (isField || m_filter->rowCount() > 0)
            m_view->setCurrentIndex(isField ? m_view->currentIndex() : m_filter->index(0, 0, m_filter->index(0, 0)));
    });
}

void TablePanel::addShortcuts()
{
    auto *find = new QShortcut(QKeySequence::Find, this, nullptr, nullptr, Qt::WindowShortcut);
    connect(find, &QShortcut::activated, this, [this] {
        m_tools->search()->setFocus(Qt::ShortcutFocusReason);
        m_tools->search()->selectAll();
    });
    auto *copy = new QShortcut(QKeySequence::Copy, m_view, nullptr, nullptr, Qt::WidgetShortcut);
    connect(copy, &QShortcut::activated, this, &TablePanel::copyValue);
}

void TablePanel::setDevices(const std::vector<Device *> &devices)
{
    std::vector<Device *> shown = devices;
    shown.resize(std::min(devices.size(), MostDevices));
    if (shown == m_model->devices() && !shown.empty())
        return;
    const Field *current = valueCell().data(FieldDataRole).value<const Field *>();
    const QString name = current ? current->name : QString();
    const int scrolled = m_view->verticalScrollBar()->value();
    m_model->setDevices(shown);
    m_tools->setDeviceCount(static_cast<int>(shown.size()));
    refreshMarks();
    std::vector<const ControlTable *> tables;
    for (const Device *device : shown)
        tables.push_back(&device->table());
    m_view->makeRoomFor(tables);
    m_view->applyColumnWidths();
    updateGroups();
    selectField(name);
    m_view->verticalScrollBar()->setValue(scrolled);
    currentChanged();
}

void TablePanel::setSelected(std::size_t count)
{
    const std::size_t shown = m_model->devices().size();
    m_others->setText(
        tr("%1 of %2 selected devices are shown").arg(shown).arg(std::max(shown, count)));
    m_others->setToolTip(tr("What is edited here is written to those whose columns are shown. Torque, LED, reboot and "
                            "Read all act on every selected device."));
    m_others->setVisible(shown > 0 && count > shown);
}

void TablePanel::selectField(const QString &name)
{
    if (name.isEmpty() || m_model->devices().empty())
        return;
    const QModelIndex known = m_model->indexOf(m_model->rowOf(name), m_model->mainValueColumn());
    const QModelIndex cell = m_filter->mapFromSource(m_words->mapFromSource(known));
    if (cell.isValid())
        m_view->selectionModel()->setCurrentIndex(
            cell, QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Rows);
}

void TablePanel::refreshWatches()
{
    m_model->refreshWatches();
}

void TablePanel::refreshMarks()
{
    m_model->refreshMarks();
    const std::vector<Device *> &devices = m_model->devices();
    m_tools->setAnySetHere(std::ranges::any_of(devices, [this](const Device *device) {
        const auto fields = static_cast<int>(device->table().fields().size());
        for (int field = 0; m_actions.ramState && field < fields; ++field) {
            if (m_actions.ramState({device->key(), field}) != RamState::NotSet)
                return true;
        }
        return false;
    }));
}

void TablePanel::showSetHere()
{
    m_tools->showSetHere();
}

void TablePanel::setLostAgain()
{
    m_actions.setAgain(m_model->devices(), [here = QPointer<TablePanel>(this)](const Result<void> &result) {
        if (here && !result && result.error().kind == ErrorKind::NotConfirmed) // of a failed write the cell says it
            emit here->notWritten(result.error().text);
    });
}

void TablePanel::setUnits(const UnitPreferences &units)
{
    m_units = units;
    m_delegate->setUnits(units);
    m_words->setUnits(units);
    m_goals->setUnits(units);
    m_help->setUnits(units);
    m_help->showCell(valueCell());
}

void TablePanel::tellConsequences(const std::vector<Device *> &devices, int field, qint64 raw)
{
    AskedWrite write{devices, field, raw, m_units, {}, {}};
    write.writeOnly = [this, field, raw](Device &device) { m_actions.write(device, field, raw); };
    write.writeSafely = [this, field, raw](Device &device, bool torqueBack) {
        m_actions.writeSafely(device, field, raw, torqueBack);
    };
    askAboutConsequences(std::move(write), this);
}

QModelIndex TablePanel::valueCell() const
{
    const QModelIndex current = m_view->currentIndex();
    if (!fieldAt(current))
        return {};
    if (isValueKind(kindAt(current)))
        return current;
    return current.siblingAtColumn(m_model->mainValueColumn());
}

void TablePanel::currentChanged()
{
    const QModelIndex cell = valueCell();
    m_help->showCell(cell);
    if (m_model->devices().empty() || !m_actions.write) {
        m_goals->setDevices({});
        return;
    }
    std::vector<Device *> targets = m_model->targets(cell.isValid() ? cell.column() : 0);
    // One slider stands at raw values, which mean the same only in one table.
    const auto isOther = [&](const Device *device) { return &device->table() != &targets.front()->table(); };
    if (std::ranges::any_of(targets, isOther))
        targets.clear();
    const bool several = m_model->devices().size() > 1;
    m_goals->setDevices(targets, !several ? QString()
                            : targets.size() != 1 ? tr("all %1").arg(targets.size()) : targets.front()->displayName());
}

void TablePanel::togglePlot(const QModelIndex &cell)
{
    const QModelIndex tick = cell.siblingAtColumn(m_model->columnOf(ColumnKind::Plot));
    const bool on = tick.data(WatchedRole).toInt() == Qt::Checked;
    for (const QModelIndex &row : m_view->selectionModel()->selectedRows(tick.column())) {
        if (fieldAt(row) && row != tick)
            m_filter->setData(row, static_cast<int>(on ? Qt::Unchecked : Qt::Checked), Qt::CheckStateRole);
    }
    m_filter->setData(tick, static_cast<int>(on ? Qt::Unchecked : Qt::Checked), Qt::CheckStateRole);
}

void TablePanel::copyValue()
{
    const QString text = valueCell().data().toString();
    if (!text.isEmpty())
        QGuiApplication::clipboard()->setText(text);
    else if (const QVariant raw = valueCell().data(RawRole); raw.isValid())
        QGuiApplication::clipboard()->setText(raw.toString());
}

void TablePanel::showMenu(const QPoint &at)
{
    const QModelIndex under = m_view->indexAt(at);
    if (under.isValid() && !m_view->selectionModel()->isRowSelected(under.row(), under.parent()))
        m_view->setCurrentIndex(under);
    const QPersistentModelIndex cell = valueCell();
    TableMenuActions actions;
    if (const Field *field = fieldAt(cell)) {
        actions.togglePlot = [this, cell] { togglePlot(cell); };
        if (isEditable(*field))
            actions.edit = [this, cell] { m_view->startEdit(cell); };
        if (cell.data(RawRole).isValid())
            actions.copyValue = [this] { copyValue(); };
        if (field->isWritable() && field->initial && !isProcedureField(*field)
            && cell.data(ChangedFromDefaultRole).toBool())
            actions.resetToDefault = [this, cell, initial = *field->initial] { m_flow->write(cell, initial); };
        addSettingAll(actions, cell);
    }
    if (m_actions.setAgain && cell.data(RamStateRole).toInt() == static_cast<int>(RamState::Lost))
        actions.setAgain = [this] { setLostAgain(); };
    const auto readAgain = [this] {
        for (Device *device : std::vector<Device *>(m_model->devices()))
            m_actions.readAll(*device);
    };
    if (m_actions.readAll)
        actions.readAgain = readAgain;
    actions.deviceCount = static_cast<int>(m_model->devices().size());
    popupTableMenu(cell, actions, m_view->viewport()->mapToGlobal(at), this);
}

void TablePanel::addSettingAll(TableMenuActions &actions, const QPersistentModelIndex &cell)
{
    const Field &field = *fieldAt(cell);
    const int column = m_model->columnOf(ColumnKind::All);
    if (column < 0 || !isEditable(field) || isProcedureField(field))
        return;
    const QPersistentModelIndex all = cell.sibling(cell.row(), column);
    actions.editAll = [this, all] { m_view->startEdit(all); };
    const std::optional<std::int64_t> meant = m_model->forAll(m_words->mapToSource(m_filter->mapToSource(cell)));
    if (!meant || kindAt(cell) == ColumnKind::All)
        return;
    actions.value = cell.data().toString();
    actions.copyToAll = [this, all, raw = *meant] { m_flow->write(all, raw); };
}

void TablePanel::showEvent(QShowEvent *event)
{
    QWidget::showEvent(event);
    m_model->setLive(true);
}

void TablePanel::resizeEvent(QResizeEvent *event)
{
    QWidget::resizeEvent(event);
    m_help->setTight(height() < LittleHeight);
}

void TablePanel::hideEvent(QHideEvent *event)
{
    QWidget::hideEvent(event);
    m_model->setLive(false);
}

} // namespace dynascope
