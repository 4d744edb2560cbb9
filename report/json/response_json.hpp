#pragma once

#include "response/frequency/response_study.hpp"

#include <nlohmann/json_fwd.hpp>

namespace flexarm::report {

/// Members of one arm in schema `flexarm.response/1` (docs/json.md) that say how it responds.
nlohmann::ordered_json response_json(const response::ResponseStudy& study);

}  // namespace flexarm::report
