#pragma once

#include <nlohmann/json.hpp>

#include <string_view>

namespace flexarm::measured {

/// The JSON in a text, or the list of the objects that stand in it one a line. NaN and Infinity are
/// null. Throws InputError for other texts, and for a key that an object has twice.
nlohmann::ordered_json parsed_json(std::string_view text);

}  // namespace flexarm::measured
