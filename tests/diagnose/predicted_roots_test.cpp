// Poles and zeros that an arm predicts for a modal table, with its damping.
#include "diagnose/predictors/predicted_roots.hpp"

#include "arm/arm.hpp"
#include "effects/registry/vocabulary.hpp"
#include "exact_tf/exact_arm.hpp"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

namespace flexarm::diagnose {
namespace {

using measured::Feature;

const arm::Sensor kHubAngleOfRuler{arm::SensorKind::hub_angle};

/// A steel ruler, damped by its material alone.
arm::Arm damped_ruler(double hub_inertia_kg_m2, double kelvin_voigt_s) {
  arm::Arm arm;
  arm.beam = arm::Beam::from_rigidity(0.43, 0.17, 0.13);
  arm.hub.inertia_kg_m2 = hub_inertia_kg_m2;
  arm.payload = {0.008, 7e-7};
  arm.damping.kelvin_voigt_s = kelvin_voigt_s;
  return arm;
}

measured::ModalTable table_of_hub_zeros(int count) {
  measured::ModalTable table;
  for (int order = 1; order <= count; ++order) {
    table.push_back({kHubAngleOfRuler, Feature::zero, order, 1.0, {}, 0.01, {}});
  }
  return table;
}

/// Frequency [Hz] and damping ratio of each.
Eigen::VectorXd predicted(const arm::Arm& arm, const measured::ModalTable& table) {
  Eigen::VectorXd values(2 * std::ssize(table));
  predict_roots(arm, table, values);
  return values;
}

/// s^2/(1 + kv s) = -omega^2: |s| = omega, and the damping ratio is kv omega/2.
TEST(PredictedRoots, HubZerosWithMaterialDampingDoNotDependOnTheHub) {
  constexpr int kZeros = 3;
  const auto undamped =
      exact_tf::ExactArm(damped_ruler(0.01, 0.0)).zeros(kHubAngleOfRuler, kZeros).s_rad_per_s;
  const auto table = table_of_hub_zeros(kZeros);
  for (const double kelvin_voigt_s : {2e-4, 3e-4, 4e-4, 5e-4, 1e-3}) {
    for (const double hub_inertia_kg_m2 : {1e-3, 0.01, 0.1, 1.0}) {
      SCOPED_TRACE(testing::Message()
                   << "kv " << kelvin_voigt_s << " s, hub " << hub_inertia_kg_m2 << " kg m^2");
      const auto values = predicted(damped_ruler(hub_inertia_kg_m2, kelvin_voigt_s), table);
      for (int k = 0; k < kZeros; ++k) {
        const double omega = undamped[static_cast<std::size_t>(k)].imag();
        EXPECT_NEAR(2.0 * std::numbers::pi * values(2 * k) / omega, 1.0, 1e-9);
        EXPECT_NEAR(values(2 * k + 1) / (0.5 * kelvin_voigt_s * omega), 1.0, 1e-9);
      }
    }
  }
}

/// With effects that take the arm to another method of exact_tf, likewise.
TEST(PredictedRoots, HubZerosDoNotDependOnTheHubWithEffectsEither) {
  const auto table = table_of_hub_zeros(2);
  for (const char* effect : {"root_compliance", "hub_radius"}) {
    const auto with = [&](double hub_inertia_kg_m2) {
      arm::Arm arm = damped_ruler(hub_inertia_kg_m2, 5e-4);
      arm.hub.viscous_friction_N_m_s_per_rad = 0.02 * hub_inertia_kg_m2;
      effects::put(arm, effect,
                   {{effect == std::string("hub_radius") ? "radius" : "stiffness", 0.05}});
      return predicted(arm, table);
    };
    const auto first = with(0.01);
    for (const double hub_inertia_kg_m2 : {1e-3, 0.1, 1.0}) {
      EXPECT_LT((with(hub_inertia_kg_m2) - first).norm(), 1e-9 * first.norm()) << effect;
    }
  }
}

}  // namespace
}  // namespace flexarm::diagnose
