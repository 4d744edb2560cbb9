#pragma once

#include "arm/sensor.hpp"
#include "export/samples/arm_samples.hpp"
#include "response/state_space.hpp"
#include "response/truncation.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::samples {

struct StateSpaceSettings {
  std::string formulation = "exact_tf";
  std::optional<int> modes = {};  ///< flexible ones; empty: chosen for the nominal arm
  bool static_correction = true;
  std::vector<arm::Sensor> sensors = {};
};

/// State spaces (response/state_space.hpp) of all samples, with the same states in the same order:
/// modes by ascending frequency, each with the sign of a positive hub slope, then lags. A sample
/// without a lag that others have gets a state in its place that nothing reaches and that reaches
/// nothing, x' = -x.
struct SampledStateSpace {
  std::vector<std::string> states;
  std::vector<response::StateSpace> systems;  ///< one a sample
  /// Of the nominal arm, from well below its first pole to above its fifth.
  response::Truncation truncation;
};

/// `advance` is called after each sample, from any thread. Throws InputError as the formulation and
/// `require_responsive` do; for one that was drawn with its number.
SampledStateSpace state_spaces(const ArmSamples& samples, const StateSpaceSettings& settings,
                               const std::function<void()>& advance = {});

}  // namespace flexarm::samples
