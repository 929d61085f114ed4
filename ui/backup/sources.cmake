target_sources(dynascope_ui PRIVATE
    backup/backupactions.cpp backup/backupactions.h
    backup/comparedialog.cpp backup/comparedialog.h
    backup/comparemodel.cpp backup/comparemodel.h
    backup/comparesource.cpp backup/comparesource.h
    backup/inservodialog.cpp backup/inservodialog.h
    backup/restoredialog.cpp backup/restoredialog.h
)
