# SPDX-License-Identifier: GPL-3.0-or-later
# Programs, desktop entry, icon, and the udev rule that makes servo adapters usable and quick.
include(GNUInstallDirs)

# udev reads /etc and /usr/lib (or /lib), wherever else we are installed; packages set this.
set(DYNASCOPE_UDEV_DIR "lib/udev/rules.d" CACHE STRING "Where the udev rule goes, under the install prefix if relative")

if(TARGET dxl)
    install(TARGETS dxl RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
if(TARGET dynascope)
    install(TARGETS dynascope RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
    install(FILES ${PROJECT_SOURCE_DIR}/resources/dynascope.desktop
        DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
    install(FILES ${PROJECT_SOURCE_DIR}/resources/icons/dynascope.svg
        DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
endif()
if(CMAKE_SYSTEM_NAME STREQUAL "Linux")
    install(FILES ${PROJECT_SOURCE_DIR}/resources/70-dynascope.rules DESTINATION ${DYNASCOPE_UDEV_DIR})
endif()
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md
    DESTINATION ${CMAKE_INSTALL_DOCDIR})
