// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/layoutmanager.h"

#include <QEvent>
#include <QMainWindow>
#include <QScreen>
#include <QSettings>
#include <QSplitter>

#include <algorithm>

namespace dynascope {

namespace {

constexpr QSize DefaultSize(1440, 900);
constexpr QSize Frame(16, 48); ///< what a window manager puts around it; not known before it is shown
constexpr int WideEnough = 1200; ///< from here on table and plots fit beside each other
constexpr int DevicesWidth = 248;
constexpr int TableWidth = 826; ///< shows every column of one device
constexpr int HealthHeight = 264; ///< six devices, the line, and what is said about them
constexpr int PlotWidth = 364;  ///< what the table leaves to the plots

const QString GeometryKey = QStringLiteral("window/geometry");
const QString OuterKey = QStringLiteral("window/outer");
const QString RightKey = QStringLiteral("window/plotsRight");
const QString BelowKey = QStringLiteral("window/plotsBelow");
const QString RightName = QStringLiteral("right");
const QString BelowName = QStringLiteral("below");
const QString HealthKey = QStringLiteral("window/health");
const QString HealthShownKey = QStringLiteral("window/healthShown");
const QString PlaceKey = QStringLiteral("window/plotPlace");

} // namespace

LayoutManager::LayoutManager(QMainWindow &window, const Splitters &splitters)
    : QObject(&window)
    , m_window(window)
    , m_whole(splitters.whole)
    , m_outer(splitters.outer)
    , m_inner(splitters.inner)
{
    m_whole.setChildrenCollapsible(false);
    m_whole.setHandleWidth(1);
    m_whole.setStretchFactor(0, 1);
    m_whole.setStretchFactor(1, 0);
    m_whole.widget(1)->hide();
    m_outer.setChildrenCollapsible(false);
    m_inner.setChildrenCollapsible(false);
    m_outer.setStretchFactor(0, 0);
    m_outer.setStretchFactor(1, 1);
    m_inner.setStretchFactor(0, 1);
    m_inner.setStretchFactor(1, 1);
    window.installEventFilter(this);
    m_inner.installEventFilter(this);
    m_whole.installEventFilter(this);
    connect(&m_inner, &QSplitter::splitterMoved, this, &LayoutManager::storeInner);
    connect(&m_whole, &QSplitter::splitterMoved, this, [this] { m_health = m_whole.saveState(); });
}

PlotPlace LayoutManager::fitting() const
{
    return m_window.width() < WideEnough ? PlotPlace::Below : PlotPlace::Right;
}

bool LayoutManager::eventFilter(QObject *watched, QEvent *event)
{
    if (event->type() == QEvent::Resize && watched == &m_window && !m_chosen && fitting() != m_place)
        apply(fitting());
    if (event->type() == QEvent::Resize && watched == &m_inner)
        arrange();
    if (event->type() == QEvent::Resize && watched == &m_whole)
        arrangeHealth();
    return QObject::eventFilter(watched, event);
}

void LayoutManager::setPlotPlace(PlotPlace place)
{
    m_chosen = true;
    if (place == m_place)
        return;
    apply(place);
}

void LayoutManager::apply(PlotPlace place)
{
    m_place = place;
    m_inner.restoreState(place == PlotPlace::Right ? m_right : m_below);
    m_inner.setOrientation(place == PlotPlace::Right ? Qt::Horizontal : Qt::Vertical);
    m_inner.setHandleWidth(1);
    m_inner.setChildrenCollapsible(false);
    arrange();
    emit plotPlaceChanged();
}

/// Until a person moves the handle the table has what its columns need, where that leaves room for the plots.
void LayoutManager::arrange()
{
    if (!(m_place == PlotPlace::Right ? m_right : m_below).isEmpty())
        return;
    const int whole = m_place == PlotPlace::Right ? m_inner.width() : m_inner.height();
    const int table = m_place == PlotPlace::Right ? std::max(whole / 2, std::min(TableWidth, whole - PlotWidth))
                                                  : whole * 65 / 100;
    m_inner.setSizes({table, whole - table});
}

void LayoutManager::setHealthShown(bool shown)
{
    if (shown == m_healthShown)
        return;
    m_healthShown = shown;
    m_whole.widget(1)->setVisible(shown);
    if (shown)
        arrangeHealth();
    emit healthShownChanged();
}

/// Until a person moves the handle it has room for a few devices, and stays small in a small window.
void LayoutManager::arrangeHealth()
{
    if (!m_healthShown || !m_health.isEmpty())
        return;
    const int height = std::min(HealthHeight, m_whole.height() * 2 / 5);
    m_whole.setSizes({m_whole.height() - height, height});
}

void LayoutManager::storeInner()
{
    (m_place == PlotPlace::Right ? m_right : m_below) = m_inner.saveState();
}

void LayoutManager::setDefaultSizes()
{
    const QSize screen = m_window.screen() ? m_window.screen()->availableSize() - Frame : DefaultSize;
    m_window.resize(DefaultSize.boundedTo(screen).expandedTo(m_window.minimumSize()));
    m_outer.setSizes({DevicesWidth, m_window.width() - DevicesWidth});
}

void LayoutManager::restore()
{
    const QSettings settings;
    setDefaultSizes();
    if (settings.contains(GeometryKey))
        m_window.restoreGeometry(settings.value(GeometryKey).toByteArray());
    if (settings.contains(OuterKey))
        m_outer.restoreState(settings.value(OuterKey).toByteArray());
    m_outer.setHandleWidth(1);
    m_outer.setChildrenCollapsible(false);
    m_right = settings.value(RightKey).toByteArray();
    m_below = settings.value(BelowKey).toByteArray();
    m_health = settings.value(HealthKey).toByteArray();
    if (!m_health.isEmpty())
        m_whole.restoreState(m_health);
    m_whole.setHandleWidth(1);
    m_whole.setChildrenCollapsible(false);
    setHealthShown(settings.value(HealthShownKey).toBool());
    m_whole.widget(1)->setVisible(m_healthShown); // the state that was restored may say otherwise
    const QString place = settings.value(PlaceKey).toString();
    m_chosen = place == RightName || place == BelowName;
    apply(!m_chosen ? fitting() : place == BelowName ? PlotPlace::Below : PlotPlace::Right);
}

void LayoutManager::save() const
{
    QSettings settings;
    settings.setValue(GeometryKey, m_window.saveGeometry());
    settings.setValue(OuterKey, m_outer.saveState());
    settings.setValue(HealthKey, m_health);
    settings.setValue(HealthShownKey, m_healthShown);
    settings.setValue(RightKey, m_right);
    settings.setValue(BelowKey, m_below);
    settings.setValue(PlaceKey, !m_chosen ? QString() : m_place == PlotPlace::Right ? RightName : BelowName);
}

void LayoutManager::reset()
{
    m_chosen = false;
    m_right.clear();
    m_below.clear();
    m_health.clear();
    setHealthShown(false);
    if (!m_window.isMaximized() && !m_window.isFullScreen())
        setDefaultSizes();
    else
        m_outer.setSizes({DevicesWidth, m_window.width() - DevicesWidth});
    apply(fitting());
}

} // namespace dynascope
