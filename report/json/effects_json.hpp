#pragma once

#include "effects/registry/entry.hpp"

#include <nlohmann/json_fwd.hpp>

#include <vector>

namespace flexarm::report {

/// The content of `flexarm effects --json`: docs/json.md, flexarm.effects/1.
nlohmann::ordered_json effects_json(const std::vector<effects::Entry>& entries);

/// A JSON Schema (draft 2020-12) of the arm file, for editors that check TOML by one:
/// docs/formats.md.
nlohmann::ordered_json arm_file_schema(const std::vector<effects::Entry>& entries);

}  // namespace flexarm::report
