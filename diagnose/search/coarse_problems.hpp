#pragma once

#include "diagnose/search/fit.hpp"
#include "diagnose/search/problem.hpp"
#include "diagnose/search/reported_work.hpp"
#include "diagnose/search/selection_options.hpp"

namespace flexarm::diagnose {

/// A problem on parts of its estimation runs and with few modes, for looks at many values.
class CoarseProblems {
 public:
  CoarseProblems(const Problem& problem, const SelectionOptions& options);
  CoarseProblems(const CoarseProblems&) = delete;
  CoarseProblems& operator=(const CoarseProblems&) = delete;

  /// options.coarse_samples of each run.
  const Problem& coarse() const { return coarse_; }
  /// options.short_samples of each run: the same as coarse() where no run has more.
  const Problem& early() const { return early_; }
  bool is_early_shorter() const;

 private:
  Experiment coarse_experiment_;
  Experiment early_experiment_;
  Problem coarse_;
  Problem early_;
};

/// A fit of few steps, for one of these.
Fit coarse_fit(const Problem& part, const Candidate& start, const ReportedWork& work);

}  // namespace flexarm::diagnose
