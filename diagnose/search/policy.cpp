#include "diagnose/search/policy.hpp"

#include "arm/input_error.hpp"
#include "arm/nearest_name.hpp"
#include "arm/number.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace flexarm::diagnose {

std::span<const PolicyNumber> policy_numbers() {
  static constexpr std::array kAll = {PolicyNumber{"sample_size", &Policy::sample_size},
                                      PolicyNumber{"discrepancy", &Policy::discrepancy},
                                      PolicyNumber{"motion_draws", &Policy::motion_draws},
                                      PolicyNumber{"band_deviations", &Policy::band_deviations},
                                      PolicyNumber{"total_deviations", &Policy::total_deviations},
                                      PolicyNumber{"error_factor", &Policy::error_factor},
                                      PolicyNumber{"place_deviation", &Policy::place_deviation},
                                      PolicyNumber{"first_samples", &Policy::first_samples},
                                      PolicyNumber{"coarse_modes", &Policy::coarse_modes},
                                      PolicyNumber{"beam", &Policy::beam},
                                      PolicyNumber{"looks", &Policy::looks},
                                      PolicyNumber{"depth", &Policy::depth},
                                      PolicyNumber{"peaks", &Policy::peaks},
                                      PolicyNumber{"near", &Policy::near},
                                      PolicyNumber{"least_time", &Policy::least_time},
                                      PolicyNumber{"odds", &Policy::odds},
                                      PolicyNumber{"bare_mention", &Policy::bare_mention},
                                      PolicyNumber{"beyond_doubt", &Policy::beyond_doubt},
                                      PolicyNumber{"least_agreement", &Policy::least_agreement},
                                      PolicyNumber{"useless", &Policy::useless}};
  return kAll;
}

double PolicyNumber::of(const Policy& policy) const {
  return std::visit([&](auto own) { return static_cast<double>(policy.*own); }, member);
}

void PolicyNumber::set(Policy& policy, double value) const {
  const bool is_whole = std::holds_alternative<std::size_t Policy::*>(member);
  constexpr double kMostWhole = 1e6;
  const bool is_allowed = is_whole
                              ? value >= 1.0 && value <= kMostWhole && value == std::floor(value)
                              : value > 0.0 && std::isfinite(value);
  if (!is_allowed) {
    throw arm::out_of_range(std::string(name), value, "",
                            is_whole ? "a whole number from 1 to 1e6" : "a finite number above 0");
  }
  if (is_whole) {
    policy.*std::get<std::size_t Policy::*>(member) = static_cast<std::size_t>(value);
  } else {
    policy.*std::get<double Policy::*>(member) = value;
  }
}

void set_number(Policy& policy, const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  const auto number = std::ranges::find(policy_numbers(), name, &PolicyNumber::name);
  if (number == policy_numbers().end()) {
    std::vector<std::string> names;
    for (const PolicyNumber& one : policy_numbers()) names.emplace_back(one.name);
    throw arm::InputError(
        fmt::format("{}: unknown number of the search{}; docs/search-numbers.md "
                    "lists them",
                    arm::shown(name), arm::did_you_mean(name, names)));
  }
  const auto value = equals == std::string::npos
                         ? std::nullopt
                         : arm::parse_number<double>(std::string_view(text).substr(equals + 1));
  if (!value) throw arm::InputError(fmt::format("{}: must be NAME=NUMBER", arm::shown(text)));
  number->set(policy, *value);
}

}  // namespace flexarm::diagnose
