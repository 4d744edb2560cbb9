#include "app/exported_arm.hpp"

#include "arm/input_error.hpp"
#include "effects/registry/vocabulary.hpp"
#include "measured/files/arm_file.hpp"
#include "measured/files/text_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>

namespace flexarm::app {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestDiagnosis_bytes = std::size_t{1} << 28U;
constexpr const char* kSchema = "flexarm.diagnosis/2";

arm::InputError not_a_diagnosis(const std::string& file, const std::string& why) {
  return arm::InputError(fmt::format(
      "{}: {}; must be an arm file (.toml) or the JSON of flexarm diagnose", file, why));
}

}  // namespace

ExportedArm read_exported_arm(const std::string& file) {
  if (fs::path(file).extension() != ".json") {
    return {measured::read_arm_file(file, effects::vocabulary())};
  }
  const std::string text = measured::read_text_file(file, kLargestDiagnosis_bytes);
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (json.is_discarded()) throw not_a_diagnosis(file, "is not JSON");
  if (!json.is_object() || json.value("schema", "") != kSchema) {
    throw not_a_diagnosis(file, fmt::format("schema is not {}", kSchema));
  }
  try {
    const auto& extended = json.at("extended_arm");
    if (extended.is_null()) {
      throw arm::InputError(fmt::format("{}: the diagnosis has no extended arm", file));
    }
    const fs::path arm_file = fs::path(file).parent_path() / extended.get<std::string>();
    ExportedArm made{measured::read_arm_file(arm_file, effects::vocabulary())};
    for (const auto& cause : json.at("causes")) {
      for (const auto& [name, estimate] : cause.at("parameters").items()) {
        made.standard_deviations[fmt::format("effects.{}.{}", cause.at("effect").get<std::string>(),
                                             name)] = estimate.at("std_error").get<double>();
      }
    }
    for (const auto& number : json.at("uncertain_numbers")) {
      made.standard_deviations[number.at("key").get<std::string>()] =
          number.at("std_error").get<double>();
    }
    return made;
  } catch (const nlohmann::json::exception& error) {
    throw not_a_diagnosis(file, error.what());
  }
}

}  // namespace flexarm::app
