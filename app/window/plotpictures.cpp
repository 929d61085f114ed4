// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/window/plotpictures.h"

#include "ui/plot/plotarea.h"
#include "ui/plot/plotpanel.h"
#include "ui/plot/tracelist.h"
#include "ui/plot/tracemodel.h"

#include <QAction>
#include <QDialog>

#include <chrono>

namespace dynascope {

using namespace std::chrono_literals;

std::vector<Device *> PlotPictures::joints() const
{
    std::vector<Device *> present;
    for (Device *device : m_workshop.session().devices()) {
        if (device->state() == Device::State::Present)
            present.push_back(device);
    }
    return present;
}

PlotArea *PlotPictures::plots() const
{
    return m_workshop.window().findChild<PlotArea *>();
}

void PlotPictures::setUp()
{
    const std::vector<Device *> devices = joints();
    if (devices.empty())
        return;
    PlotArea &area = *plots();
    area.addPanel();
    const auto watch = [](const Device &device, QStringView field) {
        return Watch{device.key(), device.table().indexOf(field)};
    };
    for (std::size_t i = 0; i < std::min<std::size_t>(3, devices.size()); ++i) {
        Derivation lag;
        lag.kind = Derivation::Kind::Difference;
        lag.other = watch(*devices[i], u"Present Position");
        area.addTrace({watch(*devices[i], u"Goal Position"), lag});
    }
    Derivation mean;
    mean.kind = Derivation::Kind::Average;
    mean.span = 500ms;
    area.addTrace({watch(*devices.front(), u"Present Current"), mean});
}

/// Of a joint that is plotted; the first of them fires the trigger.
void PlotPictures::addEvents()
{
    const std::vector<Device *> devices = joints();
    if (devices.empty())
        return;
    Device &device = *devices.front();
    m_workshop.commands().writeField(device, device.table().indexOf(u"LED"), 1);
    m_workshop.commands().setTorque({&device}, false, {});
}

void PlotPictures::measure()
{
    TriggerChoice choice;
    choice.settings.kind = TriggerSettings::Kind::Event;
    choice.settings.before = 6s;
    choice.settings.after = 2s;
    plots()->arm(choice);
    plots()->setCursorsOn(true);
}

QDialog *PlotPictures::openDerived()
{
    for (const PlotPanel *panel : plots()->panels()) {
        if (panel->model().watches().empty())
            continue;
        panel->findChild<TraceList *>()->askForDerived();
        break;
    }
    return m_workshop.window().findChild<QDialog *>(QStringLiteral("derivedDialog"));
}

QDialog *PlotPictures::openTrigger()
{
    plots()->askForTrigger();
    return m_workshop.window().findChild<QDialog *>(QStringLiteral("triggerDialog"));
}

} // namespace dynascope
