#include "tests/reference/reference_cases.hpp"

#include "tests/reference/digits.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace flexarm::reference {
namespace {

using nlohmann::json;

ReferenceResponse response(const json& point) {
  return {complex_number(point.at("s")), complex_number(point.at("hub_angle")),
          complex_number(point.at("tip_displacement")),
          complex_number(point.at("curvature_quarter"))};
}

template <class Value, std::size_t size>
void read(const json& list, Value (*convert)(const json&), std::array<Value, size>& values) {
  if (list.size() != size) throw std::length_error("reference list of " + list.dump());
  std::transform(list.begin(), list.end(), values.begin(), convert);
}

ReferenceCase reference_case(const std::string& name, const json& values) {
  ReferenceCase each{};
  each.name = name;
  each.flexural_rigidity_N_m2 = number(values.at("EI"));
  each.linear_density_kg_per_m = number(values.at("rho"));
  each.length_m = number(values.at("l"));
  each.hub_inertia_kg_m2 = number(values.at("Ih"));
  each.payload_mass_kg = number(values.at("Mp"));
  each.payload_inertia_kg_m2 = number(values.at("Ip"));
  read(values.at("pole_lambda"), number, each.pole_lambda);
  read(values.at("pole_hz"), number, each.pole_Hz);
  read(values.at("hub_zero_lambda"), number, each.hub_zero_lambda);
  read(values.at("hub_zero_hz"), number, each.hub_zero_Hz);
  read(values.at("tip_zero_alpha_rad_s"), number, each.real_tip_zero_rad_per_s);
  read(values.at("transfer"), response, each.responses);
  values.at("pole_lambda").get_to(each.pole_lambda_digits);
  values.at("hub_zero_lambda").get_to(each.hub_zero_lambda_digits);
  return each;
}

}  // namespace

const std::vector<ReferenceCase>& reference_cases() {
  static const std::vector<ReferenceCase> cases = [] {
    std::ifstream file(FLEXARM_SOURCE_DIR "/tests/reference/exact.json");
    std::vector<ReferenceCase> read_cases;
    const json all = json::parse(file);
    for (const auto& [name, values] : all.items()) {
      read_cases.push_back(reference_case(name, values));
    }
    return read_cases;
  }();
  return cases;
}

const ReferenceCase& case_named(std::string_view name) {
  const auto& cases = reference_cases();
  const auto found = std::find_if(cases.begin(), cases.end(),
                                  [&](const ReferenceCase& each) { return each.name == name; });
  if (found == cases.end()) throw std::out_of_range("no reference case " + std::string(name));
  return *found;
}

arm::Arm arm_of(const ReferenceCase& reference) {
  arm::Arm arm;
  arm.beam = arm::Beam::from_rigidity(reference.length_m, reference.flexural_rigidity_N_m2,
                                      reference.linear_density_kg_per_m);
  arm.beam.thickness_m = 2.0;
  arm.hub.inertia_kg_m2 = reference.hub_inertia_kg_m2;
  arm.payload = {reference.payload_mass_kg, reference.payload_inertia_kg_m2};
  return arm;
}

void PrintTo(const ReferenceCase& reference, std::ostream* out) {
  *out << reference.name;
}

}  // namespace flexarm::reference
