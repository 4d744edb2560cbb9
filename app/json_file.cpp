#include "app/json_file.hpp"

#include "app/standard_output.hpp"
#include "measured/files/atomic_file.hpp"

namespace flexarm::app {

bool is_standard_output(const std::string& json_file) {
  return json_file == "-";
}

void write_json(const std::string& json_file, const std::string& json) {
  if (json_file.empty()) return;
  if (is_standard_output(json_file)) {
    print_document(json);
  } else {
    measured::write_atomically(json_file, json);
  }
}

}  // namespace flexarm::app
