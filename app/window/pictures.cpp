// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/window/pictures.h"

#include "app/window/dialogpictures.h"
#include "app/window/plotpictures.h"
#include "app/window/replaypicture.h"
#include "app/window/workshop.h"
#include "ui/devices/devicepanel.h"
#include "ui/library/librarydialog.h"
#include "ui/plot/plotarea.h"

#include <QAction>
#include <QApplication>
#include <QDir>
#include <QElapsedTimer>
#include <QPointer>
#include <QSettings>
#include <QTimer>

#include <chrono>
#include <cstdio>
#include <deque>

namespace dynascope {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t DemoServos = 7;     ///< six of the arm, one fresh
constexpr qint64 LongestScan = 15000;     ///< ms; then the picture is taken of what there is
constexpr auto PlotTime = 8s;             ///< of movement on the plots
constexpr auto DialogTime = 2s;           ///< for what a dialog reads

/// Brings the window into the state that the pictures show, then takes one step after the other.
class PictureTaker : public QObject
{
public:
    PictureTaker(Workshop &workshop, const WindowOptions &options)
        : m_workshop(workshop)
        , m_dialogs(workshop)
        , m_replay(workshop)
        , m_plots(workshop)
        , m_directory(QDir(options.pictureDirectory).absolutePath()) // the current one is left for another
    {
        if (options.pictureDirectory.isEmpty())
            planOne(options.picture);
        else
            planAll();
        connect(&m_timer, &QTimer::timeout, this, &PictureTaker::waitForDevices);
        m_elapsed.start();
        m_timer.start(100ms);
    }

private:
    struct Step {
        std::function<void()> run;
        std::chrono::milliseconds pause = 700ms; ///< behind it: the next frames come in the new look
    };

    void waitForDevices()
    {
        const bool allThere = m_workshop.session().devices().size() >= DemoServos;
        if (!allThere && m_elapsed.elapsed() < LongestScan)
            return;
        m_timer.stop();
        m_workshop.scanner().cancel();
        showSomething();
        QTimer::singleShot(PlotTime, this, &PictureTaker::next);
    }

    /// Selects a joint and plots it beside another, as a person would.
    void showSomething()
    {
        const std::vector<Device *> devices = m_workshop.session().devices();
        auto *panel = m_workshop.window().findChild<DevicePanel *>();
        auto *plots = m_workshop.window().findChild<PlotArea *>();
        int joints = 0;
        for (Device *device : devices) {
            if (device->state() != Device::State::Present || joints == 3)
                continue;
            if (joints++ == 0 && panel)
                panel->selectDevice(device);
            const int position = device->table().indexOf(u"Present Position");
            if (plots && position >= 0)
                plots->addTrace({device->key(), position});
            const int current = device->table().indexOf(u"Present Current");
            if (plots && current >= 0 && joints == 1)
                plots->addTrace({device->key(), current});
        }
    }

    void planOne(const QString &file)
    {
        m_steps.push_back({[this, file] { save(file); }});
    }

    void shoot(ColorScheme scheme, QSize size, const QString &name)
    {
        m_steps.push_back({[this, scheme, size] {
            m_workshop.applyScheme(scheme);
            if (size.isValid())
                shown().resize(size);
        }});
        const QString scale = qApp->devicePixelRatio() > 1 ? QStringLiteral("@2x") : QString();
        m_steps.push_back({[this, file = m_directory.filePath(name + scale + QStringLiteral(".png"))] { save(file); }});
    }
    /// In light and dark.
    void shootBoth(QSize size, const char *name)
    {
        shoot(ColorScheme::Light, size, QLatin1String(name) + QStringLiteral("-light"));
        shoot(ColorScheme::Dark, size, QLatin1String(name) + QStringLiteral("-dark"));
    }

    void planAll()
    {
        const QSize large(1440, 900);
        const QSize small(960, 640);
        shootBoth(large, "window");
        shootBoth(small, "window-small");
        m_steps.push_back({[this] { m_replay.record(); }, PlotTime});
        m_steps.push_back({[this] { m_dialog = m_replay.open(); }, DialogTime});
        shootBoth(QSize(1360, 820), "replay");
        m_steps.push_back({[this] { closeDialog(); }});
        for (const DialogPictures::One &one : m_dialogs.all()) {
            for (const auto &step : one.steps)
                m_steps.push_back({[this, step] { m_dialog = step(); }, DialogTime});
            shootBoth(one.size, one.name);
        }
        m_steps.push_back({[this] { closeDialog(); }});
        m_steps.push_back({[this] { setCables(true); }, PlotTime});
        shootBoth(large, "health");
        shootBoth(small, "health-small");
        m_steps.push_back({[this] { openLibrary(); }});
        const QSize dialog(1160, 760);
        shootBoth(dialog, "library");
        m_steps.push_back({[this] { closeDialog(); }});
        m_steps.push_back({[this] { setCables(false); }});
        planPlots(large);
    }

