# flexarm_precompiled(NAME HEADERS ... LIBRARIES ... OPTIONS ...)
#   Headers of libraries, parsed once for every target that says flexarm_optimise(TARGET NAME): a
#   quarter of the time of a clean build. Sources include what they use all the same; the preset
#   `debug`, where each is compiled by itself, holds them to it.
option(FLEXARM_PRECOMPILED_HEADERS "Parse the headers of libraries once" ON)

function(flexarm_precompiled name)
  if(NOT FLEXARM_PRECOMPILED_HEADERS)
    return()
  endif()
  cmake_parse_arguments(HEADERS "" "" "HEADERS;LIBRARIES;OPTIONS" ${ARGN})
  set(target flexarm_precompiled_${name})
  set(source "${CMAKE_CURRENT_BINARY_DIR}/precompiled_${name}.cpp")
  file(CONFIGURE OUTPUT "${source}" CONTENT "")
  add_library(${target} OBJECT "${source}")
  target_link_libraries(${target} PRIVATE ${HEADERS_LIBRARIES} flexarm_flags)
  target_compile_options(${target} PRIVATE ${HEADERS_OPTIONS})
  target_precompile_headers(${target} PRIVATE ${HEADERS_HEADERS})
endfunction()

if(FLEXARM_PRECOMPILED_HEADERS)
  include(FlexarmEigen)
endif()

set(library_headers <algorithm> <array> <cmath> <complex> <cstddef> <filesystem> <functional> <limits>
    <map> <memory> <numbers> <optional> <random> <ranges> <span> <stdexcept> <string> <string_view>
    <utility> <variant> <vector> <fmt/format.h> <Eigen/SparseCore> "${FLEXARM_EIGEN_HEADER}")

# What computes is optimised in full. What writes or reads need not be, nor need the tests: they
# build in half the time.
set(brief_option $<$<CONFIG:Release>:-O1>)
set(test_option $<$<CONFIG:Release>:-O0>)
flexarm_precompiled(full LIBRARIES Eigen3::Eigen fmt::fmt HEADERS ${library_headers})
flexarm_precompiled(brief LIBRARIES Eigen3::Eigen fmt::fmt HEADERS ${library_headers}
                    OPTIONS ${brief_option})
if(FLEXARM_TESTS)
  flexarm_precompiled(test LIBRARIES Eigen3::Eigen fmt::fmt GTest::gmock GTest::gtest_main
                      HEADERS ${library_headers} <gmock/gmock.h> <gtest/gtest.h>
                      OPTIONS ${test_option})
endif()

# Sources of a target are compiled in batches: templates of libraries, most of the time of a source,
# are instantiated once a batch. Names in the anonymous namespaces of a folder must therefore differ,
# which -DCMAKE_UNITY_BUILD_BATCH_SIZE=0 (all in one batch) tells of all of them.
option(FLEXARM_UNITY_BUILD "Compile sources in batches" ON)
if(NOT DEFINED CMAKE_UNITY_BUILD_BATCH_SIZE)
  set(CMAKE_UNITY_BUILD_BATCH_SIZE 8)
endif()

# flexarm_optimise(TARGET full|brief|test)
function(flexarm_optimise target how)
  target_compile_options(${target} PRIVATE ${${how}_option})
  if(FLEXARM_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} REUSE_FROM flexarm_precompiled_${how})
    target_link_libraries(${target} PUBLIC flexarm_eigen)
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${FLEXARM_UNITY_BUILD})
endfunction()
