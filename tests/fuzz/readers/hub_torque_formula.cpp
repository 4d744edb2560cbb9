#include "arm/compiled_formula.hpp"
#include "arm/given_effects.hpp"
#include "tests/fuzz/contract.hpp"
#include "tests/fuzz/reader.hpp"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace flexarm::fuzz {

namespace {

/// Numbers of its own that a formula may have; those that it does have must stand in it.
constexpr std::array<const char*, 2> kNumbers = {"c", "k"};
constexpr double kValue = 0.5;

void read_formula(std::string_view bytes) {
  arm::HubTorqueFormula stated{std::string(bytes)};
  std::vector<std::string> names;
  std::map<std::string, double> typical;
  for (const char* name : kNumbers) {
    if (bytes.find(name) == std::string_view::npos) continue;
    names.emplace_back(name);
    stated.numbers.push_back({name});
    typical[name] = kValue;
  }
  returns_or_refuses([&] {
    const arm::CompiledFormula formula(stated.text, names);
    const std::vector<double> numbers(names.size(), kValue);
    for (const double direction : {-1.0, 1.0}) {
      formula({0.1, 2.0 * direction, 0.3, 4.0}, direction, numbers);
    }
  });
  returns_or_refuses([&] { arm::define_effect("law", stated, typical); });
}

}  // namespace

Reader hub_torque_formula() {
  return {"hub_torque_formula", read_formula};
}

}  // namespace flexarm::fuzz
