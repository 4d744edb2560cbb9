#include "compare/measured.hpp"

#include "arm/uncertainties.hpp"
#include "compare/damped_roots.hpp"
#include "compare/root_numbering.hpp"
#include "exact_tf/exact_arm.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <map>
#include <numbers>

namespace flexarm::compare {

namespace {

constexpr double kRadiansPerCycle = 2.0 * std::numbers::pi;

/// The poles, or a sensor's zeros on the imaginary axis, of all models, in the order of the first.
std::vector<const RootRow*> imaginary_roots(const Comparison& comparison,
                                            const std::optional<arm::Sensor>& zeros_of) {
  std::vector<const RootRow*> roots;
  for (const auto& row : comparison.roots) {
    if (row.family.zeros_of == zeros_of && row.s_rad_per_s.front()->real() == 0.0) {
      roots.push_back(&row);
    }
  }
  return roots;
}

/// Of model k with damping; empty where that root was not found.
std::optional<NaturalFrequency> natural_of(const RootRow& row, std::size_t k) {
  if (!row.s_rad_per_s[k]) return std::nullopt;
  if (row.damped.empty()) return NaturalFrequency{std::abs(*row.s_rad_per_s[k]) / kRadiansPerCycle};
  if (!row.damped[k]) return std::nullopt;
  return natural_frequency(*row.damped[k]);
}

/// The first model's, counted from 1.
std::vector<ModelRoot> numbered(const std::vector<const RootRow*>& roots) {
  std::vector<ModelRoot> out;
  int order = 0;
  for (const RootRow* row : roots) {
    ++order;
    if (const auto natural = natural_of(*row, 0)) out.push_back({natural->frequency_Hz, order});
  }
  return out;
}

/// Natural frequencies [Hz] of poles, or of zeros that are antiresonances without damping.
using Frequencies = std::map<std::optional<std::string>, std::vector<double>>;

Frequencies frequencies_of(const arm::Arm& arm, const Comparison& comparison,
                           const std::vector<arm::Sensor>& sensors) {
  Frequencies frequencies;
  const exact_tf::ExactArm exact(arm);
  const auto count = [&](const std::optional<arm::Sensor>& zeros_of) {
    return static_cast<int>(std::ranges::count(
        comparison.roots, zeros_of, [](const RootRow& row) { return row.family.zeros_of; }));
  };
  for (const auto& pair : exact.damped_poles(count({})).flexible) {
    frequencies[{}].push_back(natural_frequency(pair).frequency_Hz);
  }
  for (const auto& sensor : sensors) {
    auto zeros = exact.zeros(sensor, count(sensor)).s_rad_per_s;
    std::erase_if(zeros, [](std::complex<double> s) { return s.real() != 0.0; });
    for (const auto& pair : exact.damped_zeros(sensor, zeros).pairs) {
      frequencies[arm::to_string(sensor)].push_back(
          pair ? natural_frequency(*pair).frequency_Hz : std::numeric_limits<double>::quiet_NaN());
    }
  }
  return frequencies;
}

std::optional<std::string> family_of(const measured::ModalEntry& entry) {
  if (entry.feature == measured::Feature::pole) return std::nullopt;
  return arm::to_string(*entry.sensor);
}

/// A tenth of a standard deviation: curvature is small there, and rounding too.
constexpr double kStep = 0.1;

/// Fills the standard deviations that the uncertain numbers of the arm make: central differences
/// over each, in standard deviations, and the root of the sum of squares.
void add_model_std(const Comparison& comparison, const std::vector<arm::Sensor>& sensors,
                   std::vector<MeasuredRow>& rows) {
  const std::size_t uncertain = comparison.arm.relative_uncertainties.size();
  if (uncertain == 0 || rows.empty()) return;
  std::vector<double> variances(rows.size(), 0.0);
  for (std::size_t number = 0; number < uncertain; ++number) {
    std::vector<double> deviations(uncertain, 0.0);
    const auto at = [&](double deviation) {
      deviations[number] = deviation;
      return frequencies_of(arm::with_deviations(comparison.arm, deviations), comparison, sensors);
    };
    const Frequencies above = at(kStep);
    const Frequencies below = at(-kStep);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto high = above.find(family_of(rows[i].measured));
      const auto low = below.find(family_of(rows[i].measured));
      const std::size_t place = static_cast<std::size_t>(rows[i].order.value_or(0)) - 1;
      const bool is_there = high != above.end() && low != below.end() && rows[i].order &&
                            place < std::min(high->second.size(), low->second.size());
      const double slope_Hz = is_there ? (high->second[place] - low->second[place]) / (2.0 * kStep)
                                       : std::numeric_limits<double>::quiet_NaN();
      variances[i] += slope_Hz * slope_Hz;
    }
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].model_frequency_Hz && std::isfinite(variances[i])) {
      rows[i].model_std_Hz = std::sqrt(variances[i]);
    }
  }
}

