#include "diagnose/modal_orders.hpp"

#include "arm/input_error.hpp"
#include "diagnose/predictors/predicted_roots.hpp"
#include "diagnose/symptoms/root_shifts.hpp"
#include "effects/registry/vocabulary.hpp"
#include "exact_tf/exact_arm.hpp"
#include "response/arm_parts.hpp"
#include "tests/diagnose/symptoms_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::diagnose {
namespace {

using measured::Feature;
using measured::ModalTable;
using testing::ElementsAre;
using testing::HasSubstr;

const arm::Sensor kHub{arm::SensorKind::hub_angle, 0.0};

/// 96 % stiffer than in its file: frequencies 1.4 times as high.
arm::Arm stiffer_arm() {
  arm::Arm arm = trial_arm();
  effects::put(arm, "flexural_rigidity", {{"factor", 1.96}});
  return arm;
}

ModalTable ordered_table() {
  ModalTable table;
  for (const Feature feature : {Feature::pole, Feature::zero}) {
    for (int order = 1; order <= 3; ++order) {
      table.push_back({kHub, feature, order, 1.0, {}, {}, {}});
    }
  }
  return table;
}

/// Of the stiffer arm: its first three poles and hub zeros, with noise of 2 % and without orders.
ModalTable measured_table() {
  ModalTable table = ordered_table();
  Eigen::VectorXd frequency_Hz(static_cast<Eigen::Index>(table.size()));
  predict_roots(stiffer_arm(), table, frequency_Hz);
  std::mt19937_64 numbers(4);
  std::normal_distribution<double> normal;
  for (std::size_t i = 0; i < table.size(); ++i) {
    table[i].frequency_Hz =
        frequency_Hz(static_cast<Eigen::Index>(i)) * (1.0 + 0.02 * normal(numbers));
    table[i].order.reset();
  }
  return table;
}

std::vector<int> orders_of(const ModalTable& table) {
  std::vector<int> orders;
  for (const auto& entry : table) orders.push_back(entry.order.value());
  return orders;
}

TEST(ModalOrders, OfAStifferBeamAreByInterlacing) {
  ModalTable table = measured_table();
  EXPECT_THAT(put_orders(trial_arm(), table),
              ElementsAre("orders assigned to 6 of 6 roots: 6 by interlacing, 0 by distance"));
  EXPECT_EQ(orders_of(table), orders_of(ordered_table()));
}

TEST(ModalOrders, ThatAreStatedStay) {
  ModalTable table = ordered_table();
  for (auto& entry : table) entry.frequency_Hz = 400.0 * *entry.order;
  const ModalTable before = table;
  EXPECT_TRUE(put_orders(trial_arm(), table).empty());
  EXPECT_EQ(table, before);
}

TEST(ModalOrders, ThatCannotBeAssignedExcludeTheRoot) {
  ModalTable table = {{kHub, Feature::pole, {}, 20.5, {}, {}, {}},
                      {kHub, Feature::pole, {}, 12.0, {}, {}, {}},
                      {kHub, Feature::pole, {}, {}, {}, 0.01, {}}};
  const auto notices = put_orders(trial_arm(), table);
  ASSERT_EQ(notices.size(), 3U);
  EXPECT_EQ(notices[0], "orders assigned to 1 of 3 roots: 0 by interlacing, 1 by distance");
  EXPECT_THAT(notices[1], HasSubstr("hub_angle pole at 20.5 Hz excluded"));
  EXPECT_THAT(notices[2], HasSubstr("hub_angle pole excluded"));
  EXPECT_EQ(orders_of(table), std::vector<int>{1});
}

/// Real zeros of the tip have no order: the first antiresonance has order 1.
TEST(ModalOrders, OfTipZerosAreThoseOfThePrediction) {
  arm::Arm arm = trial_arm();
  arm.payload = {0.05, 1e-3};
  const arm::Sensor tip{arm::SensorKind::tip_acceleration, 0.0};
  const auto zeros = exact_tf::ExactArm(response::take_apart(arm).linear).zeros(tip, 6).s_rad_per_s;
  const auto first =
      std::ranges::find_if(zeros, [](const std::complex<double>& s) { return s.real() == 0.0; });
  ASSERT_NE(first, zeros.end());
  ModalTable table = {
      {tip, Feature::zero, {}, first->imag() / (2.0 * std::numbers::pi), {}, {}, {}}};
  put_orders(arm, table);
  EXPECT_EQ(table[0].order, 1);
  Eigen::VectorXd predicted_Hz(1);
  predict_roots(arm, table, predicted_Hz);
  EXPECT_NEAR(predicted_Hz(0) / *table[0].frequency_Hz, 1.0, 1e-9);
}

TEST(ModalOrders, AZeroOnTheRealAxisIsLeftOut) {
  const arm::Sensor tip{arm::SensorKind::tip_acceleration, 0.0};
  ModalTable table = {{std::nullopt, Feature::pole, 1, 12.0, {}, {}, {}},
                      {tip, Feature::zero, 1, 30.0, {}, -1.0, {}}};
  EXPECT_THAT(
      put_orders(trial_arm(), table),
      ElementsAre("tip_acceleration zero at 30 Hz excluded: with a damping ratio of -1 it is "
                  "no antiresonance"));
  EXPECT_EQ(table.size(), 1U);
}

TEST(ModalOrders, AnAntiresonanceThatTheArmDoesNotHaveIsRefused) {
  // The zeros of a uniform beam's bare tip are real.
  arm::Arm arm = trial_arm();
  arm.payload = {};
  const arm::Sensor tip{arm::SensorKind::tip_acceleration, 0.0};
  const ModalTable table = {{tip, Feature::zero, 2, 30.0, {}, {}, {}}};
  Eigen::VectorXd predicted_Hz(1);
  EXPECT_THROW(predict_roots(arm, table, predicted_Hz), arm::InputError);
}

TEST(ModalOrders, AreAssignedWhenAnExperimentIsRead) {
  namespace fs = std::filesystem;
  std::string name = (fs::temp_directory_path() / "flexarm-orders-XXXXXX").string();
  const fs::path folder = ::mkdtemp(name.data());
  std::ofstream(folder / "arm.toml")
      << "[beam]\nlength = 0.96\nflexural_rigidity = 3.69\nlinear_density = 0.165\n"
         "[hub]\ninertia = 0.000586\n";
  std::ofstream(folder / "m.toml")
      << "arm = \"arm.toml\"\n[[run]]\nid = \"m\"\nkind = \"modal\"\nfile = \"m.csv\"\n";
  std::ofstream(folder / "m.csv")
      << "sensor,feature,frequency [Hz]\nhub_angle,zero,4.02\nhub_angle,pole,16.6\n"
         "hub_angle,zero,25.2\nhub_angle,pole,45.2\n";
  const Experiment experiment = read_experiment(folder / "m.toml");
  fs::remove_all(folder);
  EXPECT_EQ(orders_of(std::get<ModalTable>(experiment.runs[0].data)),
            (std::vector<int>{1, 1, 2, 2}));
  EXPECT_THAT(experiment.notices, testing::Contains(HasSubstr("run m: orders assigned to 4 of 4")));
}

/// Hub angle of the stiffer arm, with noise of 1 % in both parts.
Experiment response_experiment() {
  Experiment experiment;
  experiment.arm = trial_arm();
  const exact_tf::ExactArm exact(response::take_apart(stiffer_arm()).linear);
  measured::FrequencyRecord record;
  auto& channel = record.channels.emplace_back();
  channel.sensor = kHub;
  std::mt19937_64 numbers(8);
  std::normal_distribution<double> normal;
  for (double f = 1.0; f <= 95.0; f += 0.05) {
    const auto value = exact.transfer_function(kHub, {0.0, 2.0 * std::numbers::pi * f});
    channel.frequency_Hz.push_back(f);
    channel.response.push_back(value + 0.01 * std::abs(value) *
                                           std::complex<double>(normal(numbers), normal(numbers)));
    channel.coherence.push_back(0.999);
  }
  measured::MeasuredRun run;
  run.run.id = "frf";
  run.run.kind = measured::RunKind::frf;
  run.run.purpose = measured::Purpose::estimation;
  run.data = std::move(record);
  experiment.runs.push_back(std::move(run));
  return experiment;
}

TEST(RootShifts, OfAResponseOfAStifferBeamAreAllTheSame) {
  const Symptomatic data(response_experiment());
  int poles = 0;
  int zeros = 0;
  for (const RootShift& shift : root_shifts(data.input())) {
    (shift.zero_of ? zeros : poles) += 1;
    EXPECT_NEAR(shift.frequency_Hz.value().shift_percent(), 40.0, 1.0)
        << (shift.zero_of ? "zero " : "pole ") << shift.order;
  }
  EXPECT_EQ(poles, 3);
  EXPECT_GE(zeros, 2);
}

}  // namespace
}  // namespace flexarm::diagnose
