#pragma once

#include "diagnose/search/fit.hpp"
#include "diagnose/search/problem.hpp"
#include "diagnose/search/reported_work.hpp"
#include "diagnose/search/selection_options.hpp"

#include <Eigen/Core>

#include <cstddef>

namespace flexarm::diagnose {

/// A problem on parts of its estimation runs and with few modes, for looks at many values.
class CoarseProblems {
 public:
  /// `options` must outlive the object.
  CoarseProblems(const Problem& problem, const SelectionOptions& options);

  /// options.coarse_samples of each run.
  const Problem& coarse() const { return coarse_; }
  /// options.short_samples of each run: the same as coarse() where no run has more.
  const Problem& early() const { return early_; }
  bool is_early_shorter() const;

  /// Takes more of `time` runs where what is left of all of them, `residuals` of `problem`, does
  /// not show in a part: a step that saturates the actuator may come late. A part shows it where
  /// its mean square beyond noise is a tenth of that of all data, or 1. Up to
  /// options.most_coarse_samples of each run. Returns whether a part has become longer.
  bool lengthen(const Problem& problem, const Eigen::VectorXd& residuals);

 private:
  const SelectionOptions& options_;
  std::size_t coarse_samples_;
  std::size_t early_samples_;
  Problem coarse_;
  Problem early_;
};

/// A fit of few steps, for one of these.
Fit coarse_fit(const Problem& part, const Candidate& start, const ReportedWork& work);

}  // namespace flexarm::diagnose
