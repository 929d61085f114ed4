// SPDX-License-Identifier: GPL-3.0-or-later
// Every model of the library as `dxl sim` serves it on a terminal: found by a scan, read whole, one register of each
// kind written and read back, through a serial line as with hardware.
#include "core/bus/scan.h"
#include "core/bus/seriallinefactory.h"
#include "core/table/catalog.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/dxlprocess.h"
#include "tests/support/modelwalk.h"
#include "tests/support/testmain.h"

using namespace Qt::StringLiterals;
using namespace dynascope;
using namespace dynascope::test;

namespace {

constexpr int BaudRate = 1'000'000;    ///< the fastest that all of them know
constexpr std::size_t ModelsABus = 19; ///< a process each: four
constexpr int MostRepeats = 20;
constexpr std::chrono::milliseconds Patience{
    400}; ///< a loaded machine may take its time: nobody is called silent for that

/// A model on the bus, at its (first) ID.
struct Placed {
    Catalog::ModelInfo info;
    ControlTablePtr table;
    std::uint8_t id = 1;
};

} // namespace

class TestDxlSimLibrary : public QObject
{
    Q_OBJECT

    const Catalog m_catalog = builtInCatalog();

    std::vector<Catalog::ModelInfo> simulated() const
    {
        std::vector<Catalog::ModelInfo> models = m_catalog.models();
        std::erase_if(models, [](const Catalog::ModelInfo &info) { return info.addressesOnly; });
        return models;
    }

    std::vector<Placed> placed(std::size_t first) const
    {
        const std::vector<Catalog::ModelInfo> models = simulated();
        std::vector<Placed> all;
        int id = 1;
        for (std::size_t i = first; i < std::min(first + ModelsABus, models.size()); ++i) {
            all.push_back({models[i], m_catalog.find(models[i].modelNumber, 255), static_cast<std::uint8_t>(id)});
            id += all.back().table->axes();
        }
        return all;
    }

private slots:
    void everyModel_data()
    {
        QTest::addColumn<int>("first");
        const std::vector<Catalog::ModelInfo> models = simulated();
        QCOMPARE(models.size(), std::size_t(74));
        for (std::size_t i = 0; i < models.size(); i += ModelsABus)
            QTest::addRow("from %s on", qPrintable(models[i].model)) << int(i);
    }

    void everyModel()
    {
        QFETCH(int, first);
        const std::vector<Placed> models = placed(std::size_t(first));
        QStringList devices;
        std::size_t ids = 0;
        for (const Placed &one : models) {
            const QString place = u"%1@%2:%3"_s.arg(one.info.model).arg(BaudRate).arg(one.id);
            devices << (one.table->axes() == 2 ? u"%1+%2"_s.arg(place).arg(one.id + 1) : place);
            ids += std::size_t(one.table->axes());
        }
        SimProcess sim(devices.join(u','));
        QVERIFY2(!sim.path().isEmpty(), qPrintable(sim.errors()));
        auto line = SerialLineFactory({Patience}).open(sim.path(), BaudRate);
        QVERIFY2(line, line ? "" : qPrintable(line.error().text));
        Bus bus(**line);
        const auto found = scanBaud(bus, {}, {});
        QVERIFY2(found, found ? "" : qPrintable(found.error().text));
        QCOMPARE(found->devices.size(), ids);
        for (const Placed &one : models) {
            const auto device = std::find_if(found->devices.begin(), found->devices.end(),
                                             [&](const Found &each) { return each.id == one.id; });
            QVERIFY2(device != found->devices.end(), qPrintable(one.info.model));
            QCOMPARE(device->modelNumber, one.info.modelNumber);
            QCOMPARE(int(device->firmware), one.info.newestFirmware);
            QVERIFY2(device->doubt.isEmpty(), qPrintable(device->doubt));
            walk(bus, one);
        }
        QCOMPARE(sim.interrupt().code, 0);
    }

private:
    /// A machine at work elsewhere may let a terminal wait for longer than anybody asks again: only that is tried anew.
    template <typename Step>
    static void check(const Placed &one, const Step &step)
    {
        Result<void> done = step();
        for (int again = 0; again < MostRepeats && !done && done.error().kind != ErrorKind::NotConfirmed
                            && done.error().kind != ErrorKind::Refused;
             ++again)
            done = step();
        QVERIFY2(done, done ? "" : qPrintable(one.info.model + u": "_s + done.error().text));
    }

    static void walk(Bus &bus, const Placed &one)
    {
        Bytes image;
        check(one, [&] {
            const auto whole = readWhole(bus, one.id, *one.table);
            image = whole.value_or(Bytes());
            return whole ? Result<void>() : tl::unexpected(whole.error());
        });
        QVERIFY(!image.empty());
        const std::vector<const Field *> fields = oneOfEachKind(*one.table);
        QVERIFY2(fields.size() > 3, qPrintable(one.info.model));
        for (const Field *field : fields)
            check(one, [&] { return writeAndReadBack(bus, one.id, *one.table, *field, image); });
    }
};

DYNASCOPE_CORE_TEST(TestDxlSimLibrary)
#include "tst_dxlsimlibrary.moc"
