#include "export/fmu_wrapper/resource_folder.hpp"

#include "arm/input_error.hpp"

#include <fmt/format.h>

#include <charconv>
#include <string>

namespace flexarm::fmu {

namespace {

/// With %20 and the like as the bytes that they stand for.
std::string decoded(std::string_view text) {
  std::string made;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned byte = 0;
    const bool is_code = text[i] == '%' && i + 2 < text.size();
    const char* const digits = text.data() + i + 1;
    if (is_code && std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
      made += static_cast<char>(byte);
      i += 2;
    } else {
      made += text[i];
    }
  }
  return made;
}

}  // namespace

std::filesystem::path folder_of_location(std::string_view location) {
  constexpr std::string_view kScheme = "file:";
  if (!location.starts_with(kScheme)) {
    if (location.starts_with('/')) return location;
    throw arm::InputError(
        fmt::format("location of the resources {}: must be a file: URI", arm::shown(location)));
  }
  location.remove_prefix(kScheme.size());
  if (location.starts_with("//")) {
    location.remove_prefix(2);
    constexpr std::string_view kHost = "localhost";
    if (location.starts_with(kHost)) location.remove_prefix(kHost.size());
  }
  if (!location.starts_with('/')) {
    throw arm::InputError(
        fmt::format("location of the resources {}: on another host", arm::shown(location)));
  }
  return decoded(location);
}

}  // namespace flexarm::fmu
