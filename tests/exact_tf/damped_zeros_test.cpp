// Zeros of the damped transfer function, which undamped ones become.
#include "effects/registry/vocabulary.hpp"
#include "exact_tf/exact_arm.hpp"
#include "sample_arms.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <map>
#include <string>
#include <vector>

namespace flexarm::exact_tf {
namespace {

/// G changes by its slope within this part of s: |G(s)| of a zero against its value that far away.
constexpr double kBeside = 1e-9;
constexpr double kOfTheValueBeside = 1e-3;

void expect_zeros_of(const ExactArm& exact, const arm::Sensor& sensor, int count) {
  const auto undamped = exact.zeros(sensor, count).s_rad_per_s;
  const auto damped = exact.damped_zeros(sensor, undamped);
  ASSERT_EQ(damped.pairs.size(), undamped.size());
  for (std::size_t i = 0; i < undamped.size(); ++i) {
    ASSERT_TRUE(damped.pairs[i].has_value()) << "zero " << undamped[i];
    for (const auto& s : {damped.pairs[i]->first_rad_per_s, damped.pairs[i]->second_rad_per_s}) {
      const double here = std::abs(exact.transfer_function(sensor, s));
      const double beside = std::abs(exact.transfer_function(sensor, s * (1.0 + kBeside)));
      EXPECT_LE(here, kOfTheValueBeside * beside) << "s = " << s << " of " << undamped[i];
    }
  }
}

/// Arms whose engine is the transfer matrices, and whose damping is not Kelvin-Voigt's alone.
TEST(DampedZeros, AreZerosOfTheDampedTransferFunction) {
  const std::map<std::string, std::map<std::string, double>> all = {
      {"hub_radius", {{"radius", 0.2}}},
      {"root_compliance", {{"stiffness", 3.0}}},
      {"root_damping", {{"stiffness", 3.0}, {"time", 0.05}}},
      {"air_damping", {{"coefficient", 0.3}}},
      {"drive_compliance", {{"rotor_share", 0.4}, {"stiffness", 5.0}, {"time", 0.01}}},
      {"payload_offset", {{"offset", 0.1}}},
      {"tuned_mass",
       {{"position", 0.6}, {"mass", 0.1}, {"frequency", 0.9}, {"damping_ratio", 0.1}}},
  };
  for (const auto& [name, parameters] : all) {
    for (const double kelvin_voigt_s : {1e-4, 3e-3}) {
      arm::Arm arm = unit_arm(0.1, 0.5, 0.02, kelvin_voigt_s, 0.05);
      effects::put(arm, name, parameters);
      const ExactArm exact(arm);
      for (const char* sensor : {"hub_angle", "strain@0.3", "tip_acceleration"}) {
        SCOPED_TRACE(testing::Message()
                     << name << ", " << sensor << ", kv " << kelvin_voigt_s << " s");
        expect_zeros_of(exact, arm::parse_sensor(sensor), 3);
      }
    }
  }
}

TEST(DampedZeros, OverdampedOnesAreTwoRealRoots) {
  for (const bool has_radius : {false, true}) {
    arm::Arm arm = unit_arm(0.1, 0.5, 0.02, 0.5);
    if (has_radius) effects::put(arm, "hub_radius", {{"radius", 0.2}});
    const ExactArm exact(arm);
    const auto undamped = exact.zeros(kHub, 3).s_rad_per_s;
    const auto damped = exact.damped_zeros(kHub, undamped);
    ASSERT_GT(undamped.back().imag() * 0.5, 2.0) << "overdamped";
    const auto& pair = damped.pairs.back().value();
    EXPECT_EQ(pair.first_rad_per_s.imag(), 0.0);
    EXPECT_EQ(pair.second_rad_per_s.imag(), 0.0);
    expect_zeros_of(exact, kHub, 3);
  }
}

TEST(DampedZeros, WithoutDampingAreTheUndampedOnes) {
  for (const bool has_radius : {false, true}) {
    arm::Arm arm = unit_arm(0.1, 0.5, 0.02);
    if (has_radius) effects::put(arm, "hub_radius", {{"radius", 0.2}});
    const ExactArm exact(arm);
    const auto undamped = exact.zeros(kHub, 3).s_rad_per_s;
    const auto damped = exact.damped_zeros(kHub, undamped);
    for (std::size_t i = 0; i < undamped.size(); ++i) {
      EXPECT_LE(std::abs(damped.pairs[i].value().first_rad_per_s - undamped[i]),
                kRelativeTolerance * std::abs(undamped[i]));
    }
  }
}

TEST(DampedZeros, HubZerosUnderKelvinVoigtDampingDoNotDependOnTheHub) {
  const arm::Sensor hub{arm::SensorKind::hub_angle};
  for (const double inertia : {1e-3, 0.1, 10.0}) {
    for (const double kelvin_voigt_s : {1e-4, 1e-3, 1e-2}) {
      // A hub radius takes the arm from the closed form to the transfer matrices.
      for (const bool has_radius : {false, true}) {
        arm::Arm arm = unit_arm(inertia, 0.5, 0.02, kelvin_voigt_s);
        if (has_radius) effects::put(arm, "hub_radius", {{"radius", 0.2}});
        const ExactArm exact(arm);
        const auto undamped = exact.zeros(hub, 4).s_rad_per_s;
        const auto damped = exact.damped_zeros(hub, undamped);
        ASSERT_TRUE(damped.summary.converged);
        for (std::size_t i = 0; i < undamped.size(); ++i) {
          const double omega = undamped[i].imag();
          const auto& pair = damped.pairs[i].value();
          const double sum = (pair.first_rad_per_s + pair.second_rad_per_s).real();
          EXPECT_NEAR(-sum / (kelvin_voigt_s * omega * omega), 1.0, 1e-9);
        }
      }
    }
  }
}

}  // namespace
}  // namespace flexarm::exact_tf
