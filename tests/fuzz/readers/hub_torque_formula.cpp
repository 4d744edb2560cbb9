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

/// Without numbers of its own, with one, and with two, which must stand in the text.
const std::vector<std::vector<std::string>>& number_names() {
  static const std::vector<std::vector<std::string>> names = {{}, {"k"}, {"c", "k"}};
  return names;
}

void read_formula(std::string_view bytes) {
  const std::string text(bytes);
  for (const auto& names : number_names()) {
    returns_or_refuses([&] {
      const arm::CompiledFormula formula(text, names);
      const std::vector<double> numbers(names.size(), 0.5);
      for (const double direction : {-1.0, 1.0}) {
        formula({0.1, 2.0 * direction, 0.3, 4.0}, direction, numbers);
      }
    });
    returns_or_refuses([&] {
      arm::HubTorqueFormula stated{text};
      std::map<std::string, double> typical;
      for (const auto& name : names) {
        stated.numbers.push_back({name});
        typical[name] = 0.5;
      }
      arm::define_effect("law", stated, typical);
    });
  }
}

}  // namespace

Reader hub_torque_formula() {
  return {"hub_torque_formula", read_formula};
}

}  // namespace flexarm::fuzz
