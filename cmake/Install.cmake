# SPDX-License-Identifier: GPL-3.0-or-later
# Programs, desktop entry, icon, and the udev rule that makes servo adapters usable and quick.
include(GNUInstallDirs)

# udev reads /usr/lib, /usr/local/lib and /etc; for another prefix say where it is to go.
set(DYNASCOPE_UDEV_DIR "lib/udev/rules.d" CACHE STRING "Where the udev rule goes, under the install prefix if relative")

install(TARGETS dxl RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES ${PROJECT_SOURCE_DIR}/resources/dxl.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
if(TARGET dxl_completions)
    set(completions ${CMAKE_BINARY_DIR}/completions)
    install(FILES ${completions}/dxl.bash RENAME dxl DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
    install(FILES ${completions}/dxl.zsh RENAME _dxl DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
    install(FILES ${completions}/dxl.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
endif()
if(DYNASCOPE_WINDOW)
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
