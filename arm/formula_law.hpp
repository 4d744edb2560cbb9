#pragma once

#include "arm/compiled_formula.hpp"
#include "arm/ports.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::arm {

/// A stated law of hub torque f(theta, omega, tau, t) at definite numbers, taken apart for those
/// who honour it:
///
///     f = -k theta - c omega - sign(omega) F(|omega|) + rest.
///
/// F is what jumps with sign(omega), the mean of both directions, so that the rest is continuous in
/// omega; k and c are the slopes at rest, each 0 where f has a kink there, or drives the motion.
class FormulaLaw {
 public:
  /// `effect` stands in errors.
  FormulaLaw(std::string effect, std::shared_ptr<const CompiledFormula> formula,
             std::vector<double> numbers);

  double stiffness_N_m_per_rad() const { return stiffness_N_m_per_rad_; }  ///< k, 0 or more
  double damping_N_m_s_per_rad() const { return damping_N_m_s_per_rad_; }  ///< c, 0 or more
  /// Dry friction and rest; ConstantHubTorque{0} where k and c are all of f. Throws InputError for
  /// a friction below 0 at rest. What it returns throws InputError where f is not finite.
  HubLaw beyond_slopes() const;

  /// Throws InputError for a law that is not finite at rest, that jumps at omega = 0 otherwise than
  /// by sign(omega), or whose jump there depends on more than its numbers.
  void require_law() const;

 private:
  std::string key() const { return "effects." + effect_ + ".hub_torque"; }
  double value(const HubState& hub, double direction) const;
  double directed(const HubState& hub) const;
  double friction(double speed_rad_per_s) const;
  double rest(const HubState& hub) const;
  SmoothHubTorque::Value rest_with_slope(const HubState& hub) const;
  bool has_no_rest() const;
  bool jumps_beside_friction(HubState hub, double friction_N_m) const;
  DryFriction dry_friction() const;
  std::optional<double> scale_of_friction() const;

  std::string effect_;
  std::shared_ptr<const CompiledFormula> formula_;
  std::vector<double> numbers_;
  std::optional<double> constant_friction_N_m_;
  double stiffness_N_m_per_rad_ = 0.0;
  double damping_N_m_s_per_rad_ = 0.0;
};

}  // namespace flexarm::arm
