#include "diagnose/planning/plan.hpp"

#include "arm/effects.hpp"
#include "arm/input_error.hpp"
#include "arm/linear_arm.hpp"
#include "arm/plausibility.hpp"
#include "diagnose/search/hypothesis.hpp"
#include "effects/registry/vocabulary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <string_view>
#include <utility>

namespace flexarm::diagnose {

namespace {

/// Fractions of the work that are done after each part of it.
constexpr double kDetected = 0.15;
constexpr double kSeparated = 0.7;
constexpr double kRanked = 0.9;

/// The runs with the purposes that the program would give them.
std::vector<PlannedRun> with_purposes(const PlannedExperiment& planned,
                                      std::vector<PlannedRun> runs) {
  for (std::size_t r = 0; r < runs.size(); ++r) {
    runs[r].purpose = planned.experiment().runs[r].run.purpose;
  }
  return runs;
}

/// Effects of the vocabulary that are no possible cause in an experiment.
std::vector<std::string> absent_effects(const Experiment& experiment) {
  const std::vector<Hypothesis> possible = hypotheses(experiment);
  std::vector<std::string> absent;
  for (const auto& entry : effects::vocabulary()) {
    if (std::ranges::find(possible, entry->name, &Hypothesis::effect) == possible.end()) {
      absent.push_back(entry->name);
    }
  }
  return absent;
}

class Planning {
 public:
  Planning(const arm::Arm& arm, const MeasurementPlan& measurement_plan,
           const std::vector<Hypothesis>& hypotheses, const PlanOptions& options,
           const DiagnosisProgress& progress)
      : arm_(arm),
        options_(options),
        work_(progress),
        hypotheses_(hypotheses),
        planned_(arm, measurement_plan.runs, options.unknown) {
    std::erase_if(hypotheses_, [&](const Hypothesis& hypothesis) {
      return planned_.unknowns().has(hypothesis);
    });
    if (hypotheses_.empty()) {
      throw arm::InputError(
          "no effect to test: all are nuisance parameters (--refit), or none changes these runs");
    }
    made_.better = measurement_plan;
    made_.better.runs = with_purposes(planned_, measurement_plan.runs);
    made_.notices = arm::plausibility_notes(arm);
    if (!planned_.notice().empty()) made_.notices.push_back(planned_.notice());
    const bool has_response = std::ranges::any_of(
        measurement_plan.runs, [](const auto& run) { return run.kind == measured::RunKind::frf; });
    if (has_response && !arm::linear_arm(arm).is_damped()) {
      made_.notices.push_back(
          "the arm file has no damping: its frequency responses are infinite at poles and zero at "
          "zeros, so the result depends on the line nearest to one of them");
    }
    const std::vector<std::string> absent = absent_effects(planned_.experiment());
    if (!absent.empty()) {
      made_.notices.push_back(fmt::format(
          "not tested, because already in the arm file or without influence on these runs: {}",
          fmt::join(absent, ", ")));
    }
  }

  Plan run() {
    try {
      detect_all();
      separate_all();
      tie();
      improve();
    } catch (const Cancelled&) {
      made_.cancelled = true;
    }
    return std::move(made_);
  }

 private:
  void detect_all() {
    made_.effects.resize(hypotheses_.size());
    shapes_.resize(hypotheses_.size());
    work_.in_parallel(
        hypotheses_.size(), "detectability of each effect", 0.0, kDetected, [&](std::size_t i) {
          made_.effects[i] = detect(planned_, hypotheses_[i], options_.least_information_gain);
          shapes_[i] = shapes_of(planned_, made_.effects[i]);
        });
  }

