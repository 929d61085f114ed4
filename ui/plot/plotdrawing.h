// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QSize>

#include <vector>

class QPainter;

namespace dynascope {

class PlotPanel;

/// What the panels show, for a file: their charts below each other without what can be clicked, and below each all of its
/// traces by colour and name, or, with cursors, the figures between them.
class PlotDrawing
{
public:
    /// The panels outlive this.
    explicit PlotDrawing(const std::vector<PlotPanel *> &panels) : m_panels(panels) { }

    QSize size() const;
    void paint(QPainter &painter) const;

private:
    const std::vector<PlotPanel *> &m_panels;
};

} // namespace dynascope
