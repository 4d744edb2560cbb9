# Builds the shared library of this FMU against an installed flexarm:
#
#   cmake -S sources -B build -DCMAKE_PREFIX_PATH=PREFIX && cmake --build build
#
# The result goes to the folder below binaries/ that names the platform, under the name that the
# model description gives as modelIdentifier.
cmake_minimum_required(VERSION 3.25)
project(flexarm_fmu LANGUAGES CXX)
find_package(flexarm REQUIRED)
file(GLOB_RECURSE sources export/*.cpp)
add_library(flexarm_fmu MODULE ${sources})
set_target_properties(flexarm_fmu PROPERTIES PREFIX "")
target_include_directories(flexarm_fmu PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}")
target_link_libraries(flexarm_fmu PRIVATE flexarm::effects flexarm::measured flexarm::response)
if(CMAKE_SYSTEM_NAME STREQUAL "Linux")
  target_link_options(flexarm_fmu PRIVATE
    "LINKER:--version-script=${CMAKE_CURRENT_SOURCE_DIR}/exported.map" LINKER:--as-needed)
endif()
