#include "export/samples/arm_samples.hpp"

#include "arm/input_error.hpp"
#include "response/arm_parts.hpp"
#include "response/time/random_numbers.hpp"

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace flexarm::samples {

namespace {

using Eigen::Index;

/// R with R R^T = correlation, which rounding may have left a little indefinite.
Eigen::MatrixXd root_of(const Eigen::MatrixXd& correlation) {
  if (correlation.size() == 0) return correlation;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(correlation);
  const Eigen::VectorXd scale = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  return solver.eigenvectors() * scale.asDiagonal();
}

double value_at(const Marginal& marginal, double deviate) {
  if (!marginal.is_logarithmic) return marginal.value + marginal.std_error * deviate;
  return marginal.value * std::exp(marginal.std_error / std::abs(marginal.value) * deviate);
}

/// The arm with these numbers; empty where it does not allow them.
std::optional<arm::Arm> arm_with(const ArmDistribution& set, const std::vector<double>& values) {
  try {
    arm::Arm made = set.arm;
    for (std::size_t i = 0; i < values.size(); ++i) {
      put_number(made, set.marginals[i].key, values[i]);
    }
    arm::require_valid(made);
    response::take_apart(made);
    return made;
  } catch (const arm::InputError&) {
    return std::nullopt;
  }
}

std::vector<SampledNumber> numbers_of(const ParameterPosterior& posterior) {
  std::vector<SampledNumber> made;
  for (const ArmDistribution& set : posterior.sets) {
    for (const Marginal& marginal : set.marginals) {
      if (std::ranges::find(made, marginal.key, &SampledNumber::key) != made.end()) continue;
      made.push_back({marginal.key, marginal.unit});
    }
  }
  return made;
}

}  // namespace

ArmSamples draw(const ParameterPosterior& posterior, std::size_t count, std::uint64_t seed) {
  ArmSamples made{.numbers = numbers_of(posterior), .samples = {}};
  std::vector<Eigen::MatrixXd> roots;
  for (const ArmDistribution& set : posterior.sets) roots.push_back(root_of(set.correlation));
  const auto add = [&](std::size_t at, arm::Arm arm, const std::vector<double>& values) {
    const auto& marginals = posterior.sets[at].marginals;
    ArmSample sample{at, std::move(arm), {}};
    sample.values.assign(made.numbers.size(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto column = std::ranges::find(made.numbers, marginals[i].key, &SampledNumber::key);
      sample.values[static_cast<std::size_t>(column - made.numbers.begin())] = values[i];
    }
    made.samples.push_back(std::move(sample));
  };
  std::vector<double> values;
  for (const Marginal& marginal : posterior.sets.front().marginals) {
    values.push_back(marginal.value);
  }
  add(0, posterior.sets.front().arm, values);
  response::RandomNumbers random(seed);
  for (std::size_t k = 0; k < count; ++k) {
    double place = random.uniform();
    std::size_t at = 0;
    while (at + 1 < posterior.sets.size() && place >= posterior.sets[at].probability) {
      place -= posterior.sets[at++].probability;
    }
    const ArmDistribution& set = posterior.sets[at];
    values.resize(set.marginals.size());
    Eigen::VectorXd deviates(std::ssize(values));
    std::optional<arm::Arm> arm;
    for (int draws = 0; !arm; ++draws) {
      if (draws == kMostDraws) {
        throw arm::InputError(
            fmt::format("samples: in {} draws of the numbers of {} there is none that the arm "
                        "allows",
                        kMostDraws, set.effects.empty() ? "the arm" : set.effects));
      }
      for (double& deviate : deviates) deviate = random.normal();
      const Eigen::VectorXd correlated = roots[at] * deviates;
      for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = value_at(set.marginals[i], correlated(static_cast<Index>(i)));
      }
      arm = arm_with(set, values);
      if (!arm) ++made.rejected;
    }
    add(at, std::move(*arm), values);
  }
  return made;
}

}  // namespace flexarm::samples
