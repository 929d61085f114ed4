// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/devices/movedialog.h"

#include "ui/common/icons.h"
#include "ui/common/texts.h"
#include "ui/common/theme.h"
#include "ui/devices/movestepsmodel.h"
#include "ui/devices/movewishes.h"

#include <QCheckBox>
#include <QDialogButtonBox>
#include <QEvent>
#include <QLabel>
#include <QListView>
#include <QPushButton>
#include <QVBoxLayout>

#include <algorithm>
#include <set>

namespace dynascope {

MoveDialog::MoveDialog(Session &session, Commands &commands, LineSession &line, const std::vector<Device *> &devices,
                       const QString &folder, QWidget *parent)
    : QDialog(parent)
    , m_session(session)
    , m_run(session, commands, line, folder)
    , m_wishes(new MoveWishes(this))
    , m_steps(new MoveStepsModel(this))
    , m_list(new QListView(this))
    , m_where(new QLabel(this))
    , m_noteIcon(new QLabel(this))
    , m_note(new QLabel(this))
    , m_torqueOff(new QCheckBox(tr("Turn &torque off first"), this))
    , m_accept(new QPushButton(this))
    , m_cancel(new QPushButton(this))
    , m_forget(new QPushButton(tr("&Forget"), this))
{
    setObjectName(QStringLiteral("moveDialog"));
    setWindowTitle(tr("Move to other IDs or baud – %1").arg(portText(line.name())));
    for (const Device *device : devices)
        m_devices.push_back(device->key());
    build();
    connectParts(line);
    if (m_run.file().exists()) {
        const auto left = m_run.takeLeft();
        m_wasLeft = left.has_value();
        if (left)
            m_run.look();
        else
            m_planned = tl::unexpected(left.error());
    }
    if (!m_wasLeft)
        m_run.survey();
    update();
}

void MoveDialog::build()
{
    m_where->setFont(boldened(m_where->font()));
    m_where->setTextFormat(Qt::PlainText);
    m_list->setObjectName(QStringLiteral("moveSteps"));
    m_list->setAccessibleName(tr("Steps"));
    m_list->setModel(m_steps);
    m_list->setWordWrap(true);
    m_list->setSelectionMode(QAbstractItemView::NoSelection);
    m_list->setResizeMode(QListView::Adjust);
    m_list->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    m_note->setObjectName(QStringLiteral("note"));
    m_note->setWordWrap(true);
    m_note->setTextFormat(Qt::PlainText);
    m_note->setAlignment(Qt::AlignLeft | Qt::AlignTop);
    m_note->setMinimumHeight(2 * m_note->fontMetrics().lineSpacing()); // so that the dialog doesn't jump
    m_torqueOff->setObjectName(QStringLiteral("turnTorqueOff"));
    m_torqueOff->setToolTip(tr("What these servos hold may fall"));

    auto *note = new QHBoxLayout;
    note->setSpacing(8);
    note->addWidget(m_noteIcon, 0, Qt::AlignTop);
    note->addWidget(m_note, 1);
    auto *steps = new QLabel(tr("St&eps, in this order"), this);
    steps->setBuddy(m_list);
    auto *parts = new QVBoxLayout;
    parts->setSpacing(8);
    parts->addWidget(m_wishes, 3);
    parts->addSpacing(8);
    parts->addWidget(steps);
    parts->addWidget(m_list, 2);
    auto *buttons = new QDialogButtonBox(this);
    buttons->addButton(m_accept, QDialogButtonBox::AcceptRole);
    buttons->addButton(m_cancel, QDialogButtonBox::RejectRole);
    buttons->addButton(m_forget, QDialogButtonBox::ResetRole);
    m_accept->setObjectName(QStringLiteral("acceptButton"));
    m_cancel->setObjectName(QStringLiteral("cancelButton"));
    m_forget->setObjectName(QStringLiteral("forgetButton"));
    m_forget->setToolTip(tr("Leave every device where it is now, and the rest undone"));
    m_accept->setDefault(true);
    m_forget->setAutoDefault(false);

    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(24, 24, 24, 16);
    layout->setSpacing(16);
    layout->addWidget(m_where);
    layout->addLayout(parts, 1);
    layout->addWidget(m_torqueOff);
    layout->addLayout(note);
    layout->addWidget(buttons);
    setMinimumSize(600, 480);
    resize(720, 620);
    connect(m_accept, &QPushButton::clicked, this, &MoveDialog::accepted);
    connect(m_cancel, &QPushButton::clicked, this, &MoveDialog::reject);
    connect(m_forget, &QPushButton::clicked, this, &MoveDialog::forget);
}

void MoveDialog::connectParts(LineSession &line)
{
    connect(&m_run, &MoveRun::changed, this, &MoveDialog::update);
    connect(m_wishes, &MoveWishes::changed, this, [this] {
        m_run.dismissProblem(); // of other wishes
        replan();
    });
    connect(m_torqueOff, &QCheckBox::toggled, this, &MoveDialog::updateButtons);
    connect(&line, &LineSession::stateChanged, this, &MoveDialog::update);
    connect(&line, &LineSession::deviceChanged, this, &MoveDialog::update);
    connect(&line, &LineSession::deviceAdded, this, &MoveDialog::update);
    connect(&m_session, &Session::deviceAboutToBeRemoved, this, [this](const Device *device) {
        std::erase(m_devices, device->key());
        update();
    });
    connect(&line, &QObject::destroyed, this, &QDialog::close);
}

std::vector<const Device *> MoveDialog::devices() const
{
    std::vector<const Device *> devices;
    for (const DeviceKey key : m_devices) {
        if (const Device *device = m_session.device(key))
            devices.push_back(device);
    }
    return devices;
}

int MoveDialog::underTorque() const
{
    const MovePlan &plan = m_run.state() == MoveRun::State::Idle && m_planned ? *m_planned : m_run.plan();
    std::set<std::size_t> movers;
    for (std::size_t i = plan.next; i < plan.steps.size(); ++i)
        movers.insert(plan.steps[i].device);
    int count = 0;
    for (const std::size_t mover : movers) {
        const MovePlace place = plan.placeOf(mover);
        const LineSession *line = m_run.line();
        const Device *device = line ? line->deviceAt(static_cast<std::uint8_t>(place.id), place.baudRate) : nullptr;
        count += device && device->isTorqueOn() ? 1 : 0;
    }
    return count;
}

void MoveDialog::update()
{
    const LineSession *line = m_run.line();
    if (!line)
        return;
    m_where->setText(tr("%1 at %2").arg(portText(line->name()), baudText(line->baudRate())));
    const bool isPlanned = m_run.state() == MoveRun::State::Idle || m_run.state() == MoveRun::State::Looking;
    if (isPlanned && m_run.plan().steps.empty()) {
        m_wishes->setDevices(devices(), [this](int rate) { return m_run.offers(rate); });
        return replan();
    }
    if (m_run.state() == MoveRun::State::Idle) { // refused before its first write: the wishes may be changed
        m_wishes->setDevices(devices(), [this](int rate) { return m_run.offers(rate); });
        return replan();
    }
    m_wishes->showPlan(m_run.plan());
    m_steps->setPlan(m_run.plan(), line->baudRate(), m_run.state(), m_run.problem());
    if (!m_run.plan().isOver() && m_run.plan().next > 0)
        m_list->scrollTo(m_steps->index(static_cast<int>(m_run.plan().next)));
    updateButtons();
}

void MoveDialog::replan()
{
    if (m_run.isBusy() && !m_run.plan().steps.empty())
        return;
    if (!m_wasLeft && m_run.file().exists())
        m_planned = failure(ErrorKind::BadFile, tr("A plan that was left on this line can't be read: forget it first"));
    else
        m_planned = m_run.planFor(m_wishes->wishes());
    m_steps->setPlan(m_planned ? *m_planned : MovePlan(), m_run.line() ? m_run.line()->baudRate() : 0,
                     MoveRun::State::Idle, {});
    updateButtons();
}

/// What the plan means for the line and who is on it.
QString MoveDialog::whatFollows() const
{
    const LineSession *line = m_run.line();
    if (!line || !m_planned)
        return {};
    std::set<int> rates;
    bool anyHere = false, anyElsewhere = false;
    for (const MoveDevice &device : m_planned->devices) {
        rates.insert(device.goal.baudRate);
        anyHere = anyHere || device.goal.baudRate == line->baudRate();
        anyElsewhere = anyElsewhere || (device.moves() && device.goal.baudRate != line->baudRate());
    }
    const std::size_t steps = m_planned->steps.size();
    QString text = steps == 1 ? tr("One step. Everything is looked at once more before it.")
                              : tr("%1 steps, each verified before the next. Everything is looked at once more before "
                                   "the first.")
                                    .arg(steps);
    if (!anyHere && rates.size() == 1)
        text += QLatin1Char(' ') + tr("At the end the line follows to %1.").arg(baudText(*rates.begin()));
    else if (anyElsewhere)
        text += QLatin1Char(' ')
                + tr("Who goes elsewhere is parked: neither polled nor plotted until the line works there.");
    if (!m_wishes->leftOut().isEmpty())
        text += QLatin1Char(' ') + m_wishes->leftOut();
    return text;
}

void MoveDialog::showIdle()
{
    const bool isLooking = m_run.state() == MoveRun::State::Looking;
    const int held = underTorque();
    const LineSession *line = m_run.line();
    const bool isOpen = line && line->state() == BusThread::State::Open;
    bool ready = false;
    if (!isOpen)
        setNote(MessageKind::Error, tr("The line isn't open now."));
    else if (isLooking)
        setNote(MessageKind::Info, tr("Trying the port's rates and asking for Secondary IDs…"));
    else if (!m_planned)
        setNote(MessageKind::Error, asSentence(m_planned.error().text));
    else if (!m_run.isSurveyed())
        setNote(MessageKind::Error, asSentence(m_run.problem().isEmpty() ? tr(
                                                   "The line could not be looked at: close this, and open it again")
                                                                         : m_run.problem()));
    else if (m_planned->steps.empty())
        setNote(MessageKind::Info, tr("Everybody stays where they are. Choose new IDs or baud rates above."));
    else if (held > 0 && !m_torqueOff->isChecked())
        setNote(MessageKind::Error, held == 1
                                        ? tr("One of them is under torque, which locks its ID and baud rate.")
                                        : tr("%1 of them are under torque, which locks ID and baud rate.").arg(held));
    else {
        ready = true;
        const bool isWell = m_run.problem().isEmpty();
        setNote(isWell ? MessageKind::Info : MessageKind::Error, isWell ? whatFollows() : asSentence(m_run.problem()));
    }
    m_accept->setText(tr("&Carry Out"));
    m_accept->setEnabled(ready);
    m_cancel->setText(tr("Cancel"));
    m_forget->setVisible(m_run.file().exists());
}

void MoveDialog::showUnderWay()
{
    const MovePlan &plan = m_run.plan();
    const MoveRun::State state = m_run.state();
    const bool isHalted = state == MoveRun::State::Halted;
    const LineSession *line = m_run.line();
    const bool isOpen = line && line->state() == BusThread::State::Open;
    const QString done = tr("%1 of %2 steps are done").arg(plan.next).arg(plan.steps.size());
    switch (state) {
    case MoveRun::State::Looking: setNote(MessageKind::Info, tr("Looking where everybody is…")); break;
    case MoveRun::State::Moving:
        setNote(MessageKind::Info, tr("%1. STOP ends it at any time; Pause ends it before the next step.").arg(done));
        break;
    case MoveRun::State::Over: setNote(MessageKind::Success, tr("Everybody is where they shall be.")); break;
    default:
        setNote(m_run.problem().isEmpty() ? MessageKind::Warning : MessageKind::Error,
                m_run.problem().isEmpty()
                    ? asSentence(unfinishedText(plan))
                    : tr("%1. %2 Put right what is wrong, then continue.").arg(done, asSentence(m_run.problem())));
        break;
    }
    m_accept->setText(tr("&Continue"));
    m_accept->setVisible(state != MoveRun::State::Over);
    const bool mayGoOn = underTorque() == 0 || m_torqueOff->isChecked() || plan.turnTorqueOff;
    m_accept->setEnabled(isHalted && isOpen && mayGoOn);
    m_cancel->setText(state == MoveRun::State::Moving ? tr("&Pause") : tr("Close"));
    m_forget->setVisible(isHalted);
}

void MoveDialog::updateButtons()
{
    const bool isPlanning = m_run.state() == MoveRun::State::Idle || m_run.plan().steps.empty();
    m_torqueOff->setVisible(!m_run.isBusy() && (underTorque() > 0 || m_torqueOff->isChecked())
                            && m_run.state() != MoveRun::State::Over);
    isPlanning ? showIdle() : showUnderWay();
    m_accept->setToolTip(m_accept->isEnabled() || !m_accept->isVisible() ? QString() : plainToolTip(m_note->text()));
}

void MoveDialog::accepted()
{
    m_wasLeft = m_wasLeft || m_run.state() == MoveRun::State::Halted;
    if (m_run.state() == MoveRun::State::Halted)
        return m_run.goOn(m_torqueOff->isChecked());
    if (!m_planned)
        return;
    MovePlan plan = *m_planned;
    plan.turnTorqueOff = m_torqueOff->isChecked();
    m_run.start(std::move(plan));
}

void MoveDialog::forget()
{
    m_wasLeft = false;
    m_run.forget();
    if (!m_run.isSurveyed())
        m_run.survey();
    update();
}

void MoveDialog::reject()
{
    if (m_run.state() == MoveRun::State::Moving)
        return m_run.cancel(); // and says where it ended
    QDialog::reject();
}

void MoveDialog::setNote(MessageKind kind, const QString &text)
{
    m_noteKind = kind;
    m_note->setText(text);
    drawNote();
}

void MoveDialog::drawNote()
{
    QPalette palette = this->palette();
    if (m_noteKind == MessageKind::Error)
        palette.setColor(QPalette::WindowText, colors(palette).bad);
    m_note->setPalette(palette);
    const auto picture = [this] {
        switch (m_noteKind) {
        case MessageKind::Error: return icon(QStringLiteral("error"), IconTint::Bad);
        case MessageKind::Warning: return icon(QStringLiteral("warning"), IconTint::Warning);
        case MessageKind::Success: return icon(QStringLiteral("success"), IconTint::Good);
        case MessageKind::Info: break;
        }
        return icon(QStringLiteral("info"), IconTint::Accent);
    };
    m_noteIcon->setPixmap(m_note->text().isEmpty() ? QPixmap() : picture().pixmap(QSize(20, 20), devicePixelRatioF()));
}

void MoveDialog::changeEvent(QEvent *event)
{
    if (event->type() == QEvent::PaletteChange)
        drawNote();
    QDialog::changeEvent(event);
}

} // namespace dynascope
