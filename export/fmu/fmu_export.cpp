#include "export/fmu/fmu_export.hpp"

#include "arm/arm_keys.hpp"
#include "arm/ascii.hpp"
#include "export/fmu/embedded_files.hpp"
#include "export/fmu/xml_text.hpp"
#include "export/fmu/zip_archive.hpp"
#include "measured/files/arm_file.hpp"

#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/string_generator.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

namespace flexarm::fmu {

namespace {

/// A namespace of names by [RFC4122], of this project's own.
constexpr const char* kNamespace = "6f0c2a7e-5d0b-4c57-9b8e-0f3a6c1d2e94";

/// "{...}", which depends on every byte of the texts.
std::string token_of(const std::vector<std::string_view>& texts) {
  std::string all;
  for (const std::string_view text : texts) all += fmt::format("{}:{}", text.size(), text);
  const boost::uuids::uuid own = boost::uuids::string_generator()(kNamespace);
  return fmt::format("{{{}}}",
                     boost::uuids::to_string(boost::uuids::name_generator_sha1(own)(all)));
}

/// Those that the arm states of its numbers, and those of the request.
std::map<std::string, double> standard_deviations(const FmuRequest& request) {
  std::map<std::string, double> made = request.standard_deviations;
  for (const auto& [name, relative] : request.arm.relative_uncertainties) {
    const auto key = std::ranges::find(arm::arm_keys(), name, &arm::ArmKey::name);
    made.emplace(name, relative * std::abs(key->get(request.arm).value()));
  }
  return made;
}

std::string description_of(const FmuRequest& request) {
  std::string effects;
  for (const auto& [name, effect] : request.arm.effects) {
    effects += (effects.empty() ? "; effects: " : ", ") + name;
  }
  return fmt::format("Single-link flexible manipulator, {} by {}{}",
                     request.settings.modes == 1
                         ? std::string("1 flexible mode")
                         : fmt::format("{} flexible modes", request.settings.modes),
                     request.settings.formulation, effects);
}

/// documentation/index.html
std::string page(const FmuDescription& fmu) {
  std::string rows;
  for (const FmuVariable& variable : fmu.variables) {
    const auto deviation = fmu.standard_deviations.find(variable.name);
    const bool has_start =
        variable.causality == Causality::parameter || variable.causality == Causality::input;
    rows += fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
        xml_escaped(variable.name), xml_escaped(variable.unit),
        has_start ? xml_number(variable.start) : "",
        deviation == fmu.standard_deviations.end() ? "" : fmt::format("{:.3g}", deviation->second),
        xml_escaped(variable.meaning));
  }
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{0}</title></head>\n"
      "<body><h1>{0}</h1>\n<p>{1}. Written by {2}. The torque is constant between communication "
      "points; inner steps of {3} s.</p>\n"
      "<table><tr><th>variable</th><th>unit</th><th>start</th><th>standard deviation</th>"
      "<th>meaning</th></tr>\n{4}</table></body></html>\n",
      xml_escaped(fmu.model_name), xml_escaped(fmu.description), xml_escaped(fmu.generation_tool),
      xml_number(fmu.settings.sample_time_s), rows);
}

}  // namespace

std::string identifier_of(const std::string& text) {
  std::string made;
  for (const char c : text) made += arm::is_letter(c) || arm::is_digit(c) ? c : '_';
  if (made.empty() || !arm::is_letter(made.front())) made.insert(0, "arm_");
  return made;
}

Fmu make_fmu(const FmuRequest& request) {
  make_cosimulated(request.arm, request.settings)
      .readings();  // throws for what cannot be simulated
  FmuDescription fmu{
      .model_name = request.arm.name.empty() ? request.model_identifier : request.arm.name,
      .model_identifier = request.model_identifier,
      .description = description_of(request),
      .generation_tool = "flexarm " FLEXARM_VERSION,
      .settings = request.settings,
      .variables = fmu_variables(request.arm, request.settings.sensors),
      .standard_deviations = standard_deviations(request),
      .source_files = {}};
  std::vector<measured::NamedContent> files;
  for (const EmbeddedFile& file : fmu_files()) {
    constexpr std::string_view kSources = "sources/";
    if (file.name.starts_with(kSources) && file.name.ends_with(".cpp")) {
      fmu.source_files.emplace_back(file.name.substr(kSources.size()));
    }
    files.push_back({std::string(file.name), std::string(file.content)});
  }
  const bool is_v2 = request.version == FmiVersion::v2;
  const std::string arm = measured::format_arm(request.arm);
  fmu.settings.token.clear();
  const std::string unnamed = model_description(fmu, request.version);
  fmu.settings.token = token_of({unnamed, arm, fmu_library()});

  const std::string resources = "resources/";
  files.push_back({resources + std::string(kArmFile), arm});
  files.push_back({resources + std::string(kSettingsFile), format_settings(fmu.settings)});
  files.push_back({fmt::format("binaries/{}/{}.so", is_v2 ? kFmi2Platform : kFmi3Platform,
                               fmu.model_identifier),
                   std::string(fmu_library())});
  files.push_back({"documentation/index.html", page(fmu)});
  if (!is_v2) files.push_back({"sources/buildDescription.xml", build_description(fmu)});
  // First: a reader of the file comes upon it without reading the library.
  files.insert(files.begin(), {"modelDescription.xml", model_description(fmu, request.version)});
  return {zip_archive(files), std::move(fmu)};
}

}  // namespace flexarm::fmu
