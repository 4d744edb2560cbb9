#include "diagnose/search/torque_noise.hpp"

#include "diagnose/noise_floor.hpp"
#include "response/time/random_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <variant>

namespace flexarm::diagnose {

namespace {

/// Of a normal variable, over the median of its absolute value.
constexpr double kDeviationOfMedian = 1.4826;

double minus_two_log_likelihood(const Problem& problem, const arm::Arm& arm,
                                const NoiseModel& noise) {
  double sum = 0.0;
  for (const RunInnovations& run :
       problem.predictor().innovations(arm, problem.estimation_runs(), noise)) {
    sum += run.standardised.squaredNorm() + run.log_determinant;
  }
  return sum;
}

}  // namespace

double torque_noise_N_m(std::span<const double> torque_N_m) {
  if (torque_N_m.size() < 2) return 0.0;
  std::vector<double> changes;
  double squares = torque_N_m[0] * torque_N_m[0];
  for (std::size_t k = 1; k < torque_N_m.size(); ++k) {
    changes.push_back(std::abs(torque_N_m[k] - torque_N_m[k - 1]));
    squares += torque_N_m[k] * torque_N_m[k];
  }
  const auto middle = changes.begin() + std::ssize(changes) / 2;
  std::ranges::nth_element(changes, middle);
  const double by_changes = kDeviationOfMedian * *middle / std::numbers::sqrt2;
  const double noise = std::min(by_changes, white_noise(torque_N_m));
  const double rms = std::sqrt(squares / static_cast<double>(torque_N_m.size()));
  return noise < kMostTorqueNoise * rms ? noise : 0.0;
}

std::vector<double> torque_noise_N_m(const Experiment& experiment) {
  std::vector<double> made;
  for (const auto& run : experiment.runs) {
    const auto* record = std::get_if<measured::TimeRecord>(&run.data);
    made.push_back(record == nullptr ? 0.0 : torque_noise_N_m(record->torque_N_m));
  }
  return made;
}

std::vector<double> errors_of_torque(const Problem& problem) {
  const std::vector<double> noise_N_m = torque_noise_N_m(problem.experiment());
  const Observations& observations = problem.observations();
  const arm::Arm& arm = problem.experiment().arm;
  const int modes = problem.predictor().flexible_modes();
  const arm::Deadline& deadline = problem.predictor().deadline();
  const std::vector<bool> all(problem.experiment().runs.size(), true);
  std::vector<double> squares(observations.channels.size(), 0.0);
  response::RandomNumbers random(1);
  try {
    const Eigen::VectorXd simulated =
        Predictor(problem.experiment(), observations, modes, {}, deadline)(arm, all);
    for (int draw = 0; draw < kTorqueDraws; ++draw) {
      Experiment noisy = problem.experiment();
      for (std::size_t r = 0; r < noisy.runs.size(); ++r) {
        auto* record = std::get_if<measured::TimeRecord>(&noisy.runs[r].data);
        if (record == nullptr) continue;
        for (double& torque : record->torque_N_m) torque += noise_N_m[r] * random.normal();
      }
      const Eigen::VectorXd off =
          Predictor(noisy, observations, modes, {}, deadline)(arm, all) - simulated;
      for (std::size_t c = 0; c < squares.size(); ++c) {
        const ObservedChannel& channel = observations.channels[c];
        const auto signal = observations.values.segment(channel.first, channel.count).array();
        squares[c] += off.segment(channel.first, channel.count).squaredNorm() /
                      (signal - signal.mean()).matrix().squaredNorm() / kTorqueDraws;
      }
    }
  } catch (const std::runtime_error&) {
    return std::vector<double>(squares.size(), 0.0);
  }
  for (double& square : squares) square = std::sqrt(square);
  return squares;
}

std::optional<Problem> with_torque_noise(const Problem& problem) {
  const NoiseModel noise{.torque_noise_N_m = torque_noise_N_m(problem.experiment())};
  if (std::ranges::max(noise.torque_noise_N_m) == 0.0) return std::nullopt;
  const std::vector<double> errors = errors_of_torque(problem);
  const auto& channels = problem.observations().channels;
  for (std::size_t c = 0; c < errors.size(); ++c) {
    if (errors[c] >= kLeastTorqueError * channels[c].noise) {
      return problem.with_torque_noise(noise, errors);
    }
  }
  return std::nullopt;
}

bool torque_noise_is_likely(const Problem& problem, const arm::Arm& arm) {
  const NoiseModel& noise = problem.predictor().noise().value();
  const double cost = minus_two_log_likelihood(problem, arm, noise);
  return std::ranges::all_of(kOtherTorqueNoise, [&](double factor) {
    NoiseModel other = noise;
    for (double& torque_N_m : other.torque_noise_N_m) torque_N_m *= factor;
    return cost < minus_two_log_likelihood(problem, arm, other);
  });
}

}  // namespace flexarm::diagnose
