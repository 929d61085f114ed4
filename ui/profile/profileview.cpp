// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/profile/profileview.h"

#include "core/session/stopcontrol.h"
#include "ui/common/texts.h"
#include "ui/profile/profilefaults.h"
#include "ui/profile/profilefilebar.h"
#include "ui/profile/profilefilter.h"
#include "ui/profile/profilemodel.h"
#include "ui/profile/profilenote.h"
#include "ui/profile/profileplanpage.h"
#include "ui/profile/profiletexts.h"

#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSettings>
#include <QSignalBlocker>
#include <QStackedWidget>
#include <QTreeView>
#include <QVBoxLayout>

#include <algorithm>

namespace dynascope {
namespace {

const QString GeometryKey = QStringLiteral("profile/geometry");
constexpr int WidestColumn = 300;

} // namespace

ProfileView::ProfileView(const Workbench &workbench, LineSession *line, QWidget *window)
    : QDialog(window)
    , m_workbench(workbench)
    , m_run(workbench.session, workbench.commands, MoveFile::usualFolder())
    , m_saver(workbench.session)
    , m_file(new ProfileFileBar(this))
    , m_model(new ProfileModel(workbench.session.catalog(), this))
    , m_filter(new ProfileFilter(*m_model, this))
    , m_tree(new QTreeView(this))
    , m_faults(new ProfileFaults(this))
    , m_plan(new ProfilePlanPage(this))
    , m_empty(m_file->makeEmptyPage(this))
    , m_pages(new QStackedWidget(this))
    , m_lines(new QComboBox(this))
    , m_only(new QCheckBox(tr("Only &differences"), this))
    , m_note(new ProfileNote(this))
    , m_progress(new QProgressBar(this))
    , m_compare(addButton("compareButton", tr("Co&mpare")))
    , m_apply(addButton("applyButton", tr("&Apply…")))
    , m_write(addButton("writeButton", {}))
    , m_back(addButton("backButton", tr("&Back")))
    , m_cancel(addButton("cancelButton", tr("&Cancel")))
    , m_close(addButton("closeButton", tr("Close")))
{
    setObjectName(QStringLiteral("profileView"));
    setWindowTitle(tr("Robot profile"));
    setWindowFlag(Qt::WindowMaximizeButtonHint);
    build();
    m_run.setLine(line);
    connectParts();
    followLines();
    update();
}

QPushButton *ProfileView::addButton(const char *name, const QString &text)
{
    auto *button = new QPushButton(text, this);
    button->setObjectName(QLatin1String(name));
    return button;
}

void ProfileView::build()
{
    makeTree();
    m_pages->insertWidget(Empty, m_empty);
    m_pages->insertWidget(Faults, m_faults);
    m_pages->insertWidget(Compared, m_tree);
    m_pages->insertWidget(Plan, m_plan);
    m_progress->setObjectName(QStringLiteral("profileProgress"));
    m_progress->setAccessibleName(tr("Progress"));
    m_progress->setRange(0, 100);
    m_progress->setTextVisible(false);
    m_progress->setFixedHeight(6);
    QSizePolicy keeping = m_progress->sizePolicy();
    keeping.setRetainSizeWhenHidden(true);
    m_progress->setSizePolicy(keeping);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(24, 24, 24, 16);
    layout->setSpacing(12);
    layout->addWidget(m_file);
    layout->addWidget(makeTools());
    layout->addWidget(m_pages, 1);
    layout->addWidget(m_progress);
    layout->addWidget(m_note);
    layout->addLayout(makeButtons());
    setMinimumSize(760, 480);
    resize(1000, 720);
    restoreGeometry(QSettings().value(GeometryKey).toByteArray());
}

QWidget *ProfileView::makeTools()
{
    auto *tools = new QWidget(this);
    auto *label = new QLabel(tr("&Line:"), tools);
    label->setBuddy(m_lines);
    m_lines->setObjectName(QStringLiteral("profileLine"));
    m_lines->setAccessibleName(tr("Line"));
    m_lines->setSizeAdjustPolicy(QComboBox::AdjustToContents);
    m_only->setObjectName(QStringLiteral("onlyDifferences"));
    m_only->setChecked(true);
    auto *layout = new QHBoxLayout(tools);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(8);
    layout->addWidget(label);
    layout->addWidget(m_lines);
    layout->addStretch(1);
    layout->addWidget(m_only);
    return tools;
}

void ProfileView::makeTree()
{
    m_tree->setObjectName(QStringLiteral("profileTree"));
    m_tree->setAccessibleName(tr("Joints and registers"));
    m_tree->setModel(m_filter);
    m_tree->setUniformRowHeights(true);
    m_tree->setSelectionMode(QAbstractItemView::SingleSelection);
    m_tree->setEditTriggers(QAbstractItemView::NoEditTriggers);
    m_tree->setTextElideMode(Qt::ElideRight);
    m_tree->header()->setStretchLastSection(true);
    m_tree->header()->setSectionsMovable(false);
    connect(m_model, &QAbstractItemModel::modelReset, m_tree, [this] {
        m_tree->expandAll();
        fitColumns();
    });
}

QLayout *ProfileView::makeButtons()
{
    auto *row = new QHBoxLayout;
    row->setSpacing(8);
    row->addStretch(1);
    for (QPushButton *button : {m_compare, m_apply, m_write, m_back, m_cancel, m_close})
        row->addWidget(button);
    connect(m_compare, &QPushButton::clicked, this, &ProfileView::compare);
    connect(m_apply, &QPushButton::clicked, this, &ProfileView::openPlan);
    connect(m_write, &QPushButton::clicked, this, &ProfileView::write);
    connect(m_back, &QPushButton::clicked, this, [this] {
        m_isPlanning = false;
        update();
    });
    connect(m_cancel, &QPushButton::clicked, this, &ProfileView::reject);
    connect(m_close, &QPushButton::clicked, this, &ProfileView::reject);
    return row;
}

void ProfileView::connectParts()
{
    connect(&m_run, &ProfileRun::changed, this, &ProfileView::onRun);
    connect(&m_run, &ProfileRun::jointChanged, this, [this] { m_model->show(m_run); });
    connect(&m_run, &ProfileRun::progressed, this, &ProfileView::say);
    connect(&m_run, &ProfileRun::torqueTurnedOn, this, &ProfileView::torqueTurnedOn);
    connect(&m_saver, &ProfileSaver::changed, this, &ProfileView::update);
    connect(m_file, &ProfileFileBar::openRequested, this, &ProfileView::load);
    connect(m_file, &ProfileFileBar::saveNewRequested, this, [this](const QString &path) {
        if (!isBusy() && m_run.line())
            m_saver.saveNew(path, *m_run.line(), {m_file->includesCalibration(), false, {}},
                            [this, path](const auto &result) { saved(path, result); });
    });
    connect(m_file, &ProfileFileBar::saveIntoRequested, this, [this] {
        if (!isBusy() && m_run.line())
            m_saver.saveInto(m_run.path(), *m_run.line(), {m_file->includesCalibration(), false, {}},
                             [this, path = m_run.path()](const auto &result) { saved(path, result); });
    });
    connect(m_model, &ProfileModel::chosenChanged, this, &ProfileView::updateButtons);
    connect(m_only, &QCheckBox::toggled, this, [this](bool only) {
        m_filter->setOnlyDifferences(only);
        m_tree->expandAll();
    });
    connect(m_plan, &ProfilePlanPage::changed, this, &ProfileView::replan);
    connect(&m_workbench.stop, &StopControl::changed, this, &ProfileView::update);
    connect(m_lines, &QComboBox::currentIndexChanged, this, [this](int index) {
        for (const auto &line : m_workbench.session.lines()) {
            if (index >= 0 && line->name() == m_lines->itemData(index).toString())
                m_run.setLine(line.get());
        }
    });
    const auto follow = [this](LineSession *line) {
        connect(line, &LineSession::stateChanged, this, &ProfileView::followLines);
        connect(line, &QObject::destroyed, this, &ProfileView::followLines, Qt::QueuedConnection);
    };
    connect(&m_workbench.session, &Session::lineAdded, this, [this, follow](LineSession *line) {
        follow(line);
        followLines();
    });
    for (const auto &line : m_workbench.session.lines())
        follow(line.get());
}

void ProfileView::followLines()
{
    {
        const QSignalBlocker blocker(m_lines);
        m_lines->clear();
        for (const auto &line : m_workbench.session.lines())
            m_lines->addItem(tr("%1 at %2").arg(portText(line->name()), baudText(line->baudRate())), line->name());
        if (!m_run.line() && !m_workbench.session.lines().empty())
            m_run.setLine(m_workbench.session.lines().front().get());
        m_lines->setCurrentIndex(m_run.line() ? m_lines->findData(m_run.line()->name()) : -1);
        m_lines->setPlaceholderText(tr("None is open"));
    }
    update();
}

void ProfileView::setUnits(const UnitPreferences &units)
{
    m_model->setUnits(units);
    m_plan->setUnits(units);
    replan();
    fitColumns();
}

void ProfileView::load(const QString &path)
{
    if (isBusy())
        return;
    m_said.reset();
    m_isPlanning = false;
    if (m_run.load(path))
        ProfileFileBar::remember(path);
    update();
}

void ProfileView::compare()
{
    m_said.reset();
    m_isPlanning = false;
    m_run.compare();
}

void ProfileView::onRun()
{
    const bool isNews = !m_run.isBusy();
    m_model->show(m_run);
    if (isNews)
        m_tree->expandAll();
    if (isNews && m_run.comparison())
        fitColumns();
    if (m_run.isBusy())
        m_isPlanning = false;
    followLines();
}

void ProfileView::fitColumns()
{
    for (const int column : {ProfileModel::Name, ProfileModel::Wanted, ProfileModel::Held}) {
        m_tree->resizeColumnToContents(column);
        m_tree->setColumnWidth(column, std::clamp(m_tree->columnWidth(column) + 8, 120, WidestColumn));
    }
}

void ProfileView::openPlan()
{
    m_isPlanning = true;
    update();
    m_write->setFocus();
}

void ProfileView::replan()
{
    if (m_isPlanning)
        update();
}

void ProfileView::write()
{
    const ProfileApplyOptions options = m_plan->options();
    const bool moves = m_plan->moves();
    m_said.reset();
    m_isPlanning = false;
    m_run.apply(options, moves);
}

void ProfileView::saved(const QString &path, const Result<SavedProfile> &result)
{
    m_isPlanning = false;
    if (result) {
        if (m_run.load(path))
            ProfileFileBar::remember(path);
        m_said = std::pair(result->notes.isEmpty() ? MessageKind::Success : MessageKind::Warning,
                           savedText(path, *result));
    } else {
        m_said = std::pair(MessageKind::Error, asSentence(result.error().text));
    }
    update();
}

void ProfileView::showPage(Page page)
{
    m_pages->setCurrentIndex(page);
    m_only->setVisible(page == Compared);
}

void ProfileView::update()
{
    const auto &profile = m_run.profile();
    m_file->setFile(profile ? profile->name : QString(), m_run.path());
    m_file->setUse(!isBusy(), !isBusy() && isOpen(), profile.has_value());
    m_lines->setEnabled(!isBusy() && m_lines->count() > 0);
    if (m_run.fault()) {
        m_faults->show(m_run.path(), m_run.fault()->text);
        m_isPlanning = false;
    }
    m_isPlanning = m_isPlanning && m_run.comparison();
    if (m_isPlanning)
        m_plan->show(m_run, m_model->chosen());
    showPage(m_run.fault() ? Faults : !profile ? Empty : m_isPlanning ? Plan : Compared);
    updateButtons();
}

void ProfileView::updateButtons()
{
    const bool isRunning = isBusy();
    const auto offer = [](QPushButton &button, bool isShown, const QString &why) {
        button.setVisible(isShown);
        button.setEnabled(why.isEmpty());
        button.setToolTip(plainToolTip(why));
    };
    offer(*m_compare, !isRunning && !m_isPlanning, whyNotCompare());
    offer(*m_apply, !isRunning && !m_isPlanning, whyNotApply());
    offer(*m_write, !isRunning && m_isPlanning, m_isPlanning ? whyNotWrite() : QString());
    offer(*m_back, !isRunning && m_isPlanning, {});
    offer(*m_cancel, isRunning, {});
    offer(*m_close, !isRunning && !m_isPlanning, {});
    m_cancel->setText(m_run.state() == ProfileRun::State::Applying || m_run.state() == ProfileRun::State::Moving
                          ? tr("&End Here")
                          : tr("&Cancel"));
    const std::size_t writes = m_plan->writes();
    m_write->setText(m_plan->moves()  ? tr("&Move and Write")
                     : writes == 1 ? tr("&Write 1 Register")
                                   : tr("&Write %1 Registers").arg(writes));
    (m_isPlanning ? m_write : m_apply->isEnabled() ? m_apply : m_compare)->setDefault(true);
    say();
}

void ProfileView::reject()
{
    if (m_saver.isBusy())
        return m_saver.cancel();
    if (m_run.isBusy())
        return m_run.cancel(); // and says where it ended
    QDialog::reject();
}

void ProfileView::done(int result)
{
    QSettings().setValue(GeometryKey, saveGeometry());
    QDialog::done(result);
}

} // namespace dynascope
