#include "arm/input_error.hpp"
#include "compare/comparison.hpp"
#include "response/settings.hpp"
#include "tests/compare/models.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace flexarm::compare {
namespace {

using testing::HasSubstr;
using testing::Not;

Options few_roots() {
  Options options = quick();
  options.poles = 4;
  options.non_collocated_zeros = 3;
  return options;
}

/// The paper's arm by exact_tf and assumed_modes, and a fem of `other`.
Comparison with_fem_of(const arm::Arm& other) {
  auto subjects = standard_subjects(arm::paper_arm(), 6);
  subjects[1].formulation = fem::FemArm(other, response::fem_settings(6));
  return compare(subjects, few_roots());
}

bool is_worst_pair_with(const std::string& name, const Verdict& verdict) {
  return verdict.worst.first == name || verdict.worst.second == name;
}

/// The largest distance/tolerance of the findings whose quantity contains `part`.
double severity(const Comparison& comparison, const std::string& part) {
  double worst = 0.0;
  for (const auto& finding : comparison.findings) {
    if (finding.quantity.find(part) != std::string::npos) {
      worst = std::max(worst, finding.distance / finding.tolerance);
    }
  }
  return worst;
}

TEST(Disagreement, OnePerCentOfRigidityIsSeenInEveryRootAndNoShape) {
  arm::Arm other = arm::paper_arm();
  other.beam = arm::Beam::from_rigidity(0.96, 1.01 * arm::paper_arm().beam.flexural_rigidity_N_m2(),
                                        arm::paper_arm().beam.linear_density_kg_per_m());
  const auto comparison = with_fem_of(other);
  EXPECT_FALSE(comparison.verdict.agree);
  EXPECT_TRUE(is_worst_pair_with("fem", comparison.verdict)) << comparison.verdict.worst.quantity;
  for (const auto& row : comparison.roots) {
    EXPECT_NEAR(row.distance[1], std::sqrt(1.01) - 1.0, 1e-9) << label(row.family) << row.order;
    EXPECT_LE(row.distance[2], 1e-9);
  }
  EXPECT_LE(severity(comparison, "mode shape"), 1.0) << "shapes depend on ratios of inertias alone";
}

TEST(Disagreement, APayloadsInertiaIsSeenInPolesAndTipZeros) {
  arm::Arm other = arm::paper_arm();
  other.payload.inertia_kg_m2 = 1e-6;
  const auto comparison = with_fem_of(other);
  EXPECT_FALSE(comparison.verdict.agree);
  EXPECT_TRUE(is_worst_pair_with("fem", comparison.verdict)) << comparison.verdict.worst.quantity;
  EXPECT_GT(severity(comparison, "pole"), 1.0);
  EXPECT_GT(severity(comparison, "tip_acceleration zero"), 1.0);
}

TEST(Disagreement, APayloadsMassIsSeenInThePolesAndNotInTheTipZeros) {
  arm::Arm other = arm::paper_arm();
  other.payload.mass_kg = 1e-4;
  const auto comparison = with_fem_of(other);
  EXPECT_FALSE(comparison.verdict.agree);
  EXPECT_GT(severity(comparison, "pole"), 1.0);
  EXPECT_LE(severity(comparison, "tip_acceleration zero"), 1.0);
}

TEST(Disagreement, AnotherHubIsSeenInThePolesAndNotInTheHubZeros) {
  arm::Arm other = arm::paper_arm();
  other.hub.inertia_kg_m2 *= 1.001;
  const auto comparison = with_fem_of(other);
  EXPECT_FALSE(comparison.verdict.agree);
  EXPECT_GT(severity(comparison, "pole"), 1.0);
  EXPECT_LE(severity(comparison, "hub_angle zero"), 1.0);
}

TEST(Disagreement, AnotherDampingIsSeenInTheResponsesAlone) {
  for (const bool of_the_hub : {false, true}) {
    arm::Arm other = arm::paper_arm();
    (of_the_hub ? other.hub.viscous_friction_N_m_s_per_rad : other.damping.kelvin_voigt_s) = 1e-5;
    const auto comparison = with_fem_of(other);
    EXPECT_FALSE(comparison.verdict.agree);
    EXPECT_THAT(comparison.verdict.worst.quantity, HasSubstr(" response at "));
    EXPECT_EQ(comparison.verdict.worst.second, "fem");
    EXPECT_LE(severity(comparison, "pole"), 1.0);
    EXPECT_LE(severity(comparison, " zero "), 1.0);
    EXPECT_LE(severity(comparison, "mode shape"), 1.0);
  }
}

TEST(Disagreement, ASlowBasisIsTheWorstPair) {
  auto subjects = standard_subjects(arm::paper_arm(), 6);
  subjects[2].formulation = assumed_modes::AssumedModesArm(
      arm::paper_arm(), {assumed_modes::Basis::pinned_free, 40, 1e-3});
  const auto comparison = compare(subjects, few_roots());
  EXPECT_FALSE(comparison.verdict.agree);
  EXPECT_TRUE(is_worst_pair_with("assumed_modes", comparison.verdict));
}

TEST(Disagreement, TooFewElementsAreMissingRootsAndThoseAreWorst) {
  auto subjects = standard_subjects(arm::paper_arm(), 6);
  fem::FemArm::Options coarse;
  coarse.mesh.elements = 1;
  coarse.degree = 3;
  subjects[1].formulation = fem::FemArm(arm::paper_arm(), coarse);
  const auto comparison = compare(subjects, few_roots());
  EXPECT_FALSE(comparison.verdict.agree);
  EXPECT_TRUE(std::isnan(comparison.verdict.worst.distance));
  EXPECT_EQ(comparison.verdict.worst.quantity, "pole 3") << "three coordinates, one rigid";
  EXPECT_TRUE(is_worst_pair_with("fem", comparison.verdict));
}

TEST(Disagreement, AStrainGaugeElsewhereHasOtherZeros) {
  const auto at = [](double x) {
    return FeatureFamily{arm::Sensor{arm::SensorKind::strain, x}, 3};
  };
  const auto exact = roots(exact_tf::ExactArm(arm::paper_arm()), at(0.25));
  const auto found = roots(fem::FemArm(arm::paper_arm(), response::fem_settings(6)), at(0.251));
  const auto matched = match(at(0.25), exact.s_rad_per_s, found.s_rad_per_s);
  for (std::size_t i = 0; i < matched.size(); ++i) {
    ASSERT_TRUE(matched[i]) << i;
    EXPECT_GT(relative_distance(*matched[i], exact.s_rad_per_s[i]), 1e-4) << i;
  }
}

TEST(Disagreement, AModelThatCannotCarryTheSensorIsRefused) {
  // Subject arms differ: only the first has a thickness.
  auto subjects = standard_subjects(arm::paper_arm(), 2);
  arm::Arm bare = arm::paper_arm();
  bare.beam = arm::Beam::from_rigidity(0.96, 3.7, 0.165);
  subjects[1].formulation = fem::FemArm(bare, response::fem_settings(2));
  Options options = few_roots();
  options.sensors = {{arm::SensorKind::strain, 0.25}};
  EXPECT_THROW(compare(subjects, options), arm::InputError);
}

}  // namespace
}  // namespace flexarm::compare
