#include "diagnose/symptoms/hub_torque.hpp"
#include "effects/registry/vocabulary.hpp"
#include "tests/diagnose/symptoms_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <ostream>
#include <random>
#include <string>
#include <vector>

namespace flexarm::diagnose {
namespace {

using testing::HasSubstr;

HubTorque found_in(const arm::Effects& hidden) {
  const Symptomatic data(simulated_experiment(hidden));
  return hub_torque(hub_motions(data.input()));
}

struct Hidden {
  std::string effect;
  std::string parameter;
  double value;
  HubTorqueKind kind;
  double coefficient;
};

void PrintTo(const Hidden& hidden, std::ostream* out) {
  *out << hidden.effect;
}

class HubTorqueOfHidden : public testing::TestWithParam<Hidden> {};

TEST_P(HubTorqueOfHidden, IsNamedWithItsSize) {
  // The velocity is read with noise, a stuck hub's sign of velocity is noise, and what is missing
  // is proportional to the torque only to first order.
  constexpr double kSize = 0.1;
  const Hidden& hidden = GetParam();
  const HubTorque found =
      found_in({effects::named(hidden.effect, {{hidden.parameter, hidden.value}})});
  ASSERT_FALSE(found.terms.empty());
  const HubTorqueTerm& first = found.terms.front();
  EXPECT_EQ(to_string(first.kind), to_string(hidden.kind));
  EXPECT_NEAR(first.coefficient, hidden.coefficient, kSize * std::abs(hidden.coefficient));
  EXPECT_GT(first.share, 0.9);
  const auto told = significant(hub_torque_symptoms(found));
  ASSERT_FALSE(told.empty());
  EXPECT_GT(told.front().deviate, 5.0);
}

INSTANTIATE_TEST_SUITE_P(
    Effects, HubTorqueOfHidden,
    testing::Values(Hidden{"coulomb_friction", "torque", 0.01, HubTorqueKind::coulomb_friction,
                           0.01},
                    Hidden{"hub_viscous_friction", "coefficient", 0.004,
                           HubTorqueKind::viscous_friction, 0.004},
                    Hidden{"hub_spring", "stiffness", 0.2, HubTorqueKind::spring, 0.2},
                    Hidden{"hub_inertia", "factor", 1.4, HubTorqueKind::inertia,
                           0.4 * trial_arm().hub.inertia_kg_m2},
                    Hidden{"torque_bias", "torque", 0.004, HubTorqueKind::bias, 0.004},
                    Hidden{"torque_gain", "factor", 1.1, HubTorqueKind::gain, 0.1}),
    [](const auto& one) { return one.param.effect; });

TEST(HubTorqueOfNothing, DependsOnNothing) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Symptomatic data(simulated_experiment({}, {.seed = seed}));
    const HubTorque found = hub_torque(hub_motions(data.input()));
    EXPECT_TRUE(found.terms.empty()) << seed;
    const auto told = hub_torque_symptoms(found);
    ASSERT_EQ(told.size(), 1U);
    EXPECT_FALSE(told.front().is_significant);
    EXPECT_THAT(told.front().text, HasSubstr("no significant dependence on velocity"));
  }
}

TEST(HubResponse, GivesTheTorqueBackThatMadeAReading) {
  constexpr std::size_t kSamples = 1000;
  constexpr double kNoise_rad_per_s = 2e-5;
  // Of a white torque that is seen through noise; the Wiener filter keeps what the noise lets
  // through, and the last samples have not been answered yet.
  constexpr double kLost = 0.1;
  const HubResponse response(trial_arm(), arm::parse_sensor("hub_velocity"), 6,
                             measured::TorqueHold::zero, 2e-3, kSamples);
  std::mt19937_64 numbers(7);
  std::normal_distribution<double> normal;
  std::vector<double> torque(kSamples);
  for (double& value : torque) value = 0.02 + 0.01 * normal(numbers);
  std::vector<double> reading = response.reading(torque);
  for (double& value : reading) value += kNoise_rad_per_s * normal(numbers);
  const std::vector<double> found = response.torque(reading, kNoise_rad_per_s);
  double squares = 0.0;
  double missed = 0.0;
  for (std::size_t k = 0; k + 50 < kSamples; ++k) {
    squares += torque[k] * torque[k];
    missed += std::pow(found[k] - torque[k], 2);
  }
  EXPECT_LT(std::sqrt(missed / squares), kLost);
}

}  // namespace
}  // namespace flexarm::diagnose
