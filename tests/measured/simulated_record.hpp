#pragma once

#include "measured/files/time_record.hpp"
#include "response/excitation/excitation.hpp"
#include "response/formulation_maker.hpp"
#include "response/time/random_numbers.hpp"
#include "response/time/simulation.hpp"
#include "response/time/time_model.hpp"
#include "tests/measured/signals.hpp"

#include <Eigen/Dense>

#include <string>
#include <utility>
#include <vector>

namespace flexarm::measured {

/// The paper's arm with friction under which it settles in a second: damping ratios 16 %, 24 % and
/// 14 % of the first flexible poles.
inline arm::Arm settling_arm() {
  arm::Arm arm = arm::paper_arm();
  arm.damping.kelvin_voigt_s = 4e-4;
  arm.hub.viscous_friction_N_m_s_per_rad = 0.1;
  return arm;
}

inline std::vector<arm::Sensor> sensors_named(const std::vector<std::string>& names) {
  std::vector<arm::Sensor> sensors;
  for (const auto& name : names) sensors.push_back(arm::parse_sensor(name));
  return sensors;
}

/// Makes records of one arm by its first flexible modes.
class SimulatedArm {
 public:
  SimulatedArm(const arm::Arm& arm, std::vector<arm::Sensor> sensors, int modes = 4)
      : parts_(response::take_apart(arm)),
        sensors_(std::move(sensors)),
        model_(response::time_model(response::make_formulation("exact_tf", parts_.linear, modes),
                                    parts_, modes, sensors_)) {}

  const std::vector<arm::Sensor>& sensors() const { return sensors_; }
  const arm::ModalModel& model() const { return model_; }
  response::ArmParts& parts() { return parts_; }

  /// The model's response, (48) of the paper with all modes that the record is made of.
  std::complex<double> response(std::size_t sensor, double frequency_Hz) const {
    const std::complex<double> s(0.0, kTwoPi * frequency_Hz);
    std::complex<double> sum = 0.0;
    const auto count = model_.modes.size();
    // Damping couples modes: solve (s^2 + D s + Omega^2) q = theta/I_T.
    Eigen::MatrixXcd matrix =
        Eigen::MatrixXcd::Zero(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(count));
    Eigen::VectorXcd force(static_cast<Eigen::Index>(count));
    for (std::size_t i = 0; i < count; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      for (std::size_t j = 0; j < count; ++j) {
        matrix(row, static_cast<Eigen::Index>(j)) = model_.damping_rad_per_s[i * count + j] * s;
      }
      const double omega = model_.modes[i].omega_rad_per_s;
      matrix(row, row) += s * s + omega * omega;
      force(row) = model_.modes[i].hub_slope / model_.modal_mass_kg_m2;
    }
    const Eigen::VectorXcd q = matrix.partialPivLu().solve(force);
    for (std::size_t i = 0; i < count; ++i) {
      sum += model_.modes[i].sensor_values[sensor] * q(static_cast<Eigen::Index>(i));
    }
    return sum * std::pow(s, arm::derivative_order(sensors_[sensor]));
  }

  /// What samples show, the hold taken off: the response and its images (frequency_response.hpp),
  /// those beyond the 25th by the integral of their power law.
  std::complex<double> sampled_response(std::size_t sensor, double frequency_Hz, double period_s,
                                        int hold_order) const {
    constexpr int kImages = 25;
    constexpr double kEdge = kImages + 0.5;
    const auto image = [&](double m) {
      const double image_Hz = frequency_Hz + m / period_s;
      return std::pow(frequency_Hz / image_Hz, hold_order) * response(sensor, image_Hz);
    };
    std::complex<double> sum = 0.0;
    for (int m = -kImages; m <= kImages; ++m) sum += image(m);
    const int fall = hold_order + 2 - arm::derivative_order(sensors_[sensor]);
    return sum + kEdge / (fall - 1.0) * (image(kEdge) + image(-kEdge));
  }

  /// Readings with normal noise of `noise` times their own standard deviation.
  TimeRecord record(const std::vector<double>& torque_N_m, double period_s,
                    response::TorqueHold hold = response::TorqueHold::zero, double noise = 0.0,
                    std::uint64_t seed = 1) const {
    const auto made =
        response::simulate(model_, parts_, sensors_, torque_N_m,
                           {.sample_time_s = period_s, .hold = hold, .energy = false});
    TimeRecord found{made.time_s, torque_N_m, {}};
    for (std::size_t i = 0; i < sensors_.size(); ++i) {
      found.channels.push_back({sensors_[i], made.channels[i]});
      auto& values = found.channels.back().values;
      double mean = 0.0;
      for (const double value : values) mean += value / static_cast<double>(values.size());
      double power = 0.0;
      for (const double value : values) power += (value - mean) * (value - mean);
      const double size = noise * std::sqrt(power / static_cast<double>(values.size()));
      const auto added = white_noise(values.size(), seed, static_cast<std::uint32_t>(i));
      for (std::size_t k = 0; k < values.size(); ++k) values[k] += size * added[k];
    }
    return found;
  }

 private:
  response::ArmParts parts_;
  std::vector<arm::Sensor> sensors_;
  arm::ModalModel model_;
};

inline std::vector<double> torque_of(const response::Excitation& excitation, std::size_t samples,
                                     double period_s) {
  return response::sample(excitation, {samples, period_s}).torque_N_m;
}

}  // namespace flexarm::measured
