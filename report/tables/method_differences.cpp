#include "report/tables/method_differences.hpp"

#include "report/tables/identification_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace flexarm::report {

namespace {

using compare::IdentifiedRoot;
using measured::Feature;
using measured::Method;
using measured::ModalReading;

/// Lines in the half-power bandwidth below which a window widens a peak by more than its errors.
constexpr double kLinesInBandwidth = 6.0;

struct NumberWithError {
  double value = 0.0;
  double std = 0.0;
};

std::optional<NumberWithError> number_of(const std::optional<double>& value,
                                         const std::optional<double>& std) {
  if (!value || !std) return std::nullopt;
  return NumberWithError{*value, *std};
}

bool differ(const std::optional<NumberWithError>& a, const std::optional<NumberWithError>& b,
            double least) {
  if (!a || !b) return false;
  const double off = std::abs(a->value - b->value);
  return off > kSureDifference * std::hypot(a->std, b->std) && off > least * std::abs(b->value);
}

/// What the spectra of the reading's run do to the damping of a pole; empty where nothing.
std::string reason_in_spectra(const IdentifiedData& data, const ModalReading& reading,
                              const IdentifiedRoot& fitted) {
  const double bandwidth_Hz = 2.0 * *fitted.measured.damping_ratio * *fitted.measured.frequency_Hz;
  for (const auto& run : data.identification.runs) {
    if (std::ranges::find(reading.runs, run.run.id) == reading.runs.end() || !run.estimate) {
      continue;
    }
    const double spacing_Hz = run.estimate->spacing_Hz;
    if (!run.estimate->periodic && bandwidth_Hz < kLinesInBandwidth * spacing_Hz) {
      return fmt::format(
          "the window widens peaks: lines {:.2g} Hz apart, half-power bandwidth "
          "{:.2g} Hz; the fit has no window",
          spacing_Hz, bandwidth_Hz);
    }
  }
  return "";
}

bool has_distortion(const IdentifiedData& data, const measured::RunsFit& fit) {
  return std::ranges::any_of(fit.runs, [&](std::size_t r) {
    const auto& distortion = data.identification.runs[r].distortion;
    return distortion && std::ranges::any_of(distortion->channels, [](const auto& channel) {
             return channel.odd.found || channel.even.found;
           });
  });
}

/// What the fit of the same runs speaks for.
std::string reason_in_fit(const IdentifiedData& data, const ModalReading& fitted) {
  for (const auto& fit : data.identification.fits) {
    if (!fit.refusal.empty() || ids_of(fit, data.identification) != fitted.runs) continue;
    if (has_distortion(data, fit)) {
      return "the spectra show nonlinear distortion: damping that depends on the amplitude, such "
             "as "
             "friction, is likely";
    }
    const bool is_noise = std::ranges::all_of(
        fit.fit.sensors, [](const auto& sensor) { return sensor.residual.is_noise(); });
    if (!is_noise) {
      return "residuals of the fit are not noise: damping that depends on the amplitude "
             "(friction), "
             "a change over time or an unknown force is possible; runs of other amplitudes tell";
    }
  }
  return "no reason is evident from these data";
}

/// The reading of the fit that has the pole, with the pole.
struct FittedRoot {
  const ModalReading* reading = nullptr;
  const IdentifiedRoot* root = nullptr;
};

/// Runs of `part` are all among those of `whole`.
bool is_part(const std::vector<std::string>& part, const std::vector<std::string>& whole) {
  return std::ranges::all_of(
      part, [&](const std::string& id) { return std::ranges::find(whole, id) != whole.end(); });
}

FittedRoot fitted_root(const IdentifiedData& data, const ModalReading& reading, int order) {
  for (std::size_t i = 0; i < data.condition.roots.size(); ++i) {
    const auto& other = data.identification.readings[data.condition.readings[i]];
    if (other.method != Method::rational_fit || other.hub_held) continue;
    if (!is_part(reading.runs, other.runs)) continue;
    for (const auto& root : data.condition.roots[i]) {
      if (root.measured.feature == Feature::pole && root.order == order) return {&other, &root};
    }
  }
  return {};
}

void add_differences(const IdentifiedData& data, const ModalReading& reading,
                     const IdentifiedRoot& root, std::vector<std::string>& found) {
  const FittedRoot fit = fitted_root(data, reading, *root.order);
  if (fit.root == nullptr) return;
  const auto& own = root.measured;
  const auto& best = fit.root->measured;
  const std::string who =
      fmt::format("{}: pole {}: {}{}", joined(reading.runs), *root.order, to_string(reading.method),
                  reading.sensor ? " of " + arm::to_string(*reading.sensor) : "");
  const auto frequency = number_of(own.frequency_Hz, own.frequency_std_Hz);
  const auto fitted_frequency = number_of(best.frequency_Hz, best.frequency_std_Hz);
  if (differ(frequency, fitted_frequency, kLeastFrequency)) {
    found.push_back(fmt::format(
        "{}: {:.5g} +- {:.1g} Hz is {:.2g} % off the fit's {:.5g} +- {:.1g} Hz: more than the "
        "errors",
        who, frequency->value, frequency->std,
        100.0 * std::abs(frequency->value / fitted_frequency->value - 1.0), fitted_frequency->value,
        fitted_frequency->std));
  }
  const auto damping = number_of(own.damping_ratio, own.damping_ratio_std);
  const auto fitted_damping = number_of(best.damping_ratio, best.damping_ratio_std);
  if (!differ(damping, fitted_damping, kLeastDamping)) return;
  std::string reason = reason_in_spectra(data, reading, *fit.root);
  if (reason.empty()) reason = reason_in_fit(data, *fit.reading);
  found.push_back(fmt::format(
      "{}: damping ratio {:.3g} +- {:.1g} differs from the fit's {:.3g} +- {:.1g} by more than the "
      "errors; {}",
      who, damping->value, damping->std, fitted_damping->value, fitted_damping->std, reason));
}

}  // namespace

std::vector<std::string> method_differences(const IdentifiedData& data) {
  std::vector<std::string> found;
  for (std::size_t i = 0; i < data.condition.roots.size(); ++i) {
    const auto& reading = data.identification.readings[data.condition.readings[i]];
    const bool is_compared =
        reading.method == Method::nyquist_circle || reading.method == Method::response;
    if (!is_compared || joined(reading.runs) != data.runs || reading.hub_held) continue;
    for (const auto& root : data.condition.roots[i]) {
      if (root.measured.feature != Feature::pole || !root.order) continue;
      add_differences(data, reading, root, found);
    }
  }
  return found;
}

}  // namespace flexarm::report