  void separate_all() {
    const std::size_t count = hypotheses_.size();
    made_.separations.assign(count, std::vector<std::optional<Separation>>(count));
    work_.in_parallel(
        count, "distinguishability of pairs", kDetected, kSeparated, [&](std::size_t a) {
          const Detection& truth = made_.effects[a];
          if (!truth.compared || shapes_[a].empty()) return;
          const Problem problem = problem_of(planned_, *truth.compared);
          for (std::size_t b = 0; b < count; ++b) {
            work_.go_on();
            if (a == b || hypotheses_[b].contains(truth.hypothesis.effect)) continue;
            made_.separations[a][b] =
                separate(problem, planned_.unknowns(), shapes_[a].front(), shapes_[b]);
          }
        });
  }

  /// The problem of data of an arm with these effects.
  Problem problem_of(const PlannedExperiment& planned, const Candidate& truth) const {
    const Problem& described = planned.as_described();
    const std::vector<bool> all(planned.experiment().runs.size(), true);
    return planned.problem(described.predictor()(truth.extend(arm_), all));
  }

  void tie() {
    const std::size_t count = hypotheses_.size();
    std::vector<std::size_t> class_of(count);
    std::iota(class_of.begin(), class_of.end(), std::size_t{0});
    const auto lead_of = [&](std::size_t a, std::size_t b) {
      const auto& separation = made_.separations[a][b];
      return separation ? separation->lead : std::numeric_limits<double>::infinity();
    };
    for (std::size_t a = 0; a < count; ++a) {
      for (std::size_t b = a + 1; b < count; ++b) {
        const bool forward = lead_of(a, b) <= lead_of(b, a);
        const TiedPair pair{forward ? a : b, forward ? b : a,
                            std::min(lead_of(a, b), lead_of(b, a))};
        if (pair.lead >= kToldLead) continue;
        made_.ties.push_back(pair);
        const std::size_t from = class_of[b];
        std::ranges::replace(class_of, from, class_of[a]);
      }
    }
    std::ranges::stable_sort(made_.ties, {}, &TiedPair::lead);
    for (std::size_t c = 0; c < count; ++c) {
      std::vector<std::size_t> members;
      for (std::size_t i = 0; i < count; ++i) {
        if (class_of[i] == c) members.push_back(i);
      }
      if (members.size() > 1) made_.classes.push_back(std::move(members));
    }
  }

  void improve() {
    std::vector<Tie> ties;
    for (const TiedPair& pair : made_.ties) {
      const Separation& separation = *made_.separations[pair.truth][pair.rival];
      ties.push_back({joined(planned_.unknowns(), *made_.effects[pair.truth].compared),
                      separation.rival, separation.information,
                      fitted_count(planned_.as_described())});
    }
    auto worth = worth_of_further_runs(arm_, made_.better.runs, ties, options_.most_added, work_,
                                       kSeparated, kRanked);
    made_.further = std::move(worth.ranked);
    made_.added = std::move(worth.together);
    if (made_.added.empty()) return;
    for (const NextExperiment& next : made_.added) made_.better.runs.push_back(next.further.run);
    const PlannedExperiment better(arm_, made_.better.runs);
    work_.in_parallel(ties.size(), "improved plan", kRanked, 1.0, [&](std::size_t t) {
      made_.ties[t].lead_with_more =
          separate_by_fit(problem_of(better, ties[t].truth), ties[t].truth, ties[t].rival).lead;
    });
  }

  const arm::Arm& arm_;
  const PlanOptions& options_;
  ReportedWork work_;
  std::vector<Hypothesis> hypotheses_;
  const PlannedExperiment planned_;
  Plan made_;
  std::vector<std::vector<Shape>> shapes_;  // of each effect
};

}  // namespace

Plan plan_experiment(const arm::Arm& arm, const MeasurementPlan& measurement_plan,
                     const std::vector<Hypothesis>& hypotheses, const PlanOptions& options,
                     const DiagnosisProgress& progress) {
  return Planning(arm, measurement_plan, hypotheses, options, progress).run();
}

std::vector<Hypothesis> hypotheses_of(const arm::Arm& arm,
                                      const MeasurementPlan& measurement_plan) {
  return hypotheses(PlannedExperiment(arm, measurement_plan.runs).experiment());
}

}  // namespace flexarm::diagnose
