#pragma once

#include "measured/modal/modal_fit.hpp"
#include "tests/fit_cases/fit_cases.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace flexarm::measured {

/// Largest errors of a fit beside the exact roots; infinite where one is missing.
struct FitErrors {
  double frequency = 0.0;      ///< relative
  double damping_ratio = 0.0;  ///< relative
  double zeros = 0.0;          ///< |s - s_exact|/|s_exact|
};

inline double natural_Hz(std::complex<double> s) {
  return std::abs(s) / (2.0 * std::numbers::pi);
}
inline double damping_of(std::complex<double> s) {
  return -s.real() / std::abs(s);
}

/// Every exact pole and zero in the band is looked for; zeros in all or none.
inline FitErrors errors_of(const ModalFit& fit, const ExactRoots& exact, bool zeros = true) {
  constexpr double kMissing = std::numeric_limits<double>::infinity();
  FitErrors errors;
  for (const auto& s : exact.poles) {
    if (!fit.band.contains(natural_Hz(s))) continue;
    double frequency = kMissing;
    double damping = kMissing;
    for (const FittedPole& pole : fit.poles) {
      const double off = std::abs(pole.frequency_Hz / natural_Hz(s) - 1.0);
      if (!pole.is_mode || off >= frequency) continue;
      frequency = off;
      damping = std::abs(pole.damping_ratio / damping_of(s) - 1.0);
    }
    errors.frequency = std::max(errors.frequency, frequency);
    errors.damping_ratio = std::max(errors.damping_ratio, damping);
  }
  for (std::size_t j = 0; zeros && j < fit.sensors.size(); ++j) {
    for (const auto& s : exact.zeros[j]) {
      if (!fit.band.contains(natural_Hz(s))) continue;
      double off = kMissing;
      for (const FittedZero& zero : fit.sensors[j].zeros) {
        off = std::min(off, std::abs(zero.s_rad_per_s - s) / std::abs(s));
      }
      errors.zeros = std::max(errors.zeros, off);
    }
  }
  return errors;
}

}  // namespace flexarm::measured
