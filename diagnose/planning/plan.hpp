#pragma once

#include "diagnose/planning/next_experiments.hpp"
#include "diagnose/search/selection.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::diagnose {

/// Two effects, by their places in Plan::effects: where the first is there, data cannot tell it
/// from the second.
struct TiedPair {
  std::size_t truth = 0;
  std::size_t rival = 0;
  double lead = 0.0;  ///< expected, of the truth over the rival
  /// The same with the runs that are proposed, refitted; empty where none are.
  std::optional<double> lead_with_more = {};
};

/// What a planned experiment can say of the effects of the vocabulary.
struct Plan {
  std::vector<std::string> notices;
  std::vector<Detection> effects;
  /// [truth][rival] of `effects`; empty on the diagonal, for a truth that does not show, and for
  /// a rival that contains the truth as a limit.
  std::vector<std::vector<std::optional<Separation>>> separations;
  std::vector<TiedPair> ties;  ///< the closest first; of two that are tied both ways the closer
  /// Effects that ties join, directly or through others; two or more each.
  std::vector<std::vector<std::size_t>> classes;
  std::vector<NextExperiment> further;  ///< runs that might be added, the best first
  std::vector<NextExperiment> added;    ///< those that make the better plan, in their order
  MeasurementPlan better;               ///< the plan with them; every run with a purpose
  bool cancelled = false;
};

struct PlanOptions {
  /// An effect counts as detected from this delta BIC on (misfit.hpp); 10 is very strong evidence
  /// [KassRaftery1995].
  double least_information_gain = 10.0;
  std::size_t most_added = 3;
  /// Effects whose size is not known: fitted in any case, and no causes.
  std::vector<std::string> unknown = {};
};

/// Works out what `measurement_plan` can say of `hypotheses` about `arm`, and which further runs
/// would say more. Throws InputError for an arm or a plan that cannot be computed.
Plan plan_experiment(const arm::Arm& arm, const MeasurementPlan& measurement_plan,
                     const std::vector<Hypothesis>& hypotheses, const PlanOptions& options = {},
                     const DiagnosisProgress& progress = {});

/// The hypotheses of a plan: those that its runs may show.
std::vector<Hypothesis> hypotheses_of(const arm::Arm& arm, const MeasurementPlan& measurement_plan);

}  // namespace flexarm::diagnose
