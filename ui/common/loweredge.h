// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QPointer>
#include <QRect>

#include <functional>

class QWidget;

namespace dynascope {

/// Lays a strip over the lower edge of a widget, as high as its text needs: nothing under a pointer moves when it comes
/// or goes. Owned by the strip. The strip's parent is the ground's window or something between.
class LowerEdge : public QObject
{
    Q_OBJECT

public:
    LowerEdge(QWidget &strip, QWidget &ground);

    void standOn(QWidget &other); ///< above it where both are shown
    void coverAll() { m_coversAll = true; } ///< at least as high as the ground
    /// What must stay in sight, in the ground's coordinates: where it would be hidden the strip goes to the upper edge.
    void spare(std::function<QRect()> area) { m_spared = std::move(area); }

    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    void place();

    QWidget &m_strip;
    QPointer<QWidget> m_ground;
    QPointer<QWidget> m_under;
    std::function<QRect()> m_spared;
    bool m_coversAll = false;
};

} // namespace dynascope
