#pragma once

#include "python/formulations.hpp"
#include "response/frequency/frequency_response.hpp"
#include "response/state_space.hpp"

#include <optional>
#include <pybind11/pybind11.h>
#include <vector>

namespace flexarm::python {

/// What the methods of a formulation ask of a frequency response.
struct FrequencyRange {
  std::optional<double> from_Hz;
  std::optional<double> to_Hz;
  int points;
  int modes;
};

/// At these frequencies, or where they are empty at those that `flexarm response` takes.
response::FrequencyResponse frequency_response_of(const Formulation& formulation,
                                                  const std::vector<arm::Sensor>& sensors,
                                                  const std::vector<double>& frequency_Hz,
                                                  const FrequencyRange& range);

response::StateSpace state_space_of(const Formulation& formulation,
                                    const std::vector<arm::Sensor>& sensors,
                                    std::optional<int> modes, bool static_correction);

}  // namespace flexarm::python
