#pragma once

#include "diagnose/search/fit.hpp"
#include "diagnose/search/reported_work.hpp"
#include "diagnose/search/selection_options.hpp"

#include <Eigen/QR>

#include <string_view>
#include <vector>

namespace flexarm::diagnose {

/// Whether one of `hypotheses` is a limit of the hypothesis.
bool has_limit(const Hypothesis& hypothesis, const std::vector<Hypothesis>& hypotheses);

/// Its parameters, each at the middle of its range.
std::vector<double> middle_of(const Hypothesis& hypothesis);

/// The first look at effects: scans over their whole ranges on a part of the data with few modes.
class EffectScan {
 public:
  /// `hypotheses`, `options` and `work` must outlive the object.
  EffectScan(const Problem& problem, const std::vector<Hypothesis>& hypotheses,
             const SelectionOptions& options, ReportedWork& work);
  EffectScan(const EffectScan&) = delete;
  EffectScan& operator=(const EffectScan&) = delete;

  /// The `scanned_beside` hypotheses that account, at some of a few values each, for most of what
  /// `base` leaves: a score test without refitting.
  std::vector<const Hypothesis*> promising(const Candidate& base,
                                           std::vector<const Hypothesis*> others,
                                           std::string_view what);

  /// `base` with each of the hypotheses as a scan of it found it, the best first. Those that have
  /// another as a limit come after that, and only where the limit is among the best: a general
  /// effect far from its limit still does some of what the limit does.
  std::vector<Fit> first_looks(const Candidate& base, const std::vector<const Hypothesis*>& others,
                               std::string_view what, double from, double to);

  /// The last effect of `start` scanned, and all refitted to the part of the data.
  Fit first_look(const Candidate& start) const;

 private:
  double largest_part(const Fit& left, const Eigen::HouseholderQR<Eigen::MatrixXd>& refitted,
                      const Hypothesis& hypothesis) const;

  const std::vector<Hypothesis>& hypotheses_;
  const SelectionOptions& options_;
  ReportedWork& work_;
  Experiment coarse_experiment_;
  Experiment short_experiment_;
  Problem coarse_;
  Problem short_;
};

}  // namespace flexarm::diagnose
