#include "compare/mac.hpp"

#include "response/any_formulation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace flexarm::compare {

namespace {

using Shape = std::vector<std::complex<double>>;

constexpr std::size_t kFewestSensors = 2;
constexpr int kModesBeyond = 2;

/// rad, m or strain: what a sensor measures before time derivatives.
enum Quantity : std::size_t { rotation, displacement, strain, kQuantities };

Quantity quantity_of(const arm::Sensor& sensor) {
  switch (sensor.kind) {
    case arm::SensorKind::hub_angle:
    case arm::SensorKind::hub_velocity:
      return rotation;
    case arm::SensorKind::strain:
      return strain;
    default:
      return displacement;
  }
}

std::vector<MeasuredShape> shapes_of(const std::vector<MeasuredRow>& rows, int most_orders) {
  std::vector<MeasuredShape> shapes;
  for (int order = 1; order <= most_orders; ++order) {
    MeasuredShape shape{order, {}, {}, {}};
    for (const auto& row : rows) {
      const auto& entry = row.measured;
      if (entry.feature != measured::Feature::pole || row.order != order) continue;
      if (!shape.frequency_Hz) shape.frequency_Hz = entry.frequency_Hz;
      const bool is_given =
          entry.sensor && entry.shape_re && std::ranges::count(shape.sensors, *entry.sensor) == 0;
      if (!is_given) continue;
      shape.sensors.push_back(*entry.sensor);
      shape.values.emplace_back(*entry.shape_re, entry.shape_im.value_or(0.0));
    }
    if (shape.sensors.size() >= kFewestSensors) shapes.push_back(std::move(shape));
  }
  return shapes;
}

std::vector<arm::Sensor> all_sensors(const std::vector<MeasuredShape>& shapes) {
  std::vector<arm::Sensor> sensors;
  for (const auto& shape : shapes) {
    for (const auto& sensor : shape.sensors) {
      if (std::ranges::count(sensors, sensor) == 0) sensors.push_back(sensor);
    }
  }
  return sensors;
}

/// One over the root-mean-square of the values of each quantity; 1 where there are none.
std::array<double, kQuantities> scales_of(const std::vector<arm::Mode>& modes,
                                          const std::vector<arm::Sensor>& sensors) {
  std::array<double, kQuantities> sums = {};
  std::array<double, kQuantities> counts = {};
  for (const auto& mode : modes) {
    for (std::size_t i = 0; i < sensors.size(); ++i) {
      const Quantity quantity = quantity_of(sensors[i]);
      sums[quantity] += mode.sensor_values[i] * mode.sensor_values[i];
      counts[quantity] += 1.0;
    }
  }
  std::array<double, kQuantities> scales = {};
  for (std::size_t q = 0; q < kQuantities; ++q) {
    scales[q] = sums[q] > 0.0 ? std::sqrt(counts[q] / sums[q]) : 1.0;
  }
  return scales;
}

/// The computed shape at some of the sensors that the mode has values at.
Shape computed_shape(const arm::Mode& mode, const std::vector<arm::Sensor>& of_mode,
                     const std::vector<arm::Sensor>& wanted,
                     const std::array<double, kQuantities>& scales) {
  Shape shape;
  for (const auto& sensor : wanted) {
    const auto at = std::ranges::find(of_mode, sensor) - of_mode.begin();
    shape.emplace_back(mode.sensor_values[static_cast<std::size_t>(at)] *
                       scales[quantity_of(sensor)]);
  }
  return shape;
}

}  // namespace

double mac(std::span<const std::complex<double>> a, std::span<const std::complex<double>> b) {
  std::complex<double> product = 0.0;
  double norm_a = 0.0;
  double norm_b = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    product += std::conj(a[i]) * b[i];
    norm_a += std::norm(a[i]);
    norm_b += std::norm(b[i]);
  }
  return std::norm(product) / (norm_a * norm_b);
}

std::optional<ShapeCorrelation> correlate_shapes(const std::vector<MeasuredRow>& rows,
                                                 const Comparison& comparison) {
  const auto most = static_cast<int>(comparison.modes.front().size());
  ShapeCorrelation correlation{shapes_of(rows, most), {}, comparison.subjects, {}, 0.0};
  if (correlation.measured.empty()) return std::nullopt;
  const int count = std::min(most, correlation.measured.back().order + kModesBeyond);
  const auto sensors = all_sensors(correlation.measured);
  std::array<double, kQuantities> scales = {};
  for (const auto& subject : standard_subjects(comparison.arm, most)) {
    const auto modes = response::modes(subject.formulation, count, sensors, {});
    const bool is_first = correlation.mac.empty();
    if (is_first) scales = scales_of(modes, sensors);
    auto& matrix = correlation.mac.emplace_back();
    for (const auto& shape : correlation.measured) {
      Shape measured = shape.values;
      for (std::size_t i = 0; i < measured.size(); ++i) {
        measured[i] *= scales[quantity_of(shape.sensors[i])];
      }
      std::vector<Shape> computed;
      for (const auto& mode : modes) {
        computed.push_back(computed_shape(mode, sensors, shape.sensors, scales));
      }
      auto& row = matrix.emplace_back();
      for (std::size_t i = 0; i < computed.size(); ++i) {
        row.push_back(mac(measured, computed[i]));
        for (std::size_t j = 0; j < i && is_first; ++j) {
          correlation.largest_auto_mac =
              std::fmax(correlation.largest_auto_mac, mac(computed[i], computed[j]));
        }
      }
    }
    if (!is_first) continue;
    for (const auto& mode : modes) {
      correlation.model_frequencies_Hz.push_back(mode.omega_rad_per_s / (2.0 * std::numbers::pi));
    }
  }
  return correlation;
}

}  // namespace flexarm::compare
