# howl_fit: the program with the command fit alone. It is made of those objects of the program's own
# libraries that fit needs, a third of all, so that run.sh on a new machine has its first answer long
# before all is compiled; nothing is compiled twice. A folder is named where all of it is needed, a file
# where it alone is. What is missing here is a symbol that the linker does not find.
set(howl_fit_parts
    model/*.cc model/effects model/numerics model/loop/crossings.cc model/loop/instrument.cc
    model/loop/flame_table.cc
    estimation/*.cc estimation/analysis estimation/fit estimation/health estimation/joint_records
    estimation/record_fit estimation/residuals estimation/family/problem/membership.cc
    trial/outcome.cc
    io/*.cc io/config io/records io/report/run_file.cc io/results/csv_writer.cc
    io/results/family/family_csv.cc io/results/health_json.cc io/results/record_solution_json.cc
    io/results/solution_json.cc
    app/command_line/command_line.cc app/command_line/flag_words.cc app/command_line/options.cc
    app/commands/fit_command.cc app/files app/fit app/help app/input/config_fit.cc
    app/input/fit_state.cc app/input/problem_input.cc app/input/record_input.cc
    app/input/record_solution.cc app/input/usable_records.cc app/jobs/config_inputs.cc
    app/jobs/output_claim.cc app/jobs/shard.cc app/jobs/unit_store.cc app/process app/text/delay_text.cc app/text/health_text.cc
    app/text/record_fit_text.cc app/text/second_mode_text.cc app/text/text_table.cc
    app/text/vanishing_text.cc app/trial/trial_rig.cc)

set(objects)
foreach(part IN LISTS howl_fit_parts)
  string(REGEX MATCH "^[a-z]+" library ${part})
  set(folder ${PROJECT_SOURCE_DIR}/${library})
  set(target howl_${library})
  if(library STREQUAL "app")
    set(target howl_app_parts)
  endif()
  if(part MATCHES "\\*")
    file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${part})
  elseif(part MATCHES "\\.cc$")
    set(sources ${PROJECT_SOURCE_DIR}/${part})
    # Compiled together with those of its folder that are named here, and not with the others.
    get_source_file_property(group ${sources} TARGET_DIRECTORY ${target} UNITY_GROUP)
    set_source_files_properties(${sources} TARGET_DIRECTORY ${target}
                                PROPERTIES UNITY_GROUP "first_${group}")
  else()
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${part}/*.cc)
  endif()
  foreach(source IN LISTS sources)
    cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${folder} OUTPUT_VARIABLE object)
    get_source_file_property(options ${source} TARGET_DIRECTORY ${target} COMPILE_OPTIONS)
    if(CMAKE_UNITY_BUILD AND NOT options)  # with options of its own a file is compiled alone
      get_source_file_property(group ${source} TARGET_DIRECTORY ${target} UNITY_GROUP)
      set(object Unity/unity_${group}_cxx.cxx)
    endif()
    list(APPEND objects ${CMAKE_BINARY_DIR}/${library}/CMakeFiles/${target}.dir/${object}.o)
  endforeach()
endforeach()
list(REMOVE_DUPLICATES objects)
# By their paths, not as TARGET_OBJECTS, which would ask for the whole of each library.
set_source_files_properties(${objects} PROPERTIES EXTERNAL_OBJECT TRUE GENERATED TRUE)
add_executable(howl_fit main.cc fit_alone.cc ${objects})
target_include_directories(howl_fit PRIVATE ${PROJECT_SOURCE_DIR})
target_link_libraries(howl_fit PRIVATE howl_warnings Ceres::ceres glog::glog TBB::tbb yaml-cpp
                      PkgConfig::MATIO hdf5::hdf5 ZLIB::ZLIB gflags OpenSSL::Crypto)
