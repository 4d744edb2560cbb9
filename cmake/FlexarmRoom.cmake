# flexarm_room(NAME USES ... LIBRARIES ... [SOURCES ...] [EXCEPT folder] [BRIEF])
#   One static library `flexarm_NAME` (alias flexarm::NAME) of every source and header below the
#   room's folder; SOURCES names generated ones. USES names other rooms, LIBRARIES outside
#   libraries; both are visible to whoever links the room, here or from an installed flexarm.
#   EXCEPT is a folder of the room that is another target.
#   BRIEF is for a room that does not compute, and need not be optimised in full.
function(flexarm_room name)
  cmake_parse_arguments(ROOM "BRIEF" "EXCEPT" "SOURCES;USES;LIBRARIES" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS *.cpp)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS *.hpp)
  if(ROOM_EXCEPT)
    list(FILTER sources EXCLUDE REGEX "/${ROOM_EXCEPT}/")
    list(FILTER headers EXCLUDE REGEX "/${ROOM_EXCEPT}/")
  endif()
  set(target flexarm_${name})
  add_library(${target} STATIC ${sources} ${ROOM_SOURCES})
  add_library(flexarm::${name} ALIAS ${target})
  target_sources(${target} PUBLIC FILE_SET HEADERS BASE_DIRS "${PROJECT_SOURCE_DIR}" FILES ${headers})
  list(TRANSFORM ROOM_USES PREPEND flexarm::)
  target_link_libraries(${target} PUBLIC ${ROOM_USES} ${ROOM_LIBRARIES}
                        PRIVATE "$<BUILD_INTERFACE:flexarm_flags>")
  target_compile_features(${target} PUBLIC cxx_std_20)
  if(ROOM_BRIEF)
    flexarm_optimise(${target} brief)
  else()
    flexarm_optimise(${target} full)
  endif()
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  set_property(GLOBAL APPEND PROPERTY FLEXARM_ROOMS ${target})
  install(TARGETS ${target} EXPORT flexarmTargets
          ARCHIVE COMPONENT development
          FILE_SET HEADERS DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/flexarm" COMPONENT development)
endfunction()

# flexarm_test(NAME SOURCES ... USES ... LIBRARIES ... [SHARDS n] [COMPUTES])
#   One GoogleTest program; every TEST in it is a test of ctest. SHARDS is for a program of so many
#   short TESTs that starting it for each takes longer than they do: NAME.shard_1 to NAME.shard_n
#   are then its tests of ctest, and the output of one that fails names the TEST. COMPUTES is for
#   sources that themselves compute for long, with Eigen or regular expressions.
function(flexarm_test name)
  cmake_parse_arguments(CHECK "COMPUTES" "SHARDS" "SOURCES;USES;LIBRARIES" ${ARGN})
  add_executable(${name} ${CHECK_SOURCES})
  list(TRANSFORM CHECK_USES PREPEND flexarm::)
  target_link_libraries(${name} PRIVATE ${CHECK_USES} flexarm::effects ${CHECK_LIBRARIES} GTest::gtest_main
                        GTest::gmock fmt::fmt flexarm_flags)
  target_compile_definitions(${name} PRIVATE FLEXARM_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  if(CHECK_COMPUTES)
    flexarm_optimise(${name} full)
  else()
    flexarm_optimise(${name} test)
  endif()
  # The slowest takes half a minute; sanitizers slow it tenfold.
  if(FLEXARM_SANITIZE)
    set(limit_s 1500)
  else()
    set(limit_s 300)
  endif()
  if(CHECK_SHARDS)
    foreach(shard RANGE 1 ${CHECK_SHARDS})
      math(EXPR index "${shard} - 1")
      add_test(NAME ${name}.shard_${shard} COMMAND ${name})
      # What a TEST skips would not be seen among others that pass: it may not skip anything.
      set_tests_properties(${name}.shard_${shard} PROPERTIES
        ENVIRONMENT "GTEST_TOTAL_SHARDS=${CHECK_SHARDS};GTEST_SHARD_INDEX=${index}"
        FAIL_REGULAR_EXPRESSION "\\[  SKIPPED \\]"
        TIMEOUT ${limit_s})
    endforeach()
    return()
  endif()
  # Under sanitizers on a busy machine a program may take longer than CMake's 5 s to list its tests.
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 120
                       PROPERTIES TIMEOUT ${limit_s})
endfunction()
