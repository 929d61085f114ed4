// SPDX-License-Identifier: GPL-3.0-or-later
// New servos, plugged in one after the other while a person reads what to do next.
#include "app/dxl/commands.h"
#include "app/dxl/directjob.h"
#include "core/session/commissioning/commissionjournal.h"
#include "core/session/commissioning/fromprofile.h"
#include "core/session/commissioning/identify.h"

#include <QFile>
#include <QSaveFile>

#include <algorithm>

namespace dynascope::dxl {

namespace {

Result<CommissionList> wantedList(const Work &work)
{
    const CommissionWishes &wishes = work.options.commission;
    if (wishes.profile.isEmpty())
        return commissionList(work.catalog, wishes.model, wishes.ids, work.options.baudRate, wishes.names,
                              wishes.firmware);
    const auto profile = loadProfile(wishes.profile, work.catalog);
    return profile ? commissionList(*profile, work.catalog) : tl::unexpected(profile.error());
}

QString timeText(const QDateTime &at)
{
    return at.toUTC().toString(Qt::ISODate);
}

/// One run, from the first prompt to the last tick.
class Commissioning
{
public:
    Commissioning(const Work &work, CommissionList list)
        : m_work(work), m_job(work.bus),
          m_plan{work.catalog, std::move(list), {}, {}, moveFileOf(work.options), {}, {}}
    {
        const JournalDevice here = journalDevice(Found{}, {}, work.options.port);
        m_plan.line = here.line;
        m_plan.adapter = here.adapter;
        m_plan.options = {work.options.commission.turnTorqueOff, work.options.commission.takesPresent};
        m_hooks = noted(&work.journal, JournalAuthor::CommandLine, work.options.port, work.catalog);
        m_hooks.looking = [this](int baudRate) {
            m_work.output.progress(doneShare(), QStringLiteral("looking at %1 bps").arg(baudRate));
        };
    }

    ExitCode run()
    {
        while (!m_plan.list.isOver() && !m_work.output.isClosed()) {
            prompt();
            auto round = commissionRound(m_job, m_plan, m_hooks);
            if (!round)
                return end(round.error());
            m_plan.list = std::move(round->list);
            m_plan.memory = std::move(round->memory);
            sayProblem(round->problem);
            sayBystanders();
            for (const std::size_t joint : round->ticked) {
                if (const ExitCode code = ticked(joint); code != ExitCode::Done)
                    return code;
            }
        }
        return ExitCode::Done;
    }

private:
    double doneShare() const
    {
        return static_cast<double>(m_plan.list.count(CommissionState::Done)) / static_cast<double>(m_plan.list.size());
    }

    /// Once for each: what is to be done now.
    void prompt()
    {
        const std::size_t next = *m_plan.list.next();
        if (m_prompted == next || !m_plan.memory.hasLooked)
            return; // on the first look some may be ticked off as they are
        m_prompted = next;
        const CommissionJoint &joint = m_plan.list.joint(next);
        m_work.output.note(QStringLiteral("plug in the servo for %1, model %2")
                               .arg(jointText(joint), modelName(m_work.catalog, joint.modelNumber)));
    }

    void sayProblem(const QString &problem)
    {
        if (problem != m_problem && !problem.isEmpty())
            m_work.output.note(problem);
        m_problem = problem;
    }

    void sayBystanders()
    {
        if (m_hasToldBystanders || !m_plan.memory.hasLooked)
            return;
        m_hasToldBystanders = true;
        for (const CommissionMemory::Device &device : m_plan.memory.bystanders)
            m_work.output.note(QStringLiteral("%1 at %2 was there before and is left alone; if it is the new one, unplug "
                                              "it and plug it in again")
                                   .arg(modelName(m_work.catalog, device.modelNumber), placeText(device.place)));
    }

