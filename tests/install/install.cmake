# SPDX-License-Identifier: GPL-3.0-or-later
# What `cmake --install` puts where, twice: packed below DESTDIR, and straight into a prefix, from which the programs run.
# Nothing is built. cmake -D BUILD=... -D SOURCE=... -D VERSION=... -D WINDOW=ON|OFF -D CHECKS=DIRECTORY -P install.cmake
cmake_minimum_required(VERSION 3.22)

set(programs bin/dxl)
set(files
    share/man/man1/dxl.1=resources/dxl.1
    lib/udev/rules.d/70-dynascope.rules=resources/70-dynascope.rules
    share/doc/Dynascope/LICENSE=LICENSE
    share/doc/Dynascope/README.md=README.md)
set(completions
    share/bash-completion/completions/dxl
    share/zsh/site-functions/_dxl
    share/fish/vendor_completions.d/dxl.fish)
if(WINDOW)
    list(APPEND programs bin/dynascope)
    list(APPEND files
        share/applications/dynascope.desktop=resources/dynascope.desktop
        share/icons/hicolor/scalable/apps/dynascope.svg=resources/icons/dynascope.svg)
endif()

# Every file that is wanted below this directory, and no other.
function(check_prefix prefix)
    set(wanted ${programs} ${completions})
    foreach(pair IN LISTS files)
        string(REPLACE "=" ";" pair "${pair}")
        list(GET pair 0 installed)
        list(GET pair 1 original)
        list(APPEND wanted ${installed})
        if(NOT EXISTS ${prefix}/${installed})
            message(FATAL_ERROR "Not installed: ${prefix}/${installed}")
        endif()
        file(SHA256 ${prefix}/${installed} is)
        file(SHA256 ${SOURCE}/${original} should)
        if(NOT is STREQUAL should)
            message(FATAL_ERROR "${prefix}/${installed} is not ${original}")
        endif()
    endforeach()
    file(GLOB_RECURSE found RELATIVE ${prefix} ${prefix}/*)
    list(SORT found)
    list(SORT wanted)
    if(NOT found STREQUAL wanted)
        message(FATAL_ERROR "In ${prefix} there is\n  ${found}\nand there should be\n  ${wanted}")
    endif()
    foreach(script IN LISTS completions)
        file(READ ${prefix}/${script} text)
        if(NOT text MATCHES "dxl" OR NOT text MATCHES "scan")
            message(FATAL_ERROR "${prefix}/${script} completes nothing:\n${text}")
        endif()
    endforeach()
endfunction()

function(install prefix)
    execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix}
        RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
    if(NOT status EQUAL 0)
        message(FATAL_ERROR "cmake --install failed: ${status}\n${output}")
    endif()
endfunction()

file(REMOVE_RECURSE ${CHECKS})
set(ENV{DESTDIR} ${CHECKS}/packed)
install(/usr)
check_prefix(${CHECKS}/packed/usr)
file(GLOB others RELATIVE ${CHECKS}/packed ${CHECKS}/packed/*)
if(NOT others STREQUAL usr)
    message(FATAL_ERROR "Outside of the prefix there is: ${others}")
endif()

unset(ENV{DESTDIR})
set(prefix "${CHECKS}/a prefix")
install("${prefix}")
check_prefix("${prefix}")
foreach(program IN LISTS programs)
    execute_process(COMMAND "${prefix}/${program}" --version
        RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE errors)
    get_filename_component(name ${program} NAME)
    if(NOT status EQUAL 0 OR NOT output STREQUAL "${name} ${VERSION}\n")
        message(FATAL_ERROR "${prefix}/${program} --version: ${status}\n${output}${errors}")
    endif()
endforeach()

if(WINDOW) # what the desktop entry starts and shows is there
    file(STRINGS "${prefix}/share/applications/dynascope.desktop" lines)
    foreach(line "Exec=dynascope %F" "Icon=dynascope")
        if(NOT line IN_LIST lines)
            message(FATAL_ERROR "The desktop entry has no line ${line}")
        endif()
    endforeach()
endif()

file(REMOVE_RECURSE ${CHECKS})
message(STATUS "Everything is installed where it belongs")
