// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/commission/commissiondialog.h"

#include "core/session/commissioning/identify.h"
#include "ui/commission/commissionmodel.h"
#include "ui/commission/commissionsetup.h"
#include "ui/commission/commissiontexts.h"
#include "ui/common/filedialogs.h"
#include "ui/common/icons.h"
#include "ui/common/texts.h"

#include <QDialogButtonBox>
#include <QEvent>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QStackedWidget>
#include <QTreeView>
#include <QVBoxLayout>

namespace dynascope {

namespace {

constexpr double BigSentence = 1.5; ///< of the usual font
constexpr int NoteLines = 3;

QLabel *label(QWidget *parent, const QString &name)
{
    auto *label = new QLabel(parent);
    label->setObjectName(name);
    label->setWordWrap(true);
    label->setTextFormat(Qt::PlainText);
    label->setAlignment(Qt::AlignLeft | Qt::AlignTop);
    return label;
}

} // namespace

CommissionDialog::CommissionDialog(Commands &commands, LineSession &line, const QString &folder, QWidget *parent)
    : QDialog(parent)
    , m_catalog(line.catalog())
    , m_commissioning(commands, line, folder)
    , m_model(new CommissionModel(m_commissioning, line.catalog(), this))
    , m_pages(new QStackedWidget(this))
    , m_setup(new CommissionSetup(line, this))
{
    setObjectName(QStringLiteral("commissionDialog"));
    setWindowTitle(tr("Commission new servos – %1").arg(portText(line.name())));
    m_pages->addWidget(m_setup);
    m_pages->addWidget(makeWork());
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(24, 24, 24, 16);
    layout->setSpacing(16);
    layout->addWidget(m_pages);
    makeButtons();
    connect(m_setup, &CommissionSetup::changed, this, &CommissionDialog::updateButtons);
    connect(&m_commissioning, &Commissioning::changed, this, &CommissionDialog::update);
    connect(&m_commissioning, &Commissioning::ticked, this, [this](int joint) {
        m_lastTicked = joint;
        m_view->scrollTo(m_model->index(joint, 0));
    });
    connect(&m_commissioning, &Commissioning::failed, this, [this](const QString &why) {
        emit posted(MessageKind::Warning, tr("The LED could not be lit: %1").arg(why));
    });
    connect(&line, &QObject::destroyed, this, &QDialog::reject);
    connect(&line, &LineSession::stateChanged, this, &CommissionDialog::update);
    resize(720, 560);
    update();
}

QWidget *CommissionDialog::makeWork()
{
    auto *work = new QWidget(this);
    m_sentence = label(work, QStringLiteral("commissionSentence"));
    QFont big = m_sentence->font();
    big.setPointSizeF(big.pointSizeF() * BigSentence);
    big.setBold(true);
    m_sentence->setFont(big);
    m_detail = label(work, QStringLiteral("commissionDetail"));
    m_noteIcon = new QLabel(work);
    m_note = label(work, QStringLiteral("commissionNote"));
    m_note->setMinimumHeight(NoteLines * m_note->fontMetrics().lineSpacing()); // so that nothing jumps
    auto *note = new QHBoxLayout;
    note->setSpacing(8);
    note->addWidget(m_noteIcon, 0, Qt::AlignTop);
    note->addWidget(m_note, 1);
    m_view = new QTreeView(work);
    m_view->setObjectName(QStringLiteral("commissionView"));
    m_view->setAccessibleName(tr("Joints"));
    m_view->setRootIsDecorated(false);
    m_view->setUniformRowHeights(true);
    m_view->setModel(m_model);
    m_view->header()->setStretchLastSection(true);
    for (const auto &[column, widest] :
         {std::pair{CommissionColumn::Joint, "left_shoulder__"}, std::pair{CommissionColumn::Id, "0000"},
          std::pair{CommissionColumn::BaudRate, "57 600 bps"}, std::pair{CommissionColumn::Model, "XM430-W350-T"},
          std::pair{CommissionColumn::Firmware, "Firmware__"}})
        m_view->setColumnWidth(static_cast<int>(column),
                               fontMetrics().horizontalAdvance(QLatin1String(widest)) + 16);
    connect(m_view->selectionModel(), &QItemSelectionModel::selectionChanged, this, &CommissionDialog::updateButtons);
    auto *layout = new QVBoxLayout(work);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(8);
    layout->addWidget(m_sentence);
    layout->addWidget(m_detail);
    layout->addLayout(note);
    layout->addWidget(m_view, 1);
    layout->addLayout(makeJointButtons());
    return work;
}

QPushButton *CommissionDialog::button(const QString &name, const QString &text, const QString &iconName,
                                      const QString &toolTip)
{
    auto *button = new QPushButton(text, this);
    button->setObjectName(name);
    button->setAutoDefault(false);
    button->setToolTip(toolTip);
    if (!iconName.isEmpty())
        button->setIcon(icon(iconName));
    return button;
}

QLayout *CommissionDialog::makeJointButtons()
{
    m_led = button(QStringLiteral("commissionLed"), tr("&LED"), QStringLiteral("led"),
                   tr("Lights the LED of the selected one for a moment, or of the one that was done last"));
    m_skip = button(QStringLiteral("commissionSkip"), tr("&Skip"), {},
                    tr("Leaves out the joint that is to be plugged in now"));
    m_back = button(QStringLiteral("commissionBack"), tr("&Back"), {},
                    tr("The selected joint, or the one that was done last, is wanted once more"));
    m_isNew = button(QStringLiteral("commissionIsNew"), tr("&It is the new one"), {},
                     tr("Takes the servo that was there before for the one that is to be plugged in now"));
    m_again = button(QStringLiteral("commissionAgain"), tr("&Try again"), QStringLiteral("refresh"),
                     tr("Tries the servo that could not be set up once more"));
    auto *layout = new QHBoxLayout;
    layout->setSpacing(8);
    for (QPushButton *each : {m_led, m_skip, m_back, m_isNew, m_again})
        layout->addWidget(each);
    layout->addStretch(1);
    connect(m_led, &QPushButton::clicked, this, [this] {
        if (const auto joint = selected())
            m_commissioning.identify(*joint);
    });
    connect(m_skip, &QPushButton::clicked, &m_commissioning, &Commissioning::skip);
    connect(m_back, &QPushButton::clicked, this, [this] {
        if (const auto joint = selected())
            m_commissioning.reopen(*joint);
    });
    connect(m_isNew, &QPushButton::clicked, &m_commissioning, &Commissioning::takePresent);
    connect(m_again, &QPushButton::clicked, &m_commissioning, &Commissioning::tryAgain);
    return layout;
}

void CommissionDialog::makeButtons()
{
    auto *buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
    m_start = buttons->addButton(tr("Start"), QDialogButtonBox::ActionRole);
    m_start->setObjectName(QStringLiteral("commissionStart"));
    m_start->setDefault(true);
    m_pause = buttons->addButton(tr("&Pause"), QDialogButtonBox::ActionRole);
    m_pause->setObjectName(QStringLiteral("commissionPause"));
    m_pause->setAutoDefault(false);
    m_pause->setIcon(icon(QStringLiteral("pause")));
    m_pause->setToolTip(tr("Nothing more is looked for or written; Go on continues"));
    m_csv = button(QStringLiteral("commissionCsv"), tr("Save l&abels…"), QStringLiteral("csv"),
                   tr("The list of those that are done, as CSV"));
    m_pdf = button(QStringLiteral("commissionPdf"), tr("Labels as P&DF…"), QStringLiteral("save"),
                   tr("The list of those that are done, to be printed"));
    buttons->addButton(m_csv, QDialogButtonBox::ResetRole);
    buttons->addButton(m_pdf, QDialogButtonBox::ResetRole);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    connect(m_start, &QPushButton::clicked, this, &CommissionDialog::startOrGoOn);
    connect(m_pause, &QPushButton::clicked, &m_commissioning, &Commissioning::stop);
    connect(m_csv, &QPushButton::clicked, this, [this] { saveLabels(QStringLiteral("csv")); });
    connect(m_pdf, &QPushButton::clicked, this, [this] { saveLabels(QStringLiteral("pdf")); });
    layout()->addWidget(buttons);
}

void CommissionDialog::startOrGoOn()
{
    if (m_commissioning.state() != Commissioning::State::Idle)
        return m_commissioning.resume();
    const Result<CommissionList> &list = m_setup->list();
    if (!list)
        return;
    m_pages->setCurrentIndex(1);
    m_commissioning.start(*list, m_setup->options());
}

std::optional<std::size_t> CommissionDialog::selected() const
{
    const QModelIndexList rows = m_view->selectionModel()->selectedRows();
    const int row = rows.isEmpty() ? m_lastTicked : rows.front().row();
    return row >= 0 && row < m_model->rowCount() ? std::optional(static_cast<std::size_t>(row)) : std::nullopt;
}

void CommissionDialog::update()
{
    m_model->refresh();
    m_sentence->setText(commissionSentence(m_commissioning));
    m_detail->setText(commissionDetail(m_commissioning, m_catalog));
    const QString bystanders = bystanderText(m_commissioning, m_catalog);
    const bool isWrong = !m_commissioning.problem().isEmpty();
    m_noteKind = isWrong ? MessageKind::Warning : MessageKind::Info;
    m_note->setText(isWrong ? asSentence(m_commissioning.problem()) : bystanders);
    showNote();
    updateButtons();
}

void CommissionDialog::updateButtons()
{
    using State = Commissioning::State;
    const CommissionList &list = m_commissioning.list();
    const bool isIdle = m_commissioning.state() == State::Idle;
    const bool isRunning = m_commissioning.state() == State::Running;
    m_start->setText(isIdle ? tr("Start") : tr("Go on"));
    m_start->setVisible(!isRunning);
    m_start->setEnabled(isIdle ? m_setup->list().has_value() : !list.isOver());
    m_pause->setVisible(isRunning);
    for (QPushButton *each : {m_csv, m_pdf}) {
        each->setVisible(!isIdle);
        each->setEnabled(!isIdle && list.count(CommissionState::Done) > 0);
    }
    if (isIdle)
        return;
    const auto joint = selected();
    const bool isDone = joint && list.state(*joint) == CommissionState::Done;
    const ControlTablePtr table
        = isDone ? m_catalog.find(list.facts(*joint).modelNumber, list.facts(*joint).firmware) : nullptr;
    m_led->setEnabled(table && hasLed(*table) && !m_commissioning.lit());
    m_led->setToolTip(table && !hasLed(*table)
                          ? tr("%1 has no LED to be told by").arg(table->model())
                          : tr("Lights the LED of the selected one for a moment, or of the one that was done last"));
    m_skip->setEnabled(!list.isOver());
    m_back->setEnabled(joint && list.state(*joint) != CommissionState::Waiting);
    m_isNew->setVisible(isRunning && m_commissioning.memory().bystanders.size() == 1);
    m_again->setVisible(isRunning && !m_commissioning.memory().troubles.empty());
}

void CommissionDialog::showNote()
{
    const QIcon picture = m_noteKind == MessageKind::Warning ? icon(QStringLiteral("warning"), IconTint::Warning)
                                                             : icon(QStringLiteral("info"), IconTint::Accent);
    m_noteIcon->setPixmap(m_note->text().isEmpty() ? QPixmap() : picture.pixmap(QSize(20, 20), devicePixelRatioF()));
}

void CommissionDialog::changeEvent(QEvent *event)
{
    if (event->type() == QEvent::PaletteChange)
        showNote();
    QDialog::changeEvent(event);
}

void CommissionDialog::saveLabels(const QString &suffix)
{
    const bool isPdf = suffix == QLatin1String("pdf");
    askWhereToSave(this, tr("Labels"), suffix, tr("labels") + u'.' + suffix, [this, isPdf](const QString &path) {
        const CommissionList &list = m_commissioning.list();
        const Result<void> saved = isPdf ? saveLabelsPdf(list, m_catalog, tr("Servos and their IDs"), path)
                                         : saveLabelsCsv(list, m_catalog, path);
        emit posted(saved ? MessageKind::Success : MessageKind::Error,
                    saved ? tr("The labels are in %1").arg(path) : saved.error().text);
    });
}

} // namespace dynascope
