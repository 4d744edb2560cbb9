# What an installation has besides program and libraries: the CMake package, with one target
# flexarm::ROOM a room, and the file for pkg-config, with all rooms. Both are of the component
# `development`, as libraries and headers are (cmake/FlexarmRoom.cmake).
include(CMakePackageConfigHelpers)
set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/flexarm")
install(TARGETS flexarm_spectra flexarm_klu flexarm_matio flexarm_hdf5 flexarm_zip flexarm_arb
        EXPORT flexarmTargets COMPONENT development)
install(EXPORT flexarmTargets NAMESPACE flexarm:: DESTINATION "${package_folder}"
        COMPONENT development)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/flexarmConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_SOURCE_DIR}/cmake/flexarmConfig.cmake"
              "${PROJECT_BINARY_DIR}/flexarmConfigVersion.cmake"
        DESTINATION "${package_folder}" COMPONENT development)

get_property(room_libraries GLOBAL PROPERTY FLEXARM_ROOMS)
if(FLEXARM_PRECOMPILED_HEADERS)
  list(APPEND room_libraries flexarm_eigen)
endif()
list(TRANSFORM room_libraries PREPEND "-l")
list(JOIN room_libraries " " room_libraries)
# From the file to the prefix, so that an installation can be moved.
file(RELATIVE_PATH prefix_from_pc "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
configure_file("${PROJECT_SOURCE_DIR}/cmake/flexarm.pc.in" "${PROJECT_BINARY_DIR}/flexarm.pc" @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/flexarm.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig"
        COMPONENT development)

include(FlexarmDebian)
