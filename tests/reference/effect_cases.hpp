#pragma once

#include "arm/arm.hpp"

#include <complex>
#include <map>
#include <ostream>
#include <string>
#include <vector>

namespace flexarm::reference {

/// Values by the name of a sensor, as `arm::parse_sensor` reads it.
template <class Value>
using BySensor = std::map<std::string, Value>;

/// Response of the damped arm to a unit torque at `s_rad_per_s`.
struct EffectResponse {
  std::complex<double> s_rad_per_s;
  BySensor<std::complex<double>> values;
};

/// A case of effects.json, its numbers rounded to double. The arm has linear effects.
struct EffectCase {
  std::string name;
  arm::Arm arm;
  double total_inertia_kg_m2 = 0.0;
  double lowest_omega_squared_rad2_per_s2 = 0.0;
  std::vector<double> pole_rad_per_s;                // 6 flexible ones
  std::vector<double> hub_zero_rad_per_s;            // 6
  std::vector<double> real_tip_zero_rad_per_s;       // the lowest 4
  std::vector<double> imaginary_tip_zero_rad_per_s;  // those below lambda = 20, 4 at most
  std::vector<BySensor<double>> mode_values;         // 4 modes of modal mass I_T
  std::vector<EffectResponse> responses;
  std::vector<std::complex<double>>
      damped_pole_rad_per_s;  // of 4 modes, fewer near critical damping; none without damping
};

/// Every case of the file, read once. Throws std::exception if the file is not as README.md says.
const std::vector<EffectCase>& effect_cases();

/// For the messages of GoogleTest.
void PrintTo(const EffectCase& reference, std::ostream* out);

}  // namespace flexarm::reference
