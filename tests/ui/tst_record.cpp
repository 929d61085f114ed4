// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/record/recordedvalue.h"
#include "core/record/recording.h"
#include "core/session/commands.h"
#include "core/session/eventlog.h"
#include "tests/support/udpreceiver.h"
#include "tests/support/uitest.h"
#include "tests/support/workbenchfixture.h"
#include "ui/common/messagebar.h"
#include "ui/record/recordactions.h"
#include "ui/record/recordtexts.h"

#include <QAction>
#include <QComboBox>
#include <QDir>
#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QJsonDocument>
#include <QJsonObject>
#include <QSettings>
#include <QSpinBox>
#include <QStatusBar>
#include <QToolButton>

using namespace dynascope;

namespace {

struct Counted {
    std::map<QString, quint64> samples; ///< by "ID 1/Present Position"
    quint64 all() const
    {
        quint64 sum = 0;
        for (const auto &[name, count] : samples)
            sum += count;
        return sum;
    }
};

Counted count(Recording &recording)
{
    Counted counted;
    ReplaySource source(recording);
    while (const auto batch = source.next()) {
        for (const RecordedReply &reply : batch->replies) {
            const RecordedDevice *device = recording.header().device(reply.device);
            for (const RecordedField &field : device->fields) {
                if (recordedRaw(field, reply.address, reply.data))
                    ++counted.samples[device->label + u'/' + field.name];
            }
        }
    }
    return counted;
}

/// What of the window recording has to do with.
class Frame : public QMainWindow
{
public:
    explicit Frame(const Workbench &workbench)
        : log(workbench.session, nullptr, nullptr)
        , actions(new RecordActions(workbench, log, this))
        , messages(new MessageBar(this))
    {
        QMenu *menu = menuBar()->addMenu(QStringLiteral("&File"));
        for (QAction *action : actions->actions())
            menu->addAction(action);
        statusBar()->addWidget(new QLabel(QStringLiteral("figures"), this), 1);
        statusBar()->addPermanentWidget(actions->badge());
        setCentralWidget(messages);
        connect(actions, &RecordActions::posted, messages, qOverload<Message>(&MessageBar::post));
        resize(900, 600);
    }

    EventLog log;
    RecordActions *actions;
    MessageBar *messages;

protected:
    void closeEvent(QCloseEvent *event) override
    {
        actions->finish(); // as MainWindow
        QMainWindow::closeEvent(event);
    }
};

} // namespace

