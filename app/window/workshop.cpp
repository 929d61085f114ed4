// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/window/workshop.h"

#include <QApplication>
#include <QSettings>

#include <algorithm>

namespace dynascope {
namespace {

Catalog loadCatalog()
{
    auto catalog = Catalog::builtIn();
    // The tables are part of the program and tested with it: a damaged one is a damaged program.
    if (!catalog)
        qFatal("%s", qPrintable(catalog.error().text));
    return std::move(*catalog);
}

ColorScheme storedScheme()
{
    const QString stored = QSettings().value(QStringLiteral("window/scheme")).toString();
    if (stored == QLatin1String("light"))
        return ColorScheme::Light;
    return stored == QLatin1String("dark") ? ColorScheme::Dark : ColorScheme::System;
}

QString schemeName(ColorScheme scheme)
{
    switch (scheme) {
    case ColorScheme::Light: return QStringLiteral("light");
    case ColorScheme::Dark: return QStringLiteral("dark");
    case ColorScheme::System: break;
    }
    return QStringLiteral("system");
}

/// Pictures leave nothing behind.
bool isPicture(const WindowOptions &options)
{
    return !options.picture.isEmpty() || !options.pictureDirectory.isEmpty();
}

} // namespace

Workshop::Workshop(QApplication &application, const WindowOptions &options)
    : m_application(application)
    , m_catalog(loadCatalog())
    , m_tables(addUserTables(m_catalog, userTablesFolder()))
    , m_lines(m_catalog)
    , m_session(m_lines, m_catalog)
    , m_journal(isPicture(options) ? QString() : Journal::usualFolder())
    , m_commands(m_session, &m_journal)
    , m_undo(m_session, m_commands)
    , m_settings(m_session, m_commands)
    , m_monitor(m_session)
    , m_ramGuard(m_session, m_monitor, m_commands, m_journal)
    , m_indirect(m_session, m_monitor, m_settings, isPicture(options) ? QString() : IndirectFile::usualFolder())
    , m_stop(m_session, m_commands)
{
    m_historyBudget = static_cast<std::size_t>(std::max(0, options.historyBudget)) << 20;
    if (m_historyBudget > 0)
        m_monitor.setHistoryBudget(m_historyBudget);
    m_journal.setPatience({}); // STOP waits for no other program
    applyTheme(m_application, storedScheme());
    m_window = std::make_unique<MainWindow>(
        Workbench{m_session, m_commands, m_monitor, m_scanner, m_stop, m_lines, &m_journal, &m_undo, &m_settings,
                  &m_ramGuard, &m_indirect});
    m_window->setScheme(storedScheme());
    m_window->setRefusedTables(m_tables.refused);
    QObject::connect(m_window.get(), &MainWindow::schemeRequested, m_window.get(),
                     [this](ColorScheme scheme) { applyScheme(scheme); });
    QObject::connect(m_window.get(), &MainWindow::recordingRequested, m_window.get(),
                     [this](const QString &path) { openRecording(path); });
    QObject::connect(m_window.get(), &MainWindow::resumeDemoRequested, m_window.get(), [this] {
        sim::Demo *demo = m_lines.demo();
        if (demo && !m_stop.isActive())
            demo->resume();
    });
}

Workshop::~Workshop() = default;

ReplayRoom *Workshop::openRecording(const QString &path)
{
    auto opened = ReplayRoom::open(m_catalog, path, m_historyBudget);
    if (!opened) {
        m_window->say(MessageKind::Error, opened.error().text);
        m_window->show(); // hidden where only recordings were asked for: nobody would see it
        return nullptr;
    }
    ReplayRoom *room = m_rooms.emplace_back(std::move(*opened)).get();
    ReplayWindow &window = room->window();
    QObject::connect(&window, &ReplayWindow::openRequested, &window, [this](const QString &other) { openRecording(other); });
    // Not while it is being closed: its end takes the window with it.
    QObject::connect(&window, &ReplayWindow::closed, m_window.get(), [this, room] {
        std::erase_if(m_rooms, [room](const auto &one) { return one.get() == room; });
    }, Qt::QueuedConnection);
    window.show();
    return room;
}

void Workshop::applyScheme(ColorScheme scheme)
{
    applyTheme(m_application, scheme);
    QSettings().setValue(QStringLiteral("window/scheme"), schemeName(scheme));
}

} // namespace dynascope
