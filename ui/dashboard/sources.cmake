target_sources(dynascope_ui PRIVATE
    dashboard/alarmmodel.cpp dashboard/alarmmodel.h
    dashboard/dashboarddelegate.cpp dashboard/dashboarddelegate.h
    dashboard/dashboarddialog.cpp dashboard/dashboarddialog.h
    dashboard/dashboardmodel.cpp dashboard/dashboardmodel.h
    dashboard/dashboardrow.cpp dashboard/dashboardrow.h
    dashboard/faultsaver.cpp dashboard/faultsaver.h
)
