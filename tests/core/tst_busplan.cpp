// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/busplan.h"
#include "core/sim/servo.h"
#include "core/yaml/yamltree.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/testmain.h"

#include <QDir>
#include <QFile>

using namespace dynascope;
using namespace dynascope::sim;
using namespace std::chrono_literals;

namespace {

const QByteArray Device = "format: 1\ndevices:\n  - { model: XM430-W350, id: 1 }\n";

} // namespace

/// Buses as files: what they say, and what is refused with file, line and column.
class TestBusPlan : public QObject
{
    Q_OBJECT

private slots:
    void all()
    {
        const auto plan = readBusPlan(R"(# a comment
format: 1
seed: 99
temperature: 30
faults:
  - latency=16ms
  - "drop:3=0.02"
devices:
  - model: xm430w350
    firmware: 44
    baud: 1000000
    id: 3
    name: elbow
    supply: 11.5
    registers:
      Return Delay Time: 0
      Operating Mode: 4
      Homing Offset: -100
    load: { gravity: 0.45, inertia: 0.006, torque: -0.1, angle: 90 }
  - { model: XL330-M288, id: 0x07 }
)", QStringLiteral("arm.yaml"), m_catalog);
        QVERIFY2(plan, qPrintable(plan ? QString() : plan.error().text));
        QCOMPARE(plan->seed, std::optional<std::uint64_t>(99));
        QCOMPARE(plan->faults.latencyTimer, LineTime(16ms));
        QCOMPARE(plan->faults.replies.size(), std::size_t(1));
        const std::vector<ServoSpec> specs{plan->devices[0].spec, plan->devices[1].spec};
        QVERIFY((specs == std::vector<ServoSpec>{{QStringLiteral("XM430-W350"), 44, 1000000, 3},
                                                 {QStringLiteral("XL330-M288"), -1, 57600, 7}}));
        QCOMPARE(namesOf(*plan), (QStringList{QStringLiteral("elbow"), QString()}));

        const auto bus = makeBus(*plan, m_catalog);
        QVERIFY2(bus, qPrintable(bus ? QString() : bus.error().text));
        Servo &elbow = *(*bus)->servos()[0];
        QCOMPARE(elbow.value(u"Return Delay Time"), 0);
        QCOMPARE(elbow.value(u"Homing Offset"), -100);
        QCOMPARE(elbow.value(u"Operating Mode"), 4);
        QCOMPARE(elbow.value(u"Present Position"), 1024 - 100);
        QCOMPARE((*bus)->faults().seed, std::uint64_t(99));
    }

