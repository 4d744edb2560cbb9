#include "compare/sweeps/sweep.hpp"

#include "arm/input_error.hpp"
#include "arm/linear_arm.hpp"
#include "arm/unit_suffix.hpp"
#include "response/settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ranges>
#include <utility>

namespace flexarm::compare {

namespace {

/// Roots near the last one asked for may change places with it from one model to the next.
constexpr int kSpareZeros = 2;

void require_count(const char* key, int value) {
  if (value < 1 || value > response::kMostRoots - kSpareZeros) {
    throw arm::out_of_range(key, value, "",
                            fmt::format("from 1 to {}", response::kMostRoots - kSpareZeros));
  }
}

void require_axes(const std::vector<SweepAxis>& axes) {
  if (axes.empty() || axes.size() > 2) {
    throw arm::InputError("--over: give one or two parameters");
  }
  std::size_t points = 1;
  for (const SweepAxis& axis : axes) {
    if (axis.values.empty() || axis.values.size() > kMostGridPoints / points) {
      throw arm::InputError(
          fmt::format("--over: the grid must have from 1 to {} points", kMostGridPoints));
    }
    points *= axis.values.size();
  }
  if (axes.size() == 2 && axes[0].parameter.name == axes[1].parameter.name) {
    throw arm::InputError(fmt::format("--over {}: given twice", axes[0].parameter.name));
  }
}

/// Throws for an axis whose values all make the same equations.
void require_effective(const SweepTask& task, std::size_t axis) {
  std::vector<double> places(task.axes.size(), 0.0);
  const auto first = arm::linear_arm(arm_at(task.arm, task.axes, places));
  const std::size_t count = task.axes[axis].values.size();
  for (std::size_t i = 1; i < count; ++i) {
    places[axis] = static_cast<double>(i);
    if (arm::linear_arm(arm_at(task.arm, task.axes, places)) != first) return;
  }
  const std::span alone(&task.axes[axis], 1);
  for (std::size_t i = 1; i < count && task.axes.size() > 1; ++i) {
    const std::array begin = {0.0};
    const std::array place = {static_cast<double>(i)};
    if (arm::linear_arm(arm_at(task.arm, alone, place)) !=
        arm::linear_arm(arm_at(task.arm, alone, begin))) {
      throw arm::InputError(fmt::format("--over {}: sets the same number as the other --over, {}",
                                        task.axes[axis].parameter.name,
                                        task.axes[1 - axis].parameter.name));
    }
  }
  if (count > 1) {
    throw arm::InputError(
        fmt::format("--over {}: no influence on this arm", task.axes[axis].parameter.name));
  }
}

void add_pair(const arm::PolePair& pair, std::vector<std::complex<double>>& poles) {
  for (const auto s : {pair.first_rad_per_s, pair.second_rad_per_s}) {
    if (s.imag() >= 0.0) poles.push_back(s);
  }
}

/// s = 0 of a hub that nothing holds, to rounding.
constexpr double kAtRest = 1e-9;  // of the first flexible frequency

arm::InputError at_point(const SweepTask& task, std::size_t point, const arm::InputError& error) {
  return arm::InputError(fmt::format("at {}: {}", task.describe(point), error.what()), error.key());
}

}  // namespace

std::size_t SweepTask::points() const {
  std::size_t count = 1;
  for (const SweepAxis& axis : axes) count *= axis.values.size();
  return count;
}

std::vector<double> SweepTask::places_of(std::size_t point) const {
  std::vector<double> places(axes.size());
  for (std::size_t k = axes.size(); k-- > 0;) {
    places[k] = static_cast<double>(point % axes[k].values.size());
    point /= axes[k].values.size();
  }
  return places;
}

double SweepTask::value(std::size_t axis, std::size_t point) const {
  return axes[axis].at(places_of(point)[axis]);
}

arm::Arm SweepTask::arm_of(std::size_t point) const {
  return arm_at(arm, axes, places_of(point));
}

std::string SweepTask::describe(std::size_t point) const {
  std::string text;
  for (std::size_t k = 0; k < axes.size(); ++k) {
    const SweepParameter& parameter = axes[k].parameter;
    text += fmt::format("{}{} = {:.6g}{}", k > 0 ? ", " : "", parameter.name, value(k, point),
                        arm::unit_suffix(parameter.unit));
  }
  return text;
}

SweepInterrupted::SweepInterrupted(std::size_t points_done, std::size_t points)
    : std::runtime_error(fmt::format("interrupted after {} of {} points", points_done, points)),
      done(points_done),
      total(points) {}

void require_valid(const SweepTask& task) {
  require_axes(task.axes);
  require_count("--poles", task.questions.poles);
  require_count("--zeros", task.questions.zeros);
  for (std::size_t point = 0; point < task.points(); ++point) {
    try {
      const auto arm = task.arm_of(point);
      arm::require_computable(arm);
      for (const auto& sensor : task.questions.sensors) {
        arm::require_valid(sensor, arm);
        arm::require_responsive(sensor, arm);
      }
    } catch (const arm::InputError& error) {
      throw at_point(task, point, error);
    }
  }
  for (std::size_t axis = 0; axis < task.axes.size(); ++axis) require_effective(task, axis);
  // A model that refuses the arm does so at once: here at the ends of the grid.
  for (const Model& model : task.models) {
    for (const std::size_t point : {std::size_t{0}, task.points() - 1}) {
      try {
        model.make(task.arm_of(point));
      } catch (const arm::InputError& error) {
        throw at_point(task, point, error);
      }
    }
  }
}

int zeros_asked(const arm::Sensor& sensor, const SweepQuestions& questions) {
  return arm::is_collocated(sensor) ? questions.poles : questions.zeros + kSpareZeros;
}

std::vector<std::complex<double>> damped_poles(const response::AnyFormulation& formulation,
                                               const arm::PoleSet& undamped, int count) {
  std::vector<std::complex<double>> poles;
  if (arm::linear_arm(response::arm_of(formulation)).is_damped()) {
    const auto damped = response::damped_poles(formulation, count);
    add_pair(damped.lowest, poles);
    for (const auto& pair : damped.flexible) add_pair(pair, poles);
  } else {
    const auto lowest = std::sqrt(std::complex(-undamped.lowest_omega_squared_rad2_per_s2, 0.0));
    add_pair({lowest, -lowest}, poles);
    for (const double omega : undamped.omega_rad_per_s) poles.emplace_back(0.0, omega);
  }
  std::erase_if(poles, [&](const auto s) {
    return std::abs(s) <= kAtRest * undamped.omega_rad_per_s.front();
  });
  std::ranges::sort(poles, [](const auto a, const auto b) { return std::abs(a) < std::abs(b); });
  return poles;
}

SweepPoint evaluate_point(const Model& model, const arm::Arm& arm,
                          const SweepQuestions& questions) {
  const auto formulation = model.make(arm);
  SweepPoint point;
  if (questions.modes) {
    const std::array tip_m = {arm::linear_arm(arm).length_m};
    const auto modal = response::modal_model(formulation, questions.poles, {}, tip_m);
    arm::PoleSet poles;
    poles.lowest_omega_squared_rad2_per_s2 = modal.lowest_omega_squared_rad2_per_s2;
    for (const auto& mode : modal.modes | std::views::drop(1)) {
      poles.omega_rad_per_s.push_back(mode.omega_rad_per_s);
      point.hub_slope.push_back(mode.hub_slope);
      point.tip_value_m.push_back(mode.displacement_m.front());
    }
    point.damped_poles_rad_per_s = damped_poles(formulation, poles, questions.poles);
    point.omega_rad_per_s = std::move(poles.omega_rad_per_s);
  } else {
    point.omega_rad_per_s = response::poles(formulation, questions.poles).omega_rad_per_s;
  }
  for (const auto& sensor : questions.sensors) {
    point.zeros_rad_per_s.push_back(
        response::zeros(formulation, sensor, zeros_asked(sensor, questions)).s_rad_per_s);
  }
  return point;
}

}  // namespace flexarm::compare
