#pragma once

#include "measured/files/mat_file.hpp"
#include "report/tables/table.hpp"
#include "response/frequency/frequency_response.hpp"
#include "response/state_space.hpp"

#include <nlohmann/json_fwd.hpp>

#include <vector>

namespace flexarm::report {

/// A state space and its own frequency response; the matrices and names of all three files below.
struct StateSpaceExport {
  const response::StateSpace& system;
  const response::FrequencyResponse& response;
};

/// The document of schema `flexarm.state_space/1` (docs/json.md) without its `schema`; matrices are
/// arrays of rows.
nlohmann::ordered_json state_space_json(const StateSpaceExport& state_space);

/// One entry of a matrix a row: matrix, row, column (from 1), and what row and column stand for.
/// Zeros are written too; the delay is the only entry of a matrix `delay_s`.
Table state_space_listing(const response::StateSpace& system);

/// Variables A, B, C, D, delay_s, states, sensors, units, frequency_Hz (a row) and response
/// (sensors x frequencies, complex).
std::vector<measured::MatVariable> state_space_mat(const StateSpaceExport& state_space);

}  // namespace flexarm::report
