#include "app/version.hpp"

#include "app/build_facts.hpp"

#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <Spectra/Util/Version.h>
#include <arb.h>
#include <boost/version.hpp>
#include <flint/flint.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <toml++/toml.h>

#include <SuiteSparse_config.h>
#include <oneapi/tbb/version.h>

namespace flexarm::app {

namespace {

std::string dotted(int major, int minor, int patch) {
  return fmt::format("{}.{}.{}", major, minor, patch);
}

std::string line_of(const std::vector<LibraryVersion>& libraries) {
  std::string line;
  for (const auto& [name, version] : libraries) {
    line += fmt::format("{}{} {}", line.empty() ? "" : ", ", name, version);
  }
  return line;
}

}  // namespace

std::vector<LibraryVersion> numeric_libraries() {
  return {
      {"Eigen", dotted(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"Spectra", dotted(SPECTRA_MAJOR_VERSION, SPECTRA_MINOR_VERSION, SPECTRA_PATCH_VERSION)},
      {"SuiteSparse",
       dotted(SUITESPARSE_MAIN_VERSION, SUITESPARSE_SUB_VERSION, SUITESPARSE_SUBSUB_VERSION)},
      {"Boost", dotted(BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100)},
      {"FLINT", FLINT_VERSION},
      {"Arb", ARB_VERSION},
      {"oneTBB", dotted(TBB_VERSION_MAJOR, TBB_VERSION_MINOR, TBB_VERSION_PATCH)}};
}

std::vector<LibraryVersion> text_libraries() {
  return {{"CLI11", CLI11_VERSION},
          {"fmt", dotted(FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
          {"toml++", dotted(TOML_LIB_MAJOR, TOML_LIB_MINOR, TOML_LIB_PATCH)},
          {"nlohmann-json", dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
                                   NLOHMANN_JSON_VERSION_PATCH)}};
}

std::string program_version() {
  return fmt::format("flexarm {}", kVersion);
}

std::string build_text() {
  return fmt::format("{}, {}, C++{}", kBuildType, kCompiler, __cplusplus / 100 % 100);
}

std::string version_text() {
  return fmt::format("{}\n{}\nbuild: {}\nnumerics: {}\ntext: {}\n", program_version(), kDescription,
                     build_text(), line_of(numeric_libraries()), line_of(text_libraries()));
}

}  // namespace flexarm::app
