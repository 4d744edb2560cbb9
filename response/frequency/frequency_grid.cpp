#include "response/frequency/frequency_grid.hpp"

#include "arm/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flexarm::response {

namespace {

constexpr double kNarrowest = 1e-4;  // relative to the feature's frequency
constexpr double kOfHalfWidth = 0.25;

double spacing(const FrequencyGrid& grid) {
  return std::pow(grid.to_Hz / grid.from_Hz, 1.0 / (grid.points - 1));
}

}  // namespace

std::vector<double> logarithmic_frequencies(const FrequencyGrid& grid) {
  if (!(grid.from_Hz > 0.0) || !std::isfinite(grid.from_Hz)) {
    throw arm::out_of_range("from_Hz", grid.from_Hz, "Hz", "finite and above 0");
  }
  if (!std::isfinite(grid.to_Hz)) throw arm::out_of_range("to_Hz", grid.to_Hz, "Hz", "finite");
  if (!(grid.to_Hz > grid.from_Hz)) {
    throw arm::out_of_range("from_Hz", grid.from_Hz, "Hz", fmt::format("below {} Hz", grid.to_Hz));
  }
  if (grid.points < 2 || grid.points > kMostFrequencies) {
    throw arm::out_of_range("points", grid.points, "", fmt::format("2 to {}", kMostFrequencies));
  }
  std::vector<double> frequency_Hz;
  const double step = std::log(grid.to_Hz / grid.from_Hz) / (grid.points - 1);
  for (int i = 0; i < grid.points; ++i) frequency_Hz.push_back(grid.from_Hz * std::exp(step * i));
  frequency_Hz.back() = grid.to_Hz;
  return frequency_Hz;
}

std::vector<double> refined_frequencies(const FrequencyGrid& grid,
                                        std::span<const std::complex<double>> features_rad_per_s) {
  std::vector<double> frequency_Hz = logarithmic_frequencies(grid);
  const double relative_spacing = spacing(grid) - 1.0;
  const auto add = [&](double frequency) {
    if (frequency > grid.from_Hz && frequency < grid.to_Hz) frequency_Hz.push_back(frequency);
  };
  for (const auto& s : features_rad_per_s) {
    const double centre = std::abs(s.imag()) / (2.0 * std::numbers::pi);
    const double half_width = std::abs(s.real()) / (2.0 * std::numbers::pi);
    if (!(centre > grid.from_Hz && centre < grid.to_Hz)) continue;
    if (half_width > 0.0) add(centre);
    for (double offset = std::max(kOfHalfWidth * half_width, kNarrowest * centre);
         offset < relative_spacing * centre; offset *= 2.0) {
      add(centre - offset);
      add(centre + offset);
    }
  }
  std::ranges::sort(frequency_Hz);
  frequency_Hz.erase(std::unique(frequency_Hz.begin(), frequency_Hz.end()), frequency_Hz.end());
  return frequency_Hz;
}

void require_ascending(std::span<const double> frequency_Hz, const char* key) {
  if (frequency_Hz.empty()) throw arm::InputError(fmt::format("{}: no frequency is given", key));
  double last = 0.0;
  for (const double frequency : frequency_Hz) {
    if (!(frequency > last) || !std::isfinite(frequency)) {
      throw arm::out_of_range(
          key, frequency, "Hz",
          last == 0.0 ? "above 0" : fmt::format("above {} Hz, the one before", last));
    }
    last = frequency;
  }
}

}  // namespace flexarm::response
