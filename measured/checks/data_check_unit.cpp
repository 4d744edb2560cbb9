#include "measured/checks/data_check_unit.hpp"

#include "measured/spectra/robust.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace flexarm::measured {

namespace {

using arm::SensorKind;

constexpr double kLeastUnitScore = 8.0;
constexpr double kLeastUnitCorrelation = 0.7;

/// Scale of a over scale of b, as recorded over what it must be.
struct Ratio {
  std::size_t a = 0;
  std::size_t b = 0;
  double log10_off = 0.0;
  bool rough = false;
};

void add_identities(const Comparison& comparison, std::vector<Ratio>& ratios) {
  for (const auto& [x, y] : identities_of(comparison)) {
    const GainFit fit = fit_gain(comparison.transforms, x, y);
    if (holds(fit)) ratios.push_back({x.signal, y.signal, fit.log10_gain, false});
  }
}

void add_tip(const Comparison& comparison, std::vector<Ratio>& ratios) {
  const auto fit = fit_tip(comparison);
  if (!fit) return;
  const auto length_m = comparison.options.length_m;
  if (std::abs(fit->angle.score) > kLeastUnitScore && length_m) {
    ratios.push_back({fit->displacement, fit->angle.signal,
                      std::log10(std::abs(fit->angle.gain) / *length_m), false});
  }
  if (std::abs(fit->deflection.score) > kLeastUnitScore) {
    ratios.push_back({fit->displacement, fit->deflection.signal,
                      std::log10(std::abs(fit->deflection.gain)), false});
  }
}

void add_rigid(const Comparison& comparison, Quantity x, Quantity y, double expected,
               std::vector<Ratio>& ratios) {
  const auto fit =
      fit_low_frequencies(comparison.transforms, x, y, rigid_band_Hz(comparison.transforms));
  if (std::abs(fit.score) < kLeastUnitScore || std::abs(fit.correlation) < kLeastUnitCorrelation) {
    return;
  }
  ratios.push_back({x.signal, y.signal, std::log10(std::abs(fit.gain) / expected), true});
}

void add_rigid_motion(const Comparison& comparison, std::vector<Ratio>& ratios) {
  for (const auto hub_kind : {SensorKind::hub_angle, SensorKind::hub_velocity}) {
    const auto hub = comparison.find(hub_kind);
    if (!hub) continue;
    const Quantity acceleration{*hub, hub_kind == SensorKind::hub_angle ? 2 : 1};
    if (const auto length_m = comparison.options.length_m) {
      for (const auto tip_kind : {SensorKind::tip_acceleration, SensorKind::tip_displacement}) {
        const auto tip = comparison.find(tip_kind);
        const int order = tip_kind == SensorKind::tip_acceleration ? 0 : 2;
        if (tip) add_rigid(comparison, {*tip, order}, acceleration, *length_m, ratios);
      }
    }
    if (comparison.options.total_inertia_kg_m2 && comparison.usable[0]) {
      add_rigid(comparison, {0, 0}, acceleration, *comparison.options.total_inertia_kg_m2, ratios);
    }
  }
}

/// The scale of one signal that all its ratios ask for, if one does and no other ratio is off.
struct Suspect {
  std::size_t signal = 0;
  double log10_scale = 0.0;
  double unexplained = 0.0;  ///< ratios that are off all the same
  double relief = 0.0;       ///< by how much less implausible it becomes
  bool is_known_slip = false;
};

double tolerance(const Ratio& ratio, const DataCheckOptions& options) {
  return std::log10(ratio.rough ? options.rough_unit_factor : options.unit_factor);
}

Suspect suspect_of(const Comparison& comparison, const std::vector<Ratio>& ratios,
                   std::size_t signal) {
  std::vector<double> exact;
  std::vector<double> rough;
  for (const auto& ratio : ratios) {
    if (ratio.a == signal) (ratio.rough ? rough : exact).push_back(ratio.log10_off);
    if (ratio.b == signal) (ratio.rough ? rough : exact).push_back(-ratio.log10_off);
  }
  Suspect suspect;
  suspect.signal = signal;
  suspect.log10_scale = median(exact.empty() ? rough : exact);
  // What holds roughly is off by a power of ten at least.
  if (exact.empty()) suspect.log10_scale = std::round(suspect.log10_scale);
  suspect.is_known_slip = !unit_slip(suspect.log10_scale).empty();
  for (const auto& ratio : ratios) {
    double off = ratio.log10_off;
    if (ratio.a == signal) off -= suspect.log10_scale;
    if (ratio.b == signal) off += suspect.log10_scale;
    if (std::abs(off) > tolerance(ratio, comparison.options)) suspect.unexplained += 1.0;
  }
  const auto& it = comparison.signals[signal];
  suspect.relief = implausibility(it, it.deviation) -
                   implausibility(it, it.deviation * std::pow(10.0, -suspect.log10_scale));
  return suspect;
}

DataFinding unit_finding(const Comparison& comparison, const Suspect& suspect,
                         const std::string& alternatives) {
  const auto& name = comparison.signals[suspect.signal].name;
  const double factor = std::pow(10.0, suspect.log10_scale);
  return {Fault::wrong_unit,
          name,
          0,
          0.0,
          factor,
          fmt::format("{}: scale {:.3g} times the value implied by the other channels: {}{}", name,
                      factor, unit_slip(suspect.log10_scale), alternatives)};
}

}  // namespace

