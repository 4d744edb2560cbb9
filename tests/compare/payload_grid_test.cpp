#include "compare/features.hpp"
#include "tests/compare/models.hpp"

#include <gtest/gtest.h>

#include <iostream>
#include <string>

namespace flexarm::compare {
namespace {

/// The project's figure.
constexpr double kAgreement = 1e-9;

/// The pair that is furthest apart so far.
struct Worst {
  double distance = 0.0;
  std::string what;
};

std::string describe(const arm::Arm& arm) {
  return "payload mass " + std::to_string(arm.payload.mass_kg) + " m l, inertia " +
         std::to_string(arm.payload.inertia_kg_m2) + " m l^3, hub " +
         std::to_string(arm.hub.inertia_kg_m2) + " m l^3";
}

void compare_family(const std::vector<Subject>& subjects, const FeatureFamily& family,
                    Worst& worst) {
  std::vector<FeatureRoots> found;
  for (const auto& subject : subjects) found.push_back(roots(subject.formulation, family));
  ASSERT_EQ(std::ssize(found.front().s_rad_per_s), family.count);
  for (std::size_t a = 0; a < subjects.size(); ++a) {
    for (std::size_t b = a + 1; b < subjects.size(); ++b) {
      const auto matched = match(family, found[a].s_rad_per_s, found[b].s_rad_per_s);
      for (std::size_t i = 0; i < matched.size(); ++i) {
        const std::string what = label(family) + " " + std::to_string(i + 1) + ", " +
                                 subjects[a].name + " and " + subjects[b].name;
        ASSERT_TRUE(matched[i]) << what;
        const double distance = relative_distance(*matched[i], found[a].s_rad_per_s[i]);
        EXPECT_LE(distance, kAgreement) << what;
        const auto& arm = response::arm_of(subjects[a].formulation);
        if (distance > worst.distance) worst = {distance, what + "; " + describe(arm)};
      }
    }
  }
}

TEST(PayloadGrid, ThreeFormulationsAgreeAtEveryPoint) {
  Worst worst;
  for (const double payload_mass : {0.0, 0.1, 1.0, 10.0}) {
    for (const double payload_inertia : {0.0, 1e-3, 1e-2, 0.1}) {
      for (const double hub_inertia : {0.0, 0.01, 1.0, 100.0}) {
        const auto arm = unit_arm(hub_inertia, {payload_mass, payload_inertia});
        SCOPED_TRACE(describe(arm));
        const auto subjects = standard_subjects(arm, 10);
        compare_family(subjects, {std::nullopt, 10}, worst);
        compare_family(subjects, {kHubAngle, 10}, worst);
        compare_family(subjects, {kTipAcceleration, 6}, worst);
      }
    }
  }
  std::cout << "worst of 64 points: " << worst.distance << ", " << worst.what << "\n";
}

}  // namespace
}  // namespace flexarm::compare
