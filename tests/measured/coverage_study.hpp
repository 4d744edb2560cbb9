#pragma once

#include "tests/measured/fit_errors.hpp"

#include <array>
#include <cmath>
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
/// ratios of all modes and of the antiresonances of every sensor.
class CoverageStudy {
 public:
  explicit CoverageStudy(FitCase fit_case)
      : fit_case_(std::move(fit_case)),
        model_(model_of(fit_case_)),
        exact_(exact_roots(model_, fit_case_.sensors.size())) {}

  void run(std::uint64_t seed) {
    FitCase fit_case = fit_case_;
    fit_case.excitation = response::RandomNoise{.seed = 1000 + seed};
    std::array records = {clean_record(fit_case, model_)};
    add_noise(records[0], fit_case.relative_noise, seed);
    const ModalFit fit = fit_modes(records);
    ++runs_;
    if (fit.poles.size() != exact_.poles.size()) ++other_orders_;
    if (fit.robust_covariance) ++robust_;
    std::size_t at = 0;
    for (std::size_t i = 0; i < exact_.poles.size(); ++i) {
      const FittedPole* nearest = nullptr;
      for (const FittedPole& pole : fit.poles) {
        if (pole.is_mode && (!nearest || distance(pole, i) < distance(*nearest, i))) {
          nearest = &pole;
        }
      }
      const auto name = "pole " + std::to_string(i + 1);
      if (!nearest) continue;
      note(at++, name + " frequency", nearest->frequency_Hz, natural_Hz(exact_.poles[i]),
           nearest->frequency_std_Hz);
      note(at++, name + " damping ratio", nearest->damping_ratio, damping_of(exact_.poles[i]),
           nearest->damping_ratio_std);
    }
    for (std::size_t j = 0; j < fit.sensors.size(); ++j) {
      int order = 0;
      for (const auto& s : exact_.zeros[j]) {
        if (!fit.band.contains(natural_Hz(s))) continue;
        const bool real = s.imag() == 0.0;
        const FittedZero* nearest = nullptr;
        for (const FittedZero& zero : fit.sensors[j].zeros) {
          if (!nearest || std::abs(zero.s_rad_per_s - s) < std::abs(nearest->s_rad_per_s - s)) {
            nearest = &zero;
          }
        }
        const auto name = arm::to_string(fit.sensors[j].sensor) +
                          (real ? " real zero " : " zero ") + std::to_string(++order);
        if (!nearest) continue;
        note(at++, name + " frequency", nearest->frequency_Hz, natural_Hz(s),
             nearest->frequency_std_Hz);
        if (!real) {
          note(at++, name + " damping ratio", nearest->damping_ratio, damping_of(s),
               nearest->damping_ratio_std);
        }
      }
    }
  }

  const std::vector<Coverage>& coverage() const { return coverage_; }
  int runs() const { return runs_; }
  int other_orders() const { return other_orders_; }  ///< another number of blocks than modes
  int robust() const { return robust_; }

 private:
  double distance(const FittedPole& pole, std::size_t i) const {
    return std::abs(pole.s_rad_per_s[0] - exact_.poles[i]);
  }

  void note(std::size_t at, const std::string& quantity, double value, double truth,
            double standard_error) {
    if (at == coverage_.size()) coverage_.push_back({.quantity = quantity});
    Coverage& entry = coverage_[at];
    const double off = std::abs(value - truth);
    ++entry.runs;
    if (off <= kNormal95 * standard_error) ++entry.covered;
    entry.largest_relative_error = std::max(entry.largest_relative_error, off / std::abs(truth));
    entry.sum_of_squares += off * off / (standard_error * standard_error);
  }

  FitCase fit_case_;
  arm::ModalModel model_;
  ExactRoots exact_;
  std::vector<Coverage> coverage_;
  int runs_ = 0;
  int other_orders_ = 0;
  int robust_ = 0;
};

}  // namespace flexarm::measured
