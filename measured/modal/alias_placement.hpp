#pragma once

#include "measured/files/measurement.hpp"
#include "measured/modal/variable_projection.hpp"

#include <vector>

namespace flexarm::measured {

/// A block that samples show at a frequency below half the sampling frequency but that belongs
/// above.
struct MovedBlock {
  std::size_t block = 0;
  double from_Hz = 0.0;
  double to_Hz = 0.0;
};

/// Puts heavily damped blocks where they belong among the frequencies that samples cannot tell
/// apart, and returns those moved in `blocks`.
///
/// A pole p and p' = p + 2 pi i k/T have the same samples when residues change in the ratio
/// (p'/p)^e, e = 1 for a torque held constant and 2 for one linear between samples (as those of a
/// displacement: e less the sensor's derivatives). Of an arm's modes such residues are nearly
/// imaginary, b1 small beside b0/omega, and above 0 at the hub; at another alias they are turned by
/// the damping angle of both. Only a block whose residues stand more than kTurned off the imaginary
/// axis is put higher, so that coupling by friction does not move a mode; any other is put where
/// samples show it, below half the sampling frequency.
std::vector<MovedBlock> place_aliases(const BlockFit& fit, double period_s, TorqueHold hold,
                                      BlockSet& blocks);
inline constexpr double kTurned = 0.05;

}  // namespace flexarm::measured
