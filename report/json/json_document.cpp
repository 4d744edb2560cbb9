#include "report/json/json_document.hpp"

#include <nlohmann/json.hpp>

#include <stdexcept>

namespace flexarm::report {

std::string json_document(std::string_view schema, const nlohmann::ordered_json& content) {
  if (!content.is_object() || content.contains("schema")) {
    throw std::invalid_argument(
        "a JSON document is an object that leaves its schema to the writer");
  }
  nlohmann::ordered_json document{{"schema", schema}};
  document.update(content);
  return document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace flexarm::report
