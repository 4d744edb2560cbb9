#pragma once

#include "arm/formulation.hpp"
#include "response/linear_chain.hpp"

#include <Eigen/Core>

#include <complex>
#include <span>
#include <string>
#include <vector>

namespace flexarm::response {

/// x' = A x + B tau(t - delay), y = C x + D tau(t - delay): commanded torque [N m] to sensors.
/// Reading k is y_k(t - output_delay_k).
struct StateSpace {
  Eigen::MatrixXd a;  ///< N x N
  Eigen::MatrixXd b;  ///< N x 1
  Eigen::MatrixXd c;  ///< sensors x N
  Eigen::MatrixXd d;  ///< sensors x 1
  double delay_s = 0.0;
  Eigen::VectorXd output_delay_s;    ///< one a sensor
  std::vector<std::string> states;   ///< "q_0", "q_0'", "q_1", ..., "hub torque", "reading of ..."
  std::vector<arm::Sensor> sensors;  ///< rows of C and D
  std::vector<double> truncation_errors = {};  ///< response/truncation.hpp; empty: not estimated
};

/// The modes as a state space, (33)-(35) of the paper put right: X = (q_0, q_0', q_1, q_1', ...),
///
///     q_i'' = -omega_i^2 q_i - sum_j D_ij q_j' + theta_i T/I_T,
///
/// a row of C the sensor's values sigma_i at q_i or q_i'; a sensor of accelerations reads
/// sum sigma_i q_i'', hence D = sum sigma_i theta_i T/I_T and C = -sigma (diag omega^2, D).
/// With residual mode, where the model has one (response/residual_mode.hpp). A lag of the actuator
/// is a state T, T' = (gain tau - T)/lag; one of a sensor a state for its reading. A gain of a
/// sensor is in its rows of C and D. Delays stay beside the matrices.
///
/// Throws std::invalid_argument unless `require_consistent`.
StateSpace state_space(const arm::ModalModel& model, std::span<const arm::Sensor> sensors,
                       const LinearChain& chain = {});

/// (C (s I - A)^-1 B + D) exp(-s (delay + output_delay)), one a sensor.
std::vector<std::complex<double>> frequency_response(const StateSpace& system,
                                                     std::complex<double> s_rad_per_s);

}  // namespace flexarm::response
