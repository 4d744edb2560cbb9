# Outside libraries, each as one target; scripts/packages names the Debian package of each.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(Boost 1.74 REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(CLI11 REQUIRED)
find_package(TBB REQUIRED)
find_package(ZLIB REQUIRED)
find_package(NLopt REQUIRED)
find_package(muparser 2.3 REQUIRED)

# Header-only: used as SYSTEM so that its warnings are not ours.
find_path(SPECTRA_INCLUDE_DIR Spectra/SymGEigsShiftSolver.h REQUIRED)
add_library(flexarm_spectra INTERFACE)
target_include_directories(flexarm_spectra SYSTEM INTERFACE "${SPECTRA_INCLUDE_DIR}")
target_link_libraries(flexarm_spectra INTERFACE Eigen3::Eigen)

find_path(KLU_INCLUDE_DIR klu.h PATH_SUFFIXES suitesparse REQUIRED)
find_library(KLU_LIBRARY klu REQUIRED)
add_library(flexarm_klu INTERFACE)
target_include_directories(flexarm_klu SYSTEM INTERFACE "${KLU_INCLUDE_DIR}")
target_link_libraries(flexarm_klu INTERFACE "${KLU_LIBRARY}")

find_path(MATIO_INCLUDE_DIR matio.h REQUIRED)
find_library(MATIO_LIBRARY matio REQUIRED)
add_library(flexarm_matio INTERFACE)
target_include_directories(flexarm_matio SYSTEM INTERFACE "${MATIO_INCLUDE_DIR}")
target_link_libraries(flexarm_matio INTERFACE "${MATIO_LIBRARY}")

find_path(HDF5_INCLUDE_DIR hdf5.h PATH_SUFFIXES hdf5/serial REQUIRED)
find_library(HDF5_LIBRARY NAMES hdf5_serial hdf5 REQUIRED)
add_library(flexarm_hdf5 INTERFACE)
target_link_libraries(flexarm_hdf5 INTERFACE "${HDF5_LIBRARY}")

# Its own package file asks for programs that Debian has in packages of their own.
find_path(ZIP_INCLUDE_DIR zip.h REQUIRED)
find_library(ZIP_LIBRARY zip REQUIRED)
add_library(flexarm_zip INTERFACE)
target_include_directories(flexarm_zip SYSTEM INTERFACE "${ZIP_INCLUDE_DIR}")
target_link_libraries(flexarm_zip INTERFACE "${ZIP_LIBRARY}")

find_path(ARB_INCLUDE_DIR acb.h REQUIRED)
find_path(FLINT_INCLUDE_DIR flint/flint.h REQUIRED)
find_library(ARB_LIBRARY NAMES flint-arb arb REQUIRED)
find_library(FLINT_LIBRARY flint REQUIRED)
add_library(flexarm_arb INTERFACE)
target_include_directories(flexarm_arb SYSTEM INTERFACE "${ARB_INCLUDE_DIR}" "${FLINT_INCLUDE_DIR}")
target_link_libraries(flexarm_arb INTERFACE "${ARB_LIBRARY}" "${FLINT_LIBRARY}")

# Manual pages and changes of packages are compressed.
find_program(GZIP_PROGRAM gzip REQUIRED)

if(FLEXARM_TESTS)
  find_package(GTest REQUIRED)
  include(GoogleTest)
endif()
if(FLEXARM_BENCHMARKS)
  find_package(benchmark REQUIRED)
endif()
