#include "diagnose/planning/separation.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace flexarm::diagnose {

namespace {

using Eigen::Index;

/// Rivals nearer than this, or with a lead below `kNearLead` by their cosine, are fitted.
constexpr double kNearCosine = 0.9;
constexpr double kNearLead = 5.0 * kToldLead;
/// A lead is asked for to a part of what tells.
constexpr FitOptions kRivalFit{.most_steps = 10, .tolerance = 1e-4};

/// Places of a parameter without a neutral place, of one, two or more of them.
std::vector<double> other_places(std::size_t others) {
  if (others == 1) return {0.0, 0.15, 0.3, 0.5, 0.7, 0.85, 1.0};
  return {0.1, 0.3, 0.5, 0.7, 0.9};
}

double penalty(std::size_t truth_parameters, std::size_t rival_parameters, double count) {
  return (static_cast<double>(truth_parameters) - static_cast<double>(rival_parameters)) *
         std::log(std::max(2.0, count));
}

}  // namespace

double fitted_count(const Problem& problem) {
  const auto& channels = problem.observations().channels;
  return std::accumulate(channels.begin(), channels.end(), 0.0,
                         [&](double sum, const ObservedChannel& channel) {
                           const bool counts = problem.estimation_runs()[channel.run];
                           return sum + (counts ? static_cast<double>(channel.used()) : 0.0);
                         });
}

Candidate joined(const Candidate& unknowns, const Candidate& effect) {
  return unknowns.with(effect.effects.front(), effect.values);
}

std::vector<Shape> shapes_of(const PlannedExperiment& planned, const Detection& detection) {
  std::vector<Shape> made;
  const auto add = [&](const Candidate& candidate) {
    if (auto change = planned.change_by(candidate); change && change->squaredNorm() > 0.0) {
      made.push_back({candidate, change->cast<float>()});
    }
  };
  const Hypothesis& hypothesis = detection.hypothesis;
  if (detection.compared) add(*detection.compared);
  const auto growths = growths_of(hypothesis);
  if (growths.empty() && hypothesis.parameters.size() == 1) {
    for (const double place : {0.0, 1.0}) {
      Candidate candidate{{hypothesis}, {}};
      candidate.put(Eigen::VectorXd::Constant(1, place));
      add(candidate);
    }
  }
  for (const Growth& growth : growths) {
    // As far from neutral as the effect is compared at; the end of the range where it does not
    // show.
    double strength = 1.0;
    if (detection.compared) {
      const Eigen::VectorXd places = detection.compared->coordinates();
      for (std::size_t i = 0; i < hypothesis.parameters.size(); ++i) {
        const auto neutral = hypothesis.parameters[i].neutral_coordinate();
        if (!neutral) continue;
        const double room = std::max(*neutral, 1.0 - *neutral);
        strength = std::min(1.0, std::abs(places(static_cast<Index>(i)) - *neutral) / room);
      }
    }
    std::vector<Growth> variants = {growth};
    for (std::size_t other = 0; other < growth.other_places.size(); ++other) {
      std::vector<Growth> more;
      for (const Growth& variant : variants) {
        for (const double place : other_places(growth.other_places.size())) {
          more.push_back(variant);
          more.back().other_places[other] = place;
        }
      }
      variants = std::move(more);
    }
    for (const Growth& variant : variants) add(variant.at(strength));
  }
  return made;
}

Eigen::MatrixXd information_of(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residuals) {
  Eigen::MatrixXd both(residuals.size(), jacobian.cols() + 1);
  both << jacobian, residuals;
  return both.transpose() * both;
}

double expected_lead(const Eigen::MatrixXd& information, std::size_t truth_parameters,
                     double count) {
  const Index k = information.cols() - 1;
  const Eigen::VectorXd slope = information.col(k).head(k);
  double left = information(k, k);
  if (k > 0) {
    // Places in units of their own information, so that the rank does not depend on their scale.
    const Eigen::VectorXd scale =
        information.diagonal().head(k).cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd scaled =
        scale.asDiagonal() * information.topLeftCorner(k, k) * scale.asDiagonal();
    const Eigen::VectorXd right = scale.cwiseProduct(slope);
    left -= right.dot(scaled.completeOrthogonalDecomposition().solve(right));
  }
  return std::max(0.0, left) - penalty(truth_parameters, static_cast<std::size_t>(k), count);
}

Separation separate_by_fit(const Problem& problem, const Candidate& truth, const Candidate& rival) {
  const Fit fitted = fit(problem, rival, kRivalFit);
  Separation made;
  made.is_fitted = true;
  made.rival = fitted.candidate;
  made.lead = fitted.sum_of_squares -
              penalty(truth.values.size(), rival.values.size(), fitted_count(problem));
  made.information = information_of(fitted.jacobian, fitted.residuals);
  return made;
}

Separation separate(const Problem& problem, const Candidate& unknowns, const Shape& truth,
                    const std::vector<Shape>& rival) {
  Separation made;
  const Shape* nearest = nullptr;
  for (const Shape& shape : rival) {
    const double cosine = static_cast<double>(shape.change.dot(truth.change) /
                                              (shape.change.norm() * truth.change.norm()));
    if (nearest != nullptr && cosine <= made.cosine) continue;
    nearest = &shape;
    made.cosine = cosine;
  }
  const double squares = static_cast<double>(truth.change.squaredNorm());
  const double part = std::max(0.0, made.cosine);
  if (nearest == nullptr) {
    made.lead = squares;
    return made;
  }
  const std::size_t parameters = truth.candidate.values.size();
  made.rival = nearest->candidate;
  made.lead = squares * (1.0 - part * part) -
              penalty(parameters, nearest->candidate.values.size(), fitted_count(problem));
  if (part < kNearCosine && made.lead > kNearLead) return made;
  const double cosine = made.cosine;
  made = separate_by_fit(problem, joined(unknowns, truth.candidate),
                         joined(unknowns, nearest->candidate));
  made.cosine = cosine;
  return made;
}

}  // namespace flexarm::diagnose
