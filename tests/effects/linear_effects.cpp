#include "tests/effects/linear_effects.hpp"

#include "arm/sensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

namespace flexarm::effects {

std::vector<double> pole_frequencies(std::string_view formulation, const arm::Arm& arm, int count) {
  return response::poles(response::make_formulation(formulation, arm, count), count)
      .omega_rad_per_s;
}

void expect_same_responses(const response::AnyFormulation& model,
                           const response::AnyFormulation& wanted,
                           const std::vector<std::string_view>& sensors, std::complex<double> s,
                           double tolerance) {
  for (const std::string_view name : sensors) {
    const arm::Sensor sensor = arm::parse_sensor(name);
    const std::complex<double> known = response::transfer_function(wanted, sensor, s);
    const std::complex<double> found = response::transfer_function(model, sensor, s);
    EXPECT_LE(std::abs(found - known), tolerance * std::abs(known))
        << response::name(model) << " " << name << " at " << s;
  }
}

void expect_decays_as_projected(const arm::Arm& arm, int poles) {
  constexpr double kSecondOrder = 1e-4;
  for (const auto formulation : response::kFormulationNames) {
    const auto model = response::make_formulation(formulation, arm, poles);
    const auto modal = response::modal_model(model, poles, {}, {});
    const auto damped = response::damped_poles(model, poles);
    const std::size_t n = modal.modes.size();
    for (std::size_t i = 1; i < n; ++i) {
      const double decay = 0.5 * modal.damping_rad_per_s[i * n + i];
      EXPECT_GT(decay, 0.0);
      EXPECT_NEAR(-damped.flexible[i - 1].first_rad_per_s.real() / decay, 1.0, kSecondOrder)
          << formulation << " pole " << i;
    }
  }
}

}  // namespace flexarm::effects
