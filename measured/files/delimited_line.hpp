#pragma once

#include <complex>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::measured {

/// How a delimited text is written.
struct Dialect {
  char separator = ',';  ///< ' ' stands for any run of blanks and tabs
  char decimal = '.';    ///< or ','

  bool operator==(const Dialect&) const = default;
};

/// "semicolons", "blanks".
std::string_view separator_name(const Dialect& dialect);

/// Takes lines apart into cells; what it returns is valid until the next line.
class LineSplitter {
 public:
  explicit LineSplitter(char separator) : separator_(separator) {}

  /// The cells without quotes and without blanks around. A quote that is not closed ends with the
  /// line. Between blanks a date and its clock are one cell.
  std::span<const std::string_view> split(std::string_view line);

  /// The same for a line of names: between blanks, what stands in brackets belongs to the name in
  /// front, as in "Time (ms) Angle (deg)".
  std::span<const std::string_view> split_names(std::string_view line);

 private:
  std::size_t quoted_end(std::string_view line, std::size_t at);
  void join_time_stamp();

  char separator_;
  std::vector<std::string_view> cells_;
  std::deque<std::string> rewritten_;
};

inline bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

/// The text with letters of ASCII in lower case.
std::string in_lower_case(std::string_view text);

/// Without blanks and tabs around.
std::string_view trimmed(std::string_view text);

/// A cell as a number with the dialect's decimal mark, `nan` and `inf` included.
std::optional<double> parse_cell(std::string_view cell, char decimal);

/// A cell as a complex number: 1+2j, (1-2i), 1.5e-3 + 2e-4*i, 1+j2, and 2j unless it `has_both`
/// parts; nothing for a real one.
std::optional<std::complex<double>> parse_complex_cell(std::string_view cell, char decimal,
                                                       bool has_both = false);

/// Whether the cell is empty or has what programs write in place of a number that there is not: NA,
/// null, -, ..., a sign of a number out of range among them.
bool is_missing_number(std::string_view cell);

/// Whether the cell has what programs and instruments write for a number beyond their range: OVLD,
/// OL, Overflow, 1.#INF, the sign of infinity.
bool is_over_range_sign(std::string_view cell);

/// Whether the cell is a number only with its thousands separators taken out: "1,234.5", "1'234",
/// "1 234,5".
bool has_thousands_separators(std::string_view cell, char decimal);

}  // namespace flexarm::measured
