#pragma once

#include "response/time/modal_dynamics.hpp"
#include "response/time/simulation.hpp"

#include <Eigen/Core>

#include <memory>
#include <span>
#include <vector>

namespace flexarm::response {

struct QuickSimulationOptions {
  double sample_time_s = 1e-3;
  TorqueHold hold = TorqueHold::zero;
  /// Inner steps a sample where friction, drag or ripple act.
  int substeps = 4;
};

/// The readings that `simulate` gives, for fits that need them by the thousand.
///
/// A linear arm is stepped exactly, as there. Forces that are not linear are held over an inner
/// step at their mean of it, exact for the rest, with an error of order 2 in the step: drag and
/// ripple of both ends, friction of the parts before and after the hub comes to rest. Where dead
/// zone or saturation break a torque that is linear between samples, the sample has its mean.
class QuickSimulation {
 public:
  /// Throws InputError as `simulate` does for parts that do not fit together.
  QuickSimulation(const arm::ModalModel& model, const ArmParts& parts,
                  std::span<const arm::Sensor> sensors, const QuickSimulationOptions& options);
  ~QuickSimulation();

  /// Entries of the state, ModalDynamics::size().
  Eigen::Index states() const;
  /// Nothing but friction, drag and ripple keeps responses from adding up.
  bool is_linear() const;

  /// Readings under a torque, a row a sample and a column a sensor, from the state `initial` (at
  /// rest where it is empty). Throws InputError for a torque that `simulate` refuses, and for
  /// readings that are too large for a number. Concurrent calls are safe.
  Eigen::MatrixXd operator()(std::span<const double> torque_N_m,
                             const Eigen::VectorXd& initial = {}) const;

  /// Readings of the arm left alone from each unit state, the samples of all sensors one after the
  /// other in a column (as the columns above), a column a state. Without friction, drag and ripple.
  Eigen::MatrixXd free_readings(std::size_t samples) const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

}  // namespace flexarm::response
