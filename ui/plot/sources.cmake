target_sources(dynascope_ui PRIVATE
    plot/areatrigger.cpp plot/areatrigger.h
    plot/axisscaler.cpp plot/axisscaler.h
    plot/chartframe.cpp plot/chartframe.h
    plot/columncache.cpp plot/columncache.h
    plot/columnraster.cpp plot/columnraster.h
    plot/csvsave.cpp plot/csvsave.h
    plot/measuremodel.cpp plot/measuremodel.h
    plot/measuretable.cpp plot/measuretable.h
    plot/plotarea.cpp plot/plotarea.h
    plot/plotarea_cursors.cpp
    plot/plotarea_state.cpp
    plot/plotarea_times.cpp
    plot/plotbar.cpp plot/plotbar.h
    plot/plotchart.cpp plot/plotchart.h
    plot/plotchart_input.cpp
    plot/plotcursors.cpp plot/plotcursors.h
    plot/plotdrawing.cpp plot/plotdrawing.h
    plot/plotexport.cpp plot/plotexport.h
    plot/plotlayouts.cpp plot/plotlayouts.h
    plot/plotmarks.cpp plot/plotmarks.h
    plot/plotpanel.cpp plot/plotpanel.h
    plot/plotreadout.cpp plot/plotreadout.h
    plot/plotsaver.cpp plot/plotsaver.h
    plot/plotscales.cpp plot/plotscales.h
    plot/plotstate.cpp plot/plotstate.h
    plot/plottrigger.cpp plot/plottrigger.h
    plot/timeticks.cpp plot/timeticks.h
    plot/timewindow.cpp plot/timewindow.h
    plot/tracecolors.cpp plot/tracecolors.h
    plot/tracedata.h
    plot/tracedelegate.cpp plot/tracedelegate.h
    plot/traceimage.cpp plot/traceimage.h
    plot/tracelist.cpp plot/tracelist.h
    plot/tracemodel.cpp plot/tracemodel.h
    plot/tracemodel_derived.cpp
    plot/tracepaths.cpp plot/tracepaths.h
    plot/triggerdialog.cpp plot/triggerdialog.h
    plot/triggermark.cpp plot/triggermark.h
    plot/deriveddialog.cpp plot/deriveddialog.h
)
