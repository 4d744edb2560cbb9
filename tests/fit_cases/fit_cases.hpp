#pragma once

#include "measured/files/time_record.hpp"
#include "response/excitation/excitation.hpp"
#include "response/time/simulation.hpp"

#include <complex>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace flexarm::measured {

/// The paper's arm with the damping that the figures of accuracy are stated for.
arm::Arm damped_paper_arm();

std::vector<arm::Sensor> sensors_named(const std::vector<std::string>& names);

/// A simulated experiment. Everything that is fitted to it is known exactly.
struct FitCase {
  arm::Arm arm = damped_paper_arm();
  std::vector<arm::Sensor> sensors =
      sensors_named({"hub_angle", "hub_velocity", "tip_acceleration", "strain@0.05"});
  int modes = 3;  ///< flexible ones that move
  double duration_s = 60.0;
  double sample_time_s = 0.005;
  response::TorqueHold hold = response::TorqueHold::zero;
  response::Excitation excitation = response::RandomNoise{};
  double relative_noise = 0.0;
  std::uint64_t seed = 1;
};

arm::ModalModel model_of(const FitCase& fit_case);

/// The record of parts that may hold friction and delays; `model` is that of their linear arm.
TimeRecord clean_record(const FitCase& fit_case, const arm::ModalModel& model,
                        const response::ArmParts& parts);
TimeRecord clean_record(const FitCase& fit_case, const arm::ModalModel& model);
/// Adds to each channel noise of this standard deviation relative to its own.
void add_noise(TimeRecord& record, double relative_noise, std::uint64_t seed);
TimeRecord record_of(const FitCase& fit_case);

/// Poles and zeros of a modal model's own equations of motion, as an independent computation:
/// eigenvalues of its matrices.
///
///     (s^2 I + s D + Omega^2) q = theta u/I_T,   y = s^k sigma^T q
struct ExactRoots {
  std::vector<std::complex<double>> poles;               ///< Im > 0, ascending in size
  std::vector<std::vector<std::complex<double>>> zeros;  ///< per sensor; Im >= 0, not at 0
};

ExactRoots exact_roots(const arm::ModalModel& model, std::size_t sensors);

}  // namespace flexarm::measured
