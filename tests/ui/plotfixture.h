// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/table/catalog.h"
#include "ui/plot/plotarea.h"
#include "ui/plot/plotbar.h"
#include "ui/plot/plotchart.h"
#include "ui/plot/plotpanel.h"
#include "ui/plot/tracelist.h"
#include "ui/plot/tracemodel.h"

#include <QAction>

namespace dynascope {

/// No line opens: what the devices say, the test says in their place.
class NoLines : public LineFactory
{
public:
    bool knows(const QString &) const override { return true; }
    Result<std::unique_ptr<Line>> open(const QString &name, int) override
    {
        return failure(ErrorKind::PortNotFound, name);
    }
};

/// A session with two servos, and a plot area.
struct PlotBench {
    NoLines factory;
    Catalog catalog = Catalog::builtIn().value();
    Session session{factory, catalog};
    Monitor monitor{session};
    LineSession &line = session.open(QStringLiteral("test"), 1'000'000);
    Device &first = line.heard({1, 1'000'000, 1020, 45, false, {}});
    Device &second = line.heard({2, 1'000'000, 1060, 45, false, {}});
    PlotArea area{session, monitor};

    PlotBench()
    {
        area.resize(900, 400);
        area.show();
    }

    Watch watch(const Device &device, const char *field) const
    {
        return {device.key(), device.table().indexOf(QString::fromLatin1(field))};
    }

    /// One poll cycle brings this.
    void sample(const Watch &watch, LineTime at, std::int32_t raw)
    {
        const Device *device = session.device(watch.device);
        const Field &field = device->table().fields()[static_cast<std::size_t>(watch.field)];
        Batch batch;
        PollValue value;
        value.device = watch.device;
        value.address = field.address;
        value.length = field.size;
        value.data = bytesFromRaw(field, raw);
        value.at = at;
        batch.values.push_back(value);
        emit line.batchTaken(batch);
    }

    TraceModel &model(std::size_t panel = 0) const { return area.panels()[panel]->model(); }
    PlotChart &chart(std::size_t panel = 0) const { return area.panels()[panel]->chart(); }
    TraceList &list(std::size_t panel = 0) const { return *area.panels()[panel]->findChild<TraceList *>(); }
    QAction *action(const QString &text) const
    {
        for (QAction *action : area.findChild<PlotBar *>()->findChildren<QAction *>()) {
            if (action->text() == text)
                return action;
        }
        return nullptr;
    }
};

} // namespace dynascope
