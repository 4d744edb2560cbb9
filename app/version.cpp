#include "app/version.hpp"

#include "app/build_facts.hpp"

#include <CLI/Version.hpp>
#include <fmt/format.h>
#include <toml++/toml.h>

namespace flexarm::app {

std::string version_text() {
  return fmt::format(
      "flexarm {}\n"
      "{}\n"
      "build: {}, {}, C++{}\n"
      "libraries: CLI11 {}, fmt {}.{}.{}, toml++ {}.{}.{}\n",
      kVersion, kDescription, kBuildType, kCompiler, __cplusplus / 100 % 100, CLI11_VERSION,
      FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100, TOML_LIB_MAJOR,
      TOML_LIB_MINOR, TOML_LIB_PATCH);
}

}  // namespace flexarm::app
