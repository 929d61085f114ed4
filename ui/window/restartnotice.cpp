// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/restartnotice.h"

#include "ui/common/messagebar.h"

#include <QPointer>

#include <algorithm>
#include <numeric>

namespace dynascope {

namespace {

const QString Topic = QStringLiteral("restart");
constexpr int Named = 3; ///< devices; of more the rest is counted

bool isOurs(const Restart &restart)
{
    return restart.sign == RestartSign::Reboot;
}

int lostOf(const std::vector<Restart> &restarts)
{
    return std::accumulate(restarts.begin(), restarts.end(), 0,
                           [](int sum, const Restart &restart) { return sum + restart.lost; });
}

} // namespace

RestartNotice::RestartNotice(const Workbench &workbench, MessageBar &messages, Show show)
    : QObject(&messages)
    , m_workbench(workbench)
    , m_messages(messages)
    , m_show(std::move(show))
{
    connect(workbench.ramGuard, &RamGuard::restarted, this, &RestartNotice::say);
    connect(workbench.ramGuard, &RamGuard::changed, this, &RestartNotice::update);
    connect(&workbench.session, &Session::deviceAdded, this, [this](Device *device) { // back, with what it had lost
        const std::vector<Restart> restarts = present();
        if (std::ranges::find(restarts, device->key(), &Restart::device) != restarts.end())
            say();
    });
    connect(&workbench.session, &Session::deviceAboutToBeRemoved, this, &RestartNotice::update, Qt::QueuedConnection);
}

std::vector<Restart> RestartNotice::present() const
{
    std::vector<Restart> restarts = m_workbench.ramGuard->restarts();
    std::erase_if(restarts, [this](const Restart &restart) { return !m_workbench.session.device(restart.device); });
    return restarts;
}

QString RestartNotice::textOf(const std::vector<Restart> &restarts) const
{
    const int lost = lostOf(restarts);
    const bool allOurs = std::ranges::all_of(restarts, isOurs);
    if (restarts.size() == 1) {
        const QString name = m_workbench.session.device(restarts.front().device)->displayName();
        const QString again = lost == 1 ? tr("1 register set in this session is at its initial value again.")
                                        : tr("%1 registers set in this session are at their initial values again.")
                                              .arg(lost);
        if (isOurs(restarts.front()))
            return tr("%1 was rebooted; %2").arg(name, again);
        const QString how = restarts.front().sign == RestartSign::Tick
            ? tr("%1 has restarted (its Realtime Tick began anew).").arg(name)
            : tr("%1 has restarted (its torque is off, and what was set is gone).").arg(name);
        return how + u' '
            + (lost == 1 ? tr("1 register set in this session is back at its initial value.")
                         : tr("%1 registers set in this session are back at their initial values.").arg(lost));
    }
    QStringList names;
    for (const Restart &restart : restarts)
        names << m_workbench.session.device(restart.device)->displayName();
    if (names.size() > Named)
        names = names.first(Named) << tr("%1 more").arg(restarts.size() - Named);
    return (allOurs ? tr("%1 devices were rebooted: %2. %3 registers set in this session are at their initial values again.")
                    : tr("%1 devices have restarted: %2. %3 registers set in this session are back at their initial "
                         "values."))
        .arg(QString::number(restarts.size()), names.join(QStringLiteral(", ")), QString::number(lost));
}

void RestartNotice::say()
{
    const std::vector<Restart> restarts = present();
    if (restarts.empty())
        return;
    const QString text = textOf(restarts);
    if (m_messages.text() == text) // a device that comes back, or is read again, restarted once
        return;
    m_said = text;
    m_messages.post({MessageKind::Warning, m_said, tr("Set again"), [this] { setAgain(); }, Topic, tr("Show"),
                     [this] { show(); }, true});
}

/// Somebody has set some of it, or all.
void RestartNotice::update()
{
    const std::vector<Restart> restarts = present();
    if (restarts.empty())
        m_messages.retractTopic(Topic);
    else if (m_messages.text() == m_said && textOf(restarts) != m_said)
        say();
}

void RestartNotice::setAgain()
{
    const std::vector<Restart> restarts = present();
    std::vector<DeviceKey> devices;
    for (const Restart &restart : restarts)
        devices.push_back(restart.device);
    const int lost = lostOf(restarts);
    m_workbench.ramGuard->setAgain(devices, [here = QPointer<RestartNotice>(this), lost](const Result<void> &result) {
        if (!here)
            return;
        if (result) {
            here->m_messages.post(MessageKind::Success,
                                  lost == 1 ? tr("1 register is set again") : tr("%1 registers are set again").arg(lost));
        } else if (result.error().kind == ErrorKind::NotConfirmed || result.error().kind == ErrorKind::NotFound) {
            here->m_messages.post(MessageKind::Error, result.error().text); // of a write Outcomes says it
        }
        here->say(); // what is still lost stays on offer
    });
}

void RestartNotice::show()
{
    const std::vector<Restart> restarts = present();
    if (!restarts.empty())
        m_show(*m_workbench.session.device(restarts.front().device));
}

} // namespace dynascope