    void wrong_data()
    {
        QTest::addColumn<QByteArray>("yaml");
        QTest::addColumn<QString>("says");
        const auto row = [](const char *name, const QByteArray &yaml, const char *says) {
            QTest::newRow(name) << yaml << QString::fromLatin1(says);
        };
        row("empty", "", "empty");
        row("a word", "hello", "f.yaml:1:1");
        row("no format", "devices:\n  - {}\n", "\"format\" must be 1");
        row("another format", "format: 2\n", "f.yaml:1:9: \"format\"");
        row("no devices", "format: 1\n", "\"devices\"");
        row("unknown key", Device + "colour: red\n", "f.yaml:4:1: \"colour\"");
        row("unknown key of a device", "format: 1\ndevices:\n  - model: XM430-W350\n    di: 1\n", "f.yaml:4:5: \"di\"");
        row("key twice", "format: 1\nformat: 1\n", "f.yaml:2:1: this key stands twice");
        row("no id", "format: 1\ndevices:\n  - model: XM430-W350\n", "\"model\" and \"id\"");
        row("unknown model", "format: 1\ndevices:\n  - model: XM999\n    id: 1\n", "f.yaml:3:12: no model is called XM999");
        row("a rate it doesn't have", "format: 1\ndevices:\n  - model: XM430-W350\n    id: 1\n    baud: 57601\n",
            "f.yaml:5:11: the rates of XM430-W350 are");
        row("id too high", "format: 1\ndevices:\n  - { model: XM430-W350, id: 253 }\n", "f.yaml:3:30: a whole number");
        row("two ids for one axis", "format: 1\ndevices:\n  - { model: XM430-W350, id: [1, 2] }\n", "one axis");
        row("unknown register", "format: 1\ndevices:\n  - { model: XM430-W350, id: 1, registers: { Speed: 1 } }\n",
            "f.yaml:3:46: XM430-W350 has no register Speed");
        row("its ID among the registers", "format: 1\ndevices:\n  - { model: XM430-W350, id: 1, registers: { ID: 1 } }\n",
            "is said by");
        row("load that is no number", "format: 1\ndevices:\n  - { model: XM430-W350, id: 1, load: { inertia: much } }\n",
            "f.yaml:3:50: a number");
        row("not a number", "format: 1\ndevices:\n  - { model: XM430-W350, id: 1, load: { inertia: .nan } }\n", "a number");
        row("stops the wrong way round", "format: 1\ndevices:\n  - { model: XM430-W350, id: 1, load: { stops: [9, 3] } }\n",
            "lowest");
        row("unknown fault", "format: 1\nfaults: [echo, nonsense]\n", "f.yaml:2:16: \"nonsense\"");
        row("a name that is an ID", "format: 1\ndevices:\n  - { model: XM430-W350, id: 1, name: 7 }\n", "a name is one word");
        row("one name twice", "format: 1\ndevices:\n  - { model: XM430-W350, id: 1, name: a }\n"
                              "  - { model: XM430-W350, id: 2, name: a }\n", "f.yaml:4:39: the name a stands twice");
        row("anchor", "format: &a 1\n", "anchors");
        row("alias", "format: 1\nseed: *a\n", "f.yaml:2:7");
        row("tag", "format: !!int 1\n", "tags");
        row("two documents", Device + "---\nformat: 1\n", "more than one document");
        row("bad syntax", "format: [1\n", "f.yaml:");
        row("too deep", QByteArray(13, '[') + QByteArray(13, ']'), "nested too deep");
        row("much too deep", QByteArray(100'000, '['), "f.yaml:1:");
        row("too large", QByteArray(MaximumYamlSize + 1, ' '), "larger than");
        row("binary", QByteArray("format: 1\0", 10), "not a text");
    }

    void wrong()
    {
        QFETCH(QByteArray, yaml);
        QFETCH(QString, says);
        const auto plan = readBusPlan(yaml, QStringLiteral("f.yaml"), m_catalog);
        QVERIFY(!plan);
        QVERIFY2(plan.error().text.contains(says), qPrintable(plan.error().text));
        QVERIFY2(plan.error().text.startsWith(QStringLiteral("f.yaml:")), qPrintable(plan.error().text));
    }

    void aRegisterThatRefuses()
    {
        const auto plan = readBusPlan("format: 1\ndevices:\n  - { model: XM430-W350, id: 1, registers: { LED: 2 } }\n",
                                      QStringLiteral("f.yaml"), m_catalog);
        QVERIFY(plan);
        const auto bus = makeBus(*plan, m_catalog);
        QVERIFY(!bus);
        QVERIFY2(bus.error().text.contains(QStringLiteral("f.yaml:3:51")), qPrintable(bus.error().text));
    }

    void examples_data()
    {
        QTest::addColumn<QString>("path");
        const QDir folder(QStringLiteral(DYNASCOPE_SOURCE_DIR "/resources/buses"));
        for (const QString &name : folder.entryList({QStringLiteral("*.yaml")}))
            QTest::newRow(qPrintable(name)) << folder.filePath(name);
    }

    void examples()
    {
        QFETCH(QString, path);
        QFile file(path);
        QVERIFY(file.open(QIODevice::ReadOnly));
        const auto plan = readBusPlan(file.readAll(), path, m_catalog);
        QVERIFY2(plan, qPrintable(plan ? QString() : plan.error().text));
        const auto bus = makeBus(*plan, m_catalog);
        QVERIFY2(bus, qPrintable(bus ? QString() : bus.error().text));
    }

    /// Every model of the resources, without a line of code for it.
    void everyModelCanBeServed()
    {
        for (const Catalog::ModelInfo &model : m_catalog.models()) {
            if (model.addressesOnly)
                continue;
            const auto &description = m_catalog.find(model.modelNumber, model.newestFirmware)->description();
            ServoSpec spec{model.model, -1, description.baudCodes.front().rate, 1, description.axes == 2 ? 2 : -1};
            SimulatedBus bus(m_catalog);
            const auto servo = bus.add(spec);
            QVERIFY2(servo, qPrintable(model.model));
            QCOMPARE((*servo)->value(u"Model Number"), model.modelNumber);
            bus.advanceTo(1s);
        }
    }

private:
    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestBusPlan)
#include "tst_busplan.moc"
