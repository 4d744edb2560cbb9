#pragma once

#include "diagnose/planning/further_runs.hpp"
#include "diagnose/planning/separation.hpp"
#include "diagnose/search/reported_work.hpp"
#include "diagnose/search/selection.hpp"

#include <Eigen/Core>

#include <vector>

namespace flexarm::diagnose {

/// Causes that data cannot tell from others in their place.
struct Tie {
  Candidate truth;
  Candidate rival;              ///< refitted to the data of `truth`
  Eigen::MatrixXd information;  ///< what the data say of the two (Separation::information)
  double count = 0.0;           ///< numbers in the data
};

/// What a further run would be worth.
struct NextExperiment {
  FurtherRun further;
  std::vector<double> leads;  ///< expected, a tie each, with the data there are and this run
  int told = 0;               ///< of these, those that reach `kToldLead`
  double score = 0.0;
};

/// What further runs are worth.
struct FurtherRunsWorth {
  std::vector<NextExperiment> ranked;  ///< each by itself, the best first
  /// Chosen one after the other, each for what those before it leave; the score is of all so far.
  std::vector<NextExperiment> together;
};

/// What each of the `further_runs` that could be added to `runs` would tell of `ties`. Information
/// adds up over runs; the rivals are refitted to first order. The score is a count of ties that are
/// told, with soft edges: the sum of lead/(lead + kToldLead). At most `most_together` are chosen,
/// while each raises the score by a tenth of a tie or more. A run that cannot be computed for a tie
/// says nothing of it; where the arm itself cannot be computed in them (one that falls) there is no
/// advice. It takes the fraction `from` .. `to` of `work`; throws Cancelled where that is
/// cancelled.
FurtherRunsWorth worth_of_further_runs(const arm::Arm& arm, const std::vector<PlannedRun>& runs,
                                       const std::vector<Tie>& ties, std::size_t most_together,
                                       ReportedWork& work, double from, double to);

/// What to measure next, where causes that were chosen cannot be told from rivals; where nothing
/// was chosen but something is there, what would tell the nearest effects from each other. The best
/// `kMostShown`. It is the end of `work`; throws Cancelled where that is cancelled.
std::vector<NextExperiment> what_next(const Problem& problem, const Selection& selection,
                                      bool is_explained, ReportedWork& work);
inline constexpr std::size_t kMostShown = 5;

}  // namespace flexarm::diagnose
