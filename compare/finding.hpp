#pragma once

#include <limits>
#include <span>
#include <string>

namespace flexarm::compare {

/// A distance where one of two values is not there.
inline constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

/// How far two formulations are apart in one quantity, and how far they may be.
struct Finding {
  std::string
      quantity;  ///< "hub_angle zero 3", "mode shape 2", "tip_acceleration response at 40.1 Hz"
  std::string first;       ///< formulation
  std::string second;      ///< formulation
  double distance = 0.0;   ///< relative; NaN when one of the two has no value
  double tolerance = 0.0;  ///< they agree when distance <= tolerance
  /// The larger of the errors that the two state of themselves, relative; 0 where neither does,
  /// infinite where one says that a root may be missing.
  double stated = 0.0;
};

/// Agree, or not and where it is worst.
struct Verdict {
  bool agree = true;
  Finding worst;  ///< the finding with the largest distance/tolerance; one without a value is worst
  /// The formulation that differs from all others in the quantity of `worst`, while the others
  /// agree in it: two against one. Empty where there is none.
  std::string alone = {};
};

/// Throws std::invalid_argument when there is nothing to judge.
Verdict judge(std::span<const Finding> findings);

}  // namespace flexarm::compare
