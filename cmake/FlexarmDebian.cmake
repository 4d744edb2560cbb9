# Debian packages by CPack, one for each component: `flexarm` (program), `libflexarm-dev`
# (development) and, where the module is built, `python3-flexarm` (python). scripts/package makes and
# checks them.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The flexarm authors <flexarm@example.org>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME flexarm)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS gnuplot-nox)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION
  "A single-link flexible manipulator is modelled in three independent
formulations: exact transfer function, finite elements and assumed modes.
The program compares their poles and zeros, simulates and identifies
experiments, and names the physical effects that a simulation lacks.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libflexarm-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "libeigen3-dev, libspectra-dev, libsuitesparse-dev, libmatio-dev, libhdf5-dev, libzip-dev, zlib1g-dev, libboost-dev, libflint-dev, libflint-arb-dev, libtomlplusplus-dev, nlohmann-json3-dev, libfmt-dev, libmuparser-dev, libtbb-dev, libnlopt-dev, libnlopt-cxx-dev")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION
  "The static libraries and headers behind the program flexarm: formulations,
responses, identification and diagnosis, with a CMake package and a file for
pkg-config.")

if(TARGET _flexarm)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-flexarm)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  # The extension is of one version of the interpreter.
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11), python3 (<< 3.12), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS gnuplot-nox)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS
    "python3-scipy, python3-xarray, python3-distributed, python3-h5py")
  set(CPACK_DEBIAN_PYTHON_DESCRIPTION
    "Arms, formulations, responses, simulation, identification, diagnosis and
planning of flexarm from Python, with NumPy, SciPy and xarray. The program
flexarm-campaign runs many of these tasks on many machines, with dask.")
endif()

# What a Debian package has to say of itself.
string(TIMESTAMP changed "%a, %d %b %Y %H:%M:%S +0000" UTC)
set(changelog "${PROJECT_BINARY_DIR}/debian/changelog.Debian")
file(CONFIGURE OUTPUT "${changelog}" CONTENT "flexarm (${PROJECT_VERSION}-1) unstable; urgency=medium

  * As in the changes of the source, CHANGELOG.md.

 -- ${CPACK_PACKAGE_CONTACT}  ${changed}
")
execute_process(COMMAND "${GZIP_PROGRAM}" -9nf "${changelog}" COMMAND_ERROR_IS_FATAL ANY)
function(flexarm_debian_documents component package)
  set(folder "${CMAKE_INSTALL_DATAROOTDIR}/doc/${package}")
  install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${folder}" RENAME copyright
          COMPONENT ${component})
  install(FILES "${changelog}.gz" DESTINATION "${folder}" COMPONENT ${component})
endfunction()
flexarm_debian_documents(program flexarm)
flexarm_debian_documents(development libflexarm-dev)
if(TARGET _flexarm)
  flexarm_debian_documents(python python3-flexarm)
endif()

include(CPack)
