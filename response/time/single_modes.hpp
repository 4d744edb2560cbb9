#pragma once

#include "arm/formulation.hpp"
#include "arm/sensor.hpp"
#include "response/time/simulation.hpp"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace flexarm::response {

/// One mode under a torque that is linear between samples, from rest; damping that couples it with
/// other modes is left out.
class SingleMode {
 public:
  SingleMode(const arm::ModalModel& model, std::size_t mode, double period_s);

  /// q, q' and q'' just after the torque at this sample, `torque_N_m`, has begun to act.
  std::array<double, 3> at(double torque_N_m) const;
  /// To the next sample; the torque changes by `change_N_m` on the way.
  void step(double torque_N_m, double change_N_m);

 private:
  double stiffness_;
  double damping_;
  double force_;
  double scale_ = 1.0;
  double position_ = 0.0;
  double velocity_ = 0.0;
  Eigen::Matrix4d step_;
};

/// Adds to readings, a list a sensor, what a mode reads under these samples of the torque on the
/// hub.
void add_readings_of_mode(std::vector<std::vector<double>>& readings, const arm::ModalModel& model,
                          std::size_t mode, std::span<const arm::Sensor> sensors,
                          std::span<const double> torque_N_m, double period_s, TorqueHold hold);

/// Whether modes from the flexible one `first` on move by themselves: the damping D that couples
/// them with all others obeys sum_j |D_ij| <= kMostCoupling omega_i. Coupled modes of different
/// frequency change each other's amplitude by no more than about that part.
bool are_single(const arm::ModalModel& model, std::size_t first);
inline constexpr double kMostCoupling = 1e-3;

}  // namespace flexarm::response
