#include "compare/measured.hpp"

#include "compare/root_numbering.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace flexarm::compare {

namespace {

/// The first model's poles, or a sensor's zeros on the imaginary axis, counted from 1.
std::vector<ModelRoot> imaginary_roots(const Comparison& comparison,
                                       const std::optional<arm::Sensor>& zeros_of) {
  std::vector<ModelRoot> roots;
  for (const auto& row : comparison.roots) {
    const std::complex<double> s = *row.s_rad_per_s.front();
    if (row.family.zeros_of == zeros_of && s.real() == 0.0) {
      roots.push_back({s.imag() / (2.0 * std::numbers::pi), static_cast<int>(roots.size()) + 1});
    }
  }
  return roots;
}

}  // namespace

std::vector<MeasuredRow> beside_model(const measured::ModalTable& measured,
                                      const Comparison& comparison) {
  ModelRoots model{.poles = imaginary_roots(comparison, std::nullopt)};
  for (const auto& sensor : sensors_with_zeros(measured)) {
    model.zeros.push_back({sensor, imaginary_roots(comparison, sensor)});
  }
  const std::vector<RootOrder> orders = number_roots(measured, model);
  std::vector<MeasuredRow> rows;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const measured::ModalEntry& entry = measured[i];
    MeasuredRow row{.measured = entry,
                    .order = orders[i].order,
                    .model_frequency_Hz = {},
                    .error_percent = std::numeric_limits<double>::quiet_NaN()};
    const auto& roots =
        entry.feature == measured::Feature::zero
            ? std::ranges::find(model.zeros, *entry.sensor, &ModelRoots::Zeros::sensor)->roots
            : model.poles;
    const auto at = std::ranges::find(roots, row.order.value_or(0), &ModelRoot::order);
    if (at != roots.end()) row.model_frequency_Hz = at->frequency_Hz;
    if (row.model_frequency_Hz && entry.frequency_Hz) {
      row.error_percent =
          100.0 * (*entry.frequency_Hz - *row.model_frequency_Hz) / *row.model_frequency_Hz;
    }
    rows.push_back(row);
  }
  return rows;
}

std::vector<arm::Sensor> sensors_with_zeros(const measured::ModalTable& measured) {
  std::vector<arm::Sensor> sensors;
  for (const auto& feature : measured) {
    if (feature.feature == measured::Feature::zero &&
        std::ranges::find(sensors, *feature.sensor) == sensors.end()) {
      sensors.push_back(*feature.sensor);
    }
  }
  return sensors;
}

}  // namespace flexarm::compare
