#pragma once

#include <optional>
#include <string>

namespace flexarm::report {

struct TimeLeftOptions {
  double quiet_for_s = 2.0;      ///< no estimate before: a rate is not known yet
  double least_fraction = 0.01;  ///< nor where less than this is done
  /// The estimated end follows the rate so far with a time constant of this part of the time that
  /// has passed, so that it does not jump.
  double smoothing = 0.03;
};

/// Estimates when work will be done, from the mean rate so far.
class TimeLeft {
 public:
  explicit TimeLeft(const TimeLeftOptions& options = {}) : options_(options) {}

  /// `elapsed_s` after the start, the fraction done is `fraction`, 0 to 1. Neither falls from call
  /// to call.
  void update(double elapsed_s, double fraction);
  /// Seconds from the last update to the estimated end; empty while none is known.
  std::optional<double> seconds() const;

 private:
  TimeLeftOptions options_;
  double elapsed_s_ = 0.0;
  std::optional<double> end_s_;  ///< after the start
};

/// "8 s left", "40 s left", "3 min left", "2 h 10 min left": in steps that a reader can follow, 1 s
/// below 10 s, 5 s below 90 s, 1 min below 1 h, 10 min above.
std::string time_left_text(double seconds);

}  // namespace flexarm::report
