#pragma once

#include "measured/files/foreign_response.hpp"
#include "measured/files/foreign_table.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::measured {

/// Kinds of columns of a frequency response.
enum class ResponsePart { frequency, magnitude, phase, real, imaginary, coherence };

/// "magnitude", ...
std::string_view to_string(ResponsePart part);

/// A column that is part of a response.
struct PartColumn {
  ResponsePart part = ResponsePart::magnitude;
  std::string response;  ///< its name; empty for the frequencies, and in a file of one response
  std::size_t column = 0;
  std::string unit;  ///< dB, rad, deg, Hz, rad/s, or that of the response; empty: not told
  bool is_unit_assumed = false;  ///< of frequencies whose name and unit tell none
  std::string fault = {};        ///< why the numbers are not those of the part; empty: they are
};

/// Frequency responses in columns, and what was assumed to get them, a sentence each.
struct ResponseColumns {
  std::vector<ForeignResponse> responses;
  std::vector<std::string> notes;
  std::string incomplete;  ///< what a response lacks, where there are frequencies and no response
};

/// The parts of responses among the columns, by their names and units: a column of frequencies (f,
/// freq, Frequency, omega, w), and of each response the magnitude and the phase, or the real and
/// the imaginary part, perhaps the coherence: `H1 mag [dB]`, `H1 phase [deg]`, `Re(H1)`,
/// `hub_angle imag`. None where a column of the same length holds times.
std::vector<PartColumn> response_parts(const ForeignTable& table);

/// The base of the logarithms in a column, and the name of their numbers.
struct LogarithmName {
  double base = 10.0;  ///< 0 where the name leaves it open, "log f"
  std::string of;      ///< "f [Hz]"
};

/// "log10(f)", "lg f [Hz]", "ln(w)" of frequencies; nothing for any other name.
std::optional<LogarithmName> logarithm_of_frequency(std::string_view name);

/// The responses that the parts make, lines by ascending frequency; a line without a number in one
/// of them is left out. A magnitude in dB is 20 lg|H|. Of frequencies whose name is that of
/// logarithms the powers are taken. Throws InputError for a part that is given twice or missing,
/// for a column given for two, for columns of unlike length, and for a phase whose unit cannot be
/// told.
ResponseColumns responses_of(const ForeignTable& table, const std::vector<PartColumn>& parts);

/// The responses of `response_parts`; those that lack a part are left out and said.
ResponseColumns responses_in(const ForeignTable& table);

}  // namespace flexarm::measured
