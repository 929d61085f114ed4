target_sources(dynascope_ui PRIVATE
    library/firmwarechanges.cpp library/firmwarechanges.h
    library/librarydelegate.cpp library/librarydelegate.h
    library/librarydialog.cpp library/librarydialog.h library/librarydialog_build.cpp
    library/libraryreader.cpp library/libraryreader.h
    library/librarytexts.cpp library/librarytexts.h
    library/libraryview.cpp library/libraryview.h
    library/modeldelegate.cpp library/modeldelegate.h
    library/modelheader.cpp library/modelheader.h
    library/modelpanel.cpp library/modelpanel.h
    library/registermodel.cpp library/registermodel.h
    library/rowstext.cpp library/rowstext.h
    library/searchmodel.cpp library/searchmodel.h
)
