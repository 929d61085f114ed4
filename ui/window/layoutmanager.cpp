// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/layoutmanager.h"

#include <QEvent>
#include <QMainWindow>
#include <QScreen>
#include <QSettings>
#include <QSplitter>

namespace dynascope {

namespace {

constexpr QSize DefaultSize(1360, 860);
constexpr int WideEnough = 1200; ///< from here on table and plots fit beside each other
constexpr int DevicesWidth = 264;

const QString GeometryKey = QStringLiteral("window/geometry");
const QString OuterKey = QStringLiteral("window/outer");
const QString RightKey = QStringLiteral("window/plotsRight");
const QString BelowKey = QStringLiteral("window/plotsBelow");
const QString RightName = QStringLiteral("right");
const QString BelowName = QStringLiteral("below");
const QString PlaceKey = QStringLiteral("window/plotPlace");

} // namespace

LayoutManager::LayoutManager(QMainWindow &window, QSplitter &outer, QSplitter &inner)
    : QObject(&window)
    , m_window(window)
    , m_outer(outer)
    , m_inner(inner)
{
    m_outer.setChildrenCollapsible(false);
    m_inner.setChildrenCollapsible(false);
    m_outer.setStretchFactor(0, 0);
    m_outer.setStretchFactor(1, 1);
    m_inner.setStretchFactor(0, 1);
    m_inner.setStretchFactor(1, 1);
    window.installEventFilter(this);
}

PlotPlace LayoutManager::fitting() const
{
    return m_window.width() < WideEnough ? PlotPlace::Below : PlotPlace::Right;
}

bool LayoutManager::eventFilter(QObject *watched, QEvent *event)
{
    if (watched == &m_window && event->type() == QEvent::Resize && !m_chosen && fitting() != m_place) {
        storeInner();
        apply(fitting());
    }
    return QObject::eventFilter(watched, event);
}

void LayoutManager::setPlotPlace(PlotPlace place)
{
    m_chosen = true;
    if (place == m_place)
        return;
    storeInner();
    apply(place);
}

void LayoutManager::apply(PlotPlace place)
{
    m_place = place;
    m_inner.setOrientation(place == PlotPlace::Right ? Qt::Horizontal : Qt::Vertical);
    const QByteArray &state = place == PlotPlace::Right ? m_right : m_below;
    if (state.isEmpty() || !m_inner.restoreState(state)) {
        m_inner.setOrientation(place == PlotPlace::Right ? Qt::Horizontal : Qt::Vertical);
        const int whole = place == PlotPlace::Right ? m_inner.width() : m_inner.height();
        const int table = whole * (place == PlotPlace::Right ? 55 : 60) / 100;
        m_inner.setSizes({table, whole - table});
    }
    m_inner.setHandleWidth(1);
    m_inner.setChildrenCollapsible(false);
    emit plotPlaceChanged();
}

void LayoutManager::storeInner()
{
    (m_place == PlotPlace::Right ? m_right : m_below) = m_inner.saveState();
}

void LayoutManager::setDefaultSizes()
{
    const QSize screen = m_window.screen() ? m_window.screen()->availableSize() : DefaultSize;
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
    const QString place = settings.value(PlaceKey).toString();
    m_chosen = place == RightName || place == BelowName;
    apply(!m_chosen ? fitting() : place == BelowName ? PlotPlace::Below : PlotPlace::Right);
}

void LayoutManager::save() const
{
    QSettings settings;
    settings.setValue(GeometryKey, m_window.saveGeometry());
    settings.setValue(OuterKey, m_outer.saveState());
    settings.setValue(RightKey, m_place == PlotPlace::Right ? m_inner.saveState() : m_right);
    settings.setValue(BelowKey, m_place == PlotPlace::Below ? m_inner.saveState() : m_below);
    settings.setValue(PlaceKey, !m_chosen ? QString() : m_place == PlotPlace::Right ? RightName : BelowName);
}

void LayoutManager::reset()
{
    m_chosen = false;
    m_right.clear();
    m_below.clear();
    if (!m_window.isMaximized() && !m_window.isFullScreen())
        setDefaultSizes();
    else
        m_outer.setSizes({DevicesWidth, m_window.width() - DevicesWidth});
    apply(fitting());
}

} // namespace dynascope
