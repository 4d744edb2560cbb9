#pragma once

#include "diagnose/planning/detection.hpp"
#include "diagnose/search/fit.hpp"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace flexarm::diagnose {

/// An effect that is there, held against another that is not.
struct Separation {
  /// Of the changes that the two make to the data in standard deviations; the largest of the
  /// rival's directions.
  double cosine = 0.0;
  /// Information by which the effect is expected to lead the rival, refitted; with data without
  /// noise, which lowers or raises both alike.
  double lead = 0.0;
  /// The lead is of a fit; else (1 - cosine^2) of the change, for rivals that are far.
  bool is_fitted = false;
  Candidate rival;  ///< where its fit ended, behind the unknowns, or where it is nearest
  /// [J r]'[J r] of the fit's residuals r and their derivatives J by places: what the runs say of
  /// the two, which adds up over runs. Empty unless fitted.
  Eigen::MatrixXd information;
};

/// Rivals that are led by less cannot be told (Selection's exchange, diagnosis.cpp).
inline constexpr double kToldLead = 10.0;

/// A change that some value of an effect makes.
struct Shape {
  Candidate candidate;
  Eigen::VectorXf change;  ///< single precision is enough for cosines, and half the room
};
/// The changes of an effect at the strength it is compared at, in both directions and at several
/// places of the parameters that have no neutral place.
std::vector<Shape> shapes_of(const PlannedExperiment& planned, const Detection& detection);

/// The unknowns of an experiment and one effect.
Candidate joined(const Candidate& unknowns, const Candidate& effect);

/// `truth` against the rival that has these shapes. `problem` is of the data of `truth`; `unknowns`
/// are refitted with the rival.
Separation separate(const Problem& problem, const Candidate& unknowns, const Shape& truth,
                    const std::vector<Shape>& rival);

/// The rival, refitted from where it is, against an effect whose data `problem` is of.
Separation separate_by_fit(const Problem& problem, const Candidate& truth, const Candidate& rival);

/// Numbers of the runs that are fitted.
double fitted_count(const Problem& problem);

/// [J r]'[J r].
Eigen::MatrixXd information_of(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residuals);

/// The information by which the truth leads a rival of `rival_parameters`, refitted to first order,
/// where the runs of `count` numbers have this `information`:
///
///     r'r - r'J (J'J)^+ J'r - (k_truth - k_rival) ln n.
double expected_lead(const Eigen::MatrixXd& information, std::size_t truth_parameters,
                     double count);

}  // namespace flexarm::diagnose
