#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>

namespace flexarm::report {

/// The text of a `--json` file: an object whose first member is `"schema": schema`, then the
/// members of `content` in their order, indented by two. Doubles read back to the same bits; NaN
/// and infinities become null, as JSON has neither; bytes that are not UTF-8 become U+FFFD. Throws
/// std::invalid_argument when `content` is not an object or has a `schema` of its own.
std::string json_document(std::string_view schema, const nlohmann::ordered_json& content);

}  // namespace flexarm::report
