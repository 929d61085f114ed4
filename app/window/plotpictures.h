// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/window/workshop.h"

class QDialog;

namespace dynascope {

class PlotArea;

/// Plots with what they can do besides plotting, for pictures of it: derived traces in a panel of their own, events,
/// cursors, a trigger. Needs the demo. GUI thread.
class PlotPictures
{
public:
    explicit PlotPictures(Workshop &workshop) : m_workshop(workshop) { }

    void setUp();     ///< what it shows takes some seconds to come
    void measure();   ///< cursors on, and a trigger that waits for events
    void addEvents(); ///< two seconds later the view stands around them
    QDialog *openDerived();
    QDialog *openTrigger();

private:
    std::vector<Device *> joints() const;
    PlotArea *plots() const;

    Workshop &m_workshop;
};

} // namespace dynascope