MeasuredRow measured_row(const measured::ModalEntry& entry, const std::optional<int>& order,
                         const std::vector<const RootRow*>& roots, const Comparison& comparison) {
  MeasuredRow row;
  row.measured = entry;
  row.order = order;
  const std::size_t models =
      comparison.roots.empty() ? 0 : comparison.roots.front().s_rad_per_s.size();
  row.frequencies_Hz.resize(models);
  row.deviations.assign(models, std::numeric_limits<double>::quiet_NaN());
  const auto place = static_cast<std::size_t>(order.value_or(0)) - 1;
  if (order && place < roots.size()) {
    for (std::size_t k = 0; k < models; ++k) {
      if (const auto natural = natural_of(*roots[place], k)) {
        row.frequencies_Hz[k] = natural->frequency_Hz;
      }
    }
    row.model_frequency_Hz = row.frequencies_Hz.front();
    row.undamped_Hz = roots[place]->s_rad_per_s.front()->imag() / kRadiansPerCycle;
    if (const auto natural = natural_of(*roots[place], 0)) {
      row.model_damping_ratio = natural->damping_ratio;
    }
  }
  if (entry.frequency_Hz) {
    const double std_Hz = entry.frequency_std_Hz.value_or(0.0);
    for (std::size_t k = 0; k < models; ++k) {
      if (row.frequencies_Hz[k] && std_Hz > 0.0) {
        row.deviations[k] = (*entry.frequency_Hz - *row.frequencies_Hz[k]) / std_Hz;
      }
    }
  }
  if (row.model_frequency_Hz && entry.frequency_Hz) {
    row.error_percent =
        100.0 * (*entry.frequency_Hz - *row.model_frequency_Hz) / *row.model_frequency_Hz;
  }
  if (row.model_damping_ratio && entry.damping_ratio &&
      entry.damping_ratio_std.value_or(0.0) > 0.0) {
    row.damping_deviation =
        (*entry.damping_ratio - *row.model_damping_ratio) / *entry.damping_ratio_std;
  }
  return row;
}

}  // namespace

std::vector<MeasuredRow> beside_model(const measured::ModalTable& measured,
                                      const Comparison& comparison) {
  const auto poles = imaginary_roots(comparison, std::nullopt);
  const auto sensors = sensors_with_zeros(measured);
  ModelRoots model{.poles = numbered(poles)};
  for (const auto& sensor : sensors) {
    model.zeros.push_back({sensor, numbered(imaginary_roots(comparison, sensor))});
  }
  const std::vector<RootOrder> orders = number_roots(measured, model);
  std::vector<MeasuredRow> rows;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const bool is_zero = measured[i].feature == measured::Feature::zero;
    rows.push_back(measured_row(measured[i], orders[i].order,
                                is_zero ? imaginary_roots(comparison, measured[i].sensor) : poles,
                                comparison));
  }
  add_model_std(comparison, sensors, rows);
  for (auto& row : rows) {
    if (!row.model_frequency_Hz || !row.measured.frequency_Hz) continue;
    const double std_Hz =
        std::hypot(row.measured.frequency_std_Hz.value_or(0.0), row.model_std_Hz.value_or(0.0));
    if (std_Hz > 0.0) {
      row.combined_deviation = (*row.measured.frequency_Hz - *row.model_frequency_Hz) / std_Hz;
    }
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
