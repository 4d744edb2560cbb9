# Warnings of our own code; libraries come in as SYSTEM. The presets make them errors.
add_library(flexarm_flags INTERFACE)
target_compile_options(flexarm_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                       -Wsign-conversion -Wnon-virtual-dtor -Woverloaded-virtual)
if(FLEXARM_SANITIZE)
  # With sanitizers GCC 12 takes variables of <regex> for uninitialised.
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all
                      -fno-omit-frame-pointer -Wno-maybe-uninitialized)
  add_link_options(-fsanitize=address,undefined)
endif()
if(FLEXARM_COVERAGE)
  add_compile_options(--coverage)
  add_link_options(--coverage)
endif()
if(FLEXARM_FUZZ)
  # float-cast-overflow is undefined as well, but not among those of `undefined`.
  add_compile_options(-fsanitize=fuzzer-no-link,address,undefined,float-cast-overflow
                      -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_compile_definitions(_GLIBCXX_ASSERTIONS)
  add_link_options(-fsanitize=address,undefined)
endif()
