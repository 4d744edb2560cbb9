#include "arm/input_error.hpp"
#include "effects/registry/vocabulary.hpp"
#include "laws/subjects.hpp"

#include <gtest/gtest.h>

#include <array>
#include <complex>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

namespace flexarm::laws {
namespace {

using arm::Arm;
using arm::InputError;
using arm::Sensor;
using arm::SensorKind;

class RefusalLaws : public testing::TestWithParam<Subject> {
 protected:
  response::AnyFormulation model(const Arm& arm) const { return GetParam().make(arm); }
};

TEST_P(RefusalLaws, ACountBelowOneIsAnInputError) {
  const auto paper = model(arm::paper_arm());
  for (const int count : {0, -1, std::numeric_limits<int>::min()}) {
    EXPECT_THROW(response::poles(paper, count), InputError);
    EXPECT_THROW(response::modes(paper, count, {}, {}), InputError);
    EXPECT_THROW(response::zeros(paper, kHubAngle, count), InputError);
    EXPECT_THROW(response::zeros(paper, kTipAcceleration, count), InputError);
  }
}

TEST_P(RefusalLaws, AStationOffTheBeamIsAnInputError) {
  const auto paper = model(arm::paper_arm());
  const double l = arm::paper_arm().beam.length_m;
  for (const double station_m : {-1e-9, l * (1.0 + 1e-15), std::numeric_limits<double>::quiet_NaN(),
                                 std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(response::modes(paper, 1, {}, std::array{station_m}), InputError) << station_m;
  }
  EXPECT_NO_THROW(response::modes(paper, 1, {}, std::array{0.0, l}));
}

TEST_P(RefusalLaws, ASensorThatTheArmCannotCarryIsAnInputError) {
  Arm no_thickness = unit_arm(0.1);
  const std::vector<std::pair<Arm, Sensor>> cases = {
      {arm::paper_arm(), {SensorKind::strain, -1e-9}},
      {arm::paper_arm(), {SensorKind::strain, 1.0}},
      {arm::paper_arm(), {SensorKind::strain, std::numeric_limits<double>::quiet_NaN()}},
      {no_thickness, {SensorKind::strain, 0.1}}};
  for (const auto& [arm, sensor] : cases) {
    const auto subject = model(arm);
    EXPECT_THROW(response::zeros(subject, sensor, 1), InputError);
    EXPECT_THROW(response::modes(subject, 1, std::array{sensor}, {}), InputError);
    EXPECT_THROW(response::transfer_function(subject, sensor, {0.0, 1.0}), InputError);
  }
}

TEST_P(RefusalLaws, StrainAtATipWithoutPayloadInertiaHasNoZerosToAskFor) {
  Arm arm = arm::paper_arm();
  arm.payload.mass_kg = 0.05;
  const Sensor at_tip{SensorKind::strain, arm.beam.length_m};
  EXPECT_THROW(response::zeros(model(arm), at_tip, 1), InputError);
  arm.payload.inertia_kg_m2 = 1e-3;
  EXPECT_EQ(response::zeros(model(arm), at_tip, 1).s_rad_per_s.size(), 1U);
}

TEST_P(RefusalLaws, AnInvalidArmAndOneBeyondComputableScalesAreInputErrors) {
  std::vector<Arm> arms(9, unit_arm(0.1));
  arms[0].beam.length_m = 0.0;
  arms[1].hub.inertia_kg_m2 = std::numeric_limits<double>::quiet_NaN();
  arms[2].beam.length_m = 1e-300;
  arms[3].beam.length_m = 1e300;
  arms[4].beam.given_linear_density_kg_per_m = 1e-300;
  arms[5].beam.given_flexural_rigidity_N_m2 = 1e300;
  arms[6].payload.mass_kg = 1.001 * arm::kLargestPayloadRatio;
  arms[7].payload.inertia_kg_m2 = 1.001 * arm::kLargestPayloadRatio;
  effects::put(arms[8], "gravity", {});
  for (std::size_t i = 0; i < arms.size(); ++i) {
    EXPECT_THROW(model(arms[i]), InputError) << "arm " << i;
  }
}

TEST_P(RefusalLaws, SAtTheOriginOrNotFiniteIsADomainError) {
  const auto paper = model(arm::paper_arm());
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::complex<double>> refused = {
      {0.0, 0.0}, {0.0, kInfinity}, {-kInfinity, 1.0}, {nan, 1.0}, {0.0, nan}};
  for (const auto s : refused) {
    EXPECT_THROW(response::transfer_function(paper, kHubAngle, s), std::domain_error) << s;
  }
}

TEST_P(RefusalLaws, AnArmAtTheBoundsHasTheRootsOfItsUnitArm) {
  // Roots scale with sqrt(EI/(m l^4)), which is formed in double.
  constexpr double kScalingRounding = 1e-11;
  const auto expected = response::poles(model(unit_arm(0.1)), 3).omega_rad_per_s;
  for (const double l : {1e-6, 1e6}) {
    Arm arm;
    arm.beam = arm::Beam::from_rigidity(l, 1.0, 1.0);
    arm.hub.inertia_kg_m2 = 0.1 * l * l * l;
    const auto found = response::poles(model(arm), 3).omega_rad_per_s;
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(found[i] * l * l / expected[i], 1.0, kScalingRounding);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EveryFormulation, RefusalLaws, testing::ValuesIn(every_formulation()),
                         [](const auto& subject) { return subject.param.name; });

}  // namespace
}  // namespace flexarm::laws
