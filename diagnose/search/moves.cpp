#include "diagnose/search/moves.hpp"

#include "diagnose/parallel.hpp"
#include "diagnose/search/refit_projection.hpp"
#include "diagnose/search/start_places.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <memory>
#include <utility>

namespace flexarm::diagnose {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A change of less than this part of the weighted lines is rounding.
constexpr double kRounding = 1e-6;

/// Parts of its middle size that an effect of several parameters is looked at with. What it changes
/// is proportional to its size where that is small alone.
constexpr std::array<double, 2> kBaseSizes = {0.3, 0.03};
/// The part of its least sample of an effect of one parameter.
constexpr double kSmallSize = 0.1;
/// A smaller part of it beside no effect, for what is far below the range of its search.
constexpr double kSmallestSize = 0.01;

/// Returns the columns of `jacobian` but those by the effect at `index`.
MatrixXd without_effect(const MatrixXd& jacobian, const Candidate& set, std::size_t index) {
  const auto first = static_cast<Index>(set.nuisances.size() + set.values_before(index));
  const Index count = std::ssize(set.effects[index].parameters);
  MatrixXd made(jacobian.rows(), jacobian.cols() - count);
  made.leftCols(first) = jacobian.leftCols(first);
  made.rightCols(made.cols() - first) = jacobian.rightCols(made.cols() - first);
  return made;
}

/// Returns what the effect at `index` changes of the lines of a fit, by their derivatives; empty
/// for one without a value at which it does nothing.
std::optional<VectorXd> tangent_change(const ScoredFit& fit, std::size_t index) {
  const Hypothesis& effect = fit.candidate.effects[index];
  const auto sized = effect.size_parameter();
  if (!sized) return std::nullopt;
  const SearchedParameter& parameter = effect.parameters[*sized];
  const double place = parameter.coordinate(fit.candidate.values_of(index)[*sized]);
  const auto column = static_cast<Index>(fit.candidate.nuisances.size() +
                                         fit.candidate.values_before(index) + *sized);
  return (place - *parameter.neutral_coordinate()) * fit.jacobian.col(column);
}

/// Returns groups of values of an effect to look at (start_places.hpp), and of small parts of its
/// sizes: of one parameter one group, of several one with each size. Beside no effect another group
/// is of one parameter's whole range: far from the value at which an effect does nothing its change
/// says little of its size.
std::vector<std::vector<StartPlaces>> groups_of_samples(const Hypothesis& effect, bool is_alone) {
  const std::vector<StartPlaces> samples = samples_of(effect);
  const auto of_size = [&](const StartPlaces& sample, double size) {
    return places_of(effect, values_at(effect, sample, size));
  };
  if (!effect.size_parameter()) return {samples};
  std::vector<std::vector<StartPlaces>> groups;
  if (effect.parameters.size() == 1) {
    groups.push_back(samples);
    groups.back().push_back(of_size(samples.front(), kSmallSize));
    if (is_alone) {
      auto& group = groups.emplace_back();
      for (const double place : kEvenPlaces) group.push_back({place});
      group.push_back(of_size(samples.front(), kSmallestSize));
    }
    return groups;
  }
  for (const double size : kBaseSizes) {
    auto& group = groups.emplace_back();
    for (const StartPlaces& sample : samples) group.push_back(of_size(sample, size));
  }
  return groups;
}

/// Returns whether what one of two effects changes depends on the other: they act at one place, or
/// one is a limit of the other.
bool depend_on_each_other(const Hypothesis& one, const Hypothesis& other) {
  return one.entry->family == other.entry->family || one.contains(other.effect) ||
         other.contains(one.effect);
}

/// A move that adds an effect, `size` times the change of the lines by it.
struct Addition {
  Move move = {};
  double size = 0.0;
  const VectorXd* change = nullptr;
};

/// A set that an effect may be added to, as the weighted lines have it.
class Ground {
 public:
  Ground(const Likelihood& likelihood, Candidate set, VectorXd lines, const MatrixXd& jacobian,
         VectorXd weights)
      : likelihood_(likelihood),
        set_(std::move(set)),
        lines_(std::move(lines)),
        weights_(std::move(weights)),
        roots_(weights_.cwiseSqrt()),
        refitted_(roots_.asDiagonal() * jacobian),
        left_(refitted_(roots_.cwiseProduct(lines_))),
        price_(price(set_, jacobian, weights_, likelihood.problem().policy())) {}

  const Candidate& set() const { return set_; }

