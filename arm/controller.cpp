#include "arm/controller.hpp"

#include "arm/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace flexarm::arm {

namespace {

using Rows = StateSpaceController::Rows;

void require_gain(const char* key, double value, const char* unit) {
  if (!std::isfinite(value)) throw out_of_range(key, value, unit, "finite");
}

void require_size(const char* key, const Rows& matrix, std::size_t rows, std::size_t columns,
                  const char* what) {
  const bool fits = matrix.size() == rows && std::ranges::all_of(matrix, [&](const auto& row) {
                      return row.size() == columns;
                    });
  if (!fits) {
    throw InputError(fmt::format("{}: must be {} x {}: {}", key, rows, columns, what), key);
  }
  for (const auto& row : matrix) {
    for (const double value : row) {
      if (!std::isfinite(value)) throw out_of_range(key, value, "", "finite");
    }
  }
}

bool has_nonzero(std::span<const double> values) {
  return std::ranges::any_of(values, [](double value) { return value != 0.0; });
}

/// row times matrix, `columns` wide.
std::vector<double> product(const std::vector<double>& row, const Rows& matrix,
                            std::size_t columns) {
  std::vector<double> made(columns, 0.0);
  for (std::size_t i = 0; i < row.size(); ++i) {
    for (std::size_t j = 0; j < columns; ++j) made[j] += row[i] * matrix[i][j];
  }
  return made;
}

/// The sensors act on the torque through D, or by C A^j B with some j below the number of states.
bool closes_the_loop(const StateSpaceController& law, std::size_t inputs) {
  const auto of_sensors = [](const std::vector<double>& row) { return std::span(row).subspan(1); };
  if (has_nonzero(of_sensors(law.d.front()))) return true;
  std::vector<double> row = law.c.front();
  for (std::size_t j = 0; j < law.a.size(); ++j) {
    const std::vector<double> response = product(row, law.b, inputs);
    if (has_nonzero(of_sensors(response))) return true;
    row = product(row, law.a, law.a.size());
  }
  return false;
}

void require_valid_law(const PidController& law, const std::vector<Sensor>& sensors) {
  if (sensors.size() != 1) {
    throw InputError(
        fmt::format("sensor: {} sensors; a controller with kp, kd, ki has one", sensors.size()),
        "sensor");
  }
  const std::string unit(arm::unit(sensors.front()));
  require_gain("kp", law.kp, fmt::format("N m/({})", unit).c_str());
  require_gain("kd", law.kd, fmt::format("N m s/({})", unit).c_str());
  require_gain("ki", law.ki, fmt::format("N m/(({}) s)", unit).c_str());
  if (law.kp == 0.0 && law.kd == 0.0 && law.ki == 0.0) {
    throw InputError(
        "kp = 0, kd = 0, ki = 0: does not close the loop; one of the gains must not be 0", "kp");
  }
}

void require_valid_law(const StateSpaceController& law, const std::vector<Sensor>& sensors) {
  const std::size_t states = law.a.size();
  const std::size_t inputs = sensors.size() + 1;
  constexpr const char* kInputs = "a column for the reference and one for each sensor";
  require_size("A", law.a, states, states, "square");
  require_size("B", law.b, states, inputs, kInputs);
  require_size("C", law.c, 1, states, "one row, the torque, and a column for each state");
  require_size("D", law.d, 1, inputs, kInputs);
  if (closes_the_loop(law, inputs)) return;
  throw InputError(
      "D: does not close the loop; the torque must depend on a sensor by D, or by B, A and C", "D");
}

}  // namespace

void require_valid(const Controller& controller) {
  const auto& sensors = controller.sensors;
  if (sensors.empty()) throw InputError("sensor: missing; must be a sensor", "sensor");
  for (const Sensor& sensor : sensors) {
    if (std::ranges::count(sensors, sensor) > 1) {
      throw InputError(fmt::format("sensor: {} is given twice", to_string(sensor)), "sensor");
    }
  }
  if (controller.limit_N_m) {
    require_in_range("limit", *controller.limit_N_m, "N m", kPositive);
  }
  if (controller.sample_time_s) {
    require_in_range("sample_time", *controller.sample_time_s, "s", kPositive);
  }
  std::visit([&](const auto& law) { require_valid_law(law, sensors); }, controller.law);
}

int samples_per_period(const Controller& controller, double period_s) {
  if (!controller.sample_time_s) return 1;
  const double ratio = *controller.sample_time_s / period_s;
  const double whole = std::round(ratio);
  const bool is_whole = whole >= 1.0 && whole <= std::numeric_limits<int>::max() &&
                        std::abs(ratio - whole) <= kWholeMultiple * whole;
  if (is_whole) return static_cast<int>(whole);
  throw out_of_range(
      "sample_time", *controller.sample_time_s, "s",
      fmt::format("a whole multiple of the period of the record, {:.9g} s", period_s));
}

}  // namespace flexarm::arm
