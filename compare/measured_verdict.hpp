#pragma once

#include "compare/measured_responses.hpp"

#include <cstddef>
#include <string>

namespace flexarm::compare {

/// Whether a measurement agrees with the first model.
enum class MeasuredAgreement {
  none,        ///< nothing measured stands beside the model
  not_judged,  ///< no standard deviation is known: there are differences in per cent alone
  agrees,
  differs,
};

/// The measurement beside the first model, in standard deviations and in per cent.
struct MeasuredVerdict {
  MeasuredAgreement agreement = MeasuredAgreement::none;
  /// Sum of the squared differences over their standard deviations (those of the measurement and of
  /// the uncertain numbers of the arm file), of frequencies and damping ratios.
  double chi_square = 0.0;
  std::size_t judged = 0;    ///< numbers in it, its degrees of freedom
  double p_value = 1.0;      ///< probability of such a sum or a larger one by chance
  double worst_std = 0.0;    ///< the largest of the differences, in size
  std::string worst_std_of;  ///< "pole 2"
  /// Largest difference in per cent of the model's frequency, of the measured response (root mean
  /// square) or signal (NRMSE), and of what.
  double worst_percent = 0.0;
  std::string worst_percent_of;  ///< empty without any
};

/// The measurement agrees if p >= `kLeastProbability`. For one number that is |difference| <= 2
/// standard deviations, the expanded uncertainty of coverage factor 2 of the GUM: P(|z| > 2).
MeasuredVerdict judge(const MeasuredComparison& measured);
inline constexpr double kLeastProbability = 0.0455002639;

}  // namespace flexarm::compare
