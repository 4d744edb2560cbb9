#pragma once

#include "diagnose/planning/plan.hpp"

#include <nlohmann/json_fwd.hpp>

#include <vector>

namespace flexarm::report {

/// The content of `plan --json` (docs/json.md).
nlohmann::ordered_json plan_json(const diagnose::Plan& plan);

/// Further runs, a list of objects: also `next_experiments` of a diagnosis.
nlohmann::ordered_json further_runs_json(const std::vector<diagnose::NextExperiment>& runs);

}  // namespace flexarm::report