  const VectorXd& lines() const { return lines_; }
  /// Returns the predicted score where the rest is refitted.
  double score() const { return likelihood_.cost(unweighted(left_)) + price_; }

  /// Returns the move that adds an effect with which the lines change by `change` at `places`,
  /// which is to outlive it; without an effect where that changes nothing.
  Addition adding(const Hypothesis& effect, const StartPlaces& places,
                  const VectorXd& change) const {
    const VectorXd refitted = refitted_(roots_.cwiseProduct(change));
    const double squares = refitted.squaredNorm();
    if (!(squares > kRounding * kRounding * left_.squaredNorm())) return {};
    const auto [least, most] = sizes_of(effect, places);
    const double size = std::clamp(-refitted.dot(left_) / squares, least, most);
    const VectorXd predicted = unweighted(left_ + size * refitted);
    const double parameters = static_cast<double>(effect.parameters.size());
    const double deviation = place_deviation(effect, likelihood_.problem().policy());
    const double determined = parameters * std::log1p(deviation * deviation * squares);
    std::vector<double> values = values_at(effect, places, size);
    const double added = price(effect, set_.effects) + price_of_value(effect, values) + determined;
    return {.move = {.added = &effect,
                     .values = std::move(values),
                     .score = likelihood_.cost(predicted) + price_ + added},
            .size = size,
            .change = &change};
  }

  /// Returns the predicted step of the coordinates of the set where an effect is added.
  VectorXd step(const Addition& addition) const {
    return -refitted_.step(roots_.cwiseProduct(lines_ + addition.size * *addition.change));
  }

 private:
  VectorXd unweighted(const VectorXd& weighted) const {
    return weighted.cwiseQuotient(roots_.cwiseMax(1e-150));
  }

  const Likelihood& likelihood_;
  Candidate set_;
  VectorXd lines_;
  VectorXd weights_;
  VectorXd roots_;
  RefitProjection refitted_;
  VectorXd left_;
  double price_;
};

/// The moves of one set.
class Neighbourhood {
 public:
  Neighbourhood(const Likelihood& likelihood, const ScoredFit& base, const ReportedWork& work)
      : likelihood_(likelihood), base_(base), work_(work) {
    const Candidate& set = base.candidate;
    const VectorXd weights = likelihood.weights(base.lines);
    const bool is_noise = likelihood.is_noise(base.lines);
    if (!is_noise) peaks_Hz_ = likelihood.peaks_Hz(base.lines, likelihood.problem().policy().peaks);
    whole_ = std::make_unique<Ground>(likelihood, set, base.lines, base.jacobian, weights);
    without_.resize(set.effects.size());
    by_tangent_.resize(set.effects.size());
    in_parallel(without_.size(), [&](std::size_t i) {
      const Candidate rest = set.without(i);
      const MatrixXd jacobian = without_effect(base.jacobian, set, i);
      if (auto lines = lines_of(rest)) {
        const VectorXd own = likelihood.weights(*lines);
        without_[i] = std::make_unique<Ground>(likelihood, rest, *std::move(lines), jacobian, own);
      }
      if (!is_noise) return;
      if (const auto change = tangent_change(base, i)) {
        by_tangent_[i] =
            std::make_unique<Ground>(likelihood, rest, base.lines - *change, jacobian, weights);
      }
    });
  }

  std::vector<Move> drops() const {
    std::vector<Move> made;
    for (std::size_t i = 0; i < without_.size(); ++i) {
      if (!without_[i]) continue;
      made.push_back({.dropped = i, .score = without_[i]->score()});
    }
    return made;
  }

  /// Returns the best moves with an effect added: to the whole set, and in the place of each of its
  /// effects.
  std::vector<Move> with(const Hypothesis& effect) const {
    const std::vector<Hypothesis>& own = base_.candidate.effects;
    std::vector<Move> made;
    const auto same = std::ranges::find(own, effect.label(), &Hypothesis::label);
    if (same != own.end()) {
      const auto i = static_cast<std::size_t>(same - own.begin());
      if (without_[i]) {
        look_beside(*without_[i], effect, {samples_at(effect, peaks_Hz_)}, {i}, made);
      }
      return made;
    }
    std::vector<std::size_t> additive;
    bool is_new = true;
    for (std::size_t i = 0; i < own.size(); ++i) {
      if (!without_[i]) continue;
      is_new = is_new && own[i].effect != effect.effect;
      if (depend_on_each_other(own[i], effect)) {
        auto groups = groups_of_samples(effect, own.size() == 1);
        groups.push_back(samples_in_place(effect, own[i], base_.candidate.values_of(i)));
        look_beside(*without_[i], effect, groups, {i}, made);
      } else {
        additive.push_back(i);
      }
    }
    additive.push_back(own.size());
    if (is_new) {
      auto groups = groups_of_samples(effect, own.empty());
      groups.push_back(samples_at(effect, peaks_Hz_));
      look_beside(*whole_, effect, groups, additive, made);
    }
    return made;
  }

