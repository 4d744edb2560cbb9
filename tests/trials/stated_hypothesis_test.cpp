// A law that the library lacks, hidden in data by the simulator of the trials and stated by the
// user as a hypothesis.
#include "diagnose/diagnosis.hpp"
#include "diagnose/search/hypothesis.hpp"
#include "tests/trials/trial_case.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace flexarm::trials {
namespace {

namespace fs = std::filesystem;

/// The diagnosis of a case with `stated` in its arm file, among some effects of the library.
diagnose::Diagnosis diagnosed_with(const std::string& stated, const fs::path& folder) {
  std::ofstream(folder / "arm.toml", std::ios::app) << stated;
  const diagnose::Experiment experiment = diagnose::read_experiment(folder / "measurement.toml");
  auto hypotheses = diagnose::hypotheses(experiment);
  const std::vector<std::string> among = {"my_cable",         "hub_spring",  "gravity",
                                          "coulomb_friction", "hub_inertia", "hub_viscous_friction",
                                          "torque_ripple",    "torque_bias"};
  std::erase_if(hypotheses, [&](const diagnose::Hypothesis& hypothesis) {
    return std::ranges::find(among, hypothesis.effect) == among.end();
  });
  return diagnose::diagnose(experiment, hypotheses, {.most_causes = 1});
}

class StatedHypothesis : public testing::Test {
 protected:
  /// One a test: they run side by side.
  StatedHypothesis()
      : folder_(fs::path(testing::TempDir()) /
                testing::UnitTest::GetInstance()->current_test_info()->name()) {
    fs::remove_all(folder_);
  }
  ~StatedHypothesis() override { fs::remove_all(folder_); }

  fs::path folder_;
};

TEST_F(StatedHypothesis, IsNamedAboveTheLibraryWithItsNumber) {
  const Truth truth =
      write_case({.kind = measured::RunKind::time, .hidden = {"hub_hardening_spring"}}, folder_);
  const double hidden = truth.world.hidden.front().parameters.at("coefficient");
  const auto diagnosis = diagnosed_with(
      "\n[effects.my_cable]\nhub_torque = \"-k*theta^3\"\n"
      "k = { range = [0.1, 1000], unit = \"N m/rad^3\" }\n",
      folder_);
  EXPECT_EQ(diagnosis.verdict, diagnose::Verdict::explained);
  ASSERT_EQ(diagnosis.causes.size(), 1U);
  const diagnose::Cause& cause = diagnosis.causes.front();
  EXPECT_EQ(cause.effect, "my_cable");
  EXPECT_GT(cause.confidence, 0.9);
  ASSERT_EQ(cause.parameters.size(), 1U);
  EXPECT_EQ(cause.parameters[0].unit, "N m/rad^3");
  constexpr double kFivePerCent = 0.05;
  EXPECT_NEAR(cause.parameters[0].value, hidden, kFivePerCent * hidden);
  // In the extended arm it is an effect, no hypothesis any more.
  EXPECT_TRUE(diagnosis.extended_arm.hypotheses.empty());
  EXPECT_EQ(diagnosis.extended_arm.effects.at("my_cable").value("k"), cause.parameters[0].value);
}

TEST_F(StatedHypothesis, IsNotNamedWhereAnEffectOfTheLibraryIsThere) {
  write_case({.kind = measured::RunKind::time, .hidden = {"coulomb_friction"}}, folder_);
  const auto diagnosis = diagnosed_with(
      "\n[effects.my_cable]\nhub_torque = \"-k*theta^3\"\n"
      "k = { range = [0.1, 1000], unit = \"N m/rad^3\" }\n",
      folder_);
  ASSERT_EQ(diagnosis.causes.size(), 1U);
  EXPECT_EQ(diagnosis.causes.front().effect, "coulomb_friction");
  EXPECT_FALSE(diagnosis.extended_arm.effects.contains("my_cable"));
  EXPECT_TRUE(diagnosis.extended_arm.hypotheses.contains("my_cable"));
}

}  // namespace
}  // namespace flexarm::trials
