target_sources(dynascope_ui PRIVATE
    journal/journaldialog.cpp journal/journaldialog.h
    journal/journalmodel.cpp journal/journalmodel.h
    journal/undoactions.cpp journal/undoactions.h
)
