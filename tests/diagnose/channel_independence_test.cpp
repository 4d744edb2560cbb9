#include "diagnose/search/channel_independence.hpp"

#include "tests/diagnose/simulated_experiments.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <variant>
#include <vector>

namespace flexarm::diagnose {
namespace {

/// False alarms of so many fixed draws are improbable below this.
constexpr double kNoAlarm = 0.01;
constexpr double kAlarm = 1e-6;

class ChannelIndependence : public testing::Test {
 protected:
  /// White noise of unit variance in each channel, and `common` at each sample of these sensors.
  double p_value(const std::vector<std::string>& sensors,
                 const std::function<double(double part_of_run, double normal)>& common) const {
    Eigen::VectorXd residuals(problem_.residual_count());
    std::normal_distribution<double> normal;
    std::mt19937_64 engine(5);
    for (double& value : residuals) value = normal(engine);
    for (const ObservedChannel& channel : problem_.observations().channels) {
      std::mt19937_64 of_run(channel.run);  // the same for all sensors of the run
      for (Eigen::Index k = 0; k < channel.count; ++k) {
        const double part = static_cast<double>(k) / static_cast<double>(channel.count);
        const double more = common(part, normal(of_run));
        if (std::ranges::find(sensors, channel.sensor) != sensors.end()) {
          residuals(channel.first + k) += more;
        }
      }
    }
    return independence_p_value(problem_, residuals, problem_.estimation_runs());
  }

  const Experiment experiment_ = simulated_experiment({});
  const Problem problem_ = Problem(experiment_);
};

TEST_F(ChannelIndependence, IsNotRejectedOfNoiseOfEachSensor) {
  EXPECT_GT(p_value({}, [](double, double) { return 0.0; }), kNoAlarm);
}

TEST_F(ChannelIndependence, IsRejectedOfNoiseThatTwoPlacesShare) {
  const auto third_of_power = [](double, double normal) { return std::sqrt(0.5) * normal; };
  EXPECT_LT(p_value({"hub_velocity", "tip_acceleration"}, third_of_power), kAlarm);
}

TEST_F(ChannelIndependence, IsRejectedOfAShortTimeThatTwoPlacesShare) {
  const auto impact = [](double part, double normal) {
    return part > 0.5 && part < 0.52 ? 5.0 * normal : 0.0;
  };
  EXPECT_LT(p_value({"hub_velocity", "tip_acceleration"}, impact), kAlarm);
}

TEST_F(ChannelIndependence, IsNotRejectedOfAmplifiersThatWarmTogether) {
  const auto drift = [](double part, double) { return 2.0 * (1.0 - std::exp(-2.0 * part)); };
  EXPECT_GT(p_value({"hub_velocity", "tip_acceleration"}, drift), kNoAlarm);
}

TEST_F(ChannelIndependence, IsOfSensorsAtDifferentPlaces) {
  const auto all = [](double, double normal) { return normal; };
  EXPECT_GT(p_value({"hub_angle", "hub_velocity"}, all), kNoAlarm);
}

TEST_F(ChannelIndependence, IsOfRunsWithTwoSensors) {
  Experiment experiment = simulated_experiment({});
  for (auto& run : experiment.runs) {
    std::get<measured::TimeRecord>(run.data).channels.resize(1);
  }
  const Problem problem(experiment);
  const Eigen::VectorXd residuals = Eigen::VectorXd::Ones(problem.residual_count());
  EXPECT_EQ(independence_p_value(problem, residuals, problem.estimation_runs()), 1.0);
}

}  // namespace
}  // namespace flexarm::diagnose
