#pragma once

#include "diagnose/search/general_effects.hpp"
#include "diagnose/search/selection.hpp"
#include "diagnose/search/set_fits.hpp"

#include <cstddef>
#include <vector>

namespace flexarm::diagnose {

/// Sets that are made of a fitted one: with a limit of one of its effects in place of that, with an
/// effect that has one of its own as a limit, without an effect. They are fitted to all data.
class SetReplacements {
 public:
  /// The references must outlive the object.
  SetReplacements(const std::vector<Hypothesis>& hypotheses, const SelectionOptions& options,
                  const SetFits& fits, const GeneralEffects& general)
      : hypotheses_(hypotheses), options_(options), fits_(fits), general_(general) {}

  // Where these take `made`, what they fit is added to its sets.
  /// `candidate` with another effect in place of one of its own: as it was fitted before, or fitted
  /// now and kept.
  Explanation replaced(Selection& made, const Candidate& candidate, std::size_t index,
                       const Hypothesis& other) const;
  /// The same; empty where the set, not fitted before, is far from noise on a part of the data.
  std::optional<Explanation> replaced_near_noise(Selection& made, const Candidate& candidate,
                                                 std::size_t index, const Hypothesis& other) const;
  /// `candidate` without one of its effects, fitted from its values; where `made` has ended, as it
  /// was fitted before, if it was.
  Explanation without(Selection& made, const Candidate& candidate, std::size_t index) const;
  /// clears_bars against each set in which one of its effects is replaced by a limit of that: a
  /// general effect is named for what it adds to the special one. `fuller` may be among the sets of
  /// `made`.
  bool clears_limits(Selection& made, const Explanation& fuller) const;
  /// `found` with limits of its general effects in place of those that do not clear the bars over
  /// them.
  Explanation specialised(Selection& made, Explanation found) const;
  /// `best` with each effect exchanged for one that has it as a limit where that fits better.
  Explanation generalised(Selection& made, Explanation best) const;
  /// `explanation` without effects that the others, refitted, make superfluous: those that take
  /// away less than an effect must.
  Explanation needed(const Explanation& explanation) const;

 private:
  static std::optional<Explanation> fitted_before(Selection& made, const Candidate& candidate,
                                                  std::size_t index, const Hypothesis& other);
  Explanation fitted_and_kept(Selection& made, const Fit& look) const;

  const std::vector<Hypothesis>& hypotheses_;
  const SelectionOptions& options_;
  const SetFits& fits_;
  const GeneralEffects& general_;
};

}  // namespace flexarm::diagnose
