#include "diagnose/search/general_effects.hpp"

#include "diagnose/parallel.hpp"
#include "diagnose/search/admission.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>

namespace flexarm::diagnose {

namespace {

bool is_limit(const Explanation& single, const Hypothesis& general) {
  return general.contains(single.fit.candidate.effects.front().effect);
}

bool any_leaves_noise(const std::vector<Explanation>& singles) {
  return std::ranges::any_of(singles, &Explanation::leaves_noise);
}

}  // namespace

GeneralEffects::GeneralEffects(const std::vector<Hypothesis>& hypotheses,
                               const SelectionOptions& options, SetFits& fits)
    : hypotheses_(hypotheses), options_(options), fits_(fits) {
  for (const Hypothesis& effect : hypotheses) {
    (has(effect) ? general_ : special_).push_back(&effect);
  }
}

bool GeneralEffects::has(const Hypothesis& effect) const {
  return !limits_of(effect, hypotheses_).empty();
}

std::vector<const Hypothesis*> GeneralEffects::with_limit(const Hypothesis& effect) const {
  std::vector<const Hypothesis*> found;
  std::ranges::copy_if(general_, std::back_inserter(found),
                       [&](const Hypothesis* general) { return general->contains(effect.effect); });
  return found;
}

void GeneralEffects::try_by_themselves(Selection& made, std::string_view what, double to) {
  const Candidate none = made.nothing.fit.candidate;
  const std::vector<Explanation> special = made.singles;
  std::optional<LeftOfParts> left;
  std::vector<const Hypothesis*> waiting = worth_trying(special);  // for try_each
  const auto try_each = [&](const std::vector<const Hypothesis*>& tried) {
    std::vector<Look> looks(tried.size());
    fits_.add_all(labels_with(none, tried), what, to, made.singles, [&](std::size_t i) {
      looks[i] = near_look(none, special, left, *tried[i]);
      return looks[i].start;
    });
    for (std::size_t i = 0; i < tried.size(); ++i) {
      if (!looks[i].start) made.ruled_out.push_back({tried[i]->label(), looks[i].share});
    }
  };
  try {
    if (!waiting.empty()) left = left_of_parts(none, special);
    std::vector<const Hypothesis*> likely_laws;
    std::vector<const Hypothesis*> others;
    std::vector<std::optional<double>> shares(waiting.size());
    in_parallel(waiting.size(),
                [&](std::size_t i) { shares[i] = fits_.scan().share_of_law(none, *waiting[i]); });
    for (std::size_t i = 0; i < waiting.size(); ++i) {
      if (shares[i] && *shares[i] < options_.least_law_share) {
        made.ruled_out.push_back({waiting[i]->label(), *shares[i]});
        continue;
      }
      const bool is_likely = shares[i] && *shares[i] >= options_.least_share;
      (is_likely ? likely_laws : others).push_back(waiting[i]);
    }
    waiting = others;
    try_each(likely_laws);
    waiting.clear();
    const bool is_found = any_leaves_noise(made.singles) && !any_leaves_noise(special);
    if (!is_found) try_each(others);
  } catch (const Cancelled&) {
    fits_.leave_untried(labels_with(none, waiting));
    throw;
  }
  are_tried_ = true;
}

bool GeneralEffects::may_be_behind(const Explanation& single) const {
  return !are_tried_ && !single.leaves_noise() &&
         !with_limit(single.fit.candidate.effects.front()).empty();
}

std::vector<const Hypothesis*> GeneralEffects::worth_trying(
    const std::vector<Explanation>& special) const {
  if (!any_leaves_noise(special)) return general_;
  std::vector<const Hypothesis*> found;
  std::ranges::copy_if(general_, std::back_inserter(found), [&](const Hypothesis* general) {
    return std::ranges::any_of(special, [&](const Explanation& single) {
      return single.leaves_noise() && is_limit(single, *general);
    });
  });
  return found;
}

std::optional<GeneralEffects::LeftOfParts> GeneralEffects::left_of_parts(
    const Candidate& none, const std::vector<Explanation>& special) const {
  constexpr std::size_t kCompared = 3;
  const auto left_of = [&](const auto& look) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < std::min(kCompared, special.size()); ++i) {
      least = std::min(least, look(special[i].fit.candidate).sum_of_squares);
    }
    return LeftOfPart{look(none), least};
  };
  if (special.empty()) return std::nullopt;
  const EffectScan& scan = fits_.scan();
  LeftOfParts made{.coarse =
                       left_of([&](const Candidate& single) { return scan.coarse_look(single); })};
  if (fits_.parts().is_early_shorter()) {
    made.early = left_of([&](const Candidate& single) { return scan.early_look(single); });
  }
  return made;
}

GeneralEffects::Look GeneralEffects::near_look(const Candidate& none,
                                               const std::vector<Explanation>& special,
                                               const std::optional<LeftOfParts>& left,
                                               const Hypothesis& general) const {
  // What it must leave less is options_.least_information_gain and the price of its parameters.
  const double least_gain = 0.5 * options_.least_information_gain;
  const EffectScan& scan = fits_.scan();
  if (!left) return {SetFits::Start{scan.first_look(none, general).candidate}};
  const auto limit = std::ranges::find_if(
      special, [&](const Explanation& single) { return is_limit(single, general); });
  const bool has_limit = limit != special.end();
  const auto is_far = [&](const Fit& look, const LeftOfPart& part) {
    return look.sum_of_squares > options_.largest_of_general * part.least;
  };
  const auto ruled_out = [](const Fit& look, const LeftOfPart& part) {
    return Look{.share = explained_share(part.by_none, look)};
  };
  // A cause by itself leaves less than those that are not, of each part of the data.
  if (left->early && (!has_limit || is_far(scan.early_look(limit->fit.candidate), *left->early))) {
    const Fit look = scan.early_look(none, general);
    if (is_far(look, *left->early)) return ruled_out(look, *left->early);
  }
  if (has_limit && limit->leaves_noise()) {
    const Fit look = scan.look_from_limit(limit->fit.candidate, 0, general);
    if (is_far(look, left->coarse)) return ruled_out(look, left->coarse);
    return {SetFits::Start{look.candidate, limit->fit.sum_of_squares - least_gain}};
  }
  const Fit look = has_limit ? scan.look_in_place(limit->fit.candidate, 0, general)
                             : scan.first_look(none, general);
  if (is_far(look, left->coarse)) return ruled_out(look, left->coarse);
  if (has_limit && !is_ahead_of_limit(look, scan.coarse_look(limit->fit.candidate), options_)) {
    return ruled_out(look, left->coarse);
  }
  return {SetFits::Start{look.candidate}};
}

}  // namespace flexarm::diagnose
