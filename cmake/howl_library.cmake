# One library a folder. howl_library(NAME ...) takes every source in the current folder and below it,
# so that a new effect, residual or reader is one new file and no build change. INSTALL: a part of the
# installed library too, with those headers of cmake/installed_headers.cmake that are its own.
include(${CMAKE_CURRENT_LIST_DIR}/installed_headers.cmake)

# In instrumented code GCC sees uninitialised values and overruns where there are none: what counts
# are the warnings of the plain build.
if(NOT HOWL_SANITIZE)
  set(howl_warnings_are_errors -Werror)
endif()
add_library(howl_warnings INTERFACE)
target_compile_options(howl_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
                       -Wold-style-cast -Woverloaded-virtual ${howl_warnings_are_errors}
                       # Designated initialisers leave the rest at its default on purpose.
                       -Wno-missing-field-initializers)
# GCC 12 sees overlapping copies in std::string's operator+ where there are none (bug 105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(howl_warnings INTERFACE -Wno-restrict)
endif()

# Complex products without a second look for infinities; clang, and so clang-tidy, does not know the
# option.
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND NOT CMAKE_CXX_CLANG_TIDY)
  set(howl_finite_complex -fcx-limited-range)
endif()

# The headers that most files of a target include, parsed once for the target; every file still names
# what it uses. Saves a quarter of the compiling. Not for tools that read the compile commands, such as
# clang-tidy, nor where a file's options differ from its target's (SKIP_PRECOMPILE_HEADERS).
option(HOWL_PRECOMPILE "Precompile the headers that most files include" OFF)
if(HOWL_PRECOMPILE AND CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # Writes past the end of a std::string, seen where there are none.
  target_compile_options(howl_warnings INTERFACE -Wno-stringop-overflow)
endif()
function(howl_precompile target)
  if(HOWL_PRECOMPILE)
    target_precompile_headers(${target} PRIVATE <algorithm> <array> <cmath> <complex> <cstdio>
                              <filesystem> <functional> <memory> <optional> <span> <sstream>
                              <string> <vector> ${ARGN})
  endif()
endfunction()

function(howl_library name)
  cmake_parse_arguments(ARG "INSTALL" "" "PUBLIC;PRIVATE;PRECOMPILE" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cc)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.h)
  add_library(howl_${name} STATIC ${sources} ${headers})
  add_library(howl::${name} ALIAS howl_${name})
  set_target_properties(howl_${name} PROPERTIES EXPORT_NAME ${name} LINKER_LANGUAGE CXX)
  target_compile_features(howl_${name} PUBLIC cxx_std_20)
  target_include_directories(howl_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/howl>)
  target_link_libraries(howl_${name} PUBLIC ${ARG_PUBLIC}
                        PRIVATE ${ARG_PRIVATE} $<BUILD_INTERFACE:howl_warnings>)
  howl_precompile(howl_${name} ${ARG_PRECOMPILE})
  if(NOT ARG_INSTALL)
    return()
  endif()
  install(TARGETS howl_${name} EXPORT howl_targets
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
  foreach(header IN LISTS howl_front_headers howl_included_headers)
    cmake_path(GET header PARENT_PATH folder)
    if(folder MATCHES "^${name}(/|$)")
      install(FILES ${PROJECT_SOURCE_DIR}/${header}
              DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/howl/${folder} COMPONENT development)
    endif()
  endforeach()
endfunction()
