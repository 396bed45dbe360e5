# `cpack` in the build folder makes two Debian packages. howl: the programs and their data, which need
# no compiler. libhowl-dev: headers, static libraries and what find_package(howl) reads; it is a package
# of its own since it draws in the development packages of Ceres, Eigen, Boost and oneTBB (some 500 MB),
# which nobody needs who runs the program.
set(HOWL_MAINTAINER "The howl authors <howl@example.org>" CACHE STRING
    "Who answers for the packages; whoever distributes them gives a real address")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT ${HOWL_MAINTAINER})
set(CPACK_PACKAGE_VENDOR "The howl authors")
# Each package has a description of its own, to which cpack would add the project's.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE
    GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program data debian development debian_development)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)

set(CPACK_DEBIAN_HOWL_PACKAGE_NAME howl)
set(CPACK_DEBIAN_HOWL_PACKAGE_SECTION science)
set(CPACK_DEBIAN_HOWL_PACKAGE_SHLIBDEPS ON)
# The figures of howl report alone need gnuplot: without it the report says so and keeps their data and
# scripts. So a node of a cluster may go without.
set(CPACK_DEBIAN_HOWL_PACKAGE_RECOMMENDS "gnuplot-nox | gnuplot")
set(CPACK_DEBIAN_HOWL_PACKAGE_SUGGESTS "slurm-client")
set(CPACK_DEBIAN_HOWL_DESCRIPTION [[
grey-box identification of self-excited feedback loops
howl identifies self-excited feedback loops from records that nobody
excited: first of all lean combustors that oscillate by themselves. From
pressure and heat release, recorded in closed loop in a limit cycle at a few
operating points, or from a published table of such records, it finds the
models that fit, bounds every model that the data cannot reject, and says
where, why and by how much the model falls short of the rig.
]])

set(CPACK_DEBIAN_LIBHOWL_DEV_PACKAGE_NAME libhowl-dev)
set(CPACK_DEBIAN_LIBHOWL_DEV_PACKAGE_SECTION libdevel)
# What howl-config.cmake finds.
set(CPACK_DEBIAN_LIBHOWL_DEV_PACKAGE_DEPENDS
    "libboost-dev, libceres-dev, libeigen3-dev, libgoogle-glog-dev, libtbb-dev")
set(CPACK_DEBIAN_LIBHOWL_DEV_PACKAGE_SUGGESTS howl)
set(CPACK_DEBIAN_LIBHOWL_DEV_DESCRIPTION [[
identification of self-excited feedback loops (C++ library)
Static libraries, headers and CMake files of howl, for find_package(howl):
howl::model has the loop's physics (acoustics, flame, delay, poles, limit
cycles by harmonic balance, continuation, simulation), howl::estimation the
way from records to parameters (analysis, joint fits, families of models and
their guaranteed bounds).
]])

# What a Debian package has beside what `cmake --install` installs.
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(ENV{SOURCE_DATE_EPOCH} ${howl_source_date})
string(TIMESTAMP howl_changelog_date "%a, %d %b %Y %H:%M:%S +0000" UTC)
set(debian ${CMAKE_BINARY_DIR}/debian)
configure_file(packaging/debian/changelog.in ${debian}/changelog.Debian @ONLY)
configure_file(CHANGELOG.md ${debian}/changelog COPYONLY)
foreach(text changelog.Debian changelog)
  execute_process(COMMAND gzip -9nc ${debian}/${text} OUTPUT_FILE ${debian}/${text}.gz
                  COMMAND_ERROR_IS_FATAL ANY)
endforeach()
foreach(howl_package howl libhowl-dev)
  configure_file(packaging/debian/lintian-overrides.in ${debian}/overrides/${howl_package} @ONLY)
  set(part debian)
  if(howl_package STREQUAL libhowl-dev)
    set(part debian_development)
  endif()
  install(FILES packaging/debian/copyright ${debian}/changelog.Debian.gz ${debian}/changelog.gz
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${howl_package} COMPONENT ${part} EXCLUDE_FROM_ALL)
  install(FILES ${debian}/overrides/${howl_package}
          DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides COMPONENT ${part} EXCLUDE_FROM_ALL)
endforeach()
install(FILES app/help/completion/howl.zsh RENAME _howl
        DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions
        COMPONENT debian EXCLUDE_FROM_ALL)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libhowl-dev
        COMPONENT debian_development EXCLUDE_FROM_ALL)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT local)

include(CPack)
cpack_add_component_group(howl)
cpack_add_component_group(libhowl_dev)
foreach(part program data debian)
  cpack_add_component(${part} GROUP howl)
endforeach()
foreach(part development debian_development)
  cpack_add_component(${part} GROUP libhowl_dev)
endforeach()
