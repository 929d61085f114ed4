// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/table/catalog.h"
#include "tests/support/builtincatalog.h"
#include "tests/support/faultmatrix.h"
#include "tests/support/testmain.h"

using namespace faultmatrix;

namespace {

/// `id`'s reply is lost once: what may be asked again is, and brings it.
Case lostOnce(const char *name, int id, const char *found)
{
    return {.name = QString::fromLatin1(name),
            .faults = {.replies = {{.kind = Fault::Lost, .id = id}}},
            .cells = {{"idempotent", 1, "="},
                      {"commands", 0, "NothingReceived"},
                      {"Broadcast Ping", 0, found},
                      {"chained, fast", 1, "= = ="},
                      {"unanswered", 0, "."}},
            .target = id};
}

/// The controller misses it, the devices don't: the chain goes on.
Case lostAtAdapter(const char *name, int id, const char *found)
{
    Case one = lostOnce(name, id, found);
    one.faults.replies.front().atAdapter = true;
    return one;
}

/// `id` is not heard at all. In a group it goes last, so that the others are.
Case missing(const char *name, const sim::LineFaults &faults, int id, const char *found, const char *group)
{
    return {.name = QString::fromLatin1(name),
            .faults = faults,
            .cells = {{"idempotent", 2, "NothingReceived"},
                      {"commands", 0, "NothingReceived"},
                      {"Broadcast Ping", 0, found},
                      {"chained, fast", 2, group},
                      {"unanswered", 0, "."}},
            .target = id};
}

void setLevel(World &world, int id, int level, bool known)
{
    (void)world.servo(id).write(u"Status Return Level", level);
    if (known)
        world.setTraits(id, level);
}

std::vector<Case> lost()
{
    return {lostOnce("first lost once", 1, "- = ="),
            lostOnce("middle lost once", 2, "= - ="),
            lostOnce("last lost once", 3, "= = -"),
            lostAtAdapter("first lost once at the adapter", 1, "- = ="),
            lostAtAdapter("middle lost once at the adapter", 2, "= - ="),
            lostAtAdapter("last lost once at the adapter", 3, "= = -")};
}

std::vector<Case> absent()
{
    const char *first = "NothingReceived = =", *middle = "= NothingReceived =", *last = "= = NothingReceived";
    return {missing("first silent", {.silent = {1}}, 1, "- = =", first),
            missing("middle silent", {.silent = {2}}, 2, "= - =", middle),
            missing("last silent", {.silent = {3}}, 3, "= = -", last),
            missing("first deaf", {.deaf = {1}}, 1, "- = =", first),
            missing("middle deaf", {.deaf = {2}}, 2, "= - =", middle),
            missing("last deaf", {.deaf = {3}}, 3, "= = -", last),
            missing("dead segment", {.deaf = {2, 3}}, 2, "= - -", "= NothingReceived NothingReceived"),
            missing("dead line", {.deaf = {1, 2, 3}}, 2, "- - -", "NothingReceived NothingReceived NothingReceived"),
            // Its own echo is nobody's answer, or a client finds 253 phantoms.
            missing("echo, middle deaf", {.echo = {.on = true}, .deaf = {2}}, 2, "= - =", middle)};
}

std::vector<Case> rebooting()
{
    std::vector<Case> cases;
    const char *group[] = {"NothingReceived = =", "= NothingReceived =", "= = NothingReceived"};
    const char *found[] = {"- = =", "= - =", "= = -"};
    const char *names[] = {"first reboots", "middle reboots", "last reboots"};
    for (int id = 1; id <= 3; ++id) {
        const sim::LineFaults faults{.replies = {{.kind = Fault::Reboot, .id = id}}};
        cases.push_back(missing(names[id - 1], faults, id, found[id - 1], group[id - 1]));
    }
    return cases;
}

/// Silence that was to be expected is no timeout: a reply without data.
std::vector<Case> levels()
{
    const auto known = [](int level) { return [level](World &world) { setLevel(world, 2, level, true); }; };
    const auto unknown = [](int level) { return [level](World &world) { setLevel(world, 2, level, false); }; };
    return {
        {.name = QStringLiteral("level 1"),
         .faults = {},
         .cells = {{"Ping, Read, Write, commands", 0, "="},
                   {"Broadcast Ping, chained, fast", 0, "= = ="},
                   {"unanswered", 0, "."}},
         .prepare = known(1)},
        {.name = QStringLiteral("level 0"),
         .faults = {},
         .cells = {{"Ping, Write, commands", 0, "="},
                   {"Read", 2, "NothingReceived"},
                   {"Broadcast Ping", 0, "= = ="},
                   {"chained, fast", 2, "= NothingReceived ="},
                   {"unanswered", 0, "."}},
         .prepare = known(0)},
        {.name = QStringLiteral("level 1, nobody knows"),
         .faults = {},
         .cells = {{"Ping, Read", 0, "="},
                   {"Write", 2, "NothingReceived"},
                   {"Reg Write, Factory Reset, Reboot, Clear, Backup", 0, "NothingReceived"},
                   {"Broadcast Ping, chained, fast", 0, "= = ="},
                   {"unanswered", 0, "."},
                   {"Action", 0, "NothingReceived"}},
         .prepare = unknown(1)},
    };
}

} // namespace

/// Devices that are not heard: a lost answer, one that is missing, reboots, or was told to be silent.
class TestFaultMatrixSilence : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        for (const auto &family : {lost(), absent(), rebooting(), levels()})
            m_cases.insert(m_cases.end(), family.begin(), family.end());
    }

    void exchange_data() { addRows(m_cases); }

    void exchange()
    {
        QFETCH(int, number);
        QFETCH(int, request);
        run(m_catalog, m_cases.at(static_cast<std::size_t>(number)), static_cast<Kind>(request));
    }

private:
    const Catalog m_catalog = test::builtInCatalog();
    std::vector<Case> m_cases;
};

DYNASCOPE_CORE_TEST(TestFaultMatrixSilence)
#include "tst_faultmatrix_silence.moc"
