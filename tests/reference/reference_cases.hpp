#pragma once

#include "arm/arm.hpp"

#include <array>
#include <complex>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::reference {

/// Response of an undamped arm to a unit torque at `s_rad_per_s`.
struct ReferenceResponse {
  std::complex<double> s_rad_per_s;
  std::complex<double> hub_angle;          // rad/(N m)
  std::complex<double> tip_displacement;   // m/(N m)
  std::complex<double> curvature_quarter;  // y'' at l/4, 1/(N m^2)
};

/// A case of exact.json, its numbers rounded to double.
struct ReferenceCase {
  std::string name;
  double flexural_rigidity_N_m2;
  double linear_density_kg_per_m;
  double length_m;
  double hub_inertia_kg_m2;
  double payload_mass_kg;
  double payload_inertia_kg_m2;
  std::array<double, 10> pole_lambda;
  std::array<double, 10> pole_Hz;
  std::array<double, 10> hub_zero_lambda;
  std::array<double, 10> hub_zero_Hz;
  std::array<double, 6> real_tip_zero_rad_per_s;
  std::array<ReferenceResponse, 4> responses;
  /// All digits, for what is held to less than the rounding of a double.
  std::array<std::string, 10> pole_lambda_digits;
  std::array<std::string, 10> hub_zero_lambda_digits;
};

/// Every case of the file, read once. Throws std::exception if the file is not as README.md says.
const std::vector<ReferenceCase>& reference_cases();

/// Throws std::out_of_range where there is no such case.
const ReferenceCase& case_named(std::string_view name);

/// The arm of a case; its thickness of 2 m makes surface strain equal to curvature.
arm::Arm arm_of(const ReferenceCase& reference);

/// For the messages of GoogleTest.
void PrintTo(const ReferenceCase& reference, std::ostream* out);

/// For INSTANTIATE_TEST_SUITE_P; generic, so that the benchmarks need no GoogleTest.
inline constexpr auto name_of_case = [](const auto& info) { return info.param.name; };

}  // namespace flexarm::reference
