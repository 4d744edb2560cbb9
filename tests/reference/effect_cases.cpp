#include "tests/reference/effect_cases.hpp"

#include "effects/registry/vocabulary.hpp"
#include "measured/files/arm_file.hpp"
#include "tests/reference/digits.hpp"

#include <nlohmann/json.hpp>

#include <fstream>

namespace flexarm::reference {
namespace {

using nlohmann::json;

std::vector<double> numbers(const json& list) {
  std::vector<double> values;
  for (const json& text : list) values.push_back(number(text));
  return values;
}

EffectResponse effect_response(const json& point) {
  EffectResponse result;
  for (const auto& [key, value] : point.items()) {
    if (key == "s_rad_per_s") {
      result.s_rad_per_s = complex_number(value);
    } else {
      result.values[key] = complex_number(value);
    }
  }
  return result;
}

EffectCase effect_case(const json& values) {
  EffectCase each;
  values.at("name").get_to(each.name);
  each.arm = measured::parse_arm(values.at("arm").get<std::string>(), "effects.json: " + each.name,
                                 effects::vocabulary());
  each.total_inertia_kg_m2 = number(values.at("total_inertia_kg_m2"));
  each.lowest_omega_squared_rad2_per_s2 = number(values.at("lowest_omega_squared_rad2_per_s2"));
  each.pole_rad_per_s = numbers(values.at("pole_omega_rad_per_s"));
  each.hub_zero_rad_per_s = numbers(values.at("hub_zero_omega_rad_per_s"));
  each.real_tip_zero_rad_per_s = numbers(values.at("tip_zero_real_rad_per_s"));
  each.imaginary_tip_zero_rad_per_s = numbers(values.at("tip_zero_imaginary_rad_per_s"));
  for (const json& mode : values.at("mode_values")) {
    auto& by_sensor = each.mode_values.emplace_back();
    for (const auto& [sensor, text] : mode.items()) by_sensor[sensor] = number(text);
  }
  for (const json& point : values.at("responses")) each.responses.push_back(effect_response(point));
  for (const json& pole : values.at("damped_pole_rad_per_s")) {
    each.damped_pole_rad_per_s.push_back(complex_number(pole));
  }
  return each;
}

}  // namespace

const std::vector<EffectCase>& effect_cases() {
  static const std::vector<EffectCase> cases = [] {
    std::ifstream file(FLEXARM_SOURCE_DIR "/tests/reference/effects.json");
    std::vector<EffectCase> read;
    for (const json& values : json::parse(file)) read.push_back(effect_case(values));
    return read;
  }();
  return cases;
}

void PrintTo(const EffectCase& reference, std::ostream* out) {
  *out << reference.name;
}

}  // namespace flexarm::reference
