#include "report/json/diagnosis_document.hpp"

#include "diagnose/diagnosis_request.hpp"
#include "measured/files/arm_file.hpp"
#include "measured/files/atomic_file.hpp"
#include "report/json/diagnosis_json.hpp"
#include "report/json/json_document.hpp"

#include <nlohmann/json.hpp>

namespace flexarm::report {

std::string diagnosis_document(const diagnose::Diagnosis& diagnosis,
                               const std::string& extended_arm) {
  return json_document("flexarm.diagnosis/3", diagnosis_json(diagnosis, extended_arm));
}

std::filesystem::path extended_arm_beside(const std::filesystem::path& json_file) {
  return std::filesystem::path(json_file).replace_extension("extended.toml");
}

void write_diagnosis(const diagnose::Diagnosis& diagnosis, const std::filesystem::path& json_file) {
  std::string extended;
  if (diagnose::has_extended_arm(diagnosis)) {
    const auto beside = extended_arm_beside(json_file);
    measured::write_atomically(beside, measured::format_arm(diagnosis.extended_arm));
    extended = beside.filename().string();
  }
  measured::write_atomically(json_file, diagnosis_document(diagnosis, extended));
}

}  // namespace flexarm::report
