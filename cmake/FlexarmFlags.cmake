# Warnings of our own code; libraries come in as SYSTEM. The presets make them errors.
add_library(flexarm_flags INTERFACE)
target_compile_options(flexarm_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                       -Wsign-conversion -Wnon-virtual-dtor -Woverloaded-virtual)
if(FLEXARM_SANITIZE STREQUAL "address")
  set(sanitizers -fsanitize=address,undefined)
elseif(FLEXARM_SANITIZE STREQUAL "thread")
  set(sanitizers -fsanitize=thread)
elseif(FLEXARM_SANITIZE)
  message(FATAL_ERROR "FLEXARM_SANITIZE = ${FLEXARM_SANITIZE}: must be address, thread or empty")
endif()
if(FLEXARM_SANITIZE)
  # With sanitizers GCC 12 takes variables of <regex> for uninitialised.
  add_compile_options(${sanitizers} -fno-sanitize-recover=all -fno-omit-frame-pointer
                      $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  add_link_options(${sanitizers})
endif()
if(FLEXARM_COVERAGE)
  add_compile_options(--coverage)
  add_link_options(--coverage)
endif()
if(FLEXARM_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)
  if(FLEXARM_SANITIZE STREQUAL "address")
    # Undefined as well, but not among those of `undefined`.
    add_compile_options(-fsanitize=float-cast-overflow)
  endif()
  add_compile_definitions(_GLIBCXX_ASSERTIONS)
endif()
