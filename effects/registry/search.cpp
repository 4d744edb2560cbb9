#include "effects/registry/search.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace flexarm::effects {

namespace {

/// No spring is stiffer, relative to the stiffest that is looked for.
constexpr double kRigid = 1e4;

/// 0 at coordinate 0 and `high` at 1: even steps below `low`, equal ratios above.
double growing(double coordinate, double low, double high) {
  return low * std::expm1(std::max(0.0, coordinate) * std::log1p(high / low));
}

double growing_coordinate(double value, double low, double high) {
  return std::log1p(value / low) / std::log1p(high / low);
}

/// The inverse hyperbolic sines of a range through 0, in units of what is even in it.
struct SinhRange {
  double even;
  double begin;
  double length;

  explicit SinhRange(double lowest, double highest)
      : even(-kEven * lowest),
        begin(std::asinh(lowest / even)),
        length(std::asinh(highest / even) - begin) {}

 private:
  static constexpr double kEven = 0.1;  // of the range below 0
};

}  // namespace

void TorqueScales::add(std::span<const double> torque_N_m, double period_s, double inertia_kg_m2) {
  double speed_rad_per_s = 0.0;
  for (const double torque : torque_N_m) {
    sizes_N_m_.push_back(std::abs(torque));
    squares_ += torque * torque;
    speed_rad_per_s += torque * period_s / inertia_kg_m2;
    speed_squares_ += speed_rad_per_s * speed_rad_per_s;
  }
}

void TorqueScales::put(Scales& scales) const {
  if (sizes_N_m_.empty()) return;
  const auto samples = static_cast<double>(sizes_N_m_.size());
  scales.torque_rms_N_m = std::sqrt(squares_ / samples);
  scales.torque_peak_N_m = std::ranges::max(sizes_N_m_);
  scales.speed_rms_rad_per_s = std::sqrt(speed_squares_ / samples);
  std::vector<double> acting_N_m = sizes_N_m_;
  std::erase(acting_N_m, 0.0);
  if (acting_N_m.empty()) return;
  const auto tenth = acting_N_m.begin() + std::ssize(acting_N_m) / 10;
  std::ranges::nth_element(acting_N_m, tenth);
  scales.torque_low_N_m = *tenth;
}

double SearchedParameter::value(double coordinate) const {
  switch (spacing) {
    case Spacing::linear:
      return lowest + coordinate * (highest - lowest);
    case Spacing::logarithmic:
      return lowest * std::pow(highest / lowest, coordinate);
    case Spacing::from_zero:
      return growing(coordinate, lowest, highest);
    case Spacing::from_infinity:
      return 1.0 /
             std::max(growing(coordinate, 1.0 / highest, 1.0 / lowest), 1.0 / (kRigid * highest));
    case Spacing::about_zero: {
      const SinhRange range(lowest, highest);
      return range.even * std::sinh(range.begin + coordinate * range.length);
    }
  }
  return lowest;
}

double SearchedParameter::coordinate(double value) const {
  switch (spacing) {
    case Spacing::linear:
      return (value - lowest) / (highest - lowest);
    case Spacing::logarithmic:
      return std::log(value / lowest) / std::log(highest / lowest);
    case Spacing::from_zero:
      return growing_coordinate(value, lowest, highest);
    case Spacing::from_infinity:
      return growing_coordinate(1.0 / value, 1.0 / highest, 1.0 / lowest);
    case Spacing::about_zero: {
      const SinhRange range(lowest, highest);
      return (std::asinh(value / range.even) - range.begin) / range.length;
    }
  }
  return 0.0;
}

std::optional<double> SearchedParameter::neutral_coordinate() const {
  if (spacing == Spacing::from_zero || spacing == Spacing::from_infinity) return 0.0;
  if (spacing == Spacing::about_zero) return this->coordinate(0.0);
  if (!neutral) return std::nullopt;
  return coordinate(*neutral);
}

double SearchedParameter::size(double coordinate) const {
  const auto of_growing = [coordinate](double low, double high) {
    const double rate = std::log1p(high / low);
    return -std::expm1(-rate * coordinate) / rate;
  };
  if (spacing == Spacing::from_zero) return of_growing(lowest, highest);
  if (spacing == Spacing::from_infinity) return of_growing(1.0 / highest, 1.0 / lowest);
  if (spacing == Spacing::about_zero) {
    const SinhRange range(lowest, highest);
    return std::abs(std::tanh(range.begin + coordinate * range.length)) / range.length;
  }
  if (neutral) return std::abs(coordinate - *neutral_coordinate());
  return spacing == Spacing::logarithmic ? 1.0 / std::log(highest / lowest) : 0.5;
}

std::vector<double> values_at(std::span<const SearchedParameter> parameters,
                              std::span<const double> coordinates) {
  std::vector<double> parts;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    parts.push_back(parameters[i].value(coordinates[i]));
  }
  return values_of(parameters, std::move(parts));
}

std::vector<double> coordinates_of(std::span<const SearchedParameter> parameters,
                                   std::span<const double> values) {
  std::vector<double> coordinates = parts_of(parameters, values);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    coordinates[i] = parameters[i].coordinate(coordinates[i]);
  }
  return coordinates;
}

std::vector<double> parts_of(std::span<const SearchedParameter> parameters,
                             std::span<const double> values) {
  std::vector<double> parts;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const double base = parameters[i].above_previous ? values[i - 1] : 0.0;
    parts.push_back(values[i] - base);
  }
  return parts;
}

std::vector<double> values_of(std::span<const SearchedParameter> parameters,
                              std::vector<double> parts) {
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].above_previous) parts[i] += parts[i - 1];
  }
  return parts;
}

}  // namespace flexarm::effects
