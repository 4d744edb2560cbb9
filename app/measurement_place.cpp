#include "app/measurement_place.hpp"

#include "arm/atomic_file.hpp"
#include "arm/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>

namespace flexarm::app {

namespace {

namespace fs = std::filesystem;

/// A folder that --force may replace was written by this command: it holds a measurement, and
/// nothing that such a folder does not.
void require_replaceable(const fs::path& folder) {
  constexpr std::array<const char*, 4> kEndings = {".toml", ".csv", ".svg", ".json"};
  std::error_code error;
  if (!fs::is_directory(folder, error) || fs::is_empty(folder, error)) return;
  if (!fs::exists(folder / "measurement.toml", error)) {
    throw arm::InputError(fmt::format("{}: holds no measurement.toml, so --force leaves it alone",
                                      arm::shown(folder.string())));
  }
  for (const auto& entry : fs::directory_iterator(folder)) {
    const bool is_ours = std::ranges::count(kEndings, entry.path().extension().string()) > 0;
    if (entry.is_regular_file() && is_ours) continue;
    throw arm::InputError(
        fmt::format("{}: is not of a measurement, so --force leaves the folder alone",
                    arm::shown(entry.path().string())));
  }
}

}  // namespace

void require_measurement_place(const std::string& folder, bool force) {
  if (force) {
    require_replaceable(folder);
    return;
  }
  try {
    arm::require_new_folder(folder);
  } catch (const arm::InputError& error) {
    throw arm::InputError(fmt::format("{}; --force replaces a measurement", error.what()));
  }
}

}  // namespace flexarm::app
