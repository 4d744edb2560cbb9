#pragma once

#include <nlohmann/json.hpp>

namespace flexarm::measured {

/// The value, `depth` objects within others, with each list of named signals, `[{"name": "tau",
/// "unit": "N m", "data": [...]},
/// ...]`, as lists by name in the object around it, `"tau": [...]`, `"tau_unit": "N m"`. Times that
/// all signals have, as `time`, become one list; single values of a signal are in an object beside
/// it, "tau settings". Throws InputError for a name that is there twice, and for signals with
/// different times.
nlohmann::ordered_json with_lists_of_signals(nlohmann::ordered_json value, int depth = 0);

}  // namespace flexarm::measured
