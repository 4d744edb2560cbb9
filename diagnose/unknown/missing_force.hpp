#pragma once

#include "diagnose/search/problem.hpp"
#include "diagnose/unknown/force_size.hpp"
#include "diagnose/unknown/port_responses.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::diagnose {

/// What an arbitrary force at one port explains of the excess residual.
struct PortShare {
  ForcePort port = ForcePort::hub;
  std::vector<std::string> sensors = {};  ///< that err; ForcePort::sensor
  std::string place;   ///< of the places of the port the best: "force at 0.192 m"
  double share = 0.0;  ///< adjusted for the force's own freedom; below 0 for a worse than chance
  double std_error = 0.0;  ///< of the share
  /// Standard error of the distance to the share of the best port; 0 for that.
  double distance_std_error = 0.0;
};

/// At which port a force acts that the model lacks.
struct MissingForce {
  std::vector<PortShare> ports = {};  ///< all that were tried, the largest share first
  /// The first so many of `ports` are indistinguishable from the first. 0 where the port is not
  /// determined: none explains `kLeastPortShare`, or more than `kMostPorts` are indistinguishable.
  std::size_t stated = 0;
  /// That of the best port, of `time` runs. Where `stated` is above 0, and it is no force spread
  /// along the beam.
  std::optional<ForceSize> size = {};
  std::size_t lines = 0;  ///< that are beyond noise, of all segments
};
inline constexpr double kLeastPortShare = 0.5;
inline constexpr std::size_t kMostPorts = 2;

/// Tests for each port whether one unknown force there explains what is left of `time` and `frf`
/// runs (tried_places.hpp). The shape of the vector of the sensors' residuals says where the force
/// acts. One complex number explains 1/n of any n sensors' residuals, so that the share is
///
///     1 - sum n/(n - 1) U/sum T,
///
/// as with an adjusted coefficient of determination. A port with several places has in each run the
/// one that is best in the other runs (in the other parts of a single run): the choice is paid for.
/// Standard errors are by the jackknife over segments and, in each, `kBands` bands.
///
/// A port is distinguishable from the best where its share is less by more than `kDistance`
/// standard errors of the difference and leaves more than `kMoreLeft` of what the best leaves.
///
/// `errors` are those of `problem` by `arm` in standard deviations (to_errors). Empty for an arm
/// without a beam, for runs that are driven by motion, and where fewer than `kFewestLines` lines
/// are beyond noise; without ports where those of runs with two sensors or more are fewer. Throws
/// arm::Cancelled after the deadline.
std::optional<MissingForce> missing_force(const Problem& problem, const arm::Arm& arm,
                                          const Eigen::VectorXd& errors,
                                          const arm::Deadline& deadline = {});
inline constexpr double kDistance = 2.0;
inline constexpr double kMoreLeft = 1.1;
inline constexpr std::size_t kFewestLines = 20;

}  // namespace flexarm::diagnose
