target_sources(dynascope_ui PRIVATE
    record/recordactions.cpp record/recordactions.h
    record/recordbadge.cpp record/recordbadge.h
    record/recordoptionsdialog.cpp record/recordoptionsdialog.h
    record/recordtexts.cpp record/recordtexts.h
    record/recordwishes.cpp record/recordwishes.h
    record/sessionrecorder.cpp record/sessionrecorder.h
    record/sessionstream.cpp record/sessionstream.h
    record/streamdialog.cpp record/streamdialog.h
    record/watcheddevices.cpp record/watcheddevices.h
)
