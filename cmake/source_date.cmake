# howl_source_date: the date of these sources in seconds since 1970, for manual pages and the packages'
# changelog, so that the same sources give the same packages: SOURCE_DATE_EPOCH of the environment
# (https://reproducible-builds.org), else that of the last commit, else now.
if(DEFINED ENV{SOURCE_DATE_EPOCH})
  set(howl_source_date $ENV{SOURCE_DATE_EPOCH})
else()
  execute_process(COMMAND git log -1 --format=%ct WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
                  OUTPUT_VARIABLE howl_source_date OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT howl_source_date MATCHES "^[0-9]+$")
    string(TIMESTAMP howl_source_date %s UTC)
  endif()
endif()
