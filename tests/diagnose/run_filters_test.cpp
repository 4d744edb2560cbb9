// Filters of runs that are kept.
#include "diagnose/predictors/run_filters.hpp"

#include "effects/registry/vocabulary.hpp"
#include "response/formulation_maker.hpp"
#include "response/time/time_model.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace flexarm::diagnose {
namespace {

class KeptRunFilters : public testing::Test {
 protected:
  KeptRunFilters() {
    for (int k = 0; k < 300; ++k) torque_N_m_.push_back(0.05 * std::sin(0.1 * k));
    values_ = simulator({})->readings(torque_N_m_).reshaped();
  }

  std::unique_ptr<response::ArmSimulator> simulator(const arm::Effects& effects) const {
    arm::Arm arm = trial_arm();
    arm.effects = effects;
    response::ArmParts parts = response::take_apart(arm);
    parts.disturbance = response::HubDisturbance{0.05};
    return std::make_unique<response::ArmSimulator>(
        response::time_model(response::make_formulation("exact_tf", parts.linear, 3), parts, 3,
                             sensors_),
        parts, sensors_, response::options_of_fit(2e-3, response::TorqueHold::zero));
  }
  RecordedRun recorded(double disturbance_N_m) const {
    return {torque_N_m_, values_, Eigen::VectorXd::Constant(1, 1e-3), {disturbance_N_m}, true};
  }

  std::vector<arm::Sensor> sensors_ = {arm::parse_sensor("hub_angle")};
  std::vector<double> torque_N_m_;
  Eigen::VectorXd values_;
  RunFilters filters_{2};
};

TEST_F(KeptRunFilters, AreThoseOfTheLinearArmWhateverItsLawsAre) {
  const auto bare = simulator({});
  const auto first = filters_.of(0, *bare, recorded(0.01));
  const auto again = filters_.of(
      0, *simulator({effects::named("coulomb_friction", {{"torque", 0.01}})}), recorded(0.01));
  EXPECT_EQ(again, first);
  const RunFilter computed = run_filter(
      *bare, bare->sampled(recorded(0.01).process, recorded(0.01).deviations), recorded(0.01));
  EXPECT_EQ(first->log_determinant, computed.log_determinant);
  EXPECT_EQ(first->gains.steady.gain, computed.gains.steady.gain);
  EXPECT_EQ(first->gains.first.size(), computed.gains.first.size());
}

TEST_F(KeptRunFilters, AreOthersForAnotherArmNoiseOrRun) {
  const auto bare = simulator({});
  const auto first = filters_.of(0, *bare, recorded(0.01));
  EXPECT_NE(filters_.of(0, *bare, recorded(0.02)), first);
  EXPECT_NE(filters_.of(1, *bare, recorded(0.01)), first);
  const auto heavier = simulator({effects::named("payload_mass", {{"mass", 0.01}})});
  EXPECT_NE(filters_.of(0, *heavier, recorded(0.01))->gains.steady.gain, first->gains.steady.gain);
  // One state more.
  const auto lagging = simulator({effects::named("actuator_lag", {{"time_constant", 4e-3}})});
  EXPECT_NE(filters_.of(0, *lagging, recorded(0.01))->gains.steady.gain.rows(),
            first->gains.steady.gain.rows());
  EXPECT_EQ(filters_.of(0, *bare, recorded(0.01)), first);
}

TEST_F(KeptRunFilters, AreTheLastOnes) {
  const auto bare = simulator({});
  const auto first = filters_.of(0, *bare, recorded(0.01));
  for (std::size_t i = 0; i < RunFilters::kKept; ++i) {
    filters_.of(0, *bare, recorded(0.02 + 0.01 * static_cast<double>(i)));
  }
  EXPECT_NE(filters_.of(0, *bare, recorded(0.01)), first);
}

}  // namespace
}  // namespace flexarm::diagnose
