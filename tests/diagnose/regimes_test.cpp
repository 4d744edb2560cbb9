#include "diagnose/symptoms/regimes.hpp"

#include "diagnose/diagnosis.hpp"
#include "diagnose/search/misfit.hpp"
#include "diagnose/symptoms/regime_bounds.hpp"
#include "effects/registry/vocabulary.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace flexarm::diagnose {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kRounding = 1e-12;  // of sums of some thousand squares

/// Residuals that are no noise, in its standard deviations.
constexpr double kLevel = 10.0;

Experiment all_for_validation(Experiment experiment) {
  for (auto& [run, data] : experiment.runs) run.purpose = measured::Purpose::validation;
  return experiment;
}

/// An experiment whose residuals a test makes up.
class MadeUp {
 public:
  explicit MadeUp(Experiment experiment)
      : experiment_(std::move(experiment)), problem_(experiment_) {}
  MadeUp(const MadeUp&) = delete;
  MadeUp& operator=(const MadeUp&) = delete;

  const Problem& problem() const { return problem_; }
  const measured::TimeRecord& record(std::size_t run) const {
    return std::get<measured::TimeRecord>(experiment_.runs[run].data);
  }
  /// Residuals of these sizes: that of a run's sample, for all of its channels.
  Eigen::VectorXd residuals(
      const std::function<double(std::size_t, std::size_t)>& of_sample) const {
    Eigen::VectorXd made = Eigen::VectorXd::Zero(problem_.observations().values.size());
    for (const ObservedChannel& channel : problem_.observations().channels) {
      for (Eigen::Index k = 0; k < channel.count; ++k) {
        made(channel.first + k) = of_sample(channel.run, static_cast<std::size_t>(k));
      }
    }
    return made;
  }
  std::vector<RegimeError> regimes(const Eigen::VectorXd& left) const {
    const SymptomsInput input{problem_, left, left, nothing_};
    return regime_errors(input, band_errors(input));
  }

 private:
  Experiment experiment_;
  Problem problem_;
  Candidate nothing_;
};

/// Normal numbers, or with a memory the states of an autoregression of order 1.
class Chance {
 public:
  explicit Chance(std::uint64_t seed, double memory = 0.0) : numbers_(seed), memory_(memory) {}
  double operator()() {
    state_ = memory_ * state_ + std::sqrt(1.0 - memory_ * memory_) * normal_(numbers_);
    return state_;
  }

 private:
  std::mt19937_64 numbers_;
  std::normal_distribution<double> normal_;
  double memory_;
  double state_ = 0.0;
};

std::vector<RegimeError> of(RegimeQuantity quantity, std::vector<RegimeError> regimes) {
  std::erase_if(regimes, [&](const RegimeError& one) { return one.quantity != quantity; });
  return regimes;
}

std::string name_of(const RegimeError& regime) {
  return fmt::format("{} {:.3g} to {:.3g}", to_string(regime.quantity), regime.from, regime.to);
}

std::vector<std::string> significant_names(const std::vector<RegimeError>& regimes) {
  std::vector<std::string> names;
  for (const RegimeError& one : regimes) {
    if (one.is_significant()) names.push_back(name_of(one));
  }
  return names;
}

testing::Matcher<const RegimeBounds&> bounds(double from, double to) {
  return testing::AllOf(testing::Field(&RegimeBounds::from, from),
                        testing::Field(&RegimeBounds::to, to));
}

TEST(EqualRegimes, AreTheQuartilesOfTheValues) {
  std::vector<double> values(100);
  std::iota(values.rbegin(), values.rend(), 1.0);
  EXPECT_THAT(equal_regimes(values), ElementsAre(bounds(1.0, 25.0), bounds(25.0, 50.0),
                                                 bounds(50.0, 75.0), bounds(75.0, 100.0)));
}

TEST(EqualRegimes, AreTheValuesWhereThereAreFew) {
  EXPECT_THAT(equal_regimes({}), IsEmpty());
  EXPECT_THAT(equal_regimes({0.3, 0.3, 0.3}), ElementsAre(bounds(0.3, 0.3)));
  EXPECT_THAT(equal_regimes({1.0, 0.0, 1.0, 1.0, 1.0, 1.0}),
              ElementsAre(bounds(0.0, 0.0), bounds(1.0, 1.0)));
  EXPECT_THAT(equal_regimes({0.3, 0.301, 0.302, 0.3005, 0.3015, 0.3025}),
              ElementsAre(bounds(0.3, 0.3025)));
}

TEST(EqualRegimes, EndOnceWhereOneValueFillsQuartiles) {
  std::vector<double> values(60, 0.0);
  for (int k = 1; k <= 40; ++k) values.push_back(0.1 * k);
  EXPECT_THAT(equal_regimes(values),
              ElementsAre(bounds(0.0, 0.0), bounds(0.0, 1.5), bounds(1.5, 4.0)));
}

