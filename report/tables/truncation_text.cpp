#include "report/tables/truncation_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>

namespace flexarm::report {

std::string truncation_sentence(const response::Truncation& truncation,
                                std::span<const arm::Sensor> sensors) {
  std::string largest = "no sensor";
  if (!truncation.errors.empty()) {
    const auto at = std::ranges::max_element(truncation.errors) - truncation.errors.begin();
    largest = fmt::format("{:.1e} of {}", truncation.largest_error(),
                          arm::to_string(sensors[static_cast<std::size_t>(at)]));
  }
  const bool is_met = truncation.is_within_tolerance();
  return fmt::format(
      "Truncation: {} flexible mode{} {}; estimated error {} (tolerance {:.0e} of each sensor's "
      "signal{}).",
      truncation.modes, truncation.modes == 1 ? "" : "s", truncation.chosen ? "chosen" : "given",
      largest, response::kTruncationTolerance,
      is_met              ? ""
      : truncation.chosen ? ": not met; more modes by --modes, or Kelvin-Voigt damping"
                          : ": not met, the model is truncated");
}

nlohmann::ordered_json truncation_json(const response::Truncation& truncation,
                                       std::span<const arm::Sensor> sensors) {
  nlohmann::ordered_json errors = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < truncation.errors.size(); ++k) {
    errors.push_back({{"sensor", arm::to_string(sensors[k])}, {"error", truncation.errors[k]}});
  }
  return {{"chosen", truncation.chosen},
          {"modes", truncation.modes},
          {"tolerance", response::kTruncationTolerance},
          {"errors", std::move(errors)}};
}

}  // namespace flexarm::report
