#pragma once

#include "measured/files/time_record.hpp"
#include "report/figures/frequency_response_figure.hpp"

#include <cstddef>
#include <vector>

namespace flexarm::report::page {

/// Indices of the frequencies at which the torque of a record has power
/// (measured/modal/start_spectra.hpp): beyond them an estimated response says nothing.
std::vector<std::size_t> excited_lines(const measured::TimeRecord& record,
                                       const std::vector<double>& frequency_Hz);

/// The values at these lines; none of none.
template <class Number>
std::vector<Number> picked(const std::vector<Number>& values,
                           const std::vector<std::size_t>& lines) {
  std::vector<Number> made;
  if (values.empty()) return made;
  for (const std::size_t line : lines) made.push_back(values[line]);
  return made;
}
MeasuredResponse picked(const MeasuredResponse& response, const std::vector<std::size_t>& lines);

}  // namespace flexarm::report::page
