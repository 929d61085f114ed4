// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/indirectreads.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/sessionfixture.h"
#include "tests/support/testmain.h"

#include <QFile>
#include <QSignalSpy>
#include <QTemporaryDir>

using namespace dynascope;
using namespace Qt::StringLiterals;

namespace {

constexpr int Rate = 57600;

/// One line with a servo on it, read by indirect addresses; the program may be ended and started again.
struct World {
    explicit World(const Catalog &catalog, const QString &servo = u"XM430-W350@57600:1"_s)
        : all(catalog, servo, &journal)
    {
        start();
        all.open(Rate);
    }
    void start()
    {
        monitor = std::make_unique<Monitor>(all.session);
        settings = std::make_unique<SettingsCommands>(all.session, all.commands);
        reads = std::make_unique<IndirectReads>(all.session, *monitor, *settings, folder.path());
        QObject::connect(reads.get(), &IndirectReads::told, reads.get(), [this](const QString &text) { told << text; });
        QObject::connect(reads.get(), &IndirectReads::leftFound, reads.get(), [this] { ++leftFound; });
    }
    /// As if it were killed: nothing is put back, and what comes next knows the file only.
    void end()
    {
        all.close();
        reads.reset();
        settings.reset();
        monitor.reset();
    }
    Device &device() { return *all.line->devices().front(); }
    int field(const QString &name) { return device().table().indexOf(name); }
    void watch(const QStringList &names)
    {
        for (const QString &name : names)
            monitor->watch({device().key(), field(name)});
    }
    std::size_t samples(const QString &name)
    {
        const History *history = monitor->history({device().key(), field(name)});
        return history ? history->size() : 0;
    }
    std::int64_t last(const QString &name) { return monitor->history({device().key(), field(name)})->last().raw; }
    bool isPacked() { return VirtualSession::waitFor([&] { return reads->packedDevices(*all.line) == 1; }); }
    bool isIdle() { return VirtualSession::waitFor([&] { return !reads->isBusy(*all.line); }); }
    bool isReadNow(const QString &name)
    {
        const std::size_t before = samples(name);
        return VirtualSession::waitFor([&] { return samples(name) > before + 50; });
    }
    /// How many entries hold something other than at first; while the line is closed.
    int setEntries()
    {
        sim::Servo &servo = *all.factory.simulated.servos().front();
        int set = 0;
        for (const Field &each : servo.table().fields()) {
            if (each.name.startsWith(u"Indirect Address "_s) && servo.value(each.name) != each.initial.value_or(0))
                ++set;
        }
        return set;
    }
    QStringList files() const { return QDir(folder.path()).entryList(QDir::Files); }

    QTemporaryDir folder;
    Journal journal;
    VirtualSession all;
    std::unique_ptr<Monitor> monitor;
    std::unique_ptr<SettingsCommands> settings;
    std::unique_ptr<IndirectReads> reads;
    QStringList told;
    int leftFound = 0;
};

const QStringList Scattered{u"Position P Gain"_s, u"Goal PWM"_s, u"Present Temperature"_s};

} // namespace

/// Scattered registers by way of indirect addresses: right, put back, and never wrong.
class TestIndirectReads : public QObject
{
    Q_OBJECT

    const Catalog m_catalog = test::builtInCatalog();

private slots:
    void readAndPutBack_data()
    {
        QTest::addColumn<QString>("servo");
        QTest::newRow("X") << u"XM430-W350@57600:1"_s;
        QTest::newRow("XL330, firmware 51") << u"XL330-M288/51@57600:1"_s;
        QTest::newRow("XL330, firmware 52") << u"XL330-M288/52@57600:1"_s;
    }
    void readAndPutBack()
    {
        QFETCH(QString, servo);
        World world(m_catalog, servo);
        world.watch(Scattered);
        QVERIFY(world.isReadNow(Scattered.front()));
        std::vector<std::int64_t> direct;
        for (const QString &name : Scattered)
            direct.push_back(world.last(name));
        const auto forecast = world.reads->forecast(*world.all.line);
        QVERIFY2(forecast.devices == 1, qPrintable(forecast.obstacle));
        const auto rateOf = [](const PolledLine &line) {
            return predictPoll(line.plan, line.baudRate, line.delays, line.silent).cycleRate;
        };
        QVERIFY(rateOf(forecast.with) > rateOf(forecast.without) * 1.2);
        world.reads->setOn(*world.all.line, true);
        QVERIFY2(world.isPacked(), qPrintable(world.told.join(u' ')));
        QCOMPARE(world.files().size(), 1);
        for (const QString &name : Scattered)
            QVERIFY(world.isReadNow(name));
        for (std::size_t i = 0; i < direct.size(); ++i)
            QCOMPARE(world.last(Scattered[qsizetype(i)]), direct[i]);
        QCOMPARE(std::ranges::count(world.all.line->pollPlan().spans, std::chrono::milliseconds(0),
                                    &PollSpan::interval), 1);
        QVERIFY(world.journal.entries().back().by == JournalAuthor::Packing);

        world.reads->setOn(*world.all.line, false);
        QVERIFY(world.isIdle());
        QCOMPARE(world.reads->packedDevices(*world.all.line), 0);
        QVERIFY(world.isReadNow(Scattered.front())); // one by one again
        QVERIFY(world.files().isEmpty());
        QVERIFY2(world.told.isEmpty(), qPrintable(world.told.join(u' ')));
        world.all.close();
        QCOMPARE(world.setEntries(), 0);
    }

