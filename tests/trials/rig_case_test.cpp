// Rigs as they are drawn.
#include "tests/trials/rig_case.hpp"

#include "measured/files/text_file.hpp"
#include "measured/files/time_record.hpp"
#include "tests/trials/trial_list.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <set>

namespace flexarm::trials {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::AnyOf;
using testing::Contains;
using testing::Ge;
using testing::Le;

/// find_size is right to 5 %.
constexpr double kErrorTolerance = 1.06;

std::vector<TrialKey> rig_keys(int trials) {
  return list_trials({.effects = {"rig"}, .trials = trials});
}

TEST(RigList, HasEachNumberOnceInTimeWithoutDirt) {
  const auto keys = list_trials({.effects = {"rig"}, .trials = 3, .seed = 5, .dirts = {"all"}});
  EXPECT_TRUE(keys.empty());
  const auto clean = list_trials({.effects = {"rig", "none"}, .trials = 3, .seed = 5});
  std::vector<std::string> ids;
  for (const TrialKey& key : clean) {
    if (key.rig) ids.push_back(key.id());
  }
  EXPECT_THAT(ids, testing::ElementsAre("time-rig-1-1@5", "time-rig-1-2@5", "time-rig-1-3@5"));
}

TEST(RigList, AGivenSizeIsTheLargestErrorOfACause) {
  const auto keys = list_trials({.effects = {"rig"}, .size = 1.0});
  ASSERT_EQ(keys.size(), 1U);
  EXPECT_EQ(keys.front().id(), "time-rig-1-1-1@1");
  EXPECT_EQ(keys.front().hidden, rig_keys(1).front().hidden);
}

TEST(RigList, HidesFiveToEightCausesEachOnce) {
  std::set<std::size_t> counts;
  std::set<std::string> drawn;
  for (const TrialKey& key : rig_keys(200)) {
    counts.insert(key.hidden.size());
    drawn.insert(key.hidden.begin(), key.hidden.end());
    EXPECT_EQ(std::set<std::string>(key.hidden.begin(), key.hidden.end()).size(),
              key.hidden.size());
    for (const char* always :
         {"hub_viscous_friction", "coulomb_friction", "hub_inertia", "flexural_rigidity"}) {
      EXPECT_THAT(key.hidden, Contains(always));
    }
  }
  EXPECT_EQ(counts, (std::set<std::size_t>{5, 6, 7, 8}));
  EXPECT_EQ(drawn.size(), 11U);
}

TEST(RigDraw, SizesAreThoseOfLaboratories) {
  for (const TrialKey& key : rig_keys(3)) {
    const RigDraw made = draw_rig(key);
    ASSERT_EQ(made.world.hidden.size(), key.hidden.size());
    const double inertia = made.world.find("hub_inertia")->parameters.at("factor");
    EXPECT_THAT(inertia, AllOf(Ge(0.7), Le(1.4))) << key.id();
    const double rigidity = made.world.find("flexural_rigidity")->parameters.at("factor");
    EXPECT_THAT(rigidity, AllOf(Ge(0.85), Le(1.15))) << key.id();
    for (std::size_t i = 0; i < key.hidden.size(); ++i) {
      EXPECT_THAT(made.errors[i],
                  AllOf(Ge(kRigErrorLeast / kErrorTolerance), Le(kRigErrorMost * kErrorTolerance)))
          << key.id() << " " << key.hidden[i];
    }
  }
}

TEST(RigDraw, HasAHubSensorAndOneOfTheBeamOnWhichSensorCausesAct) {
  for (const TrialKey& key : rig_keys(2)) {
    const RigDraw made = draw_rig(key);
    ASSERT_EQ(made.sensors.size(), 2U);
    EXPECT_THAT(made.sensors[0].kind,
                AnyOf(arm::SensorKind::hub_angle, arm::SensorKind::hub_velocity));
    EXPECT_THAT(made.sensors[1].kind,
                AnyOf(arm::SensorKind::tip_acceleration, arm::SensorKind::tip_deflection,
                      arm::SensorKind::strain));
    for (const HiddenCause& one : made.world.hidden) {
      if (one.sensor.empty()) continue;
      EXPECT_THAT(made.sensors, Contains(arm::parse_sensor(one.sensor))) << key.id();
    }
    const auto is_validation = [](const PlannedRun& run) {
      return run.purpose == measured::Purpose::validation;
    };
    EXPECT_EQ(made.runs.size(), 3U);
    EXPECT_EQ(std::ranges::count_if(made.runs, is_validation), 1);
  }
}

/// A rig whose hub angle is recorded.
TrialKey key_with_encoder() {
  for (const TrialKey& key : rig_keys(20)) {
    if (draw_rig(key).sensors[0].kind == arm::SensorKind::hub_angle) return key;
  }
  return {};
}

struct WrittenRig {
  Truth truth;
  std::map<std::string, std::string> files;
};

WrittenRig written(const TrialKey& key) {
  const fs::path folder = fs::path(testing::TempDir()) / ("rig-" + key.folder_name());
  fs::remove_all(folder);
  WrittenRig made{write_case(key, folder), {}};
  for (const auto& entry : fs::directory_iterator(folder)) {
    made.files[entry.path().filename()] = measured::read_text_file(entry.path(), 1 << 26);
  }
  fs::remove_all(folder);
  return made;
}

TEST(RigCase, IsTheSameForTheSameSeedWithTheHubAngleInCounts) {
  const TrialKey key = key_with_encoder();
  const WrittenRig made = written(key);
  const WrittenRig again = written(key);
  EXPECT_EQ(made.files, again.files);
  EXPECT_EQ(truth_json(made.truth), truth_json(again.truth));
  TrialKey other = key;
  ++other.seed;
  EXPECT_NE(draw_rig(other).sizes, made.truth.sizes);

  EXPECT_EQ(made.files.size(), 5U);  // arm, measurement, three runs
  const RigTruth& rig = made.truth.rig.value();
  EXPECT_THAT(rig.counts_per_turn, AllOf(Ge(kEncoderLeast), Le(kEncoderMost)));
  for (const char* run : {"random-high.csv", "bang-bang.csv", "multisine.csv"}) {
    const auto record = measured::parse_time_record(made.files.at(run), run);
    std::set<double> seen;
    for (const double angle : record.channels[0].values) {
      const double counts = angle * rig.counts_per_turn / (2.0 * std::numbers::pi);
      EXPECT_NEAR(counts, std::round(counts), 1e-6);
      seen.insert(std::round(counts));
    }
    // The noise widens the range of the hub angle.
    EXPECT_GE(*seen.rbegin() - *seen.begin(), kEncoderSignal_counts - 1.0) << run;
  }
}

TEST(RigCase, TruthHasTheCostOfEachAbsenceAndTheFloor) {
  const TrialKey key = rig_keys(1).front();
  const WrittenRig made = written(key);
  const RigTruth& rig = made.truth.rig.value();
  ASSERT_EQ(rig.costs.size(), key.hidden.size());
  for (const auto& [name, cost] : rig.costs) EXPECT_GT(cost, 0.0) << name;
  const auto leading = rig.leading();
  ASSERT_EQ(leading.size(), kLeadingCauses);
  EXPECT_GE(rig.costs.at(leading[0]), rig.costs.at(leading[2]));
  const double least_floor = 0.9 * kRigNoise;
  EXPECT_THAT(rig.validation_floor, AllOf(Ge(least_floor), Le(0.03)));
  const auto json = truth_json(made.truth);
  EXPECT_EQ(json.at("costs").size(), key.hidden.size());
  EXPECT_EQ(json.at("leading").size(), kLeadingCauses);
}

}  // namespace
}  // namespace flexarm::trials
