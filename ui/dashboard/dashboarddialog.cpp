// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/dashboard/dashboarddialog.h"

#include "core/session/alarmwatch.h"
#include "ui/common/elidedlabel.h"
#include "ui/common/filedialogs.h"
#include "ui/common/icons.h"
#include "ui/dashboard/alarmmodel.h"
#include "ui/dashboard/dashboarddelegate.h"
#include "ui/dashboard/dashboardmodel.h"
#include "ui/table/tableheader.h"

#include <QDir>
#include <QLabel>
#include <QSettings>
#include <QSplitter>
#include <QStackedWidget>
#include <QToolButton>
#include <QTreeView>
#include <QVBoxLayout>

#include <chrono>

namespace dynascope {
namespace {

constexpr QSize DefaultSize(1040, 680);
constexpr QSize LeastSize(880, 400);
constexpr int HeadHeight = 40;
constexpr qint64 FigureInterval = 190; ///< ms: about as often as they are polled, and figures can be read

const QString GeometryKey = QStringLiteral("dashboard/geometry");
const QString SplitterKey = QStringLiteral("dashboard/splitter");

QToolButton *makeButton(QWidget *parent, const char *name, const char *iconName, const QString &text,
                        const QString &tip)
{
    auto *button = new QToolButton(parent);
    button->setObjectName(QLatin1String(name));
    button->setIcon(icon(QLatin1String(iconName)));
    button->setIconSize(QSize(18, 18));
    button->setFixedHeight(28);
    button->setAutoRaise(true);
    button->setText(text);
    button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    button->setToolTip(tip);
    button->setFocusPolicy(Qt::TabFocus);
    return button;
}

QLabel *makeEmpty(QWidget *parent, const char *name, const QString &text)
{
    auto *label = new QLabel(text, parent);
    label->setObjectName(QLatin1String(name));
    label->setAlignment(Qt::AlignCenter);
    label->setWordWrap(true);
    label->setForegroundRole(QPalette::PlaceholderText);
    return label;
}

ElidedLabel *makeQuiet(QWidget *parent, const char *name)
{
    auto *label = new ElidedLabel(parent);
    label->setObjectName(QLatin1String(name));
    label->setForegroundRole(QPalette::PlaceholderText);
    return label;
}

void makeFlat(QTreeView &view, const char *name, const QString &accessible)
{
    view.setObjectName(QLatin1String(name));
    view.setAccessibleName(accessible);
    view.setFrameShape(QFrame::NoFrame);
    view.setRootIsDecorated(false);
    view.setItemsExpandable(false);
    view.setUniformRowHeights(true);
    view.setEditTriggers(QAbstractItemView::NoEditTriggers);
    view.setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
    view.setMouseTracking(true);
    auto *heading = new TableHeader(&view);
    view.setHeader(heading);
    heading->setStretchLastSection(false);
}

} // namespace

DashboardDialog::DashboardDialog(Session &session, Monitor &monitor, AlarmWatch &watch, QWidget *window)
    : QDialog(window)
    , m_session(session)
    , m_monitor(monitor)
    , m_watch(watch)
    , m_model(new DashboardModel(session, watch, this))
    , m_alarms(new AlarmModel(watch, this))
    , m_saver(new FaultSaver(this))
    , m_splitter(new QSplitter(Qt::Vertical, this))
    , m_stack(new QStackedWidget(this))
    , m_devices(new QTreeView(this))
{
    setObjectName(QStringLiteral("dashboardDialog"));
    setWindowTitle(tr("At a glance"));
    setMinimumSize(LeastSize);
    resize(DefaultSize);
    makeDevices();
    m_splitter->addWidget(m_stack);
    m_splitter->addWidget(makeAlarms());
    m_splitter->setChildrenCollapsible(false);
    m_splitter->setStretchFactor(0, 3);
    m_splitter->setStretchFactor(1, 1);
    m_splitter->setSizes({440, 200});
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(makeHead());
    layout->addWidget(m_splitter, 1);

    const QSettings settings;
    restoreGeometry(settings.value(GeometryKey).toByteArray());
    m_splitter->restoreState(settings.value(SplitterKey).toByteArray());
    m_splitter->setHandleWidth(1);
    m_splitter->setChildrenCollapsible(false);

    connect(&watch, &AlarmWatch::looked, this, [this] {
        if (isVisible() && (!m_shown.isValid() || m_shown.elapsed() >= FigureInterval))
            refresh();
    });
    connect(&watch, &AlarmWatch::alarmsChanged, this, &DashboardDialog::refreshAlarms);
    connect(m_saver, &FaultSaver::finished, this, [this](const QString &error, const QString &path) {
        refreshAlarms();
        m_said->setText(error.isEmpty() ? tr("Written to %1").arg(QDir::toNativeSeparators(path)) : error);
    });
    refresh();
    refreshAlarms();
}

DashboardDialog::~DashboardDialog()
{
    m_monitor.setGlancing(false);
    QSettings settings;
    settings.setValue(GeometryKey, saveGeometry());
    settings.setValue(SplitterKey, m_splitter->saveState());
}

QWidget *DashboardDialog::makeHead()
{
    auto *head = new QWidget(this);
    head->setFixedHeight(HeadHeight);
    auto *layout = new QHBoxLayout(head);
    layout->setContentsMargins(16, 0, 16, 0);
    layout->setSpacing(16);
    m_summary = new ElidedLabel(head);
    m_summary->setObjectName(QStringLiteral("dashboardSummary"));
    QFont bold = m_summary->font();
    bold.setWeight(QFont::DemiBold);
    m_summary->setFont(bold);
    m_limits = makeQuiet(head, "dashboardLimits");
    layout->addWidget(m_summary, 1);
    layout->addWidget(m_limits, 0);
    return head;
}

void DashboardDialog::makeDevices()
{
    makeFlat(*m_devices, "dashboardView", tr("All devices, the worst first"));
    m_devices->setItemDelegate(new DashboardDelegate(m_devices));
    m_devices->setModel(m_model);
    QHeaderView *heading = m_devices->header();
    heading->setSectionResizeMode(QHeaderView::Fixed);
    heading->setMinimumSectionSize(DashboardDelegate::widthOf(DashboardColumn::Id, font()));
    for (int column = 0; column < DashboardColumns; ++column)
        heading->resizeSection(column, DashboardDelegate::widthOf(static_cast<DashboardColumn>(column), font()));
    for (const DashboardColumn column : {DashboardColumn::Device, DashboardColumn::State})
        heading->setSectionResizeMode(static_cast<int>(column), QHeaderView::Stretch);
    connect(m_devices->selectionModel(), &QItemSelectionModel::currentRowChanged, this, [this](const QModelIndex &now) {
        const DashboardRow *row = m_model->row(now.row());
        if (row && !m_model->isChangingRows())
            choose(row->key);
    });
    m_empty =
        makeEmpty(m_stack, "dashboardEmpty",
                  tr("How all devices are appears here, the worst on top, once a line is open and devices are found."));
    m_stack->addWidget(m_empty);
    m_stack->addWidget(m_devices);
}

QWidget *DashboardDialog::makeAlarms()
{
    auto *part = new QWidget(this);
    auto *head = new QWidget(part);
    head->setFixedHeight(HeadHeight);
    auto *row = new QHBoxLayout(head);
    row->setContentsMargins(16, 0, 8, 0);
    row->setSpacing(8);
    auto *title = new QLabel(tr("Alarms"), head);
    QFont bold = title->font();
    bold.setWeight(QFont::DemiBold);
    title->setFont(bold);
    m_said = makeQuiet(head, "alarmSaid");
    m_save =
        makeButton(head, "alarmSaveButton", "csv", tr("&Save as CSV…"),
                   tr("What was known of the device from ten seconds before the alarm until five seconds after it"));
    m_forget = makeButton(head, "alarmForgetButton", "trash", tr("&Forget what is over"),
                          tr("Alarms that are over leave the list"));
    row->addWidget(title);
    row->addWidget(m_said, 1);
    row->addWidget(m_save);
    row->addWidget(m_forget);

    m_alarmStack = new QStackedWidget(part);
    m_alarmView = new QTreeView(m_alarmStack);
    makeFlat(*m_alarmView, "alarmView", tr("Alarms"));
    m_alarmView->setItemDelegate(new AlarmDelegate(m_alarmView));
    m_alarmView->setModel(m_alarms);
    m_alarmView->header()->setSectionResizeMode(static_cast<int>(AlarmColumn::Cause), QHeaderView::Stretch);
    for (const auto &[column, widest] :
         {std::pair{AlarmColumn::Time, "00:00:00"}, std::pair{AlarmColumn::Device, "XM430-W350-T #252"},
          std::pair{AlarmColumn::Kind, "Hardware error 00"}, std::pair{AlarmColumn::Cleared, "00:00:00, device went"}})
        m_alarmView->setColumnWidth(static_cast<int>(column),
                                    fontMetrics().horizontalAdvance(QLatin1String(widest)) + 24);
    m_alarmStack->addWidget(
        makeEmpty(m_alarmStack, "alarmEmpty",
                  tr("What gets near its limits or beyond, a hardware error and who falls silent are listed "
                     "here, with time and cause.")));
    m_alarmStack->addWidget(m_alarmView);
    auto *layout = new QVBoxLayout(part);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(head);
    layout->addWidget(m_alarmStack, 1);

    connect(m_save, &QToolButton::clicked, this, &DashboardDialog::save);
    connect(m_forget, &QToolButton::clicked, this, [this] { m_watch.clearEnded(); });
    connect(m_alarmView->selectionModel(), &QItemSelectionModel::selectionChanged, this,
            &DashboardDialog::refreshAlarms);
    connect(m_alarmView, &QTreeView::activated, this, [this](const QModelIndex &at) {
        if (const Alarm *alarm = m_alarms->alarm(at.row()))
            choose(alarm->device);
    });
    return part;
}

void DashboardDialog::setUnits(const UnitPreferences &units)
{
    m_model->setUnits(units);
    refresh();
}

void DashboardDialog::refresh()
{
    m_shown.restart();
    m_model->refresh(m_session.now());
    m_stack->setCurrentIndex(m_model->rowCount() > 0 ? 1 : 0);
    m_summary->setText(m_model->rowCount() > 0 ? m_model->summary() : tr("No devices"));
    m_limits->setText(m_model->limitsSummary());
}

void DashboardDialog::refreshAlarms()
{
    const bool any = m_alarms->rowCount() > 0;
    m_alarmStack->setCurrentIndex(any ? 1 : 0);
    m_forget->setEnabled(static_cast<std::size_t>(m_alarms->rowCount()) > m_alarms->active());
    const Alarm *alarm = selectedAlarm();
    const FaultRecord *record = alarm ? m_watch.records().find(alarm->number) : nullptr;
    m_save->setEnabled(record && !m_saver->isRunning());
    QString said = any ? tr("%1 last, %2 in the list").arg(m_alarms->active()).arg(m_alarms->rowCount()) : QString();
    if (alarm && !record)
        said = alarm->level == AlarmLevel::Over ? tr("The seconds around it are no longer kept")
                                                : tr("Of what was only near a limit nothing is kept");
    else if (record)
        said = tr("%1 readings kept around it").arg(record->samples());
    m_said->setText(said);
}

const Alarm *DashboardDialog::selectedAlarm() const
{
    const QModelIndexList rows = m_alarmView->selectionModel()->selectedRows();
    return rows.isEmpty() ? nullptr : m_alarms->alarm(rows.front().row());
}

void DashboardDialog::choose(DeviceKey key)
{
    if (Device *device = m_session.device(key))
        emit deviceChosen(device);
}

void DashboardDialog::save()
{
    const Alarm *alarm = selectedAlarm();
    if (!alarm)
        return;
    const QString name =
        QStringLiteral("alarm %1.csv").arg(alarm->raised.toString(QStringLiteral("yyyy-MM-dd HH.mm.ss")));
    askWhereToSave(this, tr("Save the seconds around the alarm"), QStringLiteral("csv"), name,
                   [this, number = alarm->number](const QString &path) {
                       const FaultRecord *record = m_watch.records().find(number);
                       if (!record || m_saver->isRunning()) {
                           m_said->setText(tr("The seconds around it are no longer kept"));
                           return;
                       }
                       m_save->setEnabled(false);
                       m_saver->save(path, *record);
                   });
}

void DashboardDialog::showEvent(QShowEvent *event)
{
    m_monitor.setGlancing(true);
    refresh();
    QDialog::showEvent(event);
}

void DashboardDialog::hideEvent(QHideEvent *event)
{
    m_monitor.setGlancing(false);
    QDialog::hideEvent(event);
}

} // namespace dynascope
