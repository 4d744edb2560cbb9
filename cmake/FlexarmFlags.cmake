# Warnings are errors in our own code; libraries come in as SYSTEM.
add_library(flexarm_flags INTERFACE)
target_compile_options(flexarm_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                       -Wsign-conversion -Wnon-virtual-dtor -Woverloaded-virtual -Werror)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # The compiler collects its garbage less often: a tenth of the time, for 500 MB of memory.
  add_compile_options("SHELL:--param ggc-min-heapsize=500000")
endif()
if(FLEXARM_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all
                      -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()
if(FLEXARM_COVERAGE)
  add_compile_options(--coverage)
  add_link_options(--coverage)
endif()
