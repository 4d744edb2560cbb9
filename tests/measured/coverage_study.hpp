#pragma once

#include "measured/modal/modal_gains.hpp"
#include "tests/fit_cases/exact_gains.hpp"
#include "tests/measured/fit_errors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::measured {

/// How often stated 95 % intervals held the truth of one quantity.
struct Coverage {
  std::string quantity;
  int runs = 0;     ///< in which it was found
  int covered = 0;  ///< |estimate - truth| <= kNormal95 standard errors
  double largest_relative_error = 0.0;
  double sum_of_squares = 0.0;  ///< of errors in standard errors

  double share() const { return runs == 0 ? 0.0 : static_cast<double>(covered) / runs; }
  double spread() const { return runs == 0 ? 0.0 : std::sqrt(sum_of_squares / runs); }
};
inline constexpr double kNormal95 = 1.959963984540054;

/// Fits of one arm under torques and noise of `runs` seeds: coverage of the frequencies and damping
/// ratios of all modes and of the antiresonances of every sensor, of hub slopes and tip gains. The
/// arm's first sensor is of the hub, the third the tip's accelerometer.
class CoverageStudy {
 public:
  explicit CoverageStudy(FitCase fit_case)
      : fit_case_(std::move(fit_case)),
        model_(model_of(fit_case_)),
        exact_(exact_roots(model_, fit_case_.sensors.size())),
        gains_(exact_gains(model_, 0, 2)) {}

  void run(std::uint64_t seed) {
    FitCase fit_case = fit_case_;
    fit_case.excitation = response::RandomNoise{.seed = 1000 + seed};
    std::array records = {clean_record(fit_case, model_)};
    add_noise(records[0], fit_case.relative_noise, seed);
    const ModalFit fit = fit_modes(records);
    ++runs_;
    if (fit.poles.size() != exact_.poles.size()) ++other_orders_;
    if (fit.robust_covariance) ++robust_;
    note_poles(fit);
    for (std::size_t j = 0; j < fit.sensors.size(); ++j) note_zeros(fit, j);
    note_gains(modal_gains(fit));
  }

  const std::vector<Coverage>& coverage() const { return coverage_; }
  int runs() const { return runs_; }
  int other_orders() const { return other_orders_; }  ///< another number of blocks than modes
  int robust() const { return robust_; }

 private:
  void note_poles(const ModalFit& fit) {
    for (std::size_t i = 0; i < exact_.poles.size(); ++i) {
      const FittedPole* nearest = nullptr;
      for (const FittedPole& pole : fit.poles) {
        if (pole.is_mode && (!nearest || distance(pole, i) < distance(*nearest, i))) {
          nearest = &pole;
        }
      }
      if (!nearest) continue;
      const auto name = "pole " + std::to_string(i + 1);
      note(name + " frequency", nearest->frequency_Hz, natural_Hz(exact_.poles[i]),
           nearest->frequency_std_Hz);
      note(name + " damping ratio", nearest->damping_ratio, damping_of(exact_.poles[i]),
           nearest->damping_ratio_std);
    }
  }

  void note_zeros(const ModalFit& fit, std::size_t j) {
    int order = 0;
    for (const auto& s : exact_.zeros[j]) {
      if (!fit.band.contains(natural_Hz(s))) continue;
      const auto nearest = std::ranges::min_element(
          fit.sensors[j].zeros, {},
          [&s](const FittedZero& zero) { return std::abs(zero.s_rad_per_s - s); });
      const bool real = s.imag() == 0.0;
      const auto name = arm::to_string(fit.sensors[j].sensor) + (real ? " real zero " : " zero ") +
                        std::to_string(++order);
      if (nearest == fit.sensors[j].zeros.end()) continue;
      note(name + " frequency", nearest->frequency_Hz, natural_Hz(s), nearest->frequency_std_Hz);
      if (real) continue;
      note(name + " damping ratio", nearest->damping_ratio, damping_of(s),
           nearest->damping_ratio_std);
    }
  }

  void note_gains(const ModalGains& found) {
    note("total inertia", found.total_inertia_kg_m2, gains_.total_inertia_kg_m2);
    for (std::size_t i = 0; i < std::min(found.modes.size(), gains_.hub_slopes.size()); ++i) {
      const auto name = "mode " + std::to_string(i + 1);
      note(name + " hub slope (48)", found.modes[i].hub_slope, gains_.hub_slopes[i]);
      note(name + " tip gain (49)", found.modes[i].tip_gain_m, gains_.tip_gains_m[i]);
      note(name + " tip gain (52)", found.modes[i].tip_gain_of_ratio_m,
           gains_.tip_gains_of_ratio_m[i]);
    }
  }

  double distance(const FittedPole& pole, std::size_t i) const {
    return std::abs(pole.s_rad_per_s[0] - exact_.poles[i]);
  }

  void note(const std::string& quantity, const std::optional<Estimate>& found, double truth) {
    if (found) note(quantity, found->value, truth, found->standard_error);
  }

  void note(const std::string& quantity, double value, double truth, double standard_error) {
    auto entry = std::ranges::find(coverage_, quantity, &Coverage::quantity);
    if (entry == coverage_.end()) {
      coverage_.push_back({.quantity = quantity});
      entry = coverage_.end() - 1;
    }
    const double off = std::abs(value - truth);
    ++entry->runs;
    if (off <= kNormal95 * standard_error) ++entry->covered;
    entry->largest_relative_error = std::max(entry->largest_relative_error, off / std::abs(truth));
    entry->sum_of_squares += off * off / (standard_error * standard_error);
  }

  FitCase fit_case_;
  arm::ModalModel model_;
  ExactRoots exact_;
  ExactGains gains_;
  std::vector<Coverage> coverage_;
  int runs_ = 0;
  int other_orders_ = 0;
  int robust_ = 0;
};

}  // namespace flexarm::measured