    void planPlots(QSize large)
    {
        m_steps.push_back({[this] { m_plots.setUp(); }, PlotTime});
        m_steps.push_back({[this] { m_plots.measure(); }});
        m_steps.push_back({[this] { m_plots.addEvents(); }, DialogTime * 2});
        shootBoth(large, "plots");
        m_steps.push_back({[this] { expect(m_plots.openTrigger()); }});
        shootBoth({}, "trigger");
        m_steps.push_back({[this] {
            closeDialog();
            expect(m_plots.openDerived());
        }});
        shootBoth({}, "derived");
    }

    /// The next pictures are of this.
    void expect(QWidget *dialog)
    {
        m_dialog = dialog;
        m_failed = m_failed || !dialog;
    }

    void closeDialog()
    {
        if (m_dialog)
            m_dialog->close();
        m_dialog = nullptr;
    }

    /// Bus health with something to see in it: one cable that is bad, one that is poor.
    void setCables(bool bad)
    {
        const auto fault = [](int id, sim::ReplyFault::Kind kind, double share) {
            sim::ReplyFault one;
            one.id = id;
            one.kind = kind;
            one.share = share;
            one.times = -1;
            one.amount = kind == sim::ReplyFault::Kind::Cut ? 9 : 0;
            one.atAdapter = true;
            return one;
        };
        using Kind = sim::ReplyFault::Kind;
        sim::LineFaults faults;
        if (bad)
            faults.replies = {fault(3, Kind::Damaged, 0.03), fault(3, Kind::Lost, 0.004), fault(2, Kind::Cut, 0.003)};
        if (sim::Demo *demo = m_workshop.lines().demo())
            demo->server().post([faults](sim::SimulatedBus &bus, LineTime) { bus.setFaults(faults); });
        for (const auto &line : m_workshop.session().lines())
            line->health().startAnew();
        if (auto *action = m_workshop.window().findChild<QAction *>(QStringLiteral("busHealthAction")))
            action->setChecked(bad);
    }

    /// The registers of a model, one of them looked at.
    void openLibrary()
    {
        if (auto *action = m_workshop.window().findChild<QAction *>(QStringLiteral("libraryAction")))
            action->trigger();
        auto *library = m_workshop.window().findChild<LibraryDialog *>();
        if (!library)
            return;
        m_dialog = library;
        library->showModel(1020, -1); // XM430-W350
        library->showRegister(QStringLiteral("Goal Current"));
    }

    /// What the pictures are of.
    QWidget &shown() const
    {
        return m_dialog ? static_cast<QWidget &>(*m_dialog) : static_cast<QWidget &>(m_workshop.window());
    }

    void save(const QString &file)
    {
        if (shown().grab().save(file, "PNG"))
            std::printf("%s\n", qPrintable(file));
        else {
            std::fprintf(stderr, "dynascope: %s could not be written\n", qPrintable(file));
            m_failed = true;
        }
    }

    void next()
    {
        if (m_steps.empty()) {
            QCoreApplication::exit(m_failed ? 1 : 0);
            return;
        }
        const Step step = std::move(m_steps.front());
        m_steps.pop_front();
        step.run();
        QTimer::singleShot(step.pause, this, &PictureTaker::next);
    }

    Workshop &m_workshop;
    QTimer m_timer;
    QElapsedTimer m_elapsed;
    std::deque<Step> m_steps;
    DialogPictures m_dialogs;
    ReplayPicture m_replay;
    PlotPictures m_plots;
    QDir m_directory;
    QPointer<QWidget> m_dialog; ///< instead of the window
    bool m_failed = false;
};

} // namespace

OwnSettings::OwnSettings(const WindowOptions &options)
{
    if (options.picture.isEmpty() && options.pictureDirectory.isEmpty())
        return;
    m_folder = std::make_unique<QTemporaryDir>();
    QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, m_folder->path());
}

OwnSettings::~OwnSettings() = default;

int runWindow(QApplication &application, Workshop &workshop, const WindowOptions &options)
{
    const bool picture = !options.picture.isEmpty() || !options.pictureDirectory.isEmpty();
    const bool simulated = !options.pictureDirectory.isEmpty() || (picture && options.port.isEmpty());

    if (!options.recordings.isEmpty()) {
        bool isAnyOpen = false;
        for (const QString &path : options.recordings)
            isAnyOpen = workshop.openRecording(path) != nullptr || isAnyOpen;
        if (isAnyOpen && options.port.isEmpty())
            return application.exec(); // nobody has asked for a bus
    }
    workshop.window().show();
    if (picture)
        workshop.window().resize(1440, 900);
    workshop.window().connectTo(simulated ? QString(SimulatedPortName) : options.port, options.baudRate);
    std::unique_ptr<PictureTaker> taker;
    if (picture)
        taker = std::make_unique<PictureTaker>(workshop, options);
    return application.exec();
}

} // namespace dynascope
