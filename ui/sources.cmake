file(GLOB DYNASCOPE_ICONS CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/resources/icons/*.svg)
qt_add_resources(dynascope_ui dynascope_icons PREFIX /icons BASE ${PROJECT_SOURCE_DIR}/resources/icons
    FILES ${DYNASCOPE_ICONS})
target_sources(dynascope_ui PRIVATE
    mainwindow.cpp mainwindow.h
    mainwindow_dialogs.cpp
    window/firstread.cpp window/firstread.h
    window/helpdialogs.cpp window/helpdialogs.h
    window/layoutmanager.cpp window/layoutmanager.h
    window/menus.cpp window/menus.h
    window/outcomes.cpp window/outcomes.h
    window/restartnotice.cpp window/restartnotice.h
    window/statusview.cpp window/statusview.h
    window/torqueguard.cpp window/torqueguard.h
    window/unitmenu.cpp window/unitmenu.h
    window/welcomepage.cpp window/welcomepage.h
)
