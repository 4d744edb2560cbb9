#pragma once

#include "diagnose/planning/plan.hpp"
#include "report/tables/table.hpp"

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::report {

/// What the planned runs can say, in a sentence or two.
std::string plan_summary(const diagnose::Plan& plan);

/// A lead below this is told, but by little.
inline constexpr double kClearLead = 10.0 * diagnose::kToldLead;

/// "a", "b", ... of the effects of a plan; "*" of those beyond the letters there are.
std::string effect_letter(std::size_t effect);

/// Another effect, and the expected lead over it.
struct PlanRival {
  std::size_t effect = 0;
  double lead = 0.0;
};

/// The rival with the smallest expected lead of an effect that is `least_lead` or more; empty where
/// there is none.
std::optional<PlanRival> nearest_rival(
    const diagnose::Plan& plan, std::size_t effect,
    double least_lead = -std::numeric_limits<double>::infinity());

/// All effects: those with ties first, then those that are not detectable, in each of these groups
/// and after them by the smallest lead over another.
std::vector<std::size_t> least_distinguishable_first(const diagnose::Plan& plan);

/// The smallest values of an effect that would be found: "stiffness 12.3 N m/rad"; "not
/// detectable".
std::string minimum_detectable(const diagnose::Detection& detection);

/// Each effect, in the order of least_distinguishable_first: from which value on it is found, what
/// it is tied with, and the nearest other.
Table detection_table(const diagnose::Plan& plan);

/// Which effect (a row) is distinguishable from which (a column), a letter each, with a key below.
std::string separation_matrix(const diagnose::Plan& plan);

/// Cosine and expected lead of each effect over each other, a row a pair, the smallest lead first.
Table separation_table(const diagnose::Plan& plan);

/// Expected lead of each effect (a row) over each other (a column).
Table lead_table(const diagnose::Plan& plan);

/// Pairs that cannot be told, with what the better plan would make of them.
Table tie_table(const diagnose::Plan& plan);

/// Further runs with what they would tell, the best first, at most `most`: how many pairs they
/// resolve, and the smallest expected lead of those.
Table further_run_table(const std::vector<diagnose::NextExperiment>& runs, std::size_t most,
                        const std::string& caption);

}  // namespace flexarm::report
