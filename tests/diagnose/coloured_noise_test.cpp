#include "arm/given_effects.hpp"
#include "arm/hub_torque_table.hpp"
#include "diagnose/diagnosis.hpp"
#include "diagnose/search/channel_independence.hpp"
#include "diagnose/search/dependence.hpp"
#include "effects/registry/vocabulary.hpp"
#include "measured/spectra/robust.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <variant>
#include <vector>

namespace flexarm::diagnose {
namespace {

const std::vector<std::string> kSearched = {"coulomb_friction", "torque_bias", "torque_gain",
                                            "hub_inertia", "sensor_lag"};

/// What is added to a channel of this deviation, sample by sample.
using Added = std::function<std::vector<double>(std::size_t samples, double period_s, double size,
                                                std::mt19937_64& engine)>;

Experiment with_added(Experiment experiment, const Added& added) {
  std::mt19937_64 engine(11);
  for (auto& run : experiment.runs) {
    auto& record = std::get<measured::TimeRecord>(run.data);
    for (auto& channel : record.channels) {
      const double size = measured::standard_deviation(channel.values);
      const auto more =
          added(record.time_s.size(), measured::sampling_period_s(record), size, engine);
      std::ranges::transform(channel.values, more, channel.values.begin(), std::plus{});
    }
  }
  return experiment;
}

/// Of the first order, 3 % of the signal, correlated over 20 samples.
std::vector<double> first_order(std::size_t samples, double /*period_s*/, double size,
                                std::mt19937_64& engine) {
  constexpr double kStay = 0.95;
  std::normal_distribution<double> normal(0.0, 0.03 * size);
  std::vector<double> made(samples);
  double now = normal(engine);
  for (double& value : made) {
    value = now;
    now = kStay * now + std::sqrt(1.0 - kStay * kStay) * normal(engine);
  }
  return made;
}

/// An amplifier that warms: 20 % of the signal.
std::vector<double> drift(std::size_t samples, double /*period_s*/, double size,
                          std::mt19937_64& engine) {
  const double sign = engine() % 2 == 0 ? 1.0 : -1.0;
  std::vector<double> made(samples);
  for (std::size_t k = 0; k < samples; ++k) {
    made[k] = sign * 0.2 * size *
              (1.0 - std::exp(-2.0 * static_cast<double>(k) / static_cast<double>(samples)));
  }
  return made;
}

std::vector<double> hum(std::size_t samples, double period_s, double size,
                        std::mt19937_64& engine) {
  std::uniform_real_distribution<double> phase(0.0, 2.0 * std::numbers::pi);
  const double at_first = phase(engine);
  std::vector<double> made(samples);
  for (std::size_t k = 0; k < samples; ++k) {
    made[k] =
        0.05 * size *
        std::sin(2.0 * std::numbers::pi * 50.0 * period_s * static_cast<double>(k) + at_first);
  }
  return made;
}

bool says_coloured(const Diagnosis& made) {
  return std::ranges::any_of(made.notices, [](const std::string& notice) {
    return notice.find("coloured") != std::string::npos;
  });
}

struct Dirty {
  std::string name;
  Added added;
  double level;  ///< NRMSE that it makes
};

class ColouredNoise : public testing::TestWithParam<Dirty> {};

TEST_P(ColouredNoise, WithNothingHiddenIsAdequate) {
  const Experiment experiment = with_added(simulated_experiment({}), GetParam().added);
  const Diagnosis made = diagnose(experiment, named(experiment, kSearched));
  EXPECT_EQ(made.verdict, Verdict::adequate) << to_string(made.verdict);
  EXPECT_TRUE(made.causes.empty());
  EXPECT_TRUE(says_coloured(made));
  // The error of the simulation is as large as it is, and the noise floor says so.
  EXPECT_NEAR(made.estimation.before, GetParam().level, 0.3 * GetParam().level);
  EXPECT_NEAR(made.estimation.noise_floor, made.estimation.before, 0.1 * made.estimation.before);
}

class FrictionUnderColouredNoise : public testing::TestWithParam<Dirty> {};

TEST_P(FrictionUnderColouredNoise, IsFound) {
  constexpr double kHidden_N_m = 0.02;
  const Experiment experiment = with_added(
      simulated_experiment({effects::named("coulomb_friction", {{"torque", kHidden_N_m}})}),
      GetParam().added);
  const Diagnosis made = diagnose(experiment, named(experiment, kSearched));
  EXPECT_EQ(made.verdict, Verdict::explained) << to_string(made.verdict);
  ASSERT_EQ(made.causes.size(), 1U);
  EXPECT_EQ(made.causes[0].effect, "coulomb_friction");
  const auto& found = made.causes[0].parameters.front();
  // Three standard errors: one trial in 400 is beyond.
  EXPECT_NEAR(found.value, kHidden_N_m, 3.0 * found.std_error);
  EXPECT_LT(found.std_error, 0.1 * kHidden_N_m);
}

std::string name_of(const testing::TestParamInfo<Dirty>& one) {
  return one.param.name;
}

INSTANTIATE_TEST_SUITE_P(, ColouredNoise,
                         testing::Values(Dirty{"first_order", first_order, 0.03},
                                         Dirty{"drift", drift, 0.12}, Dirty{"hum", hum, 0.035}),
                         name_of);
// Not under drift: a torque bias accounts for as much of one.
INSTANTIATE_TEST_SUITE_P(, FrictionUnderColouredNoise,
                         testing::Values(Dirty{"first_order", first_order, 0.03},
                                         Dirty{"hum", hum, 0.035}),
                         name_of);

/// A torque that is 10 % less than the file says: the model error is as smooth as noise can be.
TEST(ColouredNoiseModel, IsNotTakenUpForAModelError) {
  const Experiment experiment =
      simulated_experiment({effects::named("torque_gain", {{"factor", 0.9}})}, {.duration_s = 2.0});
  SelectionOptions options;
  options.predictor = PredictorKind::output_error;
  const Diagnosis made = diagnose(experiment, named(experiment, {"hub_inertia"}), options);
  EXPECT_NE(made.verdict, Verdict::adequate);
  EXPECT_FALSE(says_coloured(made));
}

/// A constant is predicted from the reading before as well as any coloured noise is.
TEST(ColouredNoiseModel, IsNotTakenUpForAnOffsetOfOneSensor) {
  constexpr double kOffset = 0.05;
  const Experiment experiment =
      simulated_experiment({effects::named("sensor_offset", {{"value", kOffset}}, "hub_velocity")});
  const Diagnosis made = diagnose(experiment, named(experiment, {"sensor_offset", "hub_inertia"}));
  ASSERT_EQ(made.causes.size(), 1U);
  EXPECT_EQ(made.causes[0].sensor, "hub_velocity");
  EXPECT_NEAR(made.causes[0].parameters.front().value, kOffset, 0.01 * kOffset);
  EXPECT_FALSE(says_coloured(made));
}

/// Three wrong readings in a row are not recognised as outliers, and make the noise coloured.
TEST(ColouredNoiseModel, IsNotTakenUpForAnOffsetBesideWrongReadings) {
  constexpr double kOffset = 0.05;
  Experiment experiment =
      simulated_experiment({effects::named("sensor_offset", {{"value", kOffset}}, "hub_velocity")});
  for (auto& run : experiment.runs) {
    for (auto& channel : std::get<measured::TimeRecord>(run.data).channels) {
      if (channel.sensor.kind != arm::SensorKind::hub_velocity) continue;
      for (std::size_t k = 300; k < 303; ++k) channel.values[k] += 1.0;
    }
  }
  const Diagnosis made = diagnose(experiment, named(experiment, {"sensor_offset", "hub_inertia"}));
  EXPECT_NE(made.verdict, Verdict::adequate) << to_string(made.verdict);
  ASSERT_EQ(made.causes.size(), 1U);
  EXPECT_EQ(made.causes[0].sensor, "hub_velocity");
  // Twelve readings of 8000 are wrong by 1 rad/s: 0.0015 rad/s on average.
  EXPECT_NEAR(made.causes[0].parameters.front().value, kOffset, 0.06 * kOffset);
}

Experiment of_the_hub_alone(Experiment experiment) {
  for (auto& run : experiment.runs) {
    auto& channels = std::get<measured::TimeRecord>(run.data).channels;
    std::erase_if(channels, [](const measured::Channel& channel) {
      return channel.sensor.kind != arm::SensorKind::hub_angle;
    });
  }
  return experiment;
}

bool exceeds_noise_of_one_sensor(const Experiment& experiment) {
  const Problem white(experiment);
  return exceeds_noise_of_one_sensor(*white.with_coloured_noise(white.as_filed()), white);
}

TEST(ColouredNoiseModel, OfOneSensorIsNotFarAboveItsWhiteNoise) {
  const Experiment far_above = with_added(simulated_experiment({}), drift);
  EXPECT_TRUE(exceeds_noise_of_one_sensor(of_the_hub_alone(far_above)));
  EXPECT_FALSE(exceeds_noise_of_one_sensor(far_above));
  const Experiment near = with_added(simulated_experiment({}), first_order);
  EXPECT_FALSE(exceeds_noise_of_one_sensor(of_the_hub_alone(near)));
}

/// Returns the p-value of an experiment as it is filed, beside coloured noise of what that leaves.
double dependence_of(const Experiment& experiment) {
  const Problem white(experiment);
  const auto coloured = white.with_coloured_noise(white.as_filed());
  ReportedWork work({});
  return dependence_p_value(*coloured, coloured->as_filed(), work);
}

TEST(Dependence, IsSeenOfWhatAnEffectChangesAndNotOfNoise) {
  const auto dependence = [](const arm::Effects& hidden) {
    return dependence_of(with_added(simulated_experiment(hidden), first_order));
  };
  EXPECT_GT(dependence({}), 0.01);
  EXPECT_LT(dependence({effects::named("torque_gain", {{"factor", 0.9}})}), 1e-6);
  // A cable that pulls beyond 0.05 rad: no effect of the library.
  const arm::HubTorqueTable cable{.angle_rad = {-0.3, -0.05, 0.05, 0.3},
                                  .torque_N_m = {0.05, 0.0, 0.0, -0.05}};
  const arm::Effects law = {
      {std::string(arm::kHubTorqueTable), {.definition = arm::define_effect(cable)}}};
  EXPECT_LT(dependence(law), 1e-6);
}

/// Readings go from those of a stiffer beam to those of a softer one, about as a beam's that warms;
/// as filed it is midway.
Experiment softening(double factor) {
  Experiment made = simulated_experiment({});
  const Experiment soft =
      simulated_experiment({effects::named("flexural_rigidity", {{"factor", factor}})});
  for (std::size_t r = 0; r < made.runs.size(); ++r) {
    auto& record = std::get<measured::TimeRecord>(made.runs[r].data);
    const auto& other = std::get<measured::TimeRecord>(soft.runs[r].data);
    for (std::size_t c = 0; c < record.channels.size(); ++c) {
      auto& values = record.channels[c].values;
      for (std::size_t k = 0; k < values.size(); ++k) {
        const double part = static_cast<double>(k) / static_cast<double>(values.size()) - 0.5;
        values[k] = std::lerp(values[k], other.channels[c].values[k], part);
      }
    }
  }
  return made;
}

/// A tenth of another random torque acts beside the recorded one of the estimation runs: the arm is
/// linear.
Experiment with_unrecorded_torque() {
  constexpr double kPart = 0.1;
  Experiment made = simulated_experiment({});
  const Experiment other = simulated_experiment({}, {.seed = 2});
  for (std::size_t r = 0; r < made.runs.size(); ++r) {
    if (made.runs[r].run.purpose != measured::Purpose::estimation) continue;
    auto& record = std::get<measured::TimeRecord>(made.runs[r].data);
    const auto& more = std::get<measured::TimeRecord>(other.runs[r].data);
    for (std::size_t c = 0; c < record.channels.size(); ++c) {
      std::ranges::transform(record.channels[c].values, more.channels[c].values,
                             record.channels[c].values.begin(),
                             [](double one, double two) { return one + kPart * two; });
    }
  }
  return made;
}

TEST(Dependence, IsSeenOfATorqueThatNobodyRecorded) {
  EXPECT_LT(dependence_of(with_unrecorded_torque()), 1e-6);
}

TEST(Dependence, IsSeenOfANumberThatDrifts) {
  EXPECT_LT(dependence_of(softening(0.99)), 1e-6);
  EXPECT_GT(dependence_of(softening(1.0)), 0.01);
}

}  // namespace
}  // namespace flexarm::diagnose
