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

# With CMAKE_UNITY_BUILD the sources of one folder are compiled together, which takes less than half
# of the time: so no two of them may define the same name. A folder is a group, not any eight files, so that
# a new file changes what its own folder's names meet and nothing else.
function(howl_unite_folders target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
    cmake_path(GET source PARENT_PATH folder)
    string(MAKE_C_IDENTIFIER "${folder}" group)
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP "of_${group}")
  endforeach()
endfunction()

function(howl_library name)
  cmake_parse_arguments(ARG "INSTALL" "" "PUBLIC;PRIVATE" ${ARGN})
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
  howl_unite_folders(howl_${name})
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
