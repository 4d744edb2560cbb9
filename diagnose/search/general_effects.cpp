#include "diagnose/search/general_effects.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>

namespace flexarm::diagnose {

namespace {

bool is_limit(const Explanation& single, const Hypothesis& general) {
  return general.contains(single.fit.candidate.effects.front().effect);
}

}  // namespace

GeneralEffects::GeneralEffects(const Problem& problem, const std::vector<Hypothesis>& hypotheses,
                               const SelectionOptions& options, SetFits& fits)
    : problem_(problem), hypotheses_(hypotheses), options_(options), fits_(fits) {
  for (const Hypothesis& effect : hypotheses) {
    (has(effect) ? general_ : special_).push_back(&effect);
  }
}

bool GeneralEffects::has(const Hypothesis& effect) const {
  return !limits_of(effect, hypotheses_).empty();
}

void GeneralEffects::try_by_themselves(Selection& made, std::string_view what, double to) {
  const Candidate& none = made.nothing.fit.candidate;
  const std::vector<Explanation> special = made.singles;
  const std::vector<const Hypothesis*> tried = worth_trying(special);
  const auto near = [&](std::size_t i) {
    std::optional<Candidate> look;
    if (!fits_.scan().may_explain(none, *tried[i])) return look;
    look = first_look(none, special, *tried[i]);
    if (!is_near(*look, special)) look.reset();
    return look;
  };
  fits_.add_all(labels_with(none, tried), what, to, made.singles, near);
  are_tried_ = true;
}

bool GeneralEffects::may_be_behind(const Explanation& single) const {
  return !are_tried_ && !single.leaves_noise() &&
         std::ranges::any_of(general_,
                             [&](const Hypothesis* general) { return is_limit(single, *general); });
}

std::vector<const Hypothesis*> GeneralEffects::worth_trying(
    const std::vector<Explanation>& special) const {
  if (std::ranges::none_of(special, &Explanation::leaves_noise)) return general_;
  std::vector<const Hypothesis*> found;
  std::ranges::copy_if(general_, std::back_inserter(found), [&](const Hypothesis* general) {
    return std::ranges::any_of(special, [&](const Explanation& single) {
      return single.leaves_noise() && is_limit(single, *general);
    });
  });
  return found;
}

Candidate GeneralEffects::first_look(const Candidate& none, const std::vector<Explanation>& special,
                                     const Hypothesis& general) const {
  const auto limit = std::ranges::find_if(
      special, [&](const Explanation& single) { return is_limit(single, general); });
  return (limit == special.end() ? fits_.scan().first_look(none, general)
                                 : fits_.scan().look_in_place(limit->fit.candidate, 0, general))
      .candidate;
}

bool GeneralEffects::is_near(const Candidate& look, const std::vector<Explanation>& special) const {
  if (special.empty()) return true;
  const auto left = problem_.residuals(look, problem_.estimation_runs());
  return left &&
         left->squaredNorm() <= options_.largest_of_looks * special.front().fit.sum_of_squares;
}

}  // namespace flexarm::diagnose
