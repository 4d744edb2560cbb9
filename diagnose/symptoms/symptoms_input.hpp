#pragma once

#include "diagnose/search/problem.hpp"

#include <Eigen/Core>

namespace flexarm::diagnose {

/// What statements of what is wrong are made from: the residuals of all runs, in standard
/// deviations of the noise, of the arm as its file describes it and with the causes.
struct SymptomsInput {
  const Problem& problem;
  const Eigen::VectorXd& before;
  const Eigen::VectorXd& after;  ///< the same as `before` where nothing was named
  const Candidate& chosen;       ///< the causes

  bool has_causes() const { return !chosen.effects.empty(); }
};

}  // namespace flexarm::diagnose
