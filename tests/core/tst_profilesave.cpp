// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/profile/profilesave.h"
#include "core/session/profile/profilevalues.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/testmain.h"

#include <QDir>
#include <QFile>
#include <QTemporaryDir>

using namespace dynascope;
using namespace Qt::StringLiterals;

namespace {

/// A device whose registers hold what the factory wrote, but for `values`.
SavedDevice deviceOf(const Catalog &catalog, const QString &model, int id,
                     const std::vector<std::pair<QString, std::int64_t>> &values, int firmware = -1)
{
    const Catalog::ModelInfo *info = catalog.model(QStringView(model));
    SavedDevice device;
    device.found.id = static_cast<std::uint8_t>(id);
    device.found.baudRate = 1'000'000;
    device.found.modelNumber = info->modelNumber;
    device.found.firmware = static_cast<std::uint8_t>(firmware < 0 ? std::max(0, info->newestFirmware) : firmware);
    const ControlTablePtr table = catalog.find(device.found.modelNumber, device.found.firmware);
    for (const Field &field : table->fields())
        device.image.take(field.address, bytesFromRaw(field, field.initial.value_or(0)));
    for (const auto &[name, raw] : values) {
        const Field *field = table->find(name);
        if (!field)
            qFatal("%s has no %s", qPrintable(model), qPrintable(name));
        device.image.take(field->address, bytesFromRaw(*field, raw));
    }
    return device;
}

constexpr const char *Written = R"(# My arm
profile: 1
name: "arm"   # in quotes
defaults:
  all: { Return Delay Time: 0 }
joints:
# the first
- model: XM430-W350
  name: shoulder # heavy
  baud: 1000000
  id: 11
  registers:
     # stiff
     position P gain:   800   # raw
     Max Position Limit: "180 deg"
     Min Position Limit: 0.5 rad   # in radians
     Operating Mode: 'Position control'   # not extended
     Shutdown: 52

- { name: wrist, model: XL430-W250, id: 12, baud: 1000000, registers: { Temperature Limit: 72 } } # flow
- name: bare
  model: XL430-W250
  id: 13
  baud: 1000000   # last
# the end
)";

} // namespace

/// From devices to the text of a profile: in place, and nothing else touched.
class TestProfileSave : public QObject
{
    Q_OBJECT

private slots:
    void newFile()
    {
        ProfileSaveOptions options;
        options.name = u"arm: left"_s;
        const auto saved = saveProfile(
            {}, u"f"_s,
            {deviceOf(m_catalog, u"XM430-W350"_s, 1,
                      {{u"Operating Mode"_s, 4}, {u"Max Position Limit"_s, 3072}, {u"Position P Gain"_s, 640},
                       {u"Homing Offset"_s, 100}, {u"LED"_s, 1}, {u"Goal Position"_s, 7}, {u"Torque Enable"_s, 1},
                       {u"Shutdown"_s, 36}, {u"Current Limit"_s, 1000}}, 45),
             deviceOf(m_catalog, u"XL430-W250"_s, 2, {})},
            m_catalog, options);
        QVERIFY2(saved, saved ? "" : qPrintable(saved.error().text));
        QCOMPARE(QString::fromUtf8(saved->text), uR"(profile: 1
name: 'arm: left'
joints:
  - name: joint 1
    model: XM430-W350
    id: 1
    baud: 1000000
    firmware: 45
    registers:
      Operating Mode: Extended position control
      Current Limit: 2690 mA
      Max Position Limit: 270 deg
      Shutdown: Overheating, Overload
      Position P Gain: 640
  - name: joint 2
    model: XL430-W250
    id: 2
    baud: 1000000
    firmware: %1
)"_s.arg(m_catalog.model(u"XL430-W250")->newestFirmware));
        QCOMPARE(saved->newJoints, 2);
        options.calibration = options.all = true;
        const auto more = saveProfile({}, u"f"_s, {deviceOf(m_catalog, u"XM430-W350"_s, 1, {{u"Homing Offset"_s, 100}})},
                                      m_catalog, options);
        QVERIFY(more && more->text.contains("Homing Offset: 8.79 deg\n") && more->text.contains("LED: Off\n"));
        QVERIFY(!more->text.contains("Goal") && !more->text.contains("Torque Enable") && !more->text.contains("Present"));
        QVERIFY(!saveProfile({}, u"f"_s, {}, m_catalog));
    }

