#include "response/state_space.hpp"

#include "arm/input_error.hpp"
#include "response/frequency/modal_response.hpp"

#include <Eigen/LU>
#include <fmt/format.h>

#include <algorithm>

namespace flexarm::response {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// The modes alone, the torque T on the hub as input.
StateSpace modes_alone(const arm::ModalModel& model, std::span<const arm::Sensor> sensors) {
  const auto n = static_cast<Index>(model.modes.size());
  const auto outputs = static_cast<Index>(sensors.size());
  StateSpace system;
  system.sensors.assign(sensors.begin(), sensors.end());
  system.a = MatrixXd::Zero(2 * n, 2 * n);
  system.b = MatrixXd::Zero(2 * n, 1);
  system.c = MatrixXd::Zero(outputs, 2 * n);
  system.d = MatrixXd::Zero(outputs, 1);
  system.output_delay_s = Eigen::VectorXd::Zero(outputs);
  for (Index i = 0; i < n; ++i) {
    const auto mode = static_cast<std::size_t>(i);
    system.states.push_back(fmt::format("q_{}", i));
    system.states.push_back(fmt::format("q_{}'", i));
    system.a(2 * i, 2 * i + 1) = 1.0;
    system.a(2 * i + 1, 2 * i) = -omega_squared(model, mode);
    for (Index j = 0; j < n; ++j) {
      system.a(2 * i + 1, 2 * j + 1) =
          -model.damping_rad_per_s[static_cast<std::size_t>(i * n + j)];
    }
    system.b(2 * i + 1, 0) = model.modes[mode].hub_slope / model.modal_mass_kg_m2;
  }
  for (Index k = 0; k < outputs; ++k) {
    const auto sensor = static_cast<std::size_t>(k);
    const int derivatives = arm::derivative_order(sensors[sensor]);
    for (Index i = 0; i < n; ++i) {
      const double value = model.modes[static_cast<std::size_t>(i)].sensor_values[sensor];
      if (derivatives < 2) {
        system.c(k, 2 * i + derivatives) = value;
      } else {
        system.c.row(k) += value * system.a.row(2 * i + 1);
        system.d.row(k) += value * system.b.row(2 * i + 1);
      }
    }
  }
  return system;
}

/// A further state, whose row and column in A and C are zero.
Index add_state(StateSpace& system, std::string name) {
  const Index state = system.a.rows();
  system.states.push_back(std::move(name));
  system.a.conservativeResizeLike(MatrixXd::Zero(state + 1, state + 1));
  system.b.conservativeResizeLike(MatrixXd::Zero(state + 1, 1));
  system.c.conservativeResizeLike(MatrixXd::Zero(system.c.rows(), state + 1));
  return state;
}

/// tau -> gain tau/(1 + lag s) in front of the input.
void add_actuator(StateSpace& system, const LinearChain& chain) {
  system.delay_s = chain.delay_s;
  if (chain.lag_s == 0.0) {
    system.b *= chain.gain;
    system.d *= chain.gain;
    return;
  }
  const Index torque = add_state(system, "hub torque");
  system.a.col(torque) = system.b;
  system.c.col(torque) = system.d;
  system.b.setZero();
  system.d.setZero();
  system.a(torque, torque) = -1.0 / chain.lag_s;
  system.b(torque, 0) = chain.gain / chain.lag_s;
}

/// The output of that sensor through gain exp(-delay s)/(1 + lag s).
void add_sensor_chain(StateSpace& system, const SensorChain& chain) {
  for (Index k = 0; k < system.c.rows(); ++k) {
    if (system.sensors[static_cast<std::size_t>(k)] != chain.sensor) continue;
    system.c.row(k) *= chain.gain;
    system.d(k, 0) *= chain.gain;
    system.output_delay_s(k) = chain.delay_s;
    if (chain.lag_s == 0.0) continue;
    const Index reading = add_state(system, "reading of " + arm::to_string(chain.sensor));
    system.a.row(reading) = system.c.row(k) / chain.lag_s;
    system.b(reading, 0) = system.d(k, 0) / chain.lag_s;
    system.a(reading, reading) = -1.0 / chain.lag_s;
    system.c.row(k).setZero();
    system.c(k, reading) = 1.0;
    system.d(k, 0) = 0.0;
  }
}

}  // namespace

StateSpace state_space(const arm::ModalModel& model, std::span<const arm::Sensor> sensors,
                       const LinearChain& chain) {
  require_consistent(model, sensors);
  if (chain.delay_s < 0.0) {
    throw arm::out_of_range("state space: delay of the torque", chain.delay_s, "s", "0 or more");
  }
  StateSpace system = modes_alone(model, sensors);
  add_actuator(system, chain);
  for (const auto& of_sensor : chain.sensor_chains) add_sensor_chain(system, of_sensor);
  return system;
}

std::vector<std::complex<double>> frequency_response(const StateSpace& system,
                                                     std::complex<double> s_rad_per_s) {
  using Complex = std::complex<double>;
  Eigen::MatrixXcd pencil = -system.a.cast<Complex>();
  pencil.diagonal().array() += s_rad_per_s;
  const Eigen::VectorXcd states = pencil.partialPivLu().solve(system.b.col(0).cast<Complex>());
  const Eigen::ArrayXcd delays =
      -s_rad_per_s * (system.output_delay_s.array() + system.delay_s).cast<Complex>();
  const Eigen::ArrayXcd outputs =
      (system.c.cast<Complex>() * states + system.d.col(0).cast<Complex>()).array() * delays.exp();
  return {outputs.begin(), outputs.end()};
}

}  // namespace flexarm::response
