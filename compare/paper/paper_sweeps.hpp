#pragma once

#include "arm/arm.hpp"
#include "compare/sweeps/sweep.hpp"

#include <string>
#include <vector>

namespace flexarm::compare {

/// A frequency beside the curves of a sweep: a level that a curve goes to, or a value measured at
/// x.
struct SweepMark {
  std::string name;
  double x = 0.0;
  double y = 0.0;
};

/// Figure 18 (poles) or 19 (zeros of torque to hub angle) of the paper: the first two over the
/// payload's mass.
struct PaperSweep {
  std::string title;
  SweepTask task;
  bool zeros = false;
  std::vector<SweepMark> limits;  ///< [Hz], as the payload grows without bound, but for those at 0
  std::vector<SweepMark> measured;  ///< [Hz], Table 6, for the paper's own arm
};

/// Throws InputError for a number other than 18 and 19. The figures' axes are lost with the scan's
/// images; the payloads are from none to 0.5 kg, three times the beam's mass.
PaperSweep paper_sweep(int figure, const arm::Arm& arm);

}  // namespace flexarm::compare
