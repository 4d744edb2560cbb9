#pragma once

#include "tests/trials/answer.hpp"
#include "tests/trials/trial_case.hpp"

namespace flexarm::trials {

/// Held-out error over its floor, at most, of a rig that is explained.
inline constexpr double kRigErrorOverFloor = 1.5;

/// How an answer to a rig compares with the truth.
struct RigScore {
  /// The number of kLeadingCauses that a named effect stands for: it is the cause, on the right
  /// sensor; or is of its family, on the same sensor or on none as the cause; or is said to be
  /// confusable with it in a class of at most kLargestClass.
  int leading_named = 0;
  int wrong_names = 0;  ///< effects that stand for no hidden cause
  /// NRMSE of the extended arm on the validation run over RigTruth::validation_floor; infinite
  /// without an answer.
  double error_over_floor = 0.0;
};

/// The score of an answer to a trial whose truth has `rig`.
RigScore rig_score(const Truth& truth, const Answer& answer);

}  // namespace flexarm::trials
