#pragma once

#include "measured/files/frequency_record.hpp"
#include "measured/files/time_record.hpp"

#include <pybind11/pybind11.h>
#include <string>
#include <vector>

namespace flexarm::python {

/// Numbers that a user gives under a name that ends in their unit: "hub_angle_deg", or under a
/// header of a CSV file, "hub_angle [deg]".
struct GivenColumn {
  std::string name;
  pybind11::object values;
};

/// The columns of a dict or a DataFrame (None: none), with an index that has a name, and then those
/// of the keywords that are not None. Throws arm::InputError for data that have no columns, a
/// column whose name is no text, and a name given twice.
std::vector<GivenColumn> columns_of(const pybind11::object& data, const pybind11::dict& keywords);

/// A time record of columns: time, torque, sensors and reference, in any unit that `flexarm import`
/// knows. `sample_time_s` is in place of the time, None where that is
/// given. Throws arm::InputError, which begins with the name of the column, for a name that is no
/// quantity, a unit that is not the quantity's or is missing, values that are no one-dimensional
/// array of finite numbers, and a time, a torque or all sensors that are missing.
measured::TimeRecord time_record_of(const std::vector<GivenColumn>& columns,
                                    const pybind11::object& sample_time_s);

/// Frequency responses of columns: frequency_Hz, complex responses as hub_angle_rad_per_N_m, and
/// hub_angle_coherence. `input` is "torque", or "hub_angle" or "hub_velocity", which the responses
/// are named per: tip_displacement_m_per_rad. Throws arm::InputError as `time_record_of`.
measured::FrequencyRecord frequency_record_of(const std::vector<GivenColumn>& columns,
                                              const std::string& input);

/// "time_s=None, torque_N_m=None, hub_angle_rad=None, ...": the columns of a record as keywords of
/// a signature, in SI units; `per` is "_per_N_m" for responses.
std::string column_keywords(const std::string& per);

}  // namespace flexarm::python