/// Recording over simulated servos, driven by clicks and keys.
class TestRecord : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        QSettings().clear();
        m_folder = std::make_unique<QTemporaryDir>();
        QVERIFY(m_folder->isValid());
        m_bench = std::make_unique<test::WorkbenchFixture>();
        m_window = std::make_unique<Frame>(m_bench->workbench());
        m_window->show();
        m_window->activateWindow();
        QVERIFY(QTest::qWaitForWindowActive(m_window.get()));
        RecordWishes wishes;
        wishes.folder = m_folder->filePath(QStringLiteral("made/by itself"));
        wishes.note = QStringLiteral("a note");
        wishes.save();
        connectNow();
    }
    void cleanup()
    {
        m_window.reset();
        m_bench.reset();
    }

    void holdsEverySampleTheHistoryGot()
    {
        const Watch position = plot(1, "Present Position");
        const Watch current = plot(1, "Present Current");
        const Watch other = plot(4, "Present Position");
        quint64 seen = 0;
        connect(&recorder(), &SessionRecorder::changed, this, [&] { seen = histories({position, current, other}); });
        QTest::mouseClick(find<QToolButton>("recordButton"), Qt::LeftButton);
        QVERIFY(recorder().isRunning());
        QVERIFY(visible<QLabel>("recordTime"));
        QCOMPARE(visible<QLabel>("recordWord")->text(), QStringLiteral("Recording"));
        pollUntil([&] { return histories({position, current, other}) > 600; });
        QTest::mouseClick(find<QToolButton>("recordButton"), Qt::LeftButton);
        QTRY_VERIFY(!recorder().isRunning() && !recorder().isEnding());
        QVERIFY(!visible<QLabel>("recordTime"));
        QVERIFY2(message().contains(recorder().status().path), qPrintable(message()));
        QVERIFY(m_window->messages->kind() == MessageKind::Success);

        const auto recording = Recording::open(recorder().status().path);
        QVERIFY(recording);
        QVERIFY((*recording)->isWhole());
        const Counted counted = count(**recording);
        QCOMPARE(counted.samples.size(), std::size_t(3));
        QCOMPARE(counted.all(), seen);
        QCOMPARE(recorder().status().samples, seen);
        QCOMPARE(recorder().status().lost, quint64(0));
        const RecordingHeader &header = (*recording)->header();
        QCOMPARE(header.name, QStringLiteral("sim"));
        QCOMPARE(header.notes, QStringLiteral("a note"));
        QVERIFY(header.program.startsWith(QStringLiteral("Dynascope")));
        const RecordedDevice *device = header.device(position.device);
        QVERIFY(device);
        QCOMPARE(device->model, QStringLiteral("XM430-W350"));
        QCOMPARE(device->fields.back().unit, QStringLiteral("deg"));
    }

    /// Of one that was never selected, too: it is read when a recording begins.
    void holdsTheControlTables()
    {
        const Watch other = plot(4, "Present Position");
        const Device &device = *m_bench->device(4, 1000000);
        QVERIFY(!WatchedDevices::isImageWhole(device));
        key();
        QVERIFY(recorder().isRunning());
        QTRY_VERIFY(WatchedDevices::isImageWhole(device));
        key();
        QTRY_VERIFY(!recorder().isEnding());
        const auto recording = Recording::open(recorder().status().path);
        QVERIFY(recording);
        const RecordedDevice *recorded = (*recording)->header().device(other.device);
        QVERIFY(recorded);
        std::size_t bytes = 0;
        for (const RecordedSpan &span : recorded->image)
            bytes += span.data.size();
        std::size_t wanted = 0;
        for (const Field &field : device.table().fields())
            wanted += field.size;
        QCOMPARE(bytes, wanted);
    }

    void whatIsPlottedMeanwhileIsRecorded()
    {
        const Watch position = plot(1, "Present Position");
        key();
        pollUntil([&] { return histories({position}) > 50; });
        const Watch late = plot(4, "Present Velocity");
        pollUntil([&] { return histories({late}) > 50; });
        m_bench->monitor.unwatch(position);
        const quint64 first = histories({position});
        pollUntil([&] { return histories({late}) > 150; });
        const quint64 before = first + histories({late});
        key();
        QTRY_VERIFY(!recorder().isEnding());
        const auto recording = Recording::open(recorder().status().path);
        QVERIFY(recording);
        QCOMPARE(recorder().status().files, 1);
        const Counted counted = count(**recording);
        QCOMPARE(counted.all(), before);
        QCOMPARE(counted.samples.at(QStringLiteral("ID 1/Present Position")), first);
    }

    void aColumnThatComesMakesAnotherCsvFile()
    {
        RecordWishes wishes = RecordWishes::saved();
        wishes.format = QStringLiteral("csv");
        wishes.save();
        const Watch position = plot(1, "Present Position");
        key();
        pollUntil([&] { return histories({position}) > 50; });
        const Watch late = plot(4, "Present Velocity");
        pollUntil([&] { return histories({late}) > 50; });
        const quint64 seen = histories({position, late});
        key();
        QTRY_VERIFY(!recorder().isEnding());
        QCOMPARE(recorder().status().files, 2);
        quint64 cells = 0;
        QStringList heads;
        const QDir folder(wishes.folder);
        for (const QString &name : folder.entryList({QStringLiteral("*.csv")}, QDir::Files, QDir::Name)) {
            QFile file(folder.filePath(name));
            QVERIFY(file.open(QIODevice::ReadOnly));
            heads << QString::fromUtf8(file.readLine()).trimmed();
            while (!file.atEnd()) {
                const QList<QByteArray> row = file.readLine().trimmed().split(',');
                cells += static_cast<quint64>(std::count_if(row.begin() + 1, row.end(),
                                                            [](const QByteArray &cell) { return !cell.isEmpty(); }));
            }
        }
        QCOMPARE(heads.size(), 2);
        QVERIFY(!heads.first().contains(QStringLiteral("Velocity")));
        QVERIFY(heads.last().contains(QStringLiteral("ID 4/Present Velocity [rev/min]")));
        QCOMPARE(cells, seen);
    }

    void nothingWatchedIsRefused()
    {
        QTest::mouseClick(find<QToolButton>("recordButton"), Qt::LeftButton);
        QVERIFY(!recorder().isRunning());
        QVERIFY2(message().contains(QStringLiteral("plot at least one register first")), qPrintable(message()));
        QVERIFY(!QDir(RecordWishes::saved().folder).exists());
        QVERIFY(!find<QAction>("recordAction")->text().contains(QStringLiteral("End")));
    }

    void aFolderThatCannotBeMadeIsSaid()
    {
        QFile file(m_folder->filePath(QStringLiteral("file")));
        QVERIFY(file.open(QIODevice::WriteOnly));
        RecordWishes wishes;
        wishes.folder = file.fileName() + QStringLiteral("/below");
        wishes.save();
        plot(1, "Present Position");
        key();
        QVERIFY(!recorder().isRunning());
        QVERIFY2(message().contains(wishes.folder), qPrintable(message()));
        QTest::mouseClick(find<QPushButton>("messageAction"), Qt::LeftButton); // where it can be put right
        QVERIFY(find<QDialog>("recordOptionsDialog")->isVisible());
    }

    void closingFinishesTheFile()
    {
        const Watch position = plot(1, "Present Position");
        key();
        pollUntil([&] { return histories({position}) > 100; });
        const QString path = recorder().status().path;
        const quint64 seen = histories({position});
        m_window->close();
        QVERIFY(!m_window->isVisible());
        const auto recording = Recording::open(path);
        QVERIFY(recording);
        QVERIFY((*recording)->isWhole());
        QCOMPARE(count(**recording).all(), seen);
    }

    void nothingMovesWhileItRuns()
    {
        plot(1, "Present Position");
        auto *button = visible<QToolButton>("recordButton");
        const QRect before(button->mapToGlobal(QPoint()), button->size());
        key();
        QTRY_VERIFY(visible<QLabel>("recordTime"));
        QCoreApplication::processEvents();
        QCOMPARE(QRect(button->mapToGlobal(QPoint()), button->size()), before);
        auto *time = visible<QLabel>("recordTime");
        auto *size = visible<QLabel>("recordSize");
        for (const QString &text : {lengthText(std::chrono::seconds(0)), lengthText(std::chrono::hours(999))})
            QVERIFY(QFontMetrics(time->font()).horizontalAdvance(text) <= time->width());
        for (const qint64 bytes : {qint64(0), qint64(9'999'900'000), qint64(999'900'000'000)})
            QVERIFY(QFontMetrics(size->font()).horizontalAdvance(sizeText(bytes)) <= size->width());
        key();
        QTRY_VERIFY(!recorder().isEnding());
    }

    void optionsAreKept()
    {
        find<QAction>("recordOptionsAction")->trigger();
        auto *dialog = find<QDialog>("recordOptionsDialog");
        dialog->findChild<QComboBox *>(QStringLiteral("recordFormat"))->setFocus();
        QTest::keyClick(dialog->findChild<QComboBox *>(QStringLiteral("recordFormat")), Qt::Key_Down);
        auto *minutes = dialog->findChild<QSpinBox *>(QStringLiteral("splitMinutes"));
        QCOMPARE(minutes->text(), QStringLiteral("never"));
        QTest::keyClick(minutes, Qt::Key_Up);
        auto *note = dialog->findChild<QPlainTextEdit *>(QStringLiteral("recordNote"));
        QCOMPARE(note->toPlainText(), QStringLiteral("a note"));
        note->clear();
        QTest::keyClicks(note, QStringLiteral("left knee"));
        QTest::keyClick(minutes, Qt::Key_Return);
        QTRY_VERIFY(!visible<QDialog>("recordOptionsDialog"));
        const RecordWishes wishes = RecordWishes::saved();
        QCOMPARE(wishes.format, QStringLiteral("csv"));
        QCOMPARE(wishes.splitMinutes, 10);
        QCOMPARE(wishes.note, QStringLiteral("left knee"));
    }

    void streamsWhatIsPlotted()
    {
        const Watch position = plot(1, "Present Position");
        QVERIFY(!visible<QLabel>("streamPlace"));
        find<QAction>("streamAction")->trigger();
        auto *dialog = find<QDialog>("streamDialog");
        auto *host = dialog->findChild<QLineEdit *>(QStringLiteral("streamHost"));
        auto *warning = dialog->findChild<QLabel *>(QStringLiteral("streamWarning"));
        auto *state = dialog->findChild<QLabel *>(QStringLiteral("streamState"));
        auto *toggle = dialog->findChild<QPushButton *>(QStringLiteral("streamToggle"));
        QCOMPARE(host->text(), QStringLiteral("127.0.0.1"));
        QCOMPARE(dialog->findChild<QSpinBox *>(QStringLiteral("streamPort"))->value(), 9870);
        QVERIFY(warning->text().contains(QStringLiteral("Only programs on this computer")));
        host->selectAll();
        QTest::keyClicks(host, QStringLiteral("192.0.2.7"));
        QVERIFY2(warning->text().contains(QStringLiteral("neither encrypted")), qPrintable(warning->text()));
        host->selectAll();
        QTest::keyClicks(host, QStringLiteral("some.name"));
        QTest::mouseClick(toggle, Qt::LeftButton);
        QVERIFY2(state->text().contains(QStringLiteral("no IP address")), qPrintable(state->text()));
        host->selectAll();
        QTest::keyClicks(host, QStringLiteral("127.0.0.1"));
        UdpReceiver receiver;
        QVERIFY(receiver.port() > 0);
        dialog->findChild<QSpinBox *>(QStringLiteral("streamPort"))->setValue(receiver.port());
        QTest::mouseClick(toggle, Qt::LeftButton);
        QCOMPARE(visible<QLabel>("streamPlace")->text(), QStringLiteral("JSON → 127.0.0.1:%1").arg(receiver.port()));
        QVERIFY(!host->isEnabled());
        pollUntil([&] { return histories({position}) > 20; });
        const QByteArray datagram = receiver.take();
        const QJsonObject object = QJsonDocument::fromJson(datagram).object();
        QVERIFY2(object[u"timestamp"].isDouble(), datagram.constData());
        QVERIFY2(object[u"ID 1"][u"Present Position"].isDouble(), datagram.constData());
        QTRY_VERIFY2(!state->text().startsWith(QStringLiteral("0 ")), qPrintable(state->text()));
        QTest::mouseClick(toggle, Qt::LeftButton);
        QVERIFY(!visible<QLabel>("streamPlace"));
        QCOMPARE(state->text(), QStringLiteral("Nothing is sent."));
    }

