#pragma once

#include "diagnose/planning/plan.hpp"

#include <nlohmann/json_fwd.hpp>

#include <vector>

namespace flexarm::report {

/// The content of `plan --json` (docs/json.md).
nlohmann::ordered_json plan_json(const diagnose::Plan& plan);

/// Additional runs under the keys of flexarm.plan/2.
nlohmann::ordered_json additional_runs_json(const std::vector<diagnose::NextExperiment>& runs);

/// The same under the keys of flexarm.diagnosis/1: `next_experiments`.
nlohmann::ordered_json further_runs_json(const std::vector<diagnose::NextExperiment>& runs);

}  // namespace flexarm::report