    void inPlace()
    {
        for (const bool windows : {false, true}) {
            QByteArray text = Written;
            if (windows)
                text.replace("\n", "\r\n");
            const std::vector<SavedDevice> devices{
                deviceOf(m_catalog, u"XM430-W350"_s, 11,
                         {{u"Return Delay Time"_s, 0}, {u"Position P Gain"_s, 850}, {u"Max Position Limit"_s, 3072},
                          {u"Min Position Limit"_s, 1000}, {u"Operating Mode"_s, 4}, {u"Shutdown"_s, 36},
                          {u"Velocity Limit"_s, 100}}),
                deviceOf(m_catalog, u"XL430-W250"_s, 12,
                         {{u"Return Delay Time"_s, 0}, {u"Temperature Limit"_s, 70}, {u"Shutdown"_s, 36}}),
                deviceOf(m_catalog, u"XL430-W250"_s, 13, {{u"Return Delay Time"_s, 5}}),
                deviceOf(m_catalog, u"XL330-M288"_s, 20, {{u"Operating Mode"_s, 4}}, 52)};
            const auto saved = saveProfile(text, u"f"_s, devices, m_catalog);
            QVERIFY2(saved, saved ? "" : qPrintable(saved.error().text));
            QByteArray expected = text;
            const QByteArray end = windows ? "\r\n" : "\n";
            expected.replace("gain:   800 ", "gain:   850 ");
            expected.replace("\"180 deg\"", "\"270 deg\"");
            expected.replace("0.5 rad", "1.534 rad");
            expected.replace("'Position control'", "'Extended position control'");
            expected.replace("Shutdown: 52" + end, "Shutdown: 36" + end + "     Velocity Limit: 22.9 rev/min" + end);
            expected.replace("Limit: 72 }", "Limit: 70, Shutdown: 'Overheating, Overload' }");
            expected.replace("# last" + end, "# last" + end + "  registers:" + end + "     Return Delay Time: 5" + end
                                 + "- name: joint 20" + end + "  model: XL330-M288" + end + "  id: 20" + end
                                 + "  baud: 1000000" + end + "  firmware: 52" + end + "  registers:" + end
                                 + "     Return Delay Time: 500 us" + end + "     Operating Mode: Extended position control" + end);
            QCOMPARE(QString::fromUtf8(saved->text), QString::fromUtf8(expected));
            QCOMPARE(saved->changedValues, 6);
            QCOMPARE(saved->newJoints, 1);
            const auto again = saveProfile(saved->text, u"f"_s, devices, m_catalog);
            QVERIFY(again && !again->isChanged());
            QCOMPARE(again->text, saved->text);
        }
    }

    void shapes_data()
    {
        QTest::addColumn<QByteArray>("text");
        QTest::addColumn<QByteArray>("expected");
        const auto row = [](const char *name, const QByteArray &text, const QByteArray &expected) {
            QTest::newRow(name) << text << expected;
        };
        const QByteArray head = "profile: 1\njoints:\n";
        const QByteArray joint = "- name: a\n  model: XL430-W250\n  id: 1\n  baud: 1000000";
        row("nothing behind registers", head + joint + "\n  registers:   # none yet\n",
            head + joint + "\n  registers:   # none yet\n    Shutdown: Overload\n");
        row("a tilde behind registers", head + joint + "\n  registers: ~  # none yet\n",
            head + joint + "\n  registers:   # none yet\n    Shutdown: Overload\n");
        row("empty brackets", head + joint + "\n  registers: {}\n", head + joint + "\n  registers: { Shutdown: Overload }\n");
        row("no line end", head + joint, head + joint + "\n  registers:\n    Shutdown: Overload");
        row("brackets over lines", head + joint + "\n  registers: {\n    LED: 0 # }\n    }\n",
            head + joint + "\n  registers: {\n    LED: 0, Shutdown: Overload # }\n    }\n");
        row("a joint in brackets", head + "- { name: a, model: XL430-W250, id: 1, baud: 1000000 }\n",
            head + "- { name: a, model: XL430-W250, id: 1, baud: 1000000, registers: { Shutdown: Overload } }\n");
        row("all in brackets", "{profile: 1, joints: [{name: a, model: XL430-W250, id: 1, baud: 1000000}]}",
            "{profile: 1, joints: [{name: a, model: XL430-W250, id: 1, baud: 1000000, registers: { Shutdown: Overload }}]}");
        row("no joints yet", "profile: 1\njoints: []\n",
            "profile: 1\njoints: [ { name: joint 1, model: XL430-W250, id: 1, baud: 1000000, firmware: 52, registers: { "
            "Shutdown: Overload } } ]\n");
        row("keys behind the joints", head + joint + "\nname: x\n",
            head + joint + "\n  registers:\n    Shutdown: Overload\nname: x\n");
        row("registers in the middle", head + "- name: a\n  registers:\n    LED: 0\n\n  model: XL430-W250\n  id: 1\n  baud: 1000000\n",
            head + "- name: a\n  registers:\n    LED: 0\n    Shutdown: Overload\n\n  model: XL430-W250\n  id: 1\n  baud: 1000000\n");
        row("a default that is another", "profile: 1\ndefaults: { all: { Shutdown: None } }\njoints:\n" + joint + "\n",
            "profile: 1\ndefaults: { all: { Shutdown: None } }\njoints:\n" + joint + "\n  registers:\n    Shutdown: Overload\n");
        row("byte order mark", "\xEF\xBB\xBF" + head + joint + "\n  registers:\n    Shutdown: None\n",
            "\xEF\xBB\xBF" + head + joint + "\n  registers:\n    Shutdown: Overload\n");
        row("quoted key", head + joint + "\n  \"registers\":\n    'Shutdown': 4 # µ\n",
            head + joint + "\n  \"registers\":\n    'Shutdown': 32 # µ\n");
    }
    void shapes()
    {
        QFETCH(QByteArray, text);
        QFETCH(QByteArray, expected);
        const std::vector<SavedDevice> devices{deviceOf(m_catalog, u"XL430-W250"_s, 1, {{u"Shutdown"_s, 32}}, 52)};
        const auto saved = saveProfile(text, u"f"_s, devices, m_catalog);
        QVERIFY2(saved, saved ? "" : qPrintable(saved.error().text));
        QCOMPARE(QString::fromUtf8(saved->text), QString::fromUtf8(expected));
        const auto again = saveProfile(saved->text, u"f"_s, devices, m_catalog);
        QVERIFY(again && !again->isChanged());
        QCOMPARE(again->text, saved->text);
    }

