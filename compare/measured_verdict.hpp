#pragma once

#include "compare/measured_responses.hpp"

#include <cstddef>
#include <string>

namespace flexarm::compare {

/// Whether a measurement agrees with the first model.
enum class MeasuredAgreement {
  none,  ///< no measured number stands beside the model
  agrees,
  differs,
};

/// A difference in size, and what differs; empty without any.
struct LargestDifference {
  double size = 0.0;
  std::string of;  ///< "pole 2 frequency", "hub_angle of run sine"
};

/// The measurement beside the first model. Frequencies and damping ratios with standard deviations
/// are judged by these. Frequencies without, frequency responses (root mean square) and signals
/// (NRMSE) are judged by their difference in per cent.
struct MeasuredVerdict {
  MeasuredAgreement agreement = MeasuredAgreement::none;
  /// Sum of the squared differences over their standard deviations (those of the measurement and of
  /// the uncertain numbers of the arm file).
  double chi_square = 0.0;
  std::size_t judged_by_std = 0;  ///< numbers in it, its degrees of freedom
  double p_value = 1.0;           ///< probability of such a sum or a larger one by chance
  LargestDifference in_std;       ///< in standard deviations
  std::size_t judged_by_percent = 0;
  LargestDifference in_percent;  ///< of the numbers judged in per cent
  double tolerance_percent = kMeasuredTolerance_percent;

  bool agrees_by_std() const { return p_value >= kLeastProbability; }
  bool agrees_by_percent() const { return in_percent.size <= tolerance_percent; }

  /// For one number P(|z| > 2): the expanded uncertainty of coverage factor 2 of the GUM.
  static constexpr double kLeastProbability = 0.0455002639;
};

/// The measurement agrees if p >= `kLeastProbability`, and no difference that is judged in per cent
/// exceeds `MeasuredComparison::tolerance_percent`.
MeasuredVerdict judge(const MeasuredComparison& measured);

}  // namespace flexarm::compare
