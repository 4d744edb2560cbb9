#include "tests/trials/experiment_plan.hpp"

#include "tests/trials/cause.hpp"
#include "tests/trials/excitations.hpp"

#include <cmath>

namespace flexarm::trials {

namespace {

constexpr auto kEstimation = measured::Purpose::estimation;
constexpr auto kValidation = measured::Purpose::validation;

}  // namespace

std::vector<PlannedRun> plan(const TrialArm& of, measured::RunKind kind, Random& random) {
  const double beam_kg = of.arm.beam.linear_density_kg_per_m() * of.arm.beam.length_m;
  if (kind == measured::RunKind::frf) {
    return {{"bare", kEstimation, 0.0},
            {"payload", kEstimation, 0.38 * beam_kg},
            {"heavier", kValidation, 0.76 * beam_kg}};
  }
  if (kind == measured::RunKind::modal) {
    return {{"payload-0", kEstimation, 0.0},
            {"payload-1", kEstimation, 0.32 * beam_kg},
            {"payload-2", kEstimation, 0.63 * beam_kg},
            {"payload-3", kValidation, 1.26 * beam_kg}};
  }
  const double low = of.low_torque_N_m;
  const double payload_kg = 0.3 * beam_kg;
  return {{"random-low", kEstimation, 0.0, random_torque(low, random)},
          {"random-high", kEstimation, 0.0, random_torque(4.0 * low, random)},
          {"bang-bang", kEstimation, 0.0, bang_bang_torque(2.0 * low)},
          {"payload-random", kEstimation, payload_kg, random_torque(2.0 * low, random)},
          {"payload-bang-bang", kValidation, payload_kg, bang_bang_torque(1.7 * low)},
          {"multisine", kValidation, 0.0, multisine_torque(2.4 * low, random)}};
}

const std::vector<arm::Sensor>& planned_sensors() {
  static const std::vector<arm::Sensor> sensors = {{arm::SensorKind::hub_angle, 0.0},
                                                   {arm::SensorKind::hub_velocity, 0.0},
                                                   {arm::SensorKind::tip_acceleration, 0.0},
                                                   kGauge};
  return sensors;
}

std::vector<double> planned_frequencies_Hz(const TrialArm& of, int count) {
  constexpr double kLowest_Hz = 0.5;
  // In omega_scale: the fourth pole of an arm of no hub inertia is at 178/(2 pi) = 28.
  const double highest_Hz = 21.0 * NaturalSizes(of).omega_rad_per_s;
  std::vector<double> frequencies;
  for (int i = 0; i < count; ++i) {
    frequencies.push_back(kLowest_Hz *
                          std::pow(highest_Hz / kLowest_Hz, static_cast<double>(i) / (count - 1)));
  }
  return frequencies;
}

}  // namespace flexarm::trials