    void leavesAlone()
    {
        const QByteArray text = "profile: 1\njoints:\n  - { name: a, model: XL430-W250, id: 1, baud: 1000000 }\n"
                                "  - { name: b, model: XL430-W250, id: 2, baud: 1000000 }\n";
        const auto saved = saveProfile(text, u"f"_s,
                                       {deviceOf(m_catalog, u"XM430-W350"_s, 1, {{u"Operating Mode"_s, 4}})}, m_catalog);
        QVERIFY(saved);
        QCOMPARE(saved->text, text);
        QCOMPARE(saved->notes.size(), 2);
        QVERIFY(saved->notes[0].contains(u"a is a XL430-W250 in the file, but a XM430-W350 answers there"));
        QVERIFY(saved->notes[1].startsWith(u"b was not read"));
        const auto odd = saveProfile(text, u"f"_s,
                                     {deviceOf(m_catalog, u"XL430-W250"_s, 1, {{u"Position P Gain"_s, 20000}})}, m_catalog);
        QVERIFY(odd);
        QCOMPARE(odd->text, text);
        QVERIFY2(odd->notes[0].contains(u"Position P Gain holds 20000"), qPrintable(odd->notes[0]));
        const auto broken = saveProfile("profile: 1\njoints: 3\n", u"f"_s, {}, m_catalog);
        QVERIFY(!broken && broken.error().text.startsWith(u"f:2:9: "));
    }

    /// Every raw value of every register comes back from what is written for it.
    void everyModel()
    {
        for (const Catalog::ModelInfo &model : m_catalog.models()) {
            for (const int step : m_catalog.firmwareSteps(model.modelNumber)) {
                const ControlTablePtr table = m_catalog.find(model.modelNumber, step);
                const RegisterLookup initial = [&](QStringView name) -> std::optional<std::int64_t> {
                    const Field *field = table->find(name);
                    return field ? field->initial : std::nullopt;
                };
                for (const Field &field : table->fields()) {
                    if (!mayBeInProfile(profileUse(*table, field)))
                        continue;
                    const EffectiveField units = effective(field, initial);
                    const std::int64_t low = std::max(units.minimum.value_or(smallestRaw(field)), smallestRaw(field));
                    const std::int64_t high = std::min(units.maximum.value_or(largestRaw(field)), largestRaw(field));
                    for (int i = 0; i <= 40; ++i) {
                        const std::int64_t raw = low + (high - low) * i / 40;
                        if (!checkRange(field, units, raw))
                            continue;
                        const QString text = textOfValue(*table, field, raw, initial);
                        const auto back = parseValue(field, units, table->resolution(), text);
                        QVERIFY2(back && *back == raw, qPrintable(model.model + u": "_s + field.name + u' ' + text));
                        QCOMPARE(textOfValue(*table, field, raw, initial, u"17"), QString::number(raw));
                    }
                }
            }
        }
    }

    void files()
    {
        const QTemporaryDir folder;
        const QString path = folder.filePath(u"arm.yaml"_s), link = folder.filePath(u"link.yaml"_s);
        QVERIFY(writeProfile(path, "old"));
        QVERIFY(QFile::setPermissions(path, QFile::ReadOwner | QFile::WriteOwner | QFile::ReadGroup));
        const auto permissions = QFile::permissions(path);
        QVERIFY(QFile::link(path, link));
        QVERIFY(writeProfile(link, "new"));
        QVERIFY(QFileInfo(link).isSymLink());
        QCOMPARE(profileText(path).value_or(QByteArray()), QByteArray("new"));
        QCOMPARE(QFile::permissions(path), permissions);
        const auto failed = writeProfile(folder.filePath(u"none/arm.yaml"_s), "x");
        QVERIFY(!failed && failed.error().kind == ErrorKind::BadFile);
    }

private:
    const Catalog m_catalog = test::builtInCatalog();
};

DYNASCOPE_CORE_TEST(TestProfileSave)
#include "tst_profilesave.moc"
