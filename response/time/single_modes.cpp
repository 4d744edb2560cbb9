#include "response/time/single_modes.hpp"

#include "response/frequency/modal_response.hpp"

#include <unsupported/Eigen/MatrixFunctions>

#include <algorithm>
#include <cmath>

namespace flexarm::response {

SingleMode::SingleMode(const arm::ModalModel& model, std::size_t mode, double period_s)
    : stiffness_(omega_squared(model, mode)),
      damping_(model.damping_rad_per_s[mode * model.modes.size() + mode]),
      force_(model.modes[mode].hub_slope / model.modal_mass_kg_m2) {
  // X = (scale q, q'), torque, and its change over the sample.
  scale_ = std::max(std::sqrt(std::abs(stiffness_)), 1.0);
  Eigen::Matrix4d chain = Eigen::Matrix4d::Zero();
  chain(0, 1) = scale_ * period_s;
  chain(1, 0) = -stiffness_ / scale_ * period_s;
  chain(1, 1) = -damping_ * period_s;
  chain(1, 2) = force_ * period_s;
  chain(2, 3) = 1.0;
  step_ = chain.exp();
}

std::array<double, 3> SingleMode::at(double torque_N_m) const {
  const double q = position_ / scale_;
  return {q, velocity_, force_ * torque_N_m - stiffness_ * q - damping_ * velocity_};
}

void SingleMode::step(double torque_N_m, double change_N_m) {
  const double position = step_(0, 0) * position_ + step_(0, 1) * velocity_ +
                          step_(0, 2) * torque_N_m + step_(0, 3) * change_N_m;
  velocity_ = step_(1, 0) * position_ + step_(1, 1) * velocity_ + step_(1, 2) * torque_N_m +
              step_(1, 3) * change_N_m;
  position_ = position;
}

void add_readings_of_mode(std::vector<std::vector<double>>& readings, const arm::ModalModel& model,
                          std::size_t mode, std::span<const arm::Sensor> sensors,
                          std::span<const double> torque_N_m, double period_s, TorqueHold hold) {
  struct Output {
    double value;
    std::size_t derivatives;
    double* readings;
  };
  std::vector<Output> outputs;
  for (std::size_t j = 0; j < sensors.size(); ++j) {
    outputs.push_back({model.modes[mode].sensor_values[j],
                       static_cast<std::size_t>(arm::derivative_order(sensors[j])),
                       readings[j].data()});
  }
  SingleMode stepper(model, mode, period_s);
  for (std::size_t k = 0; k < torque_N_m.size(); ++k) {
    const auto motion = stepper.at(torque_N_m[k]);
    for (const Output& output : outputs) {
      output.readings[k] += output.value * motion[output.derivatives];
    }
    const bool changes = hold == TorqueHold::first && k + 1 < torque_N_m.size();
    stepper.step(torque_N_m[k], changes ? torque_N_m[k + 1] - torque_N_m[k] : 0.0);
  }
}

bool are_single(const arm::ModalModel& model, std::size_t first) {
  const std::size_t size = model.modes.size();
  for (std::size_t i = first; i < size; ++i) {
    double coupling = 0.0;
    for (std::size_t j = 0; j < size; ++j) {
      if (j != i) coupling += std::abs(model.damping_rad_per_s[i * size + j]);
    }
    if (coupling > kMostCoupling * model.modes[i].omega_rad_per_s) return false;
  }
  return true;
}

}  // namespace flexarm::response
