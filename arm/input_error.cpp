#include "arm/input_error.hpp"

#include <fmt/format.h>

namespace flexarm::arm {

InputError out_of_range(const std::string& key, double value, const std::string& unit,
                        const std::string& allowed) {
  return InputError(
      fmt::format("{} = {}{}{}: must be {}", key, value, unit.empty() ? "" : " ", unit, allowed));
}

InputError located(const InputError& error, const std::string& file, int line) {
  return InputError(line > 0 ? fmt::format("{}:{}: {}", file, line, error.what())
                             : fmt::format("{}: {}", file, error.what()));
}

}  // namespace flexarm::arm
