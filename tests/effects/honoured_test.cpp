// Every effect is honoured where its ports are, and refused by name where they are not.
#include "arm/input_error.hpp"
#include "diagnose/planning/detection.hpp"
#include "diagnose/search/hypothesis.hpp"
#include "diagnose/search/problem.hpp"
#include "effects/registry/vocabulary.hpp"
#include "laws/effect_arms.hpp"
#include "response/formulation_maker.hpp"
#include "response/frequency/frequency_response.hpp"
#include "response/time/arm_simulator.hpp"
#include "response/time/time_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::effects {
namespace {

constexpr int kModes = 4;

std::vector<arm::Sensor> sensors() {
  return {arm::parse_sensor("hub_angle"), arm::parse_sensor("hub_velocity"),
          arm::parse_sensor("tip_acceleration"), arm::parse_sensor("strain@0.05"),
          arm::parse_sensor("strain@0")};
}

class Honoured : public testing::TestWithParam<std::string> {
 protected:
  const Entry& entry() const { return *find(GetParam()); }
  arm::Arm ideal() const { return laws::damped_arm(); }
  arm::Arm with_effect() const {
    arm::Arm arm = laws::damped_arm();
    arm.effects[GetParam()] = example(entry().definition);
    return arm;
  }
};

/// Damped poles and the zeros of all sensors.
std::vector<std::complex<double>> roots(const response::AnyFormulation& formulation) {
  std::vector<std::complex<double>> all;
  const auto poles = response::damped_poles(formulation, kModes);
  all.push_back(poles.lowest.first_rad_per_s);
  for (const auto& pair : poles.flexible) all.push_back(pair.first_rad_per_s);
  for (const auto& sensor : sensors()) {
    const auto zeros = response::zeros(formulation, sensor, 3).s_rad_per_s;
    all.insert(all.end(), zeros.begin(), zeros.end());
  }
  return all;
}

TEST_P(Honoured, ByThreeFormulationsOrRefusedWithNameAndPort) {
  // The least that an example moves a root or a hub inertia moves the rigid body, relative.
  constexpr double kMoved = 1e-6;
  for (const auto name : response::kFormulationNames) {
    const auto without = roots(response::make_formulation(name, ideal(), kModes));
    if (entry().definition->is_of_linear_arm()) {
      const auto with = roots(response::make_formulation(name, with_effect(), kModes));
      double largest = 0.0;
      for (std::size_t i = 0; i < std::min(with.size(), without.size()); ++i) {
        largest = std::max(largest, std::abs(with[i] - without[i]) / (1.0 + std::abs(without[i])));
      }
      EXPECT_GT(largest, kMoved) << name;
      continue;
    }
    try {
      if (name == exact_tf::ExactArm::kName) exact_tf::ExactArm{with_effect()};
      if (name == fem::FemArm::kName) fem::FemArm{with_effect()};
      if (name == assumed_modes::AssumedModesArm::kName) {
        assumed_modes::AssumedModesArm{with_effect()};
      }
      ADD_FAILURE() << name << " accepted " << GetParam();
    } catch (const arm::InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(GetParam()));
      EXPECT_THAT(
          error.what(),
          testing::HasSubstr(std::string(arm::to_string(entry().definition->ports().front()))));
    }
  }
}

constexpr double kSample_s = 2e-3;

std::vector<double> square_wave() {
  std::vector<double> torque;
  for (int k = 0; k < 500; ++k) torque.push_back(k % 120 < 60 ? 0.15 : -0.12);
  return torque;
}

/// The readings of `sensors()`, a row a sample.
Eigen::MatrixXd simulated(const arm::Arm& arm, int modes) {
  const auto parts = response::take_apart(arm);
  const auto model = response::time_model(
      response::make_formulation("exact_tf", parts.linear, modes), parts, modes, sensors());
  return response::ArmSimulator(model, parts, sensors(),
                                response::options_of_fit(kSample_s, response::TorqueHold::zero))
      .readings(square_wave());
}

TEST_P(Honoured, ByASimulationInTime) {
  const Eigen::MatrixXd without = simulated(ideal(), kModes);
  const Eigen::MatrixXd with = simulated(with_effect(), kModes);
  constexpr double kSeen = 1e-5;  // relative: shear of a slender beam is the least
  const Eigen::RowVectorXd changes = (with - without).colwise().norm();
  const Eigen::RowVectorXd sizes = without.colwise().norm();
  EXPECT_GT(changes.cwiseQuotient(sizes).maxCoeff(), kSeen);
}

