# SPDX-License-Identifier: GPL-3.0-or-later
# One target that carries the compiler flags of everything in this tree.
add_library(dynascope_flags INTERFACE)
target_include_directories(dynascope_flags INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_definitions(dynascope_flags INTERFACE
    QT_NO_CAST_FROM_ASCII QT_NO_CAST_TO_ASCII QT_NO_URL_CAST_FROM_STRING QT_NO_CAST_FROM_BYTEARRAY
    QT_NO_NARROWING_CONVERSIONS_IN_CONNECT QT_NO_FOREACH QT_NO_JAVA_STYLE_ITERATORS
    QT_DISABLE_DEPRECATED_BEFORE=0x060400)
target_compile_options(dynascope_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
    -Woverloaded-virtual -Wcast-align -Wunused -Wimplicit-fallthrough)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(dynascope_flags INTERFACE -fpch-preprocess) # lets ccache see through precompiled headers
endif()
if(DYNASCOPE_WERROR)
    target_compile_options(dynascope_flags INTERFACE -Werror)
endif()
if(DYNASCOPE_SANITIZE)
    target_compile_options(dynascope_flags INTERFACE -fsanitize=${DYNASCOPE_SANITIZE} -fno-omit-frame-pointer
        -fno-sanitize-recover=all)
    target_link_options(dynascope_flags INTERFACE -fsanitize=${DYNASCOPE_SANITIZE})
    find_program(DYNASCOPE_LLD ld.lld)
    if(DYNASCOPE_LLD AND CMAKE_CXX_COMPILER_ID MATCHES Clang) # a hundred programs, seconds each with GNU's
        target_link_options(dynascope_flags INTERFACE -fuse-ld=lld)
    endif()
endif()
if(DYNASCOPE_FUZZ)
    target_compile_options(dynascope_flags INTERFACE -fsanitize=fuzzer-no-link) # what libFuzzer is guided by
endif()
