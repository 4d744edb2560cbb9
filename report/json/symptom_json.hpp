#pragma once

#include "diagnose/symptoms/symptoms.hpp"

#include <nlohmann/json_fwd.hpp>

namespace flexarm::report {

/// The statements, and what is behind them, as `diagnose --json` has them (docs/formats.md).
nlohmann::ordered_json statements_json(const diagnose::Symptoms& symptoms);
nlohmann::ordered_json bands_json(const diagnose::Symptoms& symptoms);
nlohmann::ordered_json regimes_json(const diagnose::Symptoms& symptoms);
nlohmann::ordered_json root_shifts_json(const diagnose::Symptoms& symptoms);
nlohmann::ordered_json hub_torque_json(const diagnose::Symptoms& symptoms);
nlohmann::ordered_json distortion_json(const diagnose::Symptoms& symptoms);
nlohmann::ordered_json run_consistency_json(const diagnose::RunDrift& drift);

}  // namespace flexarm::report
