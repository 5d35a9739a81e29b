# Compile options of every target of this project.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")

find_program(ENCORE_CCACHE ccache)
if(ENCORE_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${ENCORE_CCACHE}")
endif()

add_library(encore_options INTERFACE)
target_compile_options(encore_options INTERFACE
  -Wall -Wextra -Wshadow
  # g++ 12 warns of overlaps in std::string's operator+ that cannot happen (GCC bug 105651).
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>
  # a*b+c is never fused behind our back: hits, images and procedural scenes are the same bit for
  # bit on every machine, and exact cancellations in the edge tests stay exact.
  -ffp-contract=off
  $<$<BOOL:${ENCORE_WERROR}>:-Werror>
  # ... and of optional values that are always set before they are read (GCC bug 80635).
  $<$<AND:$<BOOL:${ENCORE_WERROR}>,$<CXX_COMPILER_ID:GNU>>:-Wno-error=maybe-uninitialized>)
target_include_directories(encore_options INTERFACE "${PROJECT_SOURCE_DIR}")

if(ENCORE_SANITIZE)
  add_compile_options(-fsanitize=${ENCORE_SANITIZE} -fno-omit-frame-pointer
                      -fno-sanitize-recover=undefined)
  add_link_options(-fsanitize=${ENCORE_SANITIZE})
endif()
if(ENCORE_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()

# encore_library(<folder> SOURCES <files> [LIBRARIES <targets>]): the library of one folder.
function(encore_library folder)
  cmake_parse_arguments(arg "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_library(encore_${folder} STATIC ${arg_SOURCES})
  target_link_libraries(encore_${folder} PUBLIC encore_options ${arg_LIBRARIES})
endfunction()