    void whatIsWatchedChanges()
    {
        World world(m_catalog);
        world.watch(Scattered);
        world.reads->setOn(*world.all.line, true);
        QVERIFY(world.isPacked());
        world.watch({u"Profile Velocity"_s});
        const int field = world.field(u"Profile Velocity"_s);
        QVERIFY(VirtualSession::waitFor([&] {
            const IndirectPacking *packing = world.all.line->packing(world.device().key());
            return packing && packing->addressOf(field) >= 0;
        }));
        QVERIFY(world.isReadNow(u"Goal PWM"_s));
        QCOMPARE(world.last(u"Goal PWM"_s), 885);
        QCOMPARE(world.last(u"Profile Velocity"_s), 0);
    }

    /// Its entries are gone with the power, and what stands in the stretch then is nobody's value.
    void restartedItIsReadOneByOne()
    {
        World world(m_catalog);
        world.watch(Scattered);
        world.reads->setOn(*world.all.line, true);
        QVERIFY(world.isPacked());
        QVERIFY(world.isReadNow(u"Goal PWM"_s));
        int wrong = 0;
        connect(world.all.line, &LineSession::batchTaken, this, [&](const Batch &batch) {
            for (const PollValue &value : batch.values) {
                const Field *field = world.device().table().at(value.address);
                if (!value.data.empty() && field->name == u"Goal PWM"_s)
                    wrong += rawFromBytes(*field, value.data) == 885 ? 0 : 1;
            }
        });
        bool isBack = false;
        world.all.commands.reboot(world.device(), [&](const Result<void> &) { isBack = true; });
        bool isPassing = false;
        const auto passTime = [&] { // between two exchanges: within one an answer would come too late
            if (isPassing)
                return;
            isPassing = true;
            world.all.line->bus().run<void>(
                Priority::Click, nullptr,
                [&](JobContext &context) {
                    world.all.factory.passing += LineTime(std::chrono::milliseconds(200)).count();
                    world.all.factory.simulated.advanceTo(context.bus().line().now());
                    return Result<void>();
                },
                [&](const Result<void> &) { isPassing = false; });
        };
        QVERIFY(VirtualSession::waitFor([&] {
            passTime();
            return isBack && world.reads->packedDevices(*world.all.line) == 0;
        }));
        QVERIFY(VirtualSession::waitFor([&] { return !isPassing; }));
        QVERIFY(world.isIdle());
        QVERIFY(world.isReadNow(u"Goal PWM"_s));
        QCOMPARE(world.last(u"Goal PWM"_s), 885);
        QCOMPARE(wrong, 0);
        QVERIFY(world.told.join(u' ').contains(u"restarted"));
        QVERIFY(world.files().isEmpty()); // nothing is left to be put back
    }

    /// The first reading after a restart, before anything else tells of it.
    void theMarkDecides()
    {
        const ControlTablePtr table = m_catalog.find(1020, 45);
        const Device device(1, nullptr, table, {1, Rate, 1020, 45, false, {}});
        const auto fresh = [&](int index) { return table->fields()[std::size_t(index)].initial; };
        const auto packing = packIndirect(*table, {table->indexOf(u"Goal PWM")}, fresh, UsedEntries::Refuse,
                                          PackingMark::Last);
        QVERIFY(packing && packing->length == 3 && packing->mark > 0);
        PackedReads reads;
        reads.set(device, *packing, std::chrono::seconds(1));
        const auto readingOf = [&](int mark, int second) {
            Batch batch;
            PollValue value;
            value.device = 1;
            value.address = packing->address;
            value.length = packing->length;
            value.data = {0x75, 0x03, std::uint8_t(mark)};
            value.at = std::chrono::seconds(second);
            batch.values.push_back(value);
            const bool isLost = !reads.unpack(batch).empty();
            return std::pair(isLost, std::vector<PollValue>(batch.values.begin() + 1, batch.values.end()));
        };
        QVERIFY(readingOf(packing->mark, 0).second.empty()); // before it was looked at
        const auto [isLost, parts] = readingOf(packing->mark, 2);
        QVERIFY(!isLost && parts.size() == 1 && parts.front().data == Bytes({0x75, 0x03}));
        const auto [isNowLost, none] = readingOf(0, 2);
        QVERIFY(isNowLost && none.size() == 1 && none.front().data.empty());
    }

