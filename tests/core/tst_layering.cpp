// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/testmain.h"

#include <QDirIterator>
#include <QFile>
#include <QRegularExpression>

#include <algorithm>
#include <array>

using namespace Qt::StringLiterals;

namespace {

struct Include {
    QString file; ///< the file that includes, from the root
    int line = 0;
    QString what; ///< as it stands between the quotes or angle brackets
    bool quoted = false;
};

/// What files under `folder` may include of this project, as wildcards from the root. The first rule that fits counts.
struct Rule {
    const char *folder;
    QStringList allowed;
};

const std::vector<Rule> &rules()
{
    static const QStringList values{u"core/result.h"_s, u"core/bytes.h"_s};
    static const std::vector<Rule> table{
        {"core/protocol/", values + QStringList{u"core/protocol/*"_s}},
        {"core/table/", values + QStringList{u"core/table/*"_s}},
        {"core/yaml/", values + QStringList{u"core/yaml/*"_s}},
        {"core/bus/", values + QStringList{u"core/bus/*"_s, u"core/protocol/*"_s}},
        {"core/sim/", values + QStringList{u"core/sim/*"_s, u"core/protocol/*"_s, u"core/table/*"_s,
                                           u"core/yaml/*"_s, u"core/bus/line.h"_s}},
        {"core/session/", values + QStringList{u"core/session/*"_s, u"core/bus/*"_s, u"core/table/*"_s,
                                               u"core/yaml/*"_s, u"core/protocol/protocol_values.h"_s}},
        {"core/record/", values + QStringList{u"core/record/*"_s, u"core/bus/*_values.h"_s,
                                              u"core/session/*_values.h"_s, u"core/table/*"_s}},
        {"core/replay/", values + QStringList{u"core/replay/*"_s, u"core/record/*"_s, u"core/session/*"_s,
                                              u"core/table/*"_s, u"core/bus/*_values.h"_s, u"core/bus/line.h"_s,
                                              u"core/bus/linefactory.h"_s}},
        {"core/", values},
        {"ui/traffic/", values + QStringList{u"ui/*"_s, u"core/session/*"_s, u"core/table/*"_s,
                                             u"core/protocol/*"_s, u"core/bus/*_values.h"_s}},
        {"ui/", values + QStringList{u"ui/*"_s, u"core/session/*"_s, u"core/table/*"_s, u"core/record/*"_s,
                                     u"core/replay/*"_s, u"core/protocol/*_values.h"_s, u"core/bus/*_values.h"_s}},
        {"app/", {u"app/*"_s, u"core/*"_s, u"ui/*"_s}},
    };
    return table;
}

/// Single steps across a wall, each with its reason.
struct Exception {
    const char *folder;
    const char *header;
};
constexpr std::array exceptions{
    Exception{"ui/connection/", "core/bus/linefactory.h"}, // PortList: which ports there are to choose from
};

/// Headers of the system that only some may know.
struct Reserved {
    const char *pattern; ///< of the header
    const char *files;   ///< of the files that may include it
};
constexpr std::array reserved{
    Reserved{"^QSerialPort", "^core/bus/|^app/"},
    Reserved{"^Q(Widget|ApplicationWindow|Painter|Pixmap|Icon|Color|Application)$", "^ui/|^app/"},
    Reserved{"^(unistd|fcntl|termios|poll|pty|signal|csignal|pthread|sys/.*|asm/.*|linux/.*)(\\.h)?$",
             "_posix\\.(h|cpp)$"},
};

/// `wildcard` holds one * at most.
bool fits(const QString &wildcard, const QString &path)
{
    const qsizetype star = wildcard.indexOf(u'*');
    if (star < 0)
        return path == wildcard;
    return path.size() >= wildcard.size() - 1 && path.startsWith(wildcard.left(star))
        && path.endsWith(wildcard.mid(star + 1));
}

QStringList sourceFiles(const QStringList &folders)
{
    const QDir root(QStringLiteral(DYNASCOPE_SOURCE_DIR));
    QStringList files;
    for (const QString &folder : folders) {
        QDirIterator entries(root.filePath(folder), {u"*.h"_s, u"*.cpp"_s}, QDir::Files,
                             QDirIterator::Subdirectories);
        while (entries.hasNext())
            files.append(root.relativeFilePath(entries.next()));
    }
    files.sort();
    return files;
}

QStringList linesOf(const QString &path)
{
    QFile file(QStringLiteral(DYNASCOPE_SOURCE_DIR "/") + path);
    if (!file.open(QIODevice::ReadOnly))
        return {};
    return QString::fromUtf8(file.readAll()).split(u'\n');
}

std::vector<Include> includesIn(const QStringList &lines, const QString &path)
{
    static const QRegularExpression pattern(u"^\\s*#\\s*include\\s*([<\"])([^>\"]+)[>\"]"_s);
    std::vector<Include> found;
    for (qsizetype i = 0; i < lines.size(); ++i) {
        const auto match = pattern.match(lines[i]);
        if (match.hasMatch())
            found.push_back({path, static_cast<int>(i) + 1, match.captured(2), match.captured(1) == u"\""});
    }
    return found;
}

/// Why this include isn't allowed; empty where it is.
QString objection(const Include &include)
{
    if (!include.quoted) {
        for (const Reserved &entry : reserved) {
            if (QRegularExpression(QLatin1String(entry.pattern)).match(include.what).hasMatch()
                && !QRegularExpression(QLatin1String(entry.files)).match(include.file).hasMatch())
                return u"only %1 may include that"_s.arg(QLatin1String(entry.files));
        }
        return {};
    }
    if (include.what.endsWith(u".moc") || include.what.startsWith(u"moc_"))
        return {};
    for (const Exception &exception : exceptions) {
        if (include.file.startsWith(QLatin1String(exception.folder)) && include.what == QLatin1String(exception.header))
            return {};
    }
    const auto rule = std::find_if(rules().begin(), rules().end(), [&](const Rule &candidate) {
        return include.file.startsWith(QLatin1String(candidate.folder));
    });
    if (rule == rules().end())
        return u"no rule for this folder"_s;
    const bool allowed = std::any_of(rule->allowed.begin(), rule->allowed.end(),
                                     [&](const QString &wildcard) { return fits(wildcard, include.what); });
    return allowed ? QString() : u"%1 may include %2"_s.arg(QLatin1String(rule->folder), rule->allowed.join(u", "));
}

} // namespace

