#include "response/time/stepped_sine.hpp"

#include "arm/input_error.hpp"
#include "arm/nearest_name.hpp"
#include "arm/number.hpp"
#include "arm/range.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace flexarm::response {

namespace {

using arm::InputError;

/// A band whose width is whole steps to this ends at its last frequency.
constexpr double kWholeStep = 1e-6;

std::string key_name(std::string_view key) {
  return fmt::format("{}.{}", kSteppedSine, key);
}

InputError wrong_value(std::string_view key, std::string_view value, std::string_view must_be) {
  return InputError(fmt::format("{} = {}: must be {}", key_name(key), arm::shown(value), must_be));
}

template <class T>
T read_number(std::string_view key, std::string_view value, std::string_view must_be) {
  const auto number = arm::parse_number<T>(value);
  if (!number) throw wrong_value(key, value, must_be);
  return *number;
}

std::vector<SineBand> read_bands(std::string_view value) {
  constexpr std::string_view kMustBe = "FROM:TO/FROM:TO/... [Hz]";
  std::vector<SineBand> bands;
  for (std::string_view rest = value;;) {
    const auto slash = std::min(rest.find('/'), rest.size());
    const std::string_view part = rest.substr(0, slash);
    const auto colon = part.find(':');
    if (colon == std::string_view::npos) throw wrong_value("bands", value, kMustBe);
    const auto from = arm::parse_number<double>(part.substr(0, colon));
    const auto to = arm::parse_number<double>(part.substr(colon + 1));
    if (!from || !to) throw wrong_value("bands", value, kMustBe);
    bands.push_back({*from, *to});
    if (slash == rest.size()) return bands;
    rest.remove_prefix(slash + 1);
  }
}

/// Sets the number of that name; false where there is none.
bool set(SteppedSine& sine, std::string_view key, std::string_view value) {
  constexpr std::string_view kTorque = "a number [N m]";
  constexpr std::string_view kFrequency = "a number [Hz]";
  constexpr std::string_view kCount = "a whole number";
  if (key == "amplitude") {
    sine.amplitude_N_m = read_number<double>(key, value, kTorque);
  } else if (key == "offset") {
    sine.offset_N_m = read_number<double>(key, value, kTorque);
  } else if (key == "from") {
    sine.bands.front().from_Hz = read_number<double>(key, value, kFrequency);
  } else if (key == "to") {
    sine.bands.back().to_Hz = read_number<double>(key, value, kFrequency);
  } else if (key == "bands") {
    sine.bands = read_bands(value);
  } else if (key == "step") {
    sine.step_Hz = read_number<double>(key, value, kFrequency);
  } else if (key == "points") {
    sine.points = read_number<int>(key, value, kCount);
  } else if (key == "settle") {
    sine.settle_s.reset();
    if (value != "steady") {
      sine.settle_s = read_number<double>(key, value, "a number [s], or steady");
    }
  } else if (key == "cycles") {
    sine.cycles = read_number<int>(key, value, kCount);
  } else {
    return false;
  }
  return true;
}

void require_count(std::string_view key, int value, int least, int most) {
  if (value >= least && value <= most) return;
  throw arm::out_of_range(key_name(key), value, "", fmt::format("from {} to {}", least, most));
}

void require_valid(const SteppedSine& sine) {
  using arm::require_in_range;
  require_in_range(key_name("amplitude"), sine.amplitude_N_m, "N m", arm::kPositive);
  require_in_range(key_name("offset"), sine.offset_N_m, "N m", arm::kAnyFinite);
  double last_Hz = 0.0;
  for (const auto& band : sine.bands) {
    require_in_range(key_name("from"), band.from_Hz, "Hz", arm::kPositive);
    require_in_range(key_name("to"), band.to_Hz, "Hz", {band.from_Hz, false});
    if (band.from_Hz <= last_Hz) {
      throw arm::out_of_range(key_name("bands"), band.from_Hz, "Hz",
                              fmt::format("above {}, the end of the previous band", last_Hz));
    }
    last_Hz = band.to_Hz;
  }
  require_in_range(key_name("step"), sine.step_Hz, "Hz", arm::kPositive);
  if (sine.points) require_count("points", *sine.points, 2, kMostSineFrequencies);
  if (sine.settle_s) {
    require_in_range(key_name("settle"), *sine.settle_s, "s", arm::kNotNegative);
    const double most_s = kMostSettlingPeriods / sine.bands.back().to_Hz;
    if (*sine.settle_s > most_s) {
      throw arm::out_of_range(
          key_name("settle"), *sine.settle_s, "s",
          fmt::format("{:g} s, {:g} periods, or less", most_s, kMostSettlingPeriods));
    }
  }
  require_count("cycles", sine.cycles, 3, kMostSineCycles);
}

/// The double nearest to the decimal of 9 places that `frequency_Hz` is but for rounding.
double as_decimal(double frequency_Hz) {
  constexpr double kPlaces = 1e9;
  constexpr double kRoundings = 4.0 * std::numeric_limits<double>::epsilon();
  const double decimal = std::round(frequency_Hz * kPlaces) / kPlaces;
  return std::abs(decimal - frequency_Hz) <= kRoundings * frequency_Hz ? decimal : frequency_Hz;
}

}  // namespace

