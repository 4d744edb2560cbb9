#include "diagnose/predictors/arm_responses.hpp"

#include "arm/linear_arm.hpp"
#include "arm/rigid_hub.hpp"
#include "response/formulation_maker.hpp"

namespace flexarm::diagnose {

ArmResponses::ArmResponses(std::size_t runs) {
  for (std::size_t r = 0; r < runs; ++r) kept_.emplace_back(kKept);
}

std::shared_ptr<const response::FrequencyResponse> ArmResponses::of(
    std::size_t run, const arm::Arm& arm, std::span<const arm::Sensor> sensors,
    std::span<const double> frequency_Hz) {
  const auto computed = [&] {
    return response::arm_response(response::formulation_of_fit(arm), sensors, frequency_Hz);
  };
  if (!arm::has_beam(arm)) return std::make_shared<const response::FrequencyResponse>(computed());
  return kept_[run].of({.arm = arm::linear_arm(arm),
                        .placed = arm::placed(sensors, arm),
                        .frequency_Hz = {frequency_Hz.begin(), frequency_Hz.end()}},
                       [&](const Key& /*key*/) { return computed(); });
}

}  // namespace flexarm::diagnose
