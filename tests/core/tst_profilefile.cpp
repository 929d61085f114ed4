// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/profile/profilesave.h"
#include "core/session/profile/profilevalues.h"
#include "core/yaml/yamltree.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/testmain.h"

#include <QElapsedTimer>
#include <QFile>
#include <QTemporaryDir>

using namespace dynascope;
using namespace Qt::StringLiterals;

namespace {

/// A profile of one joint with these registers, from line 8 on.
QByteArray withRegisters(const QByteArray &registers, const QByteArray &model = "XM430-W350")
{
    return "profile: 1\njoints:\n  - name: a\n    model: " + model + "\n    id: 1\n    baud: 57600\n    registers:\n"
           + registers;
}

QByteArray joint(const QByteArray &name, int id)
{
    return "  - { name: " + name + ", model: XM430-W350, id: " + QByteArray::number(id) + ", baud: 57600 }\n";
}

} // namespace

/// What a profile's text means, and every way in which it is refused: with file, line and column.
class TestProfileFile : public QObject
{
    Q_OBJECT

private slots:
    void reads()
    {
        const auto profile = profileFromYaml(R"(profile: 1
name: arm
defaults:
  all:
    Return Delay Time: 0
    Temperature Limit: 70 °C
  XM430-W350:
    Temperature Limit: 75 degC
joints:
  - name: shoulder   # the heavy one
    model: XM430-W350
    id: 11
    baud: 1000000
    firmware: 45
    registers:
      max position limit: 180 deg
      Position P Gain: 0x320
      Operating Mode: 'Extended position control'
      Shutdown: Overload, Overheating
  - { name: wrist, model: xl430w250, id: 12, baud: 1000000 }
)",
                                             u"f.yaml"_s, m_catalog);
        QVERIFY2(profile, profile ? "" : qPrintable(profile.error().text));
        QCOMPARE(profile->name, u"arm"_s);
        QCOMPARE(profile->joints.size(), 2U);
        const ProfileJoint &shoulder = profile->joints[0];
        QCOMPARE(shoulder.firmware, 45);
        QCOMPARE(shoulder.registers.size(), 6U);
        const ControlTablePtr table = m_catalog.find(shoulder.modelNumber, 45);
        const auto wanted = wantedValues(shoulder, *table, {});
        const auto rawOf = [&](QStringView name) -> std::int64_t {
            for (const WantedValue &each : wanted) {
                if (each.field && each.field->name == name)
                    return each.raw.value_or(-1);
            }
            return -2;
        };
        QCOMPARE(rawOf(u"Max Position Limit"), 2048);
        QCOMPARE(rawOf(u"Position P Gain"), 800);
        QCOMPARE(rawOf(u"Operating Mode"), 4);
        QCOMPARE(rawOf(u"Shutdown"), 36);
        QCOMPARE(rawOf(u"Temperature Limit"), 75); // the model's goes before that of all
        QCOMPARE(rawOf(u"Return Delay Time"), 0);
        const ProfileRegister *limit = shoulder.find(u"Max Position Limit");
        QCOMPARE(limit->line, 16);
        QCOMPARE(limit->column, 27);
        QVERIFY(!limit->isShared && shoulder.find(u"Return Delay Time")->isShared);
        const ProfileJoint &wrist = profile->joints[1];
        QCOMPARE(wrist.model, u"XL430-W250"_s);
        QCOMPARE(wrist.find(u"temperature_limit")->text, u"70 °C"_s);
        QCOMPARE(profile->baudRates(), std::vector<int>{1'000'000});
    }

    /// A unit that another register decides is only wrong once that one is known.
    void waitsForWhatDecides()
    {
        const QByteArray time = "      Profile Velocity: 200 ms\n";
        QVERIFY(profileFromYaml(withRegisters(time), u"f"_s, m_catalog));
        const auto with =
            profileFromYaml(withRegisters(time + "      Drive Mode: Time-based profile\n"), u"f"_s, m_catalog);
        QVERIFY2(with, with ? "" : qPrintable(with.error().text));
        const auto without = profileFromYaml(withRegisters(time + "      Drive Mode: None\n"), u"f"_s, m_catalog);
        QVERIFY(!without);
        QVERIFY2(without.error().text.startsWith(u"f:8:25: "), qPrintable(without.error().text));
    }

    void refused_data()
    {
        QTest::addColumn<QByteArray>("yaml");
        QTest::addColumn<QString>("says");
        const auto row = [](const char *name, const QByteArray &yaml, const char *says) {
            QTest::newRow(name) << yaml << QString::fromUtf8(says);
        };
        const QByteArray head = "profile: 1\njoints:\n";
        row("empty", "", "f.yaml: empty");
        row("a word", "hello", "f.yaml:1:1: a profile is made of");
        row("a list", "- 1\n", "f.yaml:1:1: a profile is made of");
        row("bytes", QByteArray("profile: \xff\xfe 1", 13), "f.yaml: not a text");
        row("zeros", QByteArray("profile: 1\n\0", 12), "f.yaml: not a text");
        row("no version", "joints: []\n", "f.yaml:1:1: \"profile: 1\" is missing");
        row("another version", "profile: 2\njoints: []\n", "f.yaml:1:10: profile is 1 here, not \"2\"");
        row("version is a list", "profile: [1]\njoints: []\n", "f.yaml:1:10: profile is 1 here");
        row("no joints", "profile: 1\n", "\"joints\" are missing");
        row("joints are a word", "profile: 1\njoints: all\n", "f.yaml:2:9: joints are a list");
        row("joints are nothing", "profile: 1\njoints:\n", "joints are a list");
        row("unknown key", "profile: 1\nspeed: 3\njoints: []\n", "f.yaml:2:1: \"speed\" is no key of a profile");
        row("name is a list", "profile: 1\nname: [a]\njoints: []\n", "f.yaml:2:7: name is a text");
        row("joint is a word", head + "  - shoulder\n", "f.yaml:3:5: a joint is made of");
        row("unknown key of a joint", head + "  - name: a\n    modle: X\n",
            "f.yaml:4:5: \"modle\" is no key of a joint");
        row("joint without a model", head + "  - name: a\n    id: 1\n    baud: 57600\n",
            "f.yaml:3:5: \"model\" of this joint is missing");
        row("unknown model", head + "  - { name: a, model: XM999, id: 1, baud: 57600 }\n",
            "f.yaml:3:23: no model is called XM999");
        row("id too high", head + joint("a", 253), "f.yaml:3:39: id is a whole number from 0 to 252, not \"253\"");
        row("id is a word", head + "  - { name: a, model: XM430-W350, id: one, baud: 57600 }\n",
            "f.yaml:3:39: id is a whole number");
        row("baud of no model", head + "  - { name: a, model: XM430-W350, id: 1, baud: 12345 }\n",
            "f.yaml:3:48: XM430-W350 has no baud rate of 12345; its rates are 9600, 57600");
        row("firmware out of range", head + "  - { name: a, model: XM430-W350, id: 1, baud: 57600, firmware: 256 }\n",
            "firmware is a whole number from 0 to 255");
        row("name twice", head + joint("a", 1) + joint("a", 2), "f.yaml:4:13: the joint of line 3 is called a, too");
        row("id twice", head + joint("a", 1) + joint("b", 1),
            "f.yaml:4:5: ID 1 at 57600 bps is that of a (line 3), too");
        row("name over lines", head + "  - name: \"a\\nb\"\n    model: XM430-W350\n    id: 1\n    baud: 57600\n",
            "f.yaml:3:11: name is a text of one line");
        row("unknown register", withRegisters("      Position Gain: 1\n"),
            "f.yaml:8:7: XM430-W350 has no register \"Position Gain\"; nearest: Max Position Limit");
        row("register of another model", withRegisters("      Goal Current: 1\n", "XL430-W250"),
            "f.yaml:8:7: XL430-W250 has no register \"Goal Current\"");
        row("register of older firmware",
            "profile: 1\njoints:\n  - name: a\n    model: XM430-W350\n    id: 1\n    baud: 57600\n    firmware: 40\n"
            "    registers:\n      Acceleration Limit: 3\n",
            "f.yaml:9:7: XM430-W350 has no register \"Acceleration Limit\" at firmware 40 or newer");
        row("register twice", withRegisters("      LED: 1\n      led: 0\n"),
            "f.yaml:9:7: led stands in line 8 already");
        row("same key twice", withRegisters("      LED: 1\n      LED: 0\n"), "f.yaml:9:7: this key stands twice");
        row("registers are a list", withRegisters("      - LED\n"), "f.yaml:8:7: registers are");
        row("value is a list", withRegisters("      LED: [1]\n"), "f.yaml:8:12: LED needs one value");
        row("no value", withRegisters("      LED:\n"), "LED needs one value");
        row("value over lines", withRegisters("      LED: >\n        1\n"),
            "f.yaml:8:12: the value of LED stands in one line");
        row("long value", withRegisters("      LED: " + QByteArray(300, '1') + "\n"),
            "f.yaml:8:12: the value of LED is too long");
        row("out of range", withRegisters("      Position P Gain: 16384\n"),
            "f.yaml:8:24: Position P Gain can't be 16384; its range is 0 to 16383");
        row("out of range in degrees", withRegisters("      Max Position Limit: 400 deg\n"),
            "f.yaml:8:27: Max Position Limit can't be");
        row("beyond a limit of the profile",
            withRegisters("      Velocity Limit: 100\n      Drive Mode: 0\n      Profile Velocity: 101\n",
                          "PH42-020-S300-R"),
            "f.yaml:10:25: Profile Velocity can't be 101");
        row("no value of it", withRegisters("      Operating Mode: Flying\n"),
            "f.yaml:8:23: \"Flying\" is no value of Operating Mode");
        row("another unit", withRegisters("      Max Position Limit: 3 V\n"),
            "f.yaml:8:27: \"V\" does not fit Max Position Limit");
        row("fraction", withRegisters("      Position P Gain: 1.5\n"),
            "f.yaml:8:24: Position P Gain takes a whole number");
        row("read only", withRegisters("      Present Position: 1\n"), "f.yaml:8:7: Present Position can't be written");
        row("torque", withRegisters("      Torque Enable: 1\n"), "f.yaml:8:7: Torque Enable would move the motor");
        row("goal", withRegisters("      Goal Position: 1\n"), "f.yaml:8:7: Goal Position would move the motor");
        row("goal of a wheel", withRegisters("      Moving Speed: 1\n", "XL-320"), "would move the motor");
        row("indirect data", withRegisters("      Indirect Data 1: 1\n"),
            "f.yaml:8:7: Indirect Data 1 would move the motor");
        row("id as a register", withRegisters("      ID: 2\n"), "f.yaml:8:7: ID is said by the joint's");
        row("baud as a register", withRegisters("      Baud Rate: 1\n"),
            "f.yaml:8:7: Baud Rate is said by the joint's");
        row("protocol", withRegisters("      Protocol Type: 1\n"),
            "f.yaml:8:7: Protocol Type makes the device do something");
        row("mute", withRegisters("      Status Return Level: 0\n"), "f.yaml:8:28: at Status Return Level 0");
        row("defaults are a list", "profile: 1\ndefaults: [1]\njoints: []\n",
            "f.yaml:2:11: defaults have a model's name");
        row("defaults of nobody", "profile: 1\ndefaults: { XL320: { LED: 1 } }\njoints:\n" + joint("a", 1),
            "f.yaml:2:13: no joint is a XL320");
        row("defaults that nobody has", "profile: 1\ndefaults: { all: { Speed: 1 } }\njoints:\n" + joint("a", 1),
            "f.yaml:2:20: no joint's model has a register \"Speed\"");
        row("a wrong default, said once",
            "profile: 1\ndefaults: { all: { Position P Gain: -1 } }\njoints:\n" + joint("a", 1) + joint("b", 2),
            "f.yaml:2:37: Position P Gain can't be -1");
        row("bad syntax", "profile: 1\njoints: [\n", "f.yaml:");
        row("tabs", "profile: 1\njoints:\n\t- name: a\n", "f.yaml:3:2");
        row("alias", "profile: *a\n", "f.yaml:1:10: ");
        row("anchor", "profile: &a 1\n", "anchors are not taken");
        row("tag", "profile: !!int 1\n", "tags are not taken");
        row("two documents", "profile: 1\njoints: []\n---\nprofile: 1\n", "f.yaml: more than one document");
        row("much too deep", QByteArray(100'000, '['), "f.yaml:1:");
        row("too large", QByteArray(MaximumYamlSize + 1, ' '), "f.yaml: larger than");
        QByteArray many = head;
        for (int i = 0; i < 1001; ++i)
            many += "  - a\n";
        row("too many joints", many, "f.yaml:3:3: more than 1000 joints");
    }
    void refused()
    {
        QFETCH(QByteArray, yaml);
        QFETCH(QString, says);
        const auto profile = profileFromYaml(yaml, u"f.yaml"_s, m_catalog);
        QVERIFY(!profile);
        QCOMPARE(profile.error().kind, ErrorKind::BadFile);
        QVERIFY2(profile.error().text.contains(says), qPrintable(profile.error().text));
        QVERIFY2(!profile.error().text.contains(u"b.yaml"), qPrintable(profile.error().text));
    }

    void saysTenFaults()
    {
        QByteArray registers;
        for (int i = 0; i < 30; ++i)
            registers += "      Nonsense " + QByteArray::number(i) + ": 1\n";
        const auto profile = profileFromYaml(withRegisters(registers), u"f"_s, m_catalog);
        QVERIFY(!profile);
        const QStringList lines = profile.error().text.split(u'\n');
        QCOMPARE(lines.size(), 11);
        QVERIFY(lines[9].startsWith(u"f:17:7: "));
        QCOMPARE(lines[10], u"f: and 20 more"_s);
    }

    void noise()
    {
        const QTemporaryDir folder;
        const QString path = folder.filePath(u"noise.yaml"_s);
        QFile file(path);
        QVERIFY(file.open(QIODevice::WriteOnly));
        QVERIFY(file.resize(100'000'000)); // mostly a hole, and read it is not
        file.close();
        QElapsedTimer timer;
        timer.start();
        const auto profile = loadProfile(path, m_catalog);
        QVERIFY2(timer.elapsed() < 500, qPrintable(QString::number(timer.elapsed())));
        QVERIFY(!profile);
        QVERIFY2(profile.error().text.contains(u"larger than"), qPrintable(profile.error().text));
        QVERIFY(!profileText(path));
        QCOMPARE(loadProfile(folder.filePath(u"none"_s), m_catalog).error().kind, ErrorKind::NotFound);
        QCOMPARE(loadProfile(folder.path(), m_catalog).error().kind, ErrorKind::BadFile);
    }

    void examples()
    {
        const QDir folder(QStringLiteral(DYNASCOPE_SOURCE_DIR "/resources/profiles"));
        const QStringList files = folder.entryList({u"*.yaml"_s});
        QVERIFY(!files.isEmpty());
        for (const QString &file : files) {
            const auto profile = loadProfile(folder.filePath(file), m_catalog);
            QVERIFY2(profile, profile ? "" : qPrintable(profile.error().text));
        }
    }

    void faultsGoFromTopToBottom()
    {
        const auto profile = profileFromYaml(
            withRegisters("      Max Position Limit: 500 deg\n      Position P Gainz: 1\n"), u"f.yaml"_s, m_catalog);
        QVERIFY(!profile);
        const QStringList faults = profile.error().text.split(u'\n');
        QCOMPARE(faults.size(), 2);
        QVERIFY2(faults[0].contains(u"Max Position Limit"), qPrintable(faults[0]));
        QVERIFY2(faults[1].contains(u"Position P Gainz"), qPrintable(faults[1]));
    }

private:
    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestProfileFile)
#include "tst_profilefile.moc"
