#include "app/version.hpp"

#include "app/build_facts.hpp"

#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <Spectra/Util/Version.h>
#include <SuiteSparse_config.h>
#include <arb.h>
#include <boost/version.hpp>
#include <flint/flint.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <toml++/toml.h>

namespace flexarm::app {

std::string version_text() {
  return fmt::format(
      "flexarm {}\n"
      "{}\n"
      "build: {}, {}, C++{}\n"
      "numerics: Eigen {}.{}.{}, Spectra {}.{}.{}, SuiteSparse {}.{}.{}, Boost {}.{}.{}, FLINT {}, "
      "Arb {}\n"
      "text: CLI11 {}, fmt {}.{}.{}, toml++ {}.{}.{}, nlohmann-json {}.{}.{}\n",
      kVersion, kDescription, kBuildType, kCompiler, __cplusplus / 100 % 100, EIGEN_WORLD_VERSION,
      EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION, SPECTRA_MAJOR_VERSION, SPECTRA_MINOR_VERSION,
      SPECTRA_PATCH_VERSION, SUITESPARSE_MAIN_VERSION, SUITESPARSE_SUB_VERSION,
      SUITESPARSE_SUBSUB_VERSION, BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000,
      BOOST_VERSION % 100, FLINT_VERSION, ARB_VERSION, CLI11_VERSION, FMT_VERSION / 10000,
      FMT_VERSION / 100 % 100, FMT_VERSION % 100, TOML_LIB_MAJOR, TOML_LIB_MINOR, TOML_LIB_PATCH,
      NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH);
}

}  // namespace flexarm::app
