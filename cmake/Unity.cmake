# SPDX-License-Identifier: GPL-3.0-or-later
# Compiling for somebody who wants the whole, not the next change: the sources of a folder are read as few, which takes a
# third of the time. So no two sources of one folder may define the same in their anonymous namespaces. The preset dev
# compiles each alone, and shows missing includes.
option(DYNASCOPE_UNITY "Compile the sources of each folder together" OFF)
set(DYNASCOPE_UNITY_LENGTH 12) # sources at a time

# dynascope_unite(TARGET): after all sources have been added, in the folder of the target
function(dynascope_unite target)
    if(NOT DYNASCOPE_UNITY)
        return()
    endif()
    get_target_property(sources ${target} SOURCES)
    list(FILTER sources INCLUDE REGEX "\\.cpp$")
    foreach(source IN LISTS sources)
        get_filename_component(folder ${source} DIRECTORY)
        string(MAKE_C_IDENTIFIER "folder_${folder}" group)
        math(EXPR place "0${${group}_count}")
        math(EXPR part "${place} / ${DYNASCOPE_UNITY_LENGTH}")
        math(EXPR ${group}_count "${place} + 1")
        set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group}_${part})
    endforeach()
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        # Takes a source that is included for a header, in which types of the anonymous namespace were a fault.
        target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
    endif()
endfunction()
