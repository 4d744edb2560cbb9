# How sources are compiled.
option(FLEXARM_PRECOMPILED_HEADERS "Parse the headers of libraries once" ON)
# Names in the anonymous namespaces of a room must then differ, which
# -DCMAKE_UNITY_BUILD_BATCH_SIZE=0 (a room in one batch) tells of all of them.
option(FLEXARM_UNITY_BUILD "Compile the sources of a room in batches" ON)
if(NOT DEFINED CMAKE_UNITY_BUILD_BATCH_SIZE)
  set(CMAKE_UNITY_BUILD_BATCH_SIZE 24)
endif()

# What computes is optimised in full. What writes or reads need not be, nor need the tests: they
# build in half the time.
set(full_option "")
set(brief_option $<$<CONFIG:Release,RelWithDebInfo>:-O1>)
set(test_option $<$<CONFIG:Release>:-O0> $<$<CONFIG:RelWithDebInfo>:-O1>)

# Templates fill the compiler's memory. By default GCC collects garbage from 128 MB on, which takes
# up to a seventh of the time. [kB]
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options(--param=ggc-min-heapsize=1000000)
endif()

# One target for each set of options: a precompiled header serves sources of the same options only.
# Sources include what they use all the same; the preset `debug` holds them to it. A header is
# worth it here if it takes a second to parse and most batches include it.
function(flexarm_precompile how)
  cmake_parse_arguments(PARSED "" "" "HEADERS;LIBRARIES" ${ARGN})
  set(target flexarm_precompiled_${how})
  file(CONFIGURE OUTPUT "${CMAKE_CURRENT_BINARY_DIR}/${target}.cpp" CONTENT "")
  add_library(${target} OBJECT "${CMAKE_CURRENT_BINARY_DIR}/${target}.cpp")
  target_link_libraries(${target} PRIVATE Eigen3::Eigen fmt::fmt ${PARSED_LIBRARIES} flexarm_flags)
  target_compile_options(${target} PRIVATE ${${how}_option})
  target_precompile_headers(${target} PRIVATE
    <algorithm> <array> <cmath> <complex> <cstddef> <filesystem> <functional> <limits> <map>
    <memory> <numbers> <optional> <random> <ranges> <span> <stdexcept> <string> <string_view>
    <utility> <variant> <vector> <fmt/format.h> <tbb/parallel_for.h> <Eigen/SparseCore>
    "${PROJECT_SOURCE_DIR}/cmake/eigen_decompositions.hpp" ${PARSED_HEADERS})
endfunction()
if(FLEXARM_PRECOMPILED_HEADERS)
  flexarm_precompile(full HEADERS <boost/math/distributions/normal.hpp>
                     <boost/math/quadrature/gauss.hpp>)
  flexarm_precompile(brief HEADERS <nlohmann/json.hpp>)
  if(FLEXARM_TESTS)
    flexarm_precompile(test HEADERS <gmock/gmock.h> <gtest/gtest.h> <nlohmann/json.hpp>
                       LIBRARIES GTest::gmock GTest::gtest_main)
  endif()
endif()

# Decompositions of Eigen's that many sources use, compiled once. Not in one source: the time that
# GCC needs for a template grows with the number of those it has met before.
set(eigen_folder "${CMAKE_CURRENT_LIST_DIR}/eigen")
add_library(flexarm_eigen STATIC
  "${eigen_folder}/extended.cpp"
  "${eigen_folder}/factors.cpp"
  "${eigen_folder}/pencil.cpp"
  "${eigen_folder}/schur.cpp"
  "${eigen_folder}/self_adjoint.cpp"
  "${eigen_folder}/singular_values.cpp")
target_include_directories(flexarm_eigen PRIVATE "${PROJECT_SOURCE_DIR}")
target_link_libraries(flexarm_eigen PRIVATE "$<BUILD_INTERFACE:Eigen3::Eigen>"
                                            "$<BUILD_INTERFACE:fmt::fmt>")
if(FLEXARM_PRECOMPILED_HEADERS)
  target_precompile_headers(flexarm_eigen REUSE_FROM flexarm_precompiled_full)
endif()
set_target_properties(flexarm_eigen PROPERTIES EXPORT_NAME eigen FLEXARM_FULL TRUE)
install(TARGETS flexarm_eigen EXPORT flexarmTargets COMPONENT development)

# Static libraries of this project that are optimised in full, of those that a target links.
function(flexarm_optimised_libraries target out)
  set(found "")
  set(open "${target}")
  set(met "")
  while(open)
    list(POP_FRONT open one)
    get_target_property(links ${one} LINK_LIBRARIES)
    foreach(link ${links})
      if(NOT link MATCHES "^flexarm(::|_eigen$)" OR link IN_LIST met)
        continue()
      endif()
      list(APPEND met ${link})
      get_target_property(name ${link} ALIASED_TARGET)
      if(NOT name)
        set(name ${link})
      endif()
      list(APPEND open ${name})
      get_target_property(full ${name} FLEXARM_FULL)
      if(full)
        list(APPEND found ${name})
      endif()
    endforeach()
  endwhile()
  list(REMOVE_DUPLICATES found)
  set(${out} "${found}" PARENT_SCOPE)
endfunction()

# Of a template that several objects instantiate the linker takes the first: Eigen's kernels would be
# those of a test that is not optimised, and what computes would be half as fast. So the libraries
# come before the objects of the program, whole, since nothing asks for them yet. Which they are is
# known when all targets are.
function(flexarm_libraries_first target)
  cmake_language(EVAL CODE "cmake_language(DEFER DIRECTORY \"${PROJECT_SOURCE_DIR}\"
                              CALL flexarm_link_first ${target})")
endfunction()
function(flexarm_link_first target)
  flexarm_optimised_libraries(${target} libraries)
  if(libraries)
    list(TRANSFORM libraries REPLACE "(.+)" "$<TARGET_FILE:\\1>")
    target_link_options(${target} PRIVATE -Wl,--whole-archive ${libraries} -Wl,--no-whole-archive)
  endif()
endfunction()

# flexarm_optimise(TARGET full|brief|test)
function(flexarm_optimise target how)
  target_compile_options(${target} PRIVATE ${${how}_option})
  if(how STREQUAL "full")
    set_target_properties(${target} PROPERTIES FLEXARM_FULL TRUE)
  elseif(how STREQUAL "test")
    flexarm_libraries_first(${target})
  endif()
  if(FLEXARM_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} REUSE_FROM flexarm_precompiled_${how})
    target_link_libraries(${target} PUBLIC flexarm_eigen)
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${FLEXARM_UNITY_BUILD})
endfunction()
