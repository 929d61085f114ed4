// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bus/jobqueue.h"
#include "tests/support/testmain.h"

#include <QElapsedTimer>

#include <thread>

using namespace dynascope;
using namespace std::chrono_literals;

namespace {

QueuedJob job(JobId id, Priority priority)
{
    QueuedJob made;
    made.id = id;
    made.priority = priority;
    made.job = [](JobContext *, const Error &) { return std::function<void()>([] {}); };
    return made;
}

QList<quint64> idsOf(const std::vector<QueuedJob> &jobs)
{
    QList<quint64> ids;
    for (const QueuedJob &one : jobs)
        ids << one.id;
    return ids;
}

} // namespace

class TestJobQueue : public QObject
{
    Q_OBJECT

    static void fill(JobQueue &queue)
    {
        for (const auto &[id, priority] : {std::pair{1, Priority::Scan}, {2, Priority::Click}, {3, Priority::Normal},
                                           {4, Priority::Click}, {5, Priority::Scan}}) {
            QueuedJob one = job(static_cast<JobId>(id), priority);
            if (!queue.push(one))
                qFatal("it is closed");
        }
    }
    static QList<quint64> drain(JobQueue &queue, std::optional<Priority> above = {})
    {
        QList<quint64> ids;
        while (const auto taken = queue.take(above))
            ids << taken->id;
        return ids;
    }

private slots:
    void theHighestFirstThenInOrder()
    {
        JobQueue queue;
        fill(queue);
        QCOMPARE(drain(queue), (QList<quint64>{2, 4, 3, 1, 5}));
    }

    void onlyWhatIsAbove()
    {
        JobQueue queue;
        fill(queue);
        QCOMPARE(drain(queue, Priority::Click), QList<quint64>());
        QCOMPARE(drain(queue, Priority::Normal), (QList<quint64>{2, 4}));
        QCOMPARE(drain(queue, Priority::Scan), QList<quint64>{3});
        QCOMPARE(drain(queue), (QList<quint64>{1, 5}));
    }

    void aWaitingJobIsTakenOutAndARunningOneTold()
    {
        JobQueue queue;
        fill(queue);
        const auto running = queue.take();
        QVERIFY(running && running->id == 2);
        QCOMPARE(queue.cancel(3)->id, JobId(3));
        QVERIFY(!queue.cancel(2) && running->cancelled->load());
        QVERIFY(!queue.cancel(99));
        queue.finished(2);
        const auto other = queue.take();
        QVERIFY(other && other->id == 4);
        running->cancelled->store(false);
        QVERIFY(!queue.cancel(2) && !running->cancelled->load()); // it has ended
        QVERIFY(!other->cancelled->load());
        QCOMPARE(drain(queue), (QList<quint64>{1, 5}));
    }

    void nothingGoesIntoAClosedOne()
    {
        JobQueue queue;
        fill(queue);
        const auto running = queue.take();
        int orders = 0;
        queue.pushOrder([&] { ++orders; });
        QCOMPARE(idsOf(queue.close()), (QList<quint64>{1, 3, 4, 5}));
        QVERIFY(running->cancelled->load());
        QueuedJob late = job(6, Priority::Click);
        QVERIFY(!queue.push(late));
        QCOMPARE(late.id, JobId(6));
        QVERIFY(late.job); // still there to be refused
        queue.pushOrder([&] { ++orders; });
        for (const JobQueue::Order &order : queue.takeOrders())
            order();
        QCOMPARE(orders, 1);
        QVERIFY(queue.takeOrders().empty());
        QVERIFY(queue.close().empty());
    }

    void takesAll()
    {
        JobQueue queue;
        fill(queue);
        QCOMPARE(idsOf(queue.takeAll()), (QList<quint64>{1, 2, 3, 4, 5}));
        QVERIFY(!queue.take());
        QueuedJob later = job(6, Priority::Scan);
        QVERIFY(queue.push(later)); // it is not closed
    }

    /// A job that came before the wait, and one that comes during it, end it.
    void waitsNoLongerThanThereIsNothingToDo()
    {
        JobQueue queue;
        QElapsedTimer time;
        time.start();
        QueuedJob early = job(1, Priority::Scan);
        QVERIFY(queue.push(early));
        queue.wait(1h);
        std::thread other([&] {
            QueuedJob one = job(2, Priority::Scan);
            queue.push(one);
        });
        queue.wait(1h);
        other.join();
        queue.wake();
        queue.wait(1h);
        queue.wait(1ms); // nothing: ends by itself
        QVERIFY(time.elapsed() < 60'000);
    }
};

DYNASCOPE_CORE_TEST(TestJobQueue)
#include "tst_jobqueue.moc"
