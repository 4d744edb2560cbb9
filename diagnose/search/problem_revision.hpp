#pragma once

#include "diagnose/search/selection.hpp"
#include "diagnose/search/set_fits.hpp"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace flexarm::diagnose {

/// What a search learns of its problem on the way: the level and the colour of the noise, and the
/// timing of the torque. Each step changes the problem where what it learns holds, and then refits
/// what the selection has; where that is cancelled, the problem is as it was before.
class ProblemRevision {
 public:
  /// The references must outlive the object.
  ProblemRevision(Problem& problem, const SelectionOptions& options, const SetFits& fits,
                  ReportedWork& work)
      : problem_(problem), options_(options), fits_(fits), work_(work) {}

  /// The noise that is seen under what the best so far leaves.
  void see_noise(Selection& made);

  // Coloured noise is taken up where no effect accounts for any of what a set of causes leaves
  // (dependence_test.hpp), and the timing of the torque not for much of it.
  /// Of what no cause leaves, before any effect was fitted: where besides no effect could be named
  /// for its share of that if the noise were white.
  void colour_noise_of_nothing(Selection& made);
  /// Of what no cause, or the best single leaves, where no single leaves white noise.
  void colour_noise_beside_singles(Selection& made);
  /// Of what this set of effects leaves, where that is not noise. Returns whether it is taken up.
  bool colour_noise_beside(Selection& made, const Explanation& set);
  /// Of what no cause, or the chosen set leaves, where the search has found nothing better: unless
  /// it depends on the motion for certain (kCertainDependence).
  void colour_noise_at_last(Selection& made);

  /// Where a little is left and the timing of the torque leaves noise of it: the torques as that
  /// timing has them; where it does not, it is undecided.
  void correct_timing(Selection& made);

 private:
  /// A problem with coloured noise, and the candidate that leaves this noise.
  struct ColouredFit {
    Problem problem;
    Candidate fitted;
  };

  template <class Change>
  void change_problem(Change change);
  void refit(Selection& made) const;
  bool is_for_timing(const Selection& made, const Explanation& left) const;
  bool colour_noise(Selection& made, const Explanation& best, double largest_share, double level);
  std::optional<ColouredFit> with_settled_noise(Candidate candidate) const;
  void correct_by(Selection& made, TorqueTiming timing);

  Problem& problem_;
  const SelectionOptions& options_;
  const SetFits& fits_;
  ReportedWork& work_;
  /// p-values of the dependence test, by labels and sums of squares of the fits: bounds from above
  /// of those that were rejected, 0 of those that leave no noise.
  std::map<std::pair<std::set<std::string>, double>, double> dependence_ = {};
};

}  // namespace flexarm::diagnose
