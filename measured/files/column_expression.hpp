#pragma once

#include "measured/files/foreign_table.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace flexarm::measured {

/// A column that is computed from others, row by row: "0.1574*(V - 0.518*omega)".
///
/// The grammar is muParser's: + - * / ^, comparisons, && ||, ?:, sin, cos, tan, asin, acos, atan,
/// atan2, sinh, ..., exp, ln, log2, log10, sqrt, abs, sign, rint, min, max, sum, avg, and pi.
/// Columns stand by their names (`column_place`): bare where they consist of letters, digits,
/// underscores and points; otherwise in brackets, as in [Output Voltage (V)], [data(:,1)] or [#3].
/// The numbers are those of the log, without units. ddt(COLUMN) is the rate of a column per second,
/// (x_{k+1} - x_{k-1})/(t_{k+1} - t_{k-1}), one-sided at both ends.

/// Throws InputError `expression = ...: ...` for a text that is no expression, whatever the
/// columns are.
void require_expression(const std::string& expression);

/// The places of the columns that an expression takes, ascending, each once. Throws InputError as
/// `require_expression`, for columns that are not among `names`, and for names that several have.
std::vector<std::size_t> columns_in(const std::string& expression,
                                    const std::vector<std::string>& names);

/// The value in each row; NaN where a cell that it takes is empty. Throws InputError as
/// `columns_in`, for columns of text or of unlike length, and for a rate without times.
///
/// `times_s` are those of the rows; empty where they are not known.
std::vector<double> evaluate_expression(const std::string& expression, const ForeignTable& table,
                                        std::span<const double> times_s);

}  // namespace flexarm::measured
