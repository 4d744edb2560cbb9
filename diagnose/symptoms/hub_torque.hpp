#pragma once

#include "diagnose/symptoms/hub_motion.hpp"
#include "diagnose/symptoms/symptom.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace flexarm::diagnose {

/// What a torque on the hub, beyond the commanded one, may depend on; each times its coefficient.
enum class HubTorqueKind {
  coulomb_friction,  ///< -sign(velocity) [N m]
  viscous_friction,  ///< -velocity [N m s/rad]
  inertia,           ///< -acceleration [kg m^2]
  spring,            ///< -angle [N m/rad]
  ripple,            ///< sin and cos of a multiple of the angle [N m]
  bias,              ///< 1 [N m]
  time,              ///< time from the middle of the run [N m/s]
  gain,              ///< commanded torque [1]
  dead_zone,         ///< -sign of the commanded torque [N m]
  saturation,        ///< -(commanded torque beyond a part of the largest) [1]
};

/// "coulomb_friction", "viscous_friction", ...
std::string_view to_string(HubTorqueKind kind);
/// As tables call the term.
std::string_view term_name(HubTorqueKind kind);

/// One dependence, of all runs together.
struct HubTorqueTerm {
  HubTorqueKind kind = HubTorqueKind::bias;
  std::string unit;
  double coefficient = 0.0;  ///< the amplitude of a ripple
  double std_error = 0.0;    ///< of the residuals, and 5 % for the first order
  double at = 0.0;  ///< cycles per revolution of a ripple, sin(at theta); torque [N m] beyond
                    ///< which, of a saturation
  /// Part of what is beyond noise in the hub's signals that the term takes away, after those
  /// before it; above 1 where chance has a part in it.
  double share = 0.0;
  double probability = 1.0;  ///< before Bonferroni
};

/// Residual torque of one run, a value a sample, for figures.
struct HubTorqueTrace {
  std::string run;
  std::vector<double> time_s;
  std::vector<double> torque_N_m;  ///< HubResponse::torque of the velocity, or of the angle
  std::vector<double> velocity_rad_per_s;
  std::vector<double> angle_rad;
};

struct HubTorque {
  std::vector<HubTorqueTerm> terms;      ///< significant ones, the largest share first
  std::vector<HubTorqueTerm> left_over;  ///< the others, each beside the terms
  std::size_t tests = 0;                 ///< for Bonferroni
  /// Part of what is beyond noise in the hub's signals that the terms take away together.
  double share = 0.0;
  std::vector<HubTorqueTrace> traces;  ///< a run each
};

/// Regression of the hub's residuals in all runs on the readings that torques of each kind would
/// make: forward, the one that takes most first, while an F test, for as many independent numbers
/// as the correlation of what is left says, is significant and the term takes `kLeastHubShare` of
/// what is beyond noise, and what is beyond noise is `least_error` of the signal. So errors are as
/// the simulation's are, and no signal is differentiated.
HubTorque hub_torque(const std::vector<HubMotion>& motions, double least_error = 0.0);
inline constexpr double kLeastHubShare = 0.1;
inline constexpr int kMostHubTerms = 4;

/// A statement a term, and one of what the torque does not depend on.
std::vector<Symptom> hub_torque_symptoms(const HubTorque& torque);

}  // namespace flexarm::diagnose
