#include "measured/checks/data_check_unit.hpp"

#include "measured/spectra/robust.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace flexarm::measured {

namespace {

using arm::SensorKind;

constexpr double kLeastUnitScore = 8.0;
constexpr double kLeastUnitCorrelation = 0.7;

/// log10 that the gains of half of the blocks are from their median, at most, where a scale is read
/// from them; what is beyond kNarrow widens the tolerance.
constexpr double kNarrow = 0.03;
constexpr double kMostSpread = 0.06;
constexpr double kMostPlainSpread = 0.05;
constexpr std::size_t kFewestScaleBlocks = 3;
/// Cosine of the phase that sign and delay leave, at least. Below kScaleAgreement the arm is not
/// quite as described, by its friction for instance: gains of sound records are then off by up to
/// 0.12.
constexpr double kLeastAgreement = 0.9;
constexpr double kScaleAgreement = 0.98;
constexpr double kOfDisagreement = 1.4;
/// log10 that noise may add where there are fewer.
constexpr double kNoiseOfFewBlocks = 0.01;

/// Scale of a over scale of b, as recorded over what it must be.
struct Ratio {
  std::size_t a = 0;
  std::size_t b = 0;
  double log10_off = 0.0;
  bool rough = false;
  bool narrow = false;       ///< says more than the unit
  double log10_noise = 0.0;  ///< how far noise may move it
};

Ratio ratio_of(std::size_t a, std::size_t b, const GainFit& fit) {
  const double noise = 0.5 * std::abs(fit.log10_h2 - fit.log10_h1);
  const bool is_seen = fit.blocks >= kFewestScaleBlocks || noise <= kNoiseOfFewBlocks;
  const double unlike = kOfDisagreement * std::max(0.0, kScaleAgreement - fit.agreement) +
                        std::max(0.0, fit.spread - kNarrow);
  return {a,
          b,
          fit.log10_gain,
          false,
          is_seen && fit.spread <= kMostSpread && fit.agreement >= kLeastAgreement,
          noise + unlike};
}

void add_identities(const Comparison& comparison, std::vector<Ratio>& ratios) {
  for (const auto& [x, y] : identities_of(comparison)) {
    const GainFit fit = fit_gain(comparison.transforms, x, y);
    if (!holds(fit)) continue;
    ratios.push_back(ratio_of(x.signal, y.signal, fit));
    // A mode that is folded down has another derivative: its gain changes with the frequency.
    ratios.back().narrow &= fit.spread <= kNarrow && fit.agreement >= kScaleAgreement &&
                            fit.plain_spread <= kMostPlainSpread;
  }
}

void add_described(const Comparison& comparison, std::vector<Ratio>& ratios) {
  for (const auto& [a, b, fit] : comparison.described_and_held()) {
    ratios.push_back(ratio_of(a, b, fit));
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

/// log10 of the factor off that counts.
using Tolerance = std::function<double(const Ratio&)>;

double count_off(const std::vector<Ratio>& ratios, const Tolerance& tolerance) {
  return static_cast<double>(std::ranges::count_if(
      ratios, [&](const Ratio& ratio) { return std::abs(ratio.log10_off) > tolerance(ratio); }));
}

Suspect suspect_of(const Comparison& comparison, const std::vector<Ratio>& ratios,
                   const Tolerance& tolerance, std::size_t signal) {
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
    if (std::abs(off) > tolerance(ratio)) suspect.unexplained += 1.0;
  }
  const auto& it = comparison.signals[signal];
  suspect.relief = implausibility(it, it.deviation) -
                   implausibility(it, it.deviation * std::pow(10.0, -suspect.log10_scale));
  return suspect;
}

/// Those whose scale leaves the fewest ratios off, the least plausible as recorded first; only
/// `known_slips` among them where a unit is asked for.
std::vector<Suspect> suspects_of(const Comparison& comparison, const std::vector<Ratio>& ratios,
                                 const Tolerance& tolerance, bool known_slips) {
  const double off = count_off(ratios, tolerance);
  std::vector<Suspect> suspects;
  if (off == 0.0) return suspects;
  for (std::size_t i = 0; i < comparison.signals.size(); ++i) {
    const bool compared = std::ranges::any_of(
        ratios, [&](const Ratio& ratio) { return ratio.a == i || ratio.b == i; });
    if (!compared) continue;
    const Suspect suspect = suspect_of(comparison, ratios, tolerance, i);
    if ((suspect.is_known_slip || !known_slips) && suspect.unexplained < off) {
      suspects.push_back(suspect);
    }
  }
  std::ranges::stable_sort(suspects, [](const Suspect& a, const Suspect& b) {
    return a.unexplained != b.unexplained ? a.unexplained < b.unexplained : a.relief > b.relief;
  });
  std::erase_if(suspects, [least = suspects.empty() ? 0.0 : suspects.front().unexplained](
                              const Suspect& suspect) { return suspect.unexplained > least; });
  return suspects;
}

/// The first of the suspects; the others are alternatives.
DataFinding scale_finding(const Comparison& comparison, Fault fault,
                          const std::vector<Suspect>& suspects) {
  const Suspect& first = suspects.front();
  const auto& name = comparison.signals[first.signal].name;
  const double factor = std::pow(10.0, first.log10_scale);
  std::string text =
      fmt::format("{}: scale {:.3g} times the value implied by the other channels", name, factor);
  if (fault == Fault::wrong_unit) text += ": " + unit_slip(first.log10_scale);
  for (std::size_t i = 1; i < suspects.size(); ++i) {
    text += fmt::format(", or {} {:.3g} times", comparison.signals[suspects[i].signal].name,
                        std::pow(10.0, suspects[i].log10_scale));
  }
  return {fault, name, 0, 0.0, factor, text};
}

/// A scale that is no unit, by the ratios that say so much.
std::vector<DataFinding> check_scale(const Comparison& comparison, std::vector<Ratio> ratios) {
  std::erase_if(ratios, [](const Ratio& ratio) { return !ratio.narrow; });
  const auto tolerance = [&options = comparison.options](const Ratio& ratio) {
    return ratio.log10_noise + std::log10(options.least_scale);
  };
  auto suspects = suspects_of(comparison, ratios, tolerance, false);
  std::erase_if(suspects, [&options = comparison.options](const Suspect& suspect) {
    return std::abs(suspect.log10_scale) < std::log10(options.least_scale) ||
           suspect.unexplained > 0.0;
  });
  if (suspects.empty()) return {};
  return {scale_finding(comparison, Fault::wrong_scale, suspects)};
}

}  // namespace

std::vector<DataFinding> check_units(const Comparison& comparison) {
  std::vector<Ratio> ratios;
  add_identities(comparison, ratios);
  add_tip(comparison, ratios);
  if (shows_rigid_motion(comparison.transforms)) add_rigid_motion(comparison, ratios);

  add_described(comparison, ratios);

  const auto tolerance = [&options = comparison.options](const Ratio& ratio) {
    return std::log10(ratio.rough ? options.rough_unit_factor : options.unit_factor);
  };
  const auto suspects = suspects_of(comparison, ratios, tolerance, true);
  std::vector<DataFinding> findings;
  if (!suspects.empty()) {
    findings.push_back(scale_finding(comparison, Fault::wrong_unit, suspects));
  } else {
    findings = check_scale(comparison, std::move(ratios));
  }
  for (std::size_t i = 1; i < comparison.signals.size(); ++i) {
    const auto& signal = comparison.signals[i];
    constexpr double kBreaks = 0.02;
    const bool is_told =
        std::ranges::find(findings, signal.name, &DataFinding::channel) != findings.end();
    if (!comparison.usable[i] || is_told || !signal.is(SensorKind::strain) ||
        signal.deviation <= kBreaks) {
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