    /// Somebody writes to an entry while it is in use: what he set stays, the others are put back.
    void setByAHand()
    {
        World world(m_catalog);
        world.watch(Scattered);
        world.reads->setOn(*world.all.line, true);
        QVERIFY(world.isPacked());
        world.all.commands.writeField(world.device(), world.field(u"Indirect Address 2"_s), 65);
        QCOMPARE(world.reads->packedDevices(*world.all.line), 0); // before the packet is out
        QVERIFY(world.isIdle());
        QVERIFY(world.isReadNow(u"Goal PWM"_s));
        QCOMPARE(world.last(u"Goal PWM"_s), 885);
        world.all.close();
        QCOMPARE(world.setEntries(), 1);
        QCOMPARE(world.all.factory.simulated.servos().front()->value(u"Indirect Address 2"), 65);
    }

    void killedAndPutBack()
    {
        for (const int written : {1, 3, 6}) {
            World world(m_catalog);
            world.watch(Scattered);
            std::atomic<int> writes = 0;
            world.all.factory.onPacket = [&](int, ByteView packet) {
                writes += packet[7] == std::uint8_t(Instruction::Write) ? 1 : 0;
            };
            world.reads->setOn(*world.all.line, true);
            QVERIFY(VirtualSession::waitFor([&] { return writes >= written; }));
            world.end();
            QVERIFY(world.setEntries() >= 1);
            QCOMPARE(world.files().size(), 1);

            world.start();
            world.all.open(Rate);
            QCOMPARE(world.leftFound, 1);
            QCOMPARE(world.reads->left(*world.all.line).size(), std::size_t(1));
            QVERIFY(!world.reads->isBusy(*world.all.line)); // nothing is done by itself
            QVERIFY(VirtualSession::waitFor([&] { return world.all.line->state() == BusThread::State::Open; }));
            world.reads->putBackLeft(*world.all.line);
            QVERIFY(world.isIdle());
            QVERIFY(world.files().isEmpty());
            world.end();
            QCOMPARE(world.setEntries(), 0);
        }
    }

    void usedEntriesAreRefused()
    {
        World world(m_catalog);
        bool isWritten = false;
        world.all.commands.writeField(world.device(), world.field(u"Indirect Address 5"_s), 65,
                                      [&](const Result<void> &) { isWritten = true; });
        QVERIFY(VirtualSession::waitFor([&] { return isWritten; }));
        for (int i = 1; i <= 56; i += 5)
            world.all.commands.writeField(world.device(), world.field(u"Indirect Address %1"_s.arg(i)), 65);
        world.watch(Scattered);
        world.reads->setOn(*world.all.line, true);
        QVERIFY(VirtualSession::waitFor([&] { return !world.told.isEmpty(); }));
        QVERIFY2(world.told.front().contains(u"free"), qPrintable(world.told.front()));
        QCOMPARE(world.reads->packedDevices(*world.all.line), 0);
        world.reads->setOn(*world.all.line, true, UsedEntries::Take);
        QVERIFY(world.isPacked());
        QVERIFY(world.isReadNow(u"Goal PWM"_s));
        world.reads->setOn(*world.all.line, false);
        QVERIFY(world.isIdle());
        world.all.close();
        QCOMPARE(world.all.factory.simulated.servos().front()->value(u"Indirect Address 6"), 65);
    }

    void thoseInEepromAreLeftAlone()
    {
        World world(m_catalog, u"PM54-060-S250-R@57600:1"_s);
        world.watch({u"Goal PWM"_s, u"Present Temperature"_s});
        QVERIFY(world.isReadNow(u"Goal PWM"_s));
        const auto forecast = world.reads->forecast(*world.all.line);
        QCOMPARE(forecast.devices, 0);
        QVERIFY2(forecast.obstacle.contains(u"EEPROM"), qPrintable(forecast.obstacle));
        world.reads->setOn(*world.all.line, true);
        QVERIFY(world.isReadNow(u"Goal PWM"_s));
        QVERIFY(world.journal.entries().empty());
    }

    void damagedFilesAreRefused()
    {
        const QTemporaryDir folder;
        const IndirectFile file(folder.path(), u"/dev/ttyUSB7"_s);
        const SetEntries set{1020, 1, 57600, {{168, 224, 84}, {170, 225, 85}}};
        QVERIFY(file.save({set}));
        QCOMPARE(file.load().value(), std::vector<SetEntries>{set});
        for (const char *text : {"", "[]", "{\"devices\":3}", "{\"devices\":[{}]}",
                                 "{\"devices\":[{\"model\":1,\"id\":1,\"baud\":1,\"entries\":[[1,2]]}]}",
                                 "{\"devices\":[{\"model\":1,\"id\":1,\"baud\":1,\"entries\":[[1,2,65536]]}]}"}) {
            QFile out(file.path());
            QVERIFY(out.open(QIODevice::WriteOnly));
            out.write(text);
            out.close();
            QVERIFY2(!file.load(), text);
        }
        QVERIFY(file.save({}));
        QVERIFY(file.load().value().empty());
        QVERIFY(IndirectFile(folder.path(), u"sim"_s).path().isEmpty());
    }
};

DYNASCOPE_CORE_TEST(TestIndirectReads)
#include "tst_indirectreads.moc"