    ExitCode ticked(std::size_t index)
    {
        const CommissionJoint &joint = m_plan.list.joint(index);
        const CommissionFacts &facts = m_plan.list.facts(index);
        const QString model = modelName(m_work.catalog, facts.modelNumber);
        const QString came = facts.wasSo ? QStringLiteral("stood so already")
                                         : QStringLiteral("was %1").arg(placeText(facts.foundAt));
        if (m_work.options.json) {
            Document document;
            document.add("joint", joint.name)
                .add("id", qint64(facts.place.id))
                .add("baud", qint64(facts.place.baudRate))
                .add("model", model)
                .add("model_number", qint64(facts.modelNumber))
                .add("firmware", qint64(facts.firmware))
                .add("was_id", qint64(facts.foundAt.id))
                .add("was_baud", qint64(facts.foundAt.baudRate))
                .addFlag("written", !facts.wasSo)
                .add("time", timeText(facts.at));
            m_work.output.line(document.toJson());
        } else {
            m_work.output.line(QStringLiteral("%1: %2, firmware %3, %4 (%5)")
                                   .arg(jointText(joint), model, QString::number(facts.firmware),
                                        placeText(facts.place), came)
                                   .toUtf8());
        }
        if (const auto saved = saveLabels(); !saved)
            return m_work.output.fail(saved.error());
        return facts.wasSo ? ExitCode::Done : light(facts);
    }

    ExitCode light(const CommissionFacts &facts)
    {
        if (!m_work.options.commission.lightsLed)
            return ExitCode::Done;
        const ControlTablePtr table = m_work.catalog.find(facts.modelNumber, facts.firmware);
        if (!table || !hasLed(*table)) {
            m_work.output.note(QStringLiteral("%1 has no LED to be told by")
                                   .arg(modelName(m_work.catalog, facts.modelNumber)));
            return ExitCode::Done;
        }
        Found found;
        found.id = static_cast<std::uint8_t>(facts.place.id);
        found.baudRate = facts.place.baudRate;
        found.modelNumber = static_cast<std::uint16_t>(facts.modelNumber);
        found.firmware = static_cast<std::uint8_t>(facts.firmware);
        const auto lit = identifyByLed(m_job, found, *table, m_hooks);
        if (lit)
            return ExitCode::Done;
        if (lit.error().kind == ErrorKind::PortLost || lit.error().kind == ErrorKind::Cancelled)
            return end(lit.error());
        m_work.output.note(QStringLiteral("its LED could not be lit: %1").arg(lit.error().text));
        return ExitCode::Done;
    }

    /// Each time one is ticked off: whoever ends the program has what there is.
    Result<void> saveLabels() const
    {
        const QString &path = m_work.options.commission.labels;
        if (path.isEmpty())
            return {};
        QByteArray text = labelsCsv(m_plan.list, m_work.catalog);
        if (!path.endsWith(QLatin1String(".csv"), Qt::CaseInsensitive)) {
            std::vector<QStringList> rows = labelRows(m_plan.list, m_work.catalog);
            rows.insert(rows.begin(), labelHeads());
            text = aligned(rows, {0, 3, 6}).toUtf8() + '\n';
        }
        QSaveFile file(path);
        if (file.open(QIODevice::WriteOnly) && file.write(text) == text.size() && file.commit())
            return {};
        return failure(ErrorKind::BadFile,
                       QStringLiteral("the labels can't be written to %1: %2").arg(path, file.errorString()));
    }

    ExitCode end(const Error &error)
    {
        const ExitCode code = error.kind == ErrorKind::InvalidArgument ? m_work.output.refuse(error)
                                                                       : m_work.output.fail(error);
        m_work.output.note(QStringLiteral("%1 of %2 are ticked off; the same command goes on")
                               .arg(m_plan.list.count(CommissionState::Done))
                               .arg(m_plan.list.size()));
        return code;
    }

    const Work &m_work;
    DirectJob m_job;
    CommissionRoundPlan m_plan;
    CommissionHooks m_hooks;
    std::optional<std::size_t> m_prompted;
    QString m_problem;
    bool m_hasToldBystanders = false;
};

} // namespace

ExitCode commissionCommand(const Work &work)
{
    work.output.expectLines();
    auto list = wantedList(work);
    if (!list)
        return work.output.refuse(list.error());
    return Commissioning(work, std::move(*list)).run();
}

} // namespace dynascope::dxl
