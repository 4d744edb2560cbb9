#pragma once

#include "measured/modal/modal_fit.hpp"
#include "tests/fit_cases/exact_gains.hpp"
#include "tests/fit_cases/fit_cases.hpp"

#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace flexarm::measured {

/// Torques of tests/trials/excitations.hpp.
enum class Drive { random, multisine, bang_bang };

std::string to_string(Drive drive);

/// An arm of tests/trials/trial_arms.hpp, its data and what is true of it. The data come from 40
/// Hermite elements and Newmark's method, with 14 modes, most of them beyond the band and beyond
/// half the sampling frequency; the fit knows none of that.
class UnlikeCase {
 public:
  UnlikeCase(std::size_t arm, Drive drive, double relative_noise);

  TimeRecord record(std::uint64_t seed) const;

  const std::vector<arm::Sensor>& sensors() const { return sensors_; }
  const ExactRoots& roots() const { return roots_; }
  const ExactGains& gains() const { return gains_; }
  const std::string& name() const { return name_; }

 private:
  std::size_t arm_;
  Drive drive_;
  double relative_noise_;
  std::string name_;
  std::vector<arm::Sensor> sensors_;
  ExactRoots roots_;
  ExactGains gains_;
};

/// Stated 95 % intervals of one kind of quantity.
struct KindCoverage {
  int stated = 0;
  int covered = 0;
  int fits = 0;                 ///< that state one or more: those of a fit hang together
  int withheld = 0;             ///< there, but not told
  double sum_of_squares = 0.0;  ///< of errors in standard errors
  double largest = 0.0;         ///< the same, one

  double share() const { return stated == 0 ? 0.0 : static_cast<double>(covered) / stated; }
  double rms() const { return stated == 0 ? 0.0 : std::sqrt(sum_of_squares / stated); }
  /// Whether a coverage from kLeastCoverage to kMostCoverage may show as this one: each fit counted
  /// as one trial, with a probability of `chance` or more.
  bool is_as_stated(double chance) const;
};
inline constexpr double kLeastCoverage = 0.90;
inline constexpr double kMostCoverage = 0.98;

/// Coverage by kind of quantity, "tip_acceleration real zero" for one.
class UnlikeStudy {
 public:
  void run(const UnlikeCase& unlike, std::uint64_t seed);

  const std::map<std::string, KindCoverage>& kinds() const { return kinds_; }
  int fits() const { return fits_; }

 private:
  void note(const std::string& kind, double value, double truth, double standard_error);
  void note_poles(const UnlikeCase& unlike, const ModalFit& fit);
  void note_zeros(const UnlikeCase& unlike, const ModalFit& fit, std::size_t sensor);
  void note_gains(const UnlikeCase& unlike, const ModalFit& fit);

  std::map<std::string, KindCoverage> kinds_;
  std::map<std::string, int> last_fit_;  ///< that stated a kind
  int fits_ = 0;
};

}  // namespace flexarm::measured
