#pragma once

#include "diagnose/symptoms/hub_torque.hpp"

#include <vector>

namespace flexarm::report {

/// Means of equally many samples of a residual hub torque, in the order of what it is seen over.
struct TorqueMeans {
  std::vector<double> x;
  std::vector<double> mean;
  std::vector<double> std_error;

  /// Mean square of the means about their mean, in standard errors.
  double contrast() const;
};

/// `x` is a velocity or an angle, one a sample.
TorqueMeans torque_means(const std::vector<double>& x, const std::vector<double>& torque_N_m);

/// Torque over velocity or angle.
struct TorqueLine {
  std::vector<double> x;
  std::vector<double> torque_N_m;
};

/// What the significant terms that depend on the velocity, or on the angle, make together, over the
/// range of x; of a ripple, whose phase they do not tell, nothing. Empty where it is 0.
TorqueLine identified_torque(const diagnose::HubTorque& torque, bool of_velocity,
                             const std::vector<double>& x);

/// Whether a significant term depends on the hub's velocity or angle.
bool depends_on_motion(const diagnose::HubTorque& torque);

/// The run whose residual torque depends on velocity or angle most clearly. There must be one.
const diagnose::HubTorqueTrace& clearest(const diagnose::HubTorque& torque);

}  // namespace flexarm::report
