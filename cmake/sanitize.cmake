# HOWL_SANITIZE=address,undefined (or thread): everything in this build is made with these sanitizers,
# and the first finding ends the program, so that a test sees it.
if(HOWL_SANITIZE)
  if(HOWL_SANITIZE MATCHES "thread" AND HOWL_SANITIZE MATCHES "address")
    message(FATAL_ERROR "HOWL_SANITIZE: ${HOWL_SANITIZE}: thread and address exclude each other")
  endif()
  add_compile_options(-fsanitize=${HOWL_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  # These three would be looked for at every access, and take a third of the compiling. The address
  # sanitizer finds a null pointer and a wrong type's overrun too.
  if(HOWL_SANITIZE MATCHES "undefined")
    add_compile_options(-fno-sanitize=null,alignment,vptr)
  endif()
  add_link_options(-fsanitize=${HOWL_SANITIZE})
endif()
# libFuzzer needs to see which branches an input takes; its main() comes with the targets of tests/fuzz.
if(HOWL_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL Clang)
    message(FATAL_ERROR "HOWL_FUZZ: libFuzzer is clang's, but this is ${CMAKE_CXX_COMPILER_ID}")
  endif()
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()
# Which lines of the readers an input reaches: the program writes it when it ends. What is not a reader is
# compiled as ever, so that turning this on compiles a third anew.
if(HOWL_COVERAGE)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL Clang)
    message(FATAL_ERROR "HOWL_COVERAGE: llvm-cov is clang's, but this is ${CMAKE_CXX_COMPILER_ID}")
  endif()
  set(howl_count_lines -fprofile-instr-generate -fcoverage-mapping)
  add_link_options(-fprofile-instr-generate)
endif()
# Of a library that does more than read: these files of it alone.
function(howl_count_lines_of)
  if(HOWL_COVERAGE)
    set_property(SOURCE ${ARGN} APPEND PROPERTY COMPILE_OPTIONS ${howl_count_lines})
  endif()
endfunction()
