#include "compare/measured.hpp"

#include "arm/uncertainties.hpp"
#include "compare/root_numbering.hpp"
#include "exact_tf/exact_arm.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
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

/// The first model's, counted from 1.
std::vector<ModelRoot> numbered(const std::vector<const RootRow*>& roots) {
  std::vector<ModelRoot> out;
  for (const RootRow* row : roots) {
    out.push_back(
        {row->s_rad_per_s.front()->imag() / kRadiansPerCycle, static_cast<int>(out.size()) + 1});
  }
  return out;
}

/// Frequencies [Hz] of poles or of zeros on the imaginary axis, by what they are of.
using Frequencies = std::map<std::optional<std::string>, std::vector<double>>;

Frequencies frequencies_of(const arm::Arm& arm, const Comparison& comparison,
                           const std::vector<arm::Sensor>& sensors) {
  Frequencies frequencies;
  const exact_tf::ExactArm exact(arm);
  const auto count = [&](const std::optional<arm::Sensor>& zeros_of) {
    return static_cast<int>(std::ranges::count(
        comparison.roots, zeros_of, [](const RootRow& row) { return row.family.zeros_of; }));
  };
  for (const double omega : exact.poles(count({})).omega_rad_per_s) {
    frequencies[{}].push_back(omega / kRadiansPerCycle);
  }
  for (const auto& sensor : sensors) {
    for (const auto s : exact.zeros(sensor, count(sensor)).s_rad_per_s) {
      if (s.real() == 0.0)
        frequencies[arm::to_string(sensor)].push_back(s.imag() / kRadiansPerCycle);
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

/// The projected damping ratio of the first model's flexible mode of that order.
std::optional<double> damping_ratio_of(const Comparison& comparison, int order) {
  if (comparison.modes.empty()) return std::nullopt;
  const auto& modes = comparison.modes.front();
  if (order < 1 || static_cast<std::size_t>(order) > modes.size()) return std::nullopt;
  return modes[static_cast<std::size_t>(order) - 1].damping_ratio;
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
      const auto& s = roots[place]->s_rad_per_s[k];
      if (s) row.frequencies_Hz[k] = s->imag() / kRadiansPerCycle;
    }
    row.model_frequency_Hz = row.frequencies_Hz.front();
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
  if (entry.feature == measured::Feature::pole && row.model_frequency_Hz) {
    row.model_damping_ratio = damping_ratio_of(comparison, *order);
    if (row.model_damping_ratio && entry.damping_ratio &&
        entry.damping_ratio_std.value_or(0.0) > 0.0) {
      row.damping_deviation =
          (*entry.damping_ratio - *row.model_damping_ratio) / *entry.damping_ratio_std;
    }
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
