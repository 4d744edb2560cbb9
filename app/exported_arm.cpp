#include "app/exported_arm.hpp"

#include "arm/input_error.hpp"
#include "effects/registry/vocabulary.hpp"
#include "measured/files/arm_file.hpp"
#include "measured/files/text_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <utility>

namespace flexarm::app {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestDiagnosis_bytes = std::size_t{1} << 28U;
/// The keys that are read are the same in both (docs/json.md).
constexpr const char* kSchema = "flexarm.diagnosis/3";
constexpr const char* kFormerSchema = "flexarm.diagnosis/2";

arm::InputError not_a_diagnosis(const std::string& file, const std::string& why) {
  return arm::InputError(fmt::format(
      "{}: {}; must be an arm file (.toml) or the JSON of flexarm diagnose", file, why));
}

}  // namespace

std::map<std::string, double> ExportedArm::standard_deviations() const {
  std::map<std::string, double> made;
  for (const samples::Marginal& marginal : posterior.sets.front().marginals) {
    made[marginal.key] = marginal.std_error;
  }
  return made;
}

ExportedArm read_exported_arm(const std::string& file) {
  if (fs::path(file).extension() != ".json") {
    arm::Arm arm = measured::read_arm_file(file, effects::vocabulary());
    auto posterior = samples::posterior_of(arm);
    return {std::move(arm), std::move(posterior)};
  }
  const std::string text = measured::read_text_file(file, kLargestDiagnosis_bytes);
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (json.is_discarded()) throw not_a_diagnosis(file, "is not JSON");
  const std::string schema = json.is_object() ? json.value("schema", "") : "";
  if (schema != kSchema && schema != kFormerSchema) {
    throw not_a_diagnosis(file, fmt::format("schema is not {}", kSchema));
  }
  try {
    const auto& extended = json.at("extended_arm");
    if (extended.is_null()) {
      throw arm::InputError("extended_arm: the diagnosis has none");
    }
    const fs::path arm_file = fs::path(file).parent_path() / extended.get<std::string>();
    arm::Arm arm = measured::read_arm_file(arm_file, effects::vocabulary());
    auto posterior = samples::posterior_of(json, arm);
    return {std::move(arm), std::move(posterior)};
  } catch (const nlohmann::json::exception& error) {
    throw not_a_diagnosis(file, error.what());
  } catch (const arm::InputError& error) {
    throw arm::located(error, file, 0);
  }
}

}  // namespace flexarm::app
