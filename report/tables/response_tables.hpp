#pragma once

#include "report/tables/table.hpp"
#include "response/frequency/response_study.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::report {

/// "rad/(N m)": the unit of a sensor's response to torque.
/// With an input that is a sensor of the hub: "m/rad".
std::string response_unit(const arm::Sensor& sensor, const std::optional<arm::Sensor>& input = {});

/// Undamped and damped poles, the lowest (order 0) first, `most` flexible ones; a row for each root
/// of a real pair; and the poles that lags of actuator and sensors add.
Table response_poles_table(const response::ResponseStudy& study, std::size_t most);

/// What sensor `index` responds, as two formulas: the product over poles and zeros, (40)-(42) of
/// the paper put right, and the modal sum, (48)-(49) put right; `factors_table` has their numbers.
std::vector<std::string> formulas(const response::ResponseStudy& study, std::size_t index);

/// omega_i, zero z_i, residue r_i and damping d_i of sensor `index`, a row an order i.
Table factors_table(const response::ResponseStudy& study, std::size_t index);

/// Frequency, and for each sensor magnitude, decibel and continuous phase of its response, at
/// `most` frequencies or so, evenly picked; all of them when `most` is 0.
Table response_table(const response::FrequencyResponse& response, std::size_t most);

/// The same with real and imaginary part, for a file.
Table response_listing(const response::FrequencyResponse& response);

/// frequency [Hz], sensor, re, im, coherence: a measurement of kind `frf` (docs/formats.md).
Table frf_listing(const response::FrequencyResponse& response);

/// Feedthrough D of each sensor, and how far the state space is from the response.
Table state_space_table(const response::ResponseStudy& study);

/// "6 states, 2 modes beside the rigid-body one, static correction": what a state space is made of.
std::string describe_state_space(const response::ResponseStudy& study);

/// Lines that say what of the arm's actuator, sensors and hub is in the response, and what is left
/// out because it is not linear; empty for an arm without such effects.
std::vector<std::string> chain_notes(const response::ResponseStudy& study);

}  // namespace flexarm::report
