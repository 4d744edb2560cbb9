#pragma once

#include "diagnose/planning/further_runs.hpp"
#include "diagnose/planning/separation.hpp"
#include "diagnose/selection.hpp"

#include <Eigen/Core>

#include <string>
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

/// Further runs with what they would tell of `ties`, the best first. Information adds up over runs;
/// the rivals are refitted to first order. The score is a count of ties that are told, with soft
/// edges: the sum of lead/(lead + kToldLead). Runs that cannot be computed for a tie say nothing of
/// it. `progress` gets the fraction done; false ends the work, with nothing.
std::vector<NextExperiment> next_experiments(const arm::Arm& arm,
                                             const std::vector<FurtherRun>& further,
                                             const std::vector<Tie>& ties,
                                             const std::function<bool(double)>& progress = {});

/// The best further runs together, each chosen for what those before it leave: at most `most`,
/// while each raises the score by a tenth of a tie or more.
std::vector<NextExperiment> best_set(const arm::Arm& arm, const std::vector<FurtherRun>& further,
                                     const std::vector<Tie>& ties, std::size_t most,
                                     const std::function<bool(double)>& progress = {});

/// What to measure next, where causes that were chosen cannot be told from rivals; where nothing
/// was chosen but something is there, what would tell the nearest effects from each other. The best
/// `kMostShown`.
std::vector<NextExperiment> what_next(const Problem& problem, const Selection& selection,
                                      bool is_explained);
inline constexpr std::size_t kMostShown = 5;

}  // namespace flexarm::diagnose
