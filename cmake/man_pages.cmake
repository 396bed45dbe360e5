# Writes the manual pages of HOWL and RIG, compressed, to FOLDER:
#   cmake -D HOWL=.../howl -D RIG=.../howl_rig -D FOLDER=... -P man_pages.cmake
function(write_page page)
  execute_process(COMMAND ${ARGN} COMMAND gzip -9n OUTPUT_FILE ${FOLDER}/${page}.1.gz
                  COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER})
execute_process(COMMAND ${HOWL} help commands OUTPUT_VARIABLE commands COMMAND_ERROR_IS_FATAL ANY)
string(STRIP "${commands}" commands)
string(REPLACE "\n" ";" commands "${commands}")
foreach(command IN LISTS commands)
  write_page(howl-${command} ${HOWL} help man ${command})
endforeach()
write_page(howl ${HOWL} help man)
write_page(howl_rig ${RIG} --man)
