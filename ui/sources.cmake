file(GLOB DYNASCOPE_ICONS CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/resources/icons/*.svg)
qt_add_resources(dynascope_ui dynascope_icons PREFIX /icons BASE ${PROJECT_SOURCE_DIR}/resources/icons
    FILES ${DYNASCOPE_ICONS})
target_sources(dynascope_ui PRIVATE
    mainwindow.cpp mainwindow.h
)
