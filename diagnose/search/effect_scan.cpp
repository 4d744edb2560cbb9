#include "diagnose/search/effect_scan.hpp"

#include "diagnose/search/coarse.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace flexarm::diagnose {

namespace {

constexpr FitOptions kCoarseFit{.most_steps = 8, .tolerance = 1e-4};

/// A few values of a hypothesis' parameters, over their ranges.
std::vector<std::vector<double>> samples_of(const Hypothesis& hypothesis) {
  const std::vector<double> places = hypothesis.parameters.size() == 1
                                         ? std::vector{0.15, 0.35, 0.45, 0.55, 0.65, 0.85}
                                         : std::vector{0.2, 0.5, 0.8};
  std::vector<std::vector<double>> samples = {{}};
  for (const SearchedParameter& parameter : hypothesis.parameters) {
    std::vector<std::vector<double>> longer;
    for (const auto& sample : samples) {
      for (const double place : places) {
        longer.push_back(sample);
        longer.back().push_back(parameter.value(place));
      }
    }
    samples = std::move(longer);
  }
  return samples;
}

ProblemOptions coarse_options(const Problem& problem, const SelectionOptions& options) {
  return {.flexible_modes = std::min(options.coarse_modes, problem.predictor().flexible_modes()),
          .logarithmic_responses = true};
}

}  // namespace

bool has_limit(const Hypothesis& hypothesis, const std::vector<Hypothesis>& hypotheses) {
  return std::ranges::any_of(hypotheses, [&](const Hypothesis& other) {
    return hypothesis.contains(other.effect);
  });
}

std::vector<double> middle_of(const Hypothesis& hypothesis) {
  std::vector<double> values;
  for (const auto& parameter : hypothesis.parameters) values.push_back(parameter.value(0.5));
  return values;
}

EffectScan::EffectScan(const Problem& problem, const std::vector<Hypothesis>& hypotheses,
                       const SelectionOptions& options, ReportedWork& work)
    : hypotheses_(hypotheses),
      options_(options),
      work_(work),
      coarse_experiment_(coarse(problem.experiment(), options.coarse_samples)),
      short_experiment_(coarse(problem.experiment(), options.short_samples)),
      coarse_(coarse_experiment_, coarse_options(problem, options)),
      short_(short_experiment_, coarse_options(problem, options)) {}

std::vector<Fit> EffectScan::first_looks(const Candidate& base,
                                         const std::vector<const Hypothesis*>& others,
                                         std::string_view what, double from, double to) {
  std::vector<Fit> looks;
  const auto look_at = [&](const std::vector<const Hypothesis*>& some, double begin, double end) {
    std::vector<Fit> made(some.size());
    work_.in_parallel(some.size(), what, begin, end, [&](std::size_t i) {
      made[i] = first_look(base.with(*some[i], middle_of(*some[i])));
    });
    std::ranges::move(made, std::back_inserter(looks));
    std::ranges::stable_sort(looks, {}, &Fit::sum_of_squares);
  };
  std::vector<const Hypothesis*> special;
  std::vector<const Hypothesis*> general;
  for (const Hypothesis* other : others) {
    (has_limit(*other, hypotheses_) ? general : special).push_back(other);
  }
  const double middle = 0.5 * (from + to);
  look_at(special, from, middle);
  if (work_.is_cancelled()) return {};
  const std::size_t best = std::min(options_.singles_refitted, looks.size());
  std::erase_if(general, [&](const Hypothesis* other) {
    return std::ranges::none_of(looks.begin(), looks.begin() + static_cast<std::ptrdiff_t>(best),
                                [&](const Fit& look) {
                                  return other->contains(
                                      look.candidate.effects.back().effect);
                                });
  });
  look_at(general, middle, to);
  return looks;
}

Fit EffectScan::first_look(const Candidate& start) const {
  const std::size_t parameters = start.effects.back().parameters.size();
  const int evaluations =
      options_.scan_evaluations[std::min(parameters, options_.scan_evaluations.size()) - 1];
  Fit look = fit(coarse_, scan(coarse_, start, evaluations), kCoarseFit);
  const bool is_shorter =
      short_.observations().values.size() < coarse_.observations().values.size();
  if (parameters == 1 || !is_shorter) return look;
  const Fit at_first = fit(short_, scan(short_, start, evaluations), kCoarseFit);
  Fit from_there = fit(coarse_, at_first.candidate, kCoarseFit);
  return from_there.sum_of_squares < look.sum_of_squares ? from_there : look;
}

std::vector<const Hypothesis*> EffectScan::promising(const Candidate& base,
                                                     std::vector<const Hypothesis*> others,
                                                     std::string_view what) {
  if (others.size() <= options_.scanned_beside) return others;
  const Fit left = fit(coarse_, base, kCoarseFit);
  const Eigen::HouseholderQR<Eigen::MatrixXd> refitted(left.jacobian);
  std::vector<std::pair<double, const Hypothesis*>> shares(others.size());
  work_.in_parallel(others.size(), what, work_.done(), work_.done(), [&](std::size_t i) {
    shares[i] = {largest_part(left, refitted, *others[i]), others[i]};
  });
  std::ranges::stable_sort(shares, std::ranges::greater{}, &decltype(shares)::value_type::first);
  others.clear();
  for (std::size_t i = 0; i < options_.scanned_beside; ++i) others.push_back(shares[i].second);
  return others;
}

/// Part of the residuals of `left` along the change that the hypothesis makes, its parameters
/// refitted: the largest of `samples_of` it.
double EffectScan::largest_part(const Fit& left,
                                const Eigen::HouseholderQR<Eigen::MatrixXd>& refitted,
                                const Hypothesis& hypothesis) const {
  double largest = 0.0;
  for (const std::vector<double>& values : samples_of(hypothesis)) {
    const auto with =
        coarse_.residuals(left.candidate.with(hypothesis, values), coarse_.estimation_runs());
    if (!with) continue;
    // At the fit's minimum the residuals have no part along its own parameters.
    Eigen::VectorXd change = refitted.householderQ().adjoint() * (left.residuals - *with);
    change.head(left.jacobian.cols()).setZero();
    change = refitted.householderQ() * change;
    const double size = change.norm() * left.residuals.norm();
    if (size > 0.0) largest = std::max(largest, change.dot(left.residuals) / size);
  }
  return largest;
}

}  // namespace flexarm::diagnose