private:
    void connectNow()
    {
        LineSession &line = m_bench->session.open(QStringLiteral("sim"), 1000000);
        QTRY_COMPARE(line.state(), BusThread::State::Open);
        Device &first = line.heard({1, 1000000, 1020, 45, false, {}});
        line.heard({4, 1000000, 1060, 45, false, {}});
        m_bench->commands.readAll(first);
        QTRY_VERIFY(WatchedDevices::isImageWhole(first));
    }

    Watch plot(int id, const char *field)
    {
        const Device *device = m_bench->device(id, 1000000);
        const Watch watch{device->key(), device->table().indexOf(QString::fromLatin1(field))};
        m_bench->monitor.watch(watch);
        return watch;
    }

    quint64 histories(const std::vector<Watch> &watches) const
    {
        quint64 sum = 0;
        for (const Watch &watch : watches) {
            const History *history = m_bench->monitor.history(watch);
            sum += history ? history->size() : 0;
        }
        return sum;
    }

    /// Polls until that is so, and until what was under way has come.
    void pollUntil(const std::function<bool()> &done)
    {
        m_bench->monitor.setPaused(false);
        QTRY_VERIFY_WITH_TIMEOUT(done(), 20'000);
        m_bench->monitor.setPaused(true);
        std::size_t batches = 1;
        const auto line = connect(m_bench->session.lines().front().get(), &LineSession::batchTaken, this, [&] { ++batches; });
        while (std::exchange(batches, 0) > 0)
            QTest::qWait(60); // more than a frame of those that are handed over
        disconnect(line);
    }

    /// As a person presses it.
    void key() { QTest::keyClick(m_window.get(), Qt::Key_R, Qt::ControlModifier | Qt::AltModifier); }

    const SessionRecorder &recorder() const { return m_window->actions->recorder(); }
    QString message() const { return m_window->messages->text(); }

    template <typename T>
    T *visible(const char *name) const
    {
        T *child = m_window->findChild<T *>(QString::fromLatin1(name));
        return child && child->isVisible() ? child : nullptr;
    }

    template <typename T>
    T *find(const char *name)
    {
        T *child = m_window->findChild<T *>(QString::fromLatin1(name));
        if (!child)
            qFatal("no %s", name);
        return child;
    }

    std::unique_ptr<QTemporaryDir> m_folder;
    std::unique_ptr<test::WorkbenchFixture> m_bench;
    std::unique_ptr<Frame> m_window;
};

DYNASCOPE_UI_TEST(TestRecord)
#include "tst_record.moc"