 private:
  /// Adds the best moves with this effect to `made`: as many of each group of places as it has
  /// parameters, for each of the effects in `dropped`. What it changes is computed beside `ground`.
  void look_beside(const Ground& ground, const Hypothesis& effect,
                   const std::vector<std::vector<StartPlaces>>& groups,
                   const std::vector<std::size_t>& dropped, std::vector<Move>& made) const {
    for (const auto& samples : groups) {
      std::vector<StartPlaces> looked_at;
      std::vector<VectorXd> changes;
      for (const StartPlaces& places : samples) {
        const auto values = effects::values_at(effect.parameters, places);
        const auto moved = lines_of(ground.set().with(effect, values));
        if (!moved) continue;
        looked_at.push_back(places);
        changes.push_back(*moved - ground.lines());
      }
      for (const std::size_t index : dropped) {
        std::ranges::move(best_additions(index, effect, looked_at, changes),
                          std::back_inserter(made));
      }
    }
  }

  /// Returns the best moves that add an effect to the ground at `index`, as many as it has
  /// parameters, of those with these places and changes of the lines.
  std::vector<Move> best_additions(std::size_t index, const Hypothesis& effect,
                                   const std::vector<StartPlaces>& places,
                                   const std::vector<VectorXd>& changes) const {
    const Ground& ground = ground_of(index);
    std::vector<Addition> additions;
    for (std::size_t s = 0; s < places.size(); ++s) {
      Addition one = ground.adding(effect, places[s], changes[s]);
      if (one.move.added != nullptr) additions.push_back(std::move(one));
    }
    std::ranges::stable_sort(additions, {}, [](const Addition& one) { return one.move.score; });
    additions.resize(std::min(additions.size(), effect.parameters.size()));
    std::vector<Move> made;
    for (Addition& one : additions) {
      if (index < without_.size()) {
        one.move.dropped = index;
        one.move.step = ground.step(one);
      }
      made.push_back(std::move(one.move));
    }
    return made;
  }

  /// Returns the set without the effect at `dropped`; the whole set behind the last one.
  const Ground& ground_of(std::size_t dropped) const {
    if (dropped == without_.size()) return *whole_;
    return by_tangent_[dropped] ? *by_tangent_[dropped] : *without_[dropped];
  }

  std::optional<VectorXd> lines_of(const Candidate& candidate) const {
    work_.go_on();
    return likelihood_.lines_of(candidate);
  }

  const Likelihood& likelihood_;
  const ScoredFit& base_;
  const ReportedWork& work_;
  std::vector<double> peaks_Hz_;  ///< of what the set leaves
  std::unique_ptr<Ground> whole_;
  std::vector<std::unique_ptr<Ground>> without_;  ///< one an effect; null where there is no arm
  /// Grounds of a set that leaves noise, without each effect to first order in what it changes.
  /// Without it altogether the set is so far from the data that the curvature of its change hides
  /// which other effect does the same. Null for other sets.
  std::vector<std::unique_ptr<Ground>> by_tangent_;
};

}  // namespace

Candidate Move::of(const Candidate& set, bool is_refitted) const {
  Candidate rest = dropped ? set.without(*dropped) : set;
  if (is_refitted && step.size() > 0) rest.put(rest.coordinates() + step);
  return added != nullptr ? rest.with(*added, values) : rest;
}

std::vector<Move> moves_of(const Likelihood& likelihood, const ScoredFit& base,
                           std::span<const Hypothesis> others, const ReportedWork& work) {
  const Neighbourhood neighbourhood(likelihood, base, work);
  std::vector<std::vector<Move>> with_each(others.size());
  in_parallel(others.size(), [&](std::size_t i) { with_each[i] = neighbourhood.with(others[i]); });
  std::vector<Move> moves = neighbourhood.drops();
  for (auto& with_one : with_each) std::ranges::move(with_one, std::back_inserter(moves));
  std::ranges::stable_sort(moves, {}, &Move::score);
  return moves;
}

}  // namespace flexarm::diagnose
