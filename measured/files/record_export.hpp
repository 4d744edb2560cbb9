#pragma once

#include "measured/files/frequency_record.hpp"
#include "measured/files/mat_file.hpp"
#include "measured/files/time_record.hpp"
#include "measured/files/universal_file.hpp"

#include <vector>

namespace flexarm::measured {

/// A record as functions of a universal file: the torque, then each sensor and a reference, called
/// by their standard headers, `hub_angle [rad]`, in the first ID line. Frequency responses are followed by
/// their coherence where any of it is known.
std::vector<UniversalFunction> universal_functions(const TimeRecord& record);
std::vector<UniversalFunction> universal_functions(const FrequencyRecord& record);

/// A record as MATLAB variables. In time: `schema`, `time_s` and `torque_N_m` (n x 1), `sensors`
/// and `units` (lists), `values` (n x sensors), with a reference also `reference` (n x 1) and
/// `reference_unit`. In frequency: `schema`, `sensors`, `units`, and for
/// the k-th sensor `frequency_Hz_k`, `response_k` (complex), `coherence_k` (NaN where unknown).
std::vector<MatVariable> mat_variables(const TimeRecord& record);
std::vector<MatVariable> mat_variables(const FrequencyRecord& record);

/// `schema` of the two.
inline constexpr const char* kTimeRecordSchema = "flexarm.time_record/1";
inline constexpr const char* kFrequencyRecordSchema = "flexarm.frequency_record/1";

}  // namespace flexarm::measured