TEST(Regimes, OfAResidualAtHighVelocityAreThoseAndNoOthers) {
  const MadeUp data(all_for_validation(simulated_experiment({})));
  const auto fastest = [&](const auto& regimes) {
    return of(RegimeQuantity::hub_velocity, regimes).back();
  };
  const auto quiet = data.residuals([](std::size_t, std::size_t) { return 1.0; });
  const double from = fastest(data.regimes(quiet)).from;
  Chance chance(5);
  const auto left = data.residuals([&](std::size_t run, std::size_t k) {
    const auto& velocity = *values_of(data.record(run), arm::SensorKind::hub_velocity);
    return (std::abs(velocity[k]) > from ? 3.0 * kLevel : kLevel) * chance();
  });
  const auto regimes = data.regimes(left);
  EXPECT_NEAR(fastest(regimes).ratio, 9.0, 1.0);  // 12,000 squares: 3 standard errors of 4 %
  EXPECT_THAT(significant_names(regimes), ElementsAre(name_of(fastest(regimes))));
}

TEST(Regimes, AreNotSignificantWithinTheNoise) {
  const MadeUp data(all_for_validation(simulated_experiment({}, {.duration_s = 2.0})));
  Chance chance(5);
  const auto left = data.residuals([&](std::size_t run, std::size_t k) {
    const auto& velocity = *values_of(data.record(run), arm::SensorKind::hub_velocity);
    return (std::abs(velocity[k]) > 1.0 ? 1.0 : 0.3) * chance();
  });
  EXPECT_THAT(significant_names(data.regimes(left)), IsEmpty());
}

/// Draws in which any regime but those of frequency is significant, of residuals that are the same
/// everywhere.
int false_draws(const MadeUp& data, double memory, int draws) {
  int made = 0;
  for (int draw = 0; draw < draws; ++draw) {
    Chance chance(static_cast<std::uint64_t>(draw), memory);
    const auto left = data.residuals([&](std::size_t, std::size_t) { return kLevel * chance(); });
    auto regimes = data.regimes(left);
    if (memory > 0.0) {
      // Such residuals are not the same at all frequencies.
      std::erase_if(regimes, [](const RegimeError& one) {
        return one.quantity == RegimeQuantity::frequency;
      });
    }
    made += significant_names(regimes).empty() ? 0 : 1;
  }
  return made;
}

TEST(Regimes, OfAResidualThatIsTheSameEverywhereAreRarelySignificant) {
  constexpr int kDraws = 500;
  const double most =
      kSignificantRegime * kDraws + 3.0 * std::sqrt(kSignificantRegime * kDraws);  // chance
  const Experiment experiment = simulated_experiment({}, {.duration_s = 1.0});
  for (const bool one_run : {true, false}) {
    const MadeUp data(one_run ? experiment : all_for_validation(experiment));
    for (const double memory : {0.0, 0.95}) {
      const int found = false_draws(data, memory, kDraws);
      RecordProperty(fmt::format("false_{}_{}", one_run, memory), found);
      EXPECT_LE(found, most) << "memory " << memory << ", one run: " << one_run;
    }
  }
}

TEST(Regimes, LeaveOutATorqueOfOneSize) {
  Experiment experiment = simulated_experiment({}, {.duration_s = 1.0});
  for (auto& [run, data] : experiment.runs) {
    auto& torque_N_m = std::get<measured::TimeRecord>(data).torque_N_m;
    for (std::size_t k = 0; k < torque_N_m.size(); ++k) torque_N_m[k] = k % 100 < 50 ? 0.1 : -0.1;
  }
  const MadeUp data(std::move(experiment));
  const auto regimes = data.regimes(data.residuals([](auto, auto) { return kLevel; }));
  EXPECT_THAT(of(RegimeQuantity::torque, regimes), IsEmpty());
  EXPECT_EQ(of(RegimeQuantity::hub_angle, regimes).size(), kRegimes);
}

TEST(Regimes, LeaveOutTheHubWhereNothingMeasuredIt) {
  Experiment experiment = simulated_experiment({}, {.duration_s = 1.0});
  for (auto& [run, data] : experiment.runs) {
    std::erase_if(std::get<measured::TimeRecord>(data).channels,
                  [](const auto& channel) { return arm::is_collocated(channel.sensor); });
  }
  const MadeUp data(std::move(experiment));
  const auto regimes = data.regimes(data.residuals([](auto, auto) { return kLevel; }));
  EXPECT_THAT(of(RegimeQuantity::hub_velocity, regimes), IsEmpty());
  EXPECT_THAT(of(RegimeQuantity::hub_angle, regimes), IsEmpty());
  EXPECT_EQ(of(RegimeQuantity::torque, regimes).size(), kRegimes);
  EXPECT_EQ(of(RegimeQuantity::time, regimes).size(), kRegimes);
}