std::vector<double> frequencies_Hz(const SteppedSine& sine) {
  require_valid(sine);
  std::vector<double> frequencies;
  for (const auto& band : sine.bands) {
    const double width_Hz = band.to_Hz - band.from_Hz;
    double step_Hz = sine.step_Hz;
    double steps = std::floor(width_Hz / step_Hz + kWholeStep);
    if (sine.points && width_Hz > 0.0) {
      steps = *sine.points - 1;
      step_Hz = width_Hz / steps;
    }
    if (steps + 1.0 + static_cast<double>(frequencies.size()) > kMostSineFrequencies) {
      throw InputError(
          fmt::format("{}: more than {} frequencies; use a larger step or a narrower band",
                      key_name("step"), kMostSineFrequencies));
    }
    for (int k = 0; k <= static_cast<int>(steps); ++k) {
      frequencies.push_back(as_decimal(std::min(band.from_Hz + k * step_Hz, band.to_Hz)));
    }
  }
  if (std::ranges::adjacent_find(frequencies, std::greater_equal()) != frequencies.end()) {
    throw arm::out_of_range(key_name("step"), sine.step_Hz, "Hz",
                            "large enough to change the frequency in double precision");
  }
  return frequencies;
}

std::vector<ExcitationKey> keys_of(const SteppedSine& sine) {
  std::vector<std::string> bands;
  for (const auto& band : sine.bands) {
    bands.push_back(fmt::format("{}:{}", band.from_Hz, band.to_Hz));
  }
  const bool is_steady = !sine.settle_s;
  return {{"amplitude", "N m", fmt::format("{}", sine.amplitude_N_m)},
          {"offset", "N m", fmt::format("{}", sine.offset_N_m)},
          {"bands", "Hz", fmt::format("{}", fmt::join(bands, "/"))},
          sine.points ? ExcitationKey{"points", "", fmt::format("{}", *sine.points)}
                      : ExcitationKey{"step", "Hz", fmt::format("{}", sine.step_Hz)},
          is_steady ? ExcitationKey{"settle", "", "steady"}
                    : ExcitationKey{"settle", "s", fmt::format("{}", *sine.settle_s)},
          {"cycles", "", fmt::format("{}", sine.cycles)}};
}

SteppedSine stepped_sine_of(const std::vector<std::pair<std::string, std::string>>& keys,
                            const std::vector<std::string>& further) {
  SteppedSine sine;
  const auto is_given = [&](std::string_view name) {
    return std::ranges::any_of(keys, [&](const auto& key) { return key.first == name; });
  };
  if (is_given("bands") && (is_given("from") || is_given("to"))) {
    throw InputError(fmt::format("{}: not together with from or to", key_name("bands")));
  }
  if (is_given("step") && is_given("points")) {
    throw InputError(fmt::format("{}: not together with step", key_name("points")));
  }
  for (const auto& [key, value] : keys) {
    if (set(sine, key, value)) continue;
    std::vector<std::string> allowed = {"amplitude", "offset", "from",   "to",    "bands",
                                        "step",      "points", "settle", "cycles"};
    allowed.insert(allowed.end(), further.begin(), further.end());
    throw InputError(fmt::format("{}: unknown{}; allowed: {}", key_name(arm::shown(key)),
                                 arm::did_you_mean(key, allowed), fmt::join(allowed, ", ")));
  }
  return sine;
}

}  // namespace flexarm::response