TEST_P(Honoured, ByWhatADiagnosisFits) {
  constexpr double kLeft = 1e-3;  // the same equations: no more than rounding
  measured::TimeRecord record;
  record.torque_N_m = square_wave();
  // A mass on a spring has a mode beside those of the beam.
  const int own_modes = GetParam() == "tuned_mass" ? 1 : 0;
  const Eigen::MatrixXd readings = simulated(with_effect(), kModes + own_modes);
  for (Eigen::Index k = 0; k < readings.rows(); ++k) {
    record.time_s.push_back(kSample_s * static_cast<double>(k));
  }
  for (std::size_t j = 0; j < sensors().size(); ++j) {
    const auto column = readings.col(static_cast<Eigen::Index>(j));
    record.channels.push_back({sensors()[j], {column.begin(), column.end()}});
  }
  measured::Run run;
  run.id = "square";
  run.purpose = measured::Purpose::estimation;
  diagnose::Experiment experiment;
  experiment.arm = ideal();
  experiment.runs.push_back({run, std::move(record)});
  const diagnose::Problem problem(experiment, {.flexible_modes = kModes});
  const auto misfit = [&](const diagnose::Candidate& candidate) {
    const auto residuals = problem.residuals(candidate, problem.estimation_runs());
    return residuals ? residuals->norm() : std::numeric_limits<double>::infinity();
  };
  double least = std::numeric_limits<double>::infinity();
  for (const auto& hypothesis : diagnose::hypotheses(experiment)) {
    if (hypothesis.effect != GetParam()) continue;
    std::vector<double> values;
    for (const auto& parameter : entry().definition->parameters) {
      values.push_back(parameter.example);
    }
    least = std::min(least, misfit(diagnose::Candidate{}.with(hypothesis, values)));
  }
  EXPECT_LT(least, kLeft * misfit({}));
}

TEST_P(Honoured, ByAPlan) {
  constexpr double kNoise = 1e-4;  // shear of a slender beam is the least that has to show
  constexpr double kLeastGain = 10.0;
  diagnose::PlannedRun run;
  run.id = "square";
  run.torque = square_wave();
  run.duration_s = kSample_s * static_cast<double>(square_wave().size());
  run.sample_time_s = kSample_s;
  for (const auto& sensor : sensors()) run.sensors.push_back({sensor, kNoise});
  const diagnose::PlannedExperiment planned(ideal(), {run});
  const auto all = diagnose::hypotheses(planned.experiment());
  const auto hypothesis = std::ranges::find(all, GetParam(), &diagnose::Hypothesis::effect);
  ASSERT_NE(hypothesis, all.end());
  const auto found = diagnose::detect(planned, *hypothesis, kLeastGain);
  EXPECT_TRUE(found.shows);
  EXPECT_EQ(found.smallest.has_value(), !diagnose::growths_of(*hypothesis).empty());
}

TEST_P(Honoured, ShowsInFrequencyResponsesAsItSays) {
  const std::vector<double> frequencies = {1.0, 5.0, 15.0, 40.0};
  const auto responses = [&](const arm::Arm& arm) {
    const auto parts = response::take_apart(arm);
    return response::frequency_response(response::make_formulation("exact_tf", arm, 1),
                                        response::linear_chain(parts), sensors(), frequencies)
        .values;
  };
  const bool differs = responses(with_effect()) != responses(ideal());
  EXPECT_EQ(differs, entry().shows != Shows::in_time);
  EXPECT_EQ(entry().definition->is_of_linear_arm(), entry().shows == Shows::in_all);
}

INSTANTIATE_TEST_SUITE_P(Effects, Honoured, testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const Entry& entry : entries()) {
                             names.push_back(entry.definition->name);
                           }
                           return names;
                         }()),
                         [](const auto& name) { return name.param; });

/// A law with a state of its own: torque -k z with z' = (velocity - z)/T on a rigid hub of inertia
/// I. With a torque tau from rest, w = sqrt(k/(I T) - 1/(4 T^2)),
///
///     velocity = tau/k (1 + e^(-t/(2 T)) (-cos(w t) + (k/I - 1/(2 T))/w sin(w t))).
TEST(HubLawWithAState, FollowsItsClosedForm) {
  constexpr double kLag_s = 0.05;
  constexpr double kCoefficient = 0.2;
  constexpr double kInertia = 0.01;
  constexpr double kTorque = 0.05;
  // A thousand steps of an error of order 4, the step a tenth of the law's own time.
  constexpr double kOrderFour = 1e-6;
  auto parts = response::take_apart(arm::paper_arm());
  parts.hub.smooth.push_back(
      {"lagging_friction",
       {[](const arm::HubState& hub, std::span<const double> z, std::span<double> rates) {
          rates[0] = (hub.velocity_rad_per_s - z[0]) / kLag_s;
          return arm::SmoothHubTorque::Value{-kCoefficient * z[0], 0.0};
        },
        1}});
  arm::ModalModel hub;
  hub.modal_mass_kg_m2 = kInertia;
  hub.modes = {
      {.omega_rad_per_s = 0.0, .hub_slope = 1.0, .sensor_values = {1.0}, .displacement_m = {}}};
  hub.damping_rad_per_s = {0.0};
  const std::vector<arm::Sensor> sensor = {arm::parse_sensor("hub_velocity")};
  const std::vector<double> torque(1000, kTorque);
  const auto made = response::simulate(hub, parts, sensor, torque,
                                       {.sample_time_s = 5e-3, .substeps = 4, .energy = false});
  const double w = std::sqrt(kCoefficient / (kInertia * kLag_s) - 0.25 / (kLag_s * kLag_s));
  for (std::size_t k = 0; k < made.time_s.size(); ++k) {
    const double t = made.time_s[k];
    const double swing =
        std::exp(-0.5 * t / kLag_s) *
        (-std::cos(w * t) + (kCoefficient / kInertia - 0.5 / kLag_s) / w * std::sin(w * t));
    const double expected = kTorque / kCoefficient * (1.0 + swing);
    ASSERT_NEAR(made.channels[0][k], expected, kOrderFour * kTorque / kCoefficient) << t;
  }
}

}  // namespace
}  // namespace flexarm::effects
