#include "report/page/root_map.hpp"

#include "report/figures/sensor_label.hpp"
#include "report/page/page_words.hpp"
#include "report/tables/zero_kind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace flexarm::report::page {

namespace {

using Complex = std::complex<double>;

constexpr double kRadiansPerCycle = 2.0 * std::numbers::pi;
constexpr int kShownDigits = 5;

std::vector<Complex> both_roots(double omega, double damping_ratio) {
  const Complex split = std::sqrt(Complex(damping_ratio * damping_ratio - 1.0, 0.0));
  return {omega * (-damping_ratio + split), omega * (-damping_ratio - split)};
}

std::string with_error(double value, const std::optional<double>& deviation,
                       const std::string& unit) {
  std::string text = number_of(value, kShownDigits);
  if (deviation && std::isfinite(*deviation)) text += " ± " + number_of(*deviation, 2);
  return unit.empty() ? text : text + " " + unit;
}

}  // namespace

std::vector<std::vector<arm::Sensor>> sensors_by_zeros(const std::vector<arm::Sensor>& sensors) {
  const auto place = [](const arm::Sensor& sensor) {
    switch (sensor.kind) {
      case arm::SensorKind::hub_velocity:
        return arm::Sensor{arm::SensorKind::hub_angle, 0.0};
      case arm::SensorKind::tip_acceleration:
        return arm::Sensor{arm::SensorKind::tip_displacement, 0.0};
      default:
        return sensor;
    }
  };
  std::vector<std::vector<arm::Sensor>> groups;
  for (const arm::Sensor& sensor : sensors) {
    const auto at = std::ranges::find_if(groups, [&](const std::vector<arm::Sensor>& group) {
      return place(group.front()) == place(sensor);
    });
    if (at == groups.end()) {
      groups.push_back({sensor});
    } else {
      at->push_back(sensor);
    }
  }
  return groups;
}

std::string map_title(const std::vector<arm::Sensor>& sensors) {
  std::string title = "Torque to ";
  for (const arm::Sensor& sensor : sensors) {
    title += (&sensor == &sensors.front() ? "" : ", ") + sensor_label(sensor);
  }
  return title;
}

MapBlock root_map(const std::string& id, const std::string& title, const std::string& caption) {
  return {{id, title, caption}, {"real part", "1/s"}, {"imaginary part", "rad/s"}, {}};
}

void add_poles(MapBlock& map, const MapSeries& series,
               const std::vector<compare::AnalyticalPole>& poles) {
  int number = 0;
  for (const auto& [frequency_Hz, damping_ratio] : poles) {
    ++number;
    for (const Complex& s : both_roots(kRadiansPerCycle * frequency_Hz, damping_ratio)) {
      map.points.push_back({.mark = Mark::pole,
                            .non_minimum_phase = false,
                            .series = series.name,
                            .role = series.role,
                            .real = s.real(),
                            .imaginary = s.imag(),
                            .details = {{"frequency", with_error(frequency_Hz, {}, "Hz")},
                                        {"pole", fmt::format("{}", number)},
                                        {"damping ratio", with_error(damping_ratio, {}, "")}}});
    }
  }
}

void add_zeros(MapBlock& map, const MapSeries& series,
               const std::vector<std::vector<Complex>>& roots_rad_per_s) {
  int number = 0;
  for (const std::vector<Complex>& roots : roots_rad_per_s) {
    ++number;
    for (const Complex& s : roots) {
      const bool is_real = s.imag() == 0.0;
      map.points.push_back(
          {.mark = Mark::zero,
           .non_minimum_phase = s.real() > 0.0,
           .series = series.name,
           .role = series.role,
           .real = s.real(),
           .imaginary = s.imag(),
           .details = {
               is_real ? Fact{"s", with_error(s.real(), {}, "1/s")}
                       : Fact{"frequency", with_error(std::abs(s) / kRadiansPerCycle, {}, "Hz")},
               {"zero", fmt::format("{}", number)}}});
    }
  }
}

std::vector<std::vector<Complex>> zeros_up_to(std::vector<std::vector<Complex>> roots_rad_per_s,
                                              double to_rad_per_s) {
  for (std::vector<Complex>& roots : roots_rad_per_s) {
    const bool is_near = std::ranges::any_of(
        roots, [&](const Complex& s) { return std::abs(s) <= to_rad_per_s; });
    if (!is_near) roots.clear();
  }
  return roots_rad_per_s;
}

void add_root(MapBlock& map, const MapSeries& series, const MeasuredRoot& root) {
  const double omega = kRadiansPerCycle * root.frequency_Hz;
  const double zeta = root.damping_ratio.value_or(0.0);
  MapPoint point{
      .mark = root.mark,
      .non_minimum_phase = root.mark == Mark::zero &&
                           is_non_minimum_phase(root.damping_ratio, root.damping_ratio_std),
      .series = series.name,
      .role = series.role,
      .details = {{"frequency", with_error(root.frequency_Hz, root.frequency_std_Hz, "Hz")},
                  {"root", root.name}}};
  if (root.damping_ratio) {
    point.details.push_back(
        {"damping ratio", with_error(*root.damping_ratio, root.damping_ratio_std, "")});
  }
  // s = omega (-zeta +- i sqrt(1 - zeta^2)), errors to first order.
  const double omega_std = kRadiansPerCycle * root.frequency_std_Hz.value_or(0.0);
  const double zeta_std = root.damping_ratio_std.value_or(0.0);
  const double turn = std::sqrt(std::max(0.0, 1.0 - zeta * zeta));
  if (root.frequency_std_Hz && turn > 0.0) {
    point.real_std = std::hypot(zeta * omega_std, omega * zeta_std);
    point.imaginary_std = std::hypot(turn * omega_std, omega * zeta / turn * zeta_std);
  }
  for (const Complex& s : both_roots(omega, zeta)) {
    point.real = s.real();
    point.imaginary = s.imag();
    map.points.push_back(point);
  }
}

}  // namespace flexarm::report::page