std::vector<DataFinding> check_units(const Comparison& comparison) {
  std::vector<Ratio> ratios;
  add_identities(comparison, ratios);
  add_tip(comparison, ratios);
  if (shows_rigid_motion(comparison.transforms)) add_rigid_motion(comparison, ratios);

  std::vector<DataFinding> findings;
  const auto off = static_cast<double>(std::ranges::count_if(ratios, [&](const Ratio& ratio) {
    return std::abs(ratio.log10_off) > tolerance(ratio, comparison.options);
  }));
  std::vector<Suspect> suspects;
  if (off > 0.0) {
    for (std::size_t i = 0; i < comparison.signals.size(); ++i) {
      const bool compared = std::ranges::any_of(
          ratios, [&](const Ratio& ratio) { return ratio.a == i || ratio.b == i; });
      if (!compared) continue;
      const Suspect suspect = suspect_of(comparison, ratios, i);
      if (suspect.is_known_slip && suspect.unexplained < off) suspects.push_back(suspect);
    }
  }
  if (!suspects.empty()) {
    std::ranges::stable_sort(suspects, [](const Suspect& a, const Suspect& b) {
      return a.unexplained != b.unexplained ? a.unexplained < b.unexplained : a.relief > b.relief;
    });
    std::string alternatives;
    for (std::size_t i = 1; i < suspects.size(); ++i) {
      if (suspects[i].unexplained > suspects[0].unexplained) break;
      alternatives +=
          fmt::format(", or {} {:.3g} times", comparison.signals[suspects[i].signal].name,
                      std::pow(10.0, suspects[i].log10_scale));
    }
    findings.push_back(unit_finding(comparison, suspects[0], alternatives));
  }
  for (std::size_t i = 1; i < comparison.signals.size(); ++i) {
    const auto& signal = comparison.signals[i];
    constexpr double kBreaks = 0.02;
    if (!comparison.usable[i] || !signal.is(SensorKind::strain) || signal.deviation <= kBreaks) {
      continue;
    }
    findings.push_back(
        {Fault::wrong_unit, signal.name, 0, 0.0, signal.deviation,
         fmt::format(
             "{}: standard deviation {:.3g} exceeds the strength of the link; probably microstrain",
             signal.name, signal.deviation)});
  }
  return findings;
}

}  // namespace flexarm::measured
