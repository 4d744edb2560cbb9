# What find_package(flexarm) finds after an installation: one target flexarm::ROOM a room.
include(CMakePackageConfigHelpers)
set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/flexarm")
install(TARGETS flexarm_spectra flexarm_klu flexarm_matio flexarm_zip flexarm_arb
        EXPORT flexarmTargets)
install(EXPORT flexarmTargets NAMESPACE flexarm:: DESTINATION "${package_folder}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/flexarmConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_SOURCE_DIR}/cmake/flexarmConfig.cmake"
              "${PROJECT_BINARY_DIR}/flexarmConfigVersion.cmake"
        DESTINATION "${package_folder}")