/// The payloads of runs whose residual is thrice as large with the payload as without.
std::vector<RegimeError> payload_regimes(std::size_t without, std::size_t with) {
  Experiment experiment = all_for_validation(simulated_experiment({}, {.duration_s = 1.0}));
  experiment.runs.assign(without + with, experiment.runs.front());
  for (std::size_t r = without; r < without + with; ++r) {
    experiment.runs[r].run.payload = arm::Payload{0.06, 0.0};
  }
  const MadeUp data(std::move(experiment));
  Chance chance(3);
  return of(RegimeQuantity::payload, data.regimes(data.residuals([&](std::size_t run, auto) {
    return (run < without ? kLevel : 3.0 * kLevel) * chance();
  })));
}

TEST(Regimes, OfPayloadsAreOneForEachMassAndComparedByRuns) {
  const auto payloads = payload_regimes(3, 3);
  ASSERT_EQ(payloads.size(), 2U);
  EXPECT_EQ(payloads[1].from, 0.06);
  EXPECT_EQ(payloads[1].to, 0.06);
  EXPECT_EQ(payloads[1].share, 0.5);
  EXPECT_TRUE(payloads[1].is_significant());
  EXPECT_FALSE(payloads[0].is_significant());
  // A single run with a payload may differ from others for any reason.
  EXPECT_EQ(payload_regimes(3, 1).back().p_value, 1.0);
  EXPECT_THAT(payload_regimes(3, 0), IsEmpty());
}

TEST(Regimes, OfEachQuantityAddUpToTheErrorOfTheChannels) {
  Experiment experiment = all_for_validation(simulated_experiment({}, {.duration_s = 1.0}));
  std::get<measured::TimeRecord>(experiment.runs[1].data).channels[0].left_out = {3, 400};
  const MadeUp data(std::move(experiment));
  Chance chance(8);
  const auto left = data.residuals([&](auto run, auto k) {
    return kLevel * (1.0 + static_cast<double>(run + k % 50)) * chance();
  });
  double readings = 0.0;
  double squares = 0.0;
  double of_channels = 0.0;
  double channels = 0.0;
  const Problem& problem = data.problem();
  for (const ObservedChannel& channel : problem.observations().channels) {
    const auto used = static_cast<double>(channel.used());
    const double error =
        relative_error(problem.observations(), problem.experiment(), channel, left);
    readings += used;
    squares += used * error * error;
    of_channels += error * error;
    channels += 1.0;
  }
  const auto regimes = data.regimes(left);
  for (const auto quantity :
       {RegimeQuantity::torque, RegimeQuantity::hub_velocity, RegimeQuantity::hub_angle,
        RegimeQuantity::time, RegimeQuantity::payload}) {
    double sum = 0.0;
    double share = 0.0;
    for (const RegimeError& one : of(quantity, regimes)) {
      sum += one.share * one.after * one.after;
      share += one.share;
    }
    EXPECT_NEAR(share, 1.0, kRounding) << to_string(quantity);
    EXPECT_NEAR(sum, squares / readings, kRounding * squares / readings) << to_string(quantity);
  }
  double sum = 0.0;
  for (const RegimeError& one : of(RegimeQuantity::frequency, regimes)) {
    sum += one.after * one.after;
  }
  // The window of the spectra weighs samples otherwise than the signal; white noise is the same all
  // along.
  constexpr double kWindow = 0.3;
  EXPECT_NEAR(sum, of_channels / channels, kWindow * of_channels / channels);
}

/// The regimes of what a diagnosis leaves that does not search for the hidden effect, of four runs
/// all of which are fitted. Bands of frequency are left out.
std::vector<RegimeError> left_without(const arm::Effects& hidden) {
  Experiment experiment = simulated_experiment(hidden);
  for (auto& [run, data] : experiment.runs) {
    run.purpose = measured::Purpose::estimation;
    run.torque_hold = measured::TorqueHold::zero;
  }
  const Diagnosis made = diagnose(experiment, named(experiment, {"time_delay"}));
  EXPECT_EQ(made.verdict, Verdict::unexplained);
  auto regimes = made.symptoms.regimes;
  std::erase_if(regimes,
                [](const RegimeError& one) { return one.quantity == RegimeQuantity::frequency; });
  return regimes;
}

TEST(Regimes, OfASaturationThatIsNotSearchedForAreThatOfHighTorque) {
  const auto regimes = left_without({effects::named("torque_saturation", {{"limit", 0.1}})});
  const RegimeError high = of(RegimeQuantity::torque, regimes).back();
  EXPECT_GT(high.innovation_ratio, high.ratio);
  EXPECT_THAT(significant_names(regimes), ElementsAre(name_of(high)));
}

TEST(Regimes, OfDryFrictionThatIsNotSearchedForAreThatOfLowVelocity) {
  const auto regimes = left_without({effects::named("coulomb_friction", {{"torque", 0.01}})});
  EXPECT_THAT(significant_names(regimes),
              ElementsAre(name_of(of(RegimeQuantity::hub_velocity, regimes).front())));
}

}  // namespace
}  // namespace flexarm::diagnose
