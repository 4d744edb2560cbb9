#pragma once

#include "diagnose/planning/plan.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace flexarm::report {

/// The content of `plan --json` (docs/json.md).
nlohmann::ordered_json plan_json(const diagnose::Plan& plan);

/// `additional_runs` of a plan, `next_experiments` of a diagnosis.
nlohmann::ordered_json additional_runs_json(const std::vector<diagnose::NextExperiment>& runs);

/// The document of `plan --json` (docs/json.md).
std::string plan_document(const diagnose::Plan& plan);

}  // namespace flexarm::report
