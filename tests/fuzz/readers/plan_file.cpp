#include "diagnose/planning/measurement_plan.hpp"
#include "tests/fuzz/contract.hpp"
#include "tests/fuzz/reader.hpp"

namespace flexarm::fuzz {

namespace {

void read_plan(std::string_view bytes) {
  returns_or_refuses([&] {
    const auto plan = diagnose::parse_measurement_plan(bytes, "plan.toml");
    const std::string text = diagnose::format_measurement_plan(plan);
    const auto again = diagnose::parse_measurement_plan(text, "plan.toml");
    require(diagnose::format_measurement_plan(again) == text,
            "a plan is not read back as it was written");
  });
}

}  // namespace

Reader plan_file() {
  return {"plan_file", read_plan};
}

}  // namespace flexarm::fuzz