/// ARCHITECTURE.md's table of layers, read off the sources.
class TestLayering : public QObject
{
    Q_OBJECT

private slots:
    void judges_data();
    void judges();
    void includes();
    void budgets();
};

void TestLayering::judges_data()
{
    QTest::addColumn<QString>("file");
    QTest::addColumn<QString>("what");
    QTest::addColumn<bool>("quoted");
    QTest::addColumn<bool>("allowed");
    const auto row = [](const char *file, const char *what, bool quoted, bool allowed) {
        QTest::addRow("%s <- %s", file, what)
            << QString::fromLatin1(file) << QString::fromLatin1(what) << quoted << allowed;
    };
    row("core/bus/bus.h", "core/protocol/packet.h", true, true);
    row("core/bus/bus.h", "core/table/field.h", true, false);
    row("core/protocol/packet.h", "core/table/field.h", true, false);
    row("core/sim/servo.h", "core/bus/line.h", true, true);
    row("core/sim/servo.h", "core/bus/bus.h", true, false);
    row("core/session/session.h", "core/sim/demo.h", true, false);
    row("core/session/profile/profile.cpp", "core/yaml/yamltree.h", true, true);
    row("core/yaml/yamltree.h", "core/table/field.h", true, false);
    row("core/record/recorder.h", "core/bus/poll_values.h", true, true);
    row("core/record/recorder.h", "core/bus/bus.h", true, false);
    row("core/record/recorder.h", "core/session/device.h", true, false);
    row("core/replay/replayer.h", "core/session/session.h", true, true);
    row("core/replay/replayer.h", "core/bus/bus.h", true, false);
    row("core/session/session.h", "core/replay/replayer.h", true, false);
    row("ui/plot/plot.cpp", "core/bus/poll_values.h", true, true);
    row("ui/plot/plot.cpp", "core/bus/bus.h", true, false);
    row("ui/plot/plot.cpp", "core/bus/linefactory.h", true, false);
    row("ui/connection/bar.cpp", "core/bus/linefactory.h", true, true);
    row("ui/table/grid.cpp", "core/sim/demo.h", true, false);
    row("ui/table/grid.cpp", "grid.h", true, false);
    row("ui/table/grid.cpp", "QSerialPort", false, false);
    row("core/session/device.cpp", "QWidget", false, false);
    row("core/bus/serialline.cpp", "sys/ioctl.h", false, false);
    row("core/bus/serialline_posix.cpp", "sys/ioctl.h", false, true);
}

void TestLayering::judges()
{
    QFETCH(QString, file);
    QFETCH(QString, what);
    QFETCH(bool, quoted);
    QFETCH(bool, allowed);
    QCOMPARE(objection({file, 1, what, quoted}).isEmpty(), allowed);
}

void TestLayering::includes()
{
    const QStringList files = sourceFiles({u"core"_s, u"ui"_s, u"app"_s});
    QVERIFY(files.size() > 10);
    QStringList wrong;
    for (const QString &file : files) {
        for (const Include &include : includesIn(linesOf(file), file)) {
            const QString why = objection(include);
            if (!why.isEmpty())
                wrong.append(u"%1:%2 includes %3: %4"_s.arg(include.file).arg(include.line).arg(include.what, why));
        }
    }
    QVERIFY2(wrong.isEmpty(), qPrintable(u'\n' + wrong.join(u'\n')));
}

void TestLayering::budgets()
{
    for (const QString &file : sourceFiles({u"core"_s, u"ui"_s, u"app"_s})) {
        const qsizetype lines = linesOf(file).size();
        const qsizetype budget = file.endsWith(u".h") ? 120 : 400;
        if (lines > budget)
            qInfo("%s has %lld lines, its budget is %lld: split it, or say why", qPrintable(file),
                  static_cast<long long>(lines), static_cast<long long>(budget));
    }
}

DYNASCOPE_CORE_TEST(TestLayering)
#include "tst_layering.moc"
