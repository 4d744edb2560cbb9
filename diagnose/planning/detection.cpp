#include "diagnose/planning/detection.hpp"

#include "diagnose/search/misfit.hpp"

#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace flexarm::diagnose {

namespace {

using Eigen::Index;

constexpr double kMiddle = 0.5;
/// Strengths are looked for from here to 1.
constexpr double kLeastStrength = 1e-6;
constexpr double kStrengthError = 1e-2;
constexpr std::uintmax_t kMostTrials = 30;
/// Room, in places, that a direction needs beside the neutral place.
constexpr double kRoom = 1e-6;

double change_norm(const PlannedExperiment& planned, const Candidate& candidate) {
  const auto change = planned.change_by(candidate);
  return change ? change->norm() : std::numeric_limits<double>::infinity();
}

/// The strength at which the change has this norm; nothing where it stays below.
std::optional<double> strength_of(const PlannedExperiment& planned, const Growth& growth,
                                  double change) {
  constexpr double kFar = 100.0;
  const auto ratio = [&](double log_strength) {
    const double norm = change_norm(planned, growth.at(std::exp(log_strength)));
    return std::clamp(std::log(norm / change), -kFar, kFar);
  };
  const double low = std::log(kLeastStrength);
  const double at_low = ratio(low);
  const double at_high = ratio(0.0);
  if (at_high < 0.0) return std::nullopt;
  if (at_low >= 0.0) return kLeastStrength;
  std::uintmax_t trials = kMostTrials;
  const auto [below, above] = boost::math::tools::toms748_solve(
      ratio, low, 0.0, at_low, at_high,
      [](double a, double b) { return std::abs(b - a) < kStrengthError; }, trials);
  return std::exp(0.5 * (below + above));
}

}  // namespace

Candidate Growth::at(double strength) const {
  Candidate made{{hypothesis}, std::vector<double>(hypothesis.parameters.size())};
  std::size_t other = 0;
  std::optional<double> share;  // of its highest value that the first that grows from 0 has
  for (std::size_t i = 0; i < hypothesis.parameters.size(); ++i) {
    const SearchedParameter& parameter = hypothesis.parameters[i];
    const auto neutral = parameter.neutral_coordinate();
    if (!neutral) {
      made.values[i] = parameter.value(other_places[other++]);
    } else if (parameter.spacing == effects::Spacing::from_zero && share) {
      made.values[i] = *share * parameter.highest;
      if (parameter.above_previous) made.values[i] += made.values[i - 1];
    } else {
      made.values[i] = parameter.value(*neutral + strength * ((downward ? 0.0 : 1.0) - *neutral));
      if (parameter.spacing == effects::Spacing::from_zero)
        share = made.values[i] / parameter.highest;
    }
  }
  return made;
}

std::vector<Growth> growths_of(const Hypothesis& hypothesis) {
  Growth growth{hypothesis, false, {}};
  double up = 0.0;
  double down = 0.0;
  for (const SearchedParameter& parameter : hypothesis.parameters) {
    if (const auto neutral = parameter.neutral_coordinate()) {
      up = std::max(up, 1.0 - *neutral);
      // What is below 0 in a log, as a torque that is logged late, is no matter of the experiment.
      if (parameter.spacing != effects::Spacing::about_zero) down = std::max(down, *neutral);
    } else {
      growth.other_places.push_back(kMiddle);
    }
  }
  std::vector<Growth> made;
  if (up > kRoom) made.push_back(growth);
  growth.downward = true;
  if (down > kRoom) made.push_back(growth);
  return made;
}

double detectable_change(const Problem& problem, std::size_t parameters, double least_gain) {
  const Observations& observations = problem.observations();
  Misfit noise =
      misfit(observations, problem.experiment(), Eigen::VectorXd::Zero(observations.values.size()),
             problem.estimation_runs());
  const double information =
      least_gain + static_cast<double>(parameters) * std::log(std::max(2.0, noise.count));
  // excess() is 0 up to this sum of squares, of which the noise itself makes `count`.
  const double beyond_noise = kNoiseKnown * noise.count + kChance * std::sqrt(2.0 * noise.count);
  return std::sqrt(std::max(information, beyond_noise));
}

Detection detect(const PlannedExperiment& planned, const Hypothesis& hypothesis,
                 double least_gain) {
  const double found =
      detectable_change(planned.as_described(), hypothesis.parameters.size(), least_gain);
  Detection made;
  made.hypothesis = hypothesis;
  const auto growths = growths_of(hypothesis);
  if (growths.empty()) {
    Candidate middle{{hypothesis}, {}};
    middle.put(
        Eigen::VectorXd::Constant(static_cast<Index>(hypothesis.parameters.size()), kMiddle));
    made.largest_change = change_norm(planned, middle);
    made.shows = made.largest_change >= found;
    made.compared_change = made.largest_change;
    if (made.shows) made.compared = std::move(middle);
    return made;
  }
  for (const Growth& growth : growths) {
    made.largest_change = std::max(made.largest_change, change_norm(planned, growth.at(1.0)));
    const auto strength = strength_of(planned, growth, found);
    if (!strength) continue;
    made.shows = true;
    made.smallest = growth.at(*strength);
    made.compared = growth.at(strength_of(planned, growth, kCompared * found).value_or(1.0));
    made.compared_change = change_norm(planned, *made.compared);
    break;
  }
  return made;
}

}  // namespace flexarm::diagnose
