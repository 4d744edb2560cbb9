#include "measured/files/universal_file.hpp"

#include "arm/input_error.hpp"
#include "measured/files/number_cell.hpp"
#include "measured/files/record_constants.hpp"
#include "measured/files/universal_grid.hpp"
#include "measured/files/universal_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

namespace flexarm::measured {

namespace {

using arm::InputError;
using std::string_view;

string_view trimmed_line(string_view text) {
  constexpr string_view kBlanks = " \t\r\f\v";
  const auto first = text.find_first_not_of(kBlanks);
  if (first == string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

/// Goes through the bytes of a file, line by line or by blocks.
class Cursor {
 public:
  explicit Cursor(string_view bytes) : bytes_(bytes) {}

  bool at_end() const { return at_ >= bytes_.size(); }
  std::size_t left() const { return bytes_.size() - std::min(at_, bytes_.size()); }
  /// Of the line read last.
  int line() const { return line_; }

  bool next(string_view& line) {
    if (at_end()) return false;
    const auto end = std::min(bytes_.find('\n', at_), bytes_.size());
    line = bytes_.substr(at_, end - at_);
    if (line.ends_with('\r')) line.remove_suffix(1);
    at_ = end + 1;
    ++line_;
    return true;
  }

  string_view take(std::size_t size) {
    const string_view block = bytes_.substr(at_, size);
    at_ += size;
    return block;
  }

 private:
  string_view bytes_;
  std::size_t at_ = 0;
  int line_ = 0;
};

/// The fields of a record, by columns.
class Fields {
 public:
  explicit Fields(string_view line) : line_(line) {}

  string_view text(std::size_t width) {
    const string_view field = line_.substr(0, width);
    line_.remove_prefix(field.size());
    return trimmed_line(field);
  }

  int whole(std::size_t width, const char* what) {
    const string_view field = text(width);
    if (field.empty()) return 0;
    if (const auto number = number_cell<int>(field)) return *number;
    throw InputError(fmt::format("{} = {}: must be a whole number", what, arm::shown(field)));
  }

  double number(std::size_t width, const char* what) {
    const string_view field = text(width);
    if (field.empty()) return 0.0;
    const auto value = number_cell<double>(field);
    if (value && std::isfinite(*value)) return *value;
    throw InputError(fmt::format("{} = {}: must be a finite number", what, arm::shown(field)));
  }

 private:
  string_view line_;
};

UniversalPlace place_in(Fields& fields, const char* what) {
  UniversalPlace place;
  place.entity = std::string(fields.text(11));
  place.node = fields.whole(10, what);
  place.direction = fields.whole(4, what);
  return place;
}

UniversalAxis axis_in(string_view line) {
  Fields fields(line);
  UniversalAxis axis;
  axis.quantity = fields.whole(10, "axis data type");
  axis.length_exponent = fields.whole(5, "length exponent");
  axis.force_exponent = fields.whole(5, "force exponent");
  axis.temperature_exponent = fields.whole(5, "temperature exponent");
  axis.label = std::string(fields.text(21));
  axis.units = std::string(fields.text(21));
  return axis;
}

/// Reads one data set after its first two lines.
class FunctionReader {
 public:
  FunctionReader(Cursor& cursor, string_view identifier) : cursor_(cursor) {
    Fields fields(identifier);
    fields.text(6);
    const string_view kind = fields.text(1);
    if (kind != "b" && kind != "B") return;
    is_binary_ = true;
    const int order = fields.whole(6, "byte order");
    const int format = fields.whole(6, "floating point format");
    if (order != 1 && order != 2) {
      throw InputError(
          fmt::format("byte order = {}: must be 1, little endian, or 2, big endian", order));
    }
    if (format != 2) {
      throw InputError(fmt::format("floating point format = {}: must be 2, IEEE 754", format));
    }
    is_big_endian_ = order == 2;
  }

  UniversalFunction read() {
    for (auto& id : function_.id) id = std::string(trimmed_line(line()));
    read_place(line());
    read_form(line());
    function_.abscissa_axis = axis_in(line());
    function_.ordinate_axis = axis_in(line());
    function_.denominator_axis = axis_in(line());
    function_.z_axis = axis_in(line());
    if (is_binary_) {
      read_bytes();
    } else {
      read_text();
    }
    if (layout_.is_even) function_.abscissa = grid_points(grid_, points_);
    return std::move(function_);
  }

 private:
  string_view line() {
    string_view line;
    if (!cursor_.next(line)) throw InputError("file incomplete");
    return line;
  }

  void read_place(string_view line) {
    Fields fields(line);
    function_.type = fields.whole(5, "function type");
    function_.number = fields.whole(10, "function number");
    function_.version = fields.whole(5, "version");
    function_.load_case = fields.whole(10, "load case");
    function_.response = place_in(fields, "response");
    function_.reference = place_in(fields, "reference");
  }

  void read_form(string_view line) {
    Fields fields(line);
    const int form = fields.whole(10, "ordinate data type");
    if (form != 2 && form != 4 && form != 5 && form != 6) {
      throw InputError(fmt::format(
          "ordinate data type = {}: must be 2 or 4, real in single or double precision, or 5 or 6, "
          "complex",
          form));
    }
    layout_.is_complex = form >= 5;
    layout_.is_double = form == 4 || form == 6;
    const int points = fields.whole(10, "number of points");
    // A number takes two bytes or more, which a header of random digits does not know.
    const std::size_t most = cursor_.left() / 2;
    if (points < 1 || static_cast<std::size_t>(points) > most) {
      throw InputError(
          fmt::format("number of points = {}: must be from 1 to {}, which the file "
                      "has room for",
                      points, most));
    }
    points_ = static_cast<std::size_t>(points);
    const int spacing = fields.whole(10, "abscissa spacing");
    if (spacing != 0 && spacing != 1) {
      throw InputError(
          fmt::format("abscissa spacing = {}: must be 0, uneven, or 1, even", spacing));
    }
    layout_.is_even = spacing == 1;
    grid_.first = fields.number(13, "abscissa minimum");
    grid_.step = fields.number(13, "abscissa increment");
    function_.z = fields.number(13, "z value");
    if (layout_.is_even && points_ > 1 && !(grid_.step > 0.0)) {
      throw InputError(fmt::format("abscissa increment = {}: must be above 0", grid_.step));
    }
  }

  void store(std::size_t index, double value) {
    const std::size_t k = index % layout_.numbers();
    if (!std::isfinite(value)) {
      throw InputError(
          fmt::format("number {} of the data set = {}: must be finite", index + 1, value));
    }
    if (layout_.is_abscissa(k)) {
      function_.abscissa.push_back(value);
    } else if (layout_.is_complex && k + 1 == layout_.numbers()) {
      function_.imaginary.push_back(value);
    } else {
      function_.real.push_back(value);
    }
  }

  void read_bytes() {
    const std::size_t numbers = points_ * layout_.numbers();
    const std::size_t size = layout_.bytes();
    if (numbers > cursor_.left() / size) {
      throw InputError(
          fmt::format("incomplete: {} of {} bytes of numbers", cursor_.left(), numbers * size));
    }
    const string_view block = cursor_.take(numbers * size);
    for (std::size_t i = 0; i < numbers; ++i) {
      std::uint64_t bits = 0;
      for (std::size_t byte = 0; byte < size; ++byte) {
        const std::size_t place = is_big_endian_ ? byte : size - 1 - byte;
        bits = bits << 8U | static_cast<unsigned char>(block[i * size + place]);
      }
      store(i, layout_.is_double
                   ? std::bit_cast<double>(bits)
                   : static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits))));
    }
    // The end stands right behind the last number, or on a line of its own.
    string_view end;
    while (cursor_.next(end) && trimmed_line(end).empty()) {
    }
    if (trimmed_line(end) != "-1") {
      throw InputError(fmt::format("{} bytes of numbers are not followed by -1", block.size()));
    }
  }

  /// Numbers between blanks where the line has such, and by columns where they abut.
  void read_text() {
    const std::size_t numbers = points_ * layout_.numbers();
    std::size_t done = 0;
    string_view text = line();
    for (; trimmed_line(text) != "-1"; text = line()) {
      if (done == numbers && !trimmed_line(text).empty()) {
        throw InputError(fmt::format("more than the {} numbers of the data set", numbers));
      }
      if (!read_words(text, done, numbers)) read_columns(text, done, numbers);
    }
    if (done < numbers) {
      throw InputError(fmt::format("incomplete data set: {} of {} numbers", done, numbers));
    }
  }

  bool read_words(string_view text, std::size_t& done, std::size_t numbers) {
    std::vector<double> values;
    for (text = trimmed_line(text); !text.empty(); text = trimmed_line(text)) {
      const auto end = std::min(text.find_first_of(" \t"), text.size());
      const auto value = number_cell<double>(text.substr(0, end));
      if (!value) return false;
      values.push_back(*value);
      text.remove_prefix(end);
    }
    for (const double value : values) {
      if (done < numbers) store(done++, value);  // the last line may be filled up
    }
    return true;
  }

  void read_columns(string_view text, std::size_t& done, std::size_t numbers) {
    Fields fields(text);
    for (std::size_t i = 0; i < layout_.numbers_a_line() && done < numbers; ++i) {
      const auto width = static_cast<std::size_t>(layout_.width(done % layout_.numbers()));
      const string_view field = fields.text(width);
      if (field.empty()) return;
      const auto value = number_cell<double>(field);
      if (!value) {
        throw InputError(
            fmt::format("{}: must be a number in {} columns", arm::shown(field), width));
      }
      store(done++, *value);
    }
  }

  Cursor& cursor_;
  bool is_binary_ = false;
  bool is_big_endian_ = false;
  UniversalLayout layout_;
  UniversalGrid grid_;
  std::size_t points_ = 0;
  UniversalFunction function_;
};

/// The lines of a data set, to its end.
std::vector<string_view> lines_to_end(Cursor& cursor) {
  std::vector<string_view> lines;
  string_view line;
  while (cursor.next(line)) {
    if (trimmed_line(line) == "-1") return lines;
    lines.push_back(line);
  }
  throw InputError("file incomplete: data set without its end line -1");
}

/// The code and the name of the units of data set 164; empty for SI, code 1.
std::string units_in(const std::vector<string_view>& lines) {
  if (lines.empty()) return "";
  Fields fields(lines.front());
  const int code = fields.whole(10, "units code");
  constexpr int kSi = 1;
  return code == kSi ? "" : fmt::format("{}, {}", code, fields.text(20));
}

}  // namespace

UniversalFile parse_universal_file(string_view bytes, const std::string& file_name) {
  UniversalFile file;
  Cursor cursor(bytes);
  try {
    string_view line;
    while (cursor.next(line)) {
      if (trimmed_line(line).empty()) continue;
      if (trimmed_line(line) != "-1") {
        throw InputError("not a universal file: a data set begins with a line of -1 alone");
      }
      if (!cursor.next(line)) throw InputError("file incomplete");
      const string_view number = trimmed_line(line.substr(0, 6));
      if (number == "58") {
        if (file.functions.size() == kMostRecordColumns) {
          throw InputError(fmt::format("more than {} data sets 58", kMostRecordColumns));
        }
        file.functions.push_back(FunctionReader(cursor, line).read());
      } else if (number == "55") {
        const auto lines = lines_to_end(cursor);
        file.modes.push_back(read_universal_mode(lines));
      } else {
        if (!number_cell<int>(number)) {
          throw InputError(
              fmt::format("{}: must be the number of a data set", arm::shown(trimmed_line(line))));
        }
        file.passed_over.emplace_back(number);
        const auto lines = lines_to_end(cursor);
        if (number == "164") file.units = units_in(lines);
      }
    }
    if (file.functions.empty() && file.modes.empty()) {
      throw InputError(
          file.passed_over.empty()
              ? "empty; must have one data set 58 or more"
              : "has no data set 58, which holds time and frequency responses, nor 55, "
                "which holds modes");
    }
    if (!file.functions.empty()) file.functions = joined(std::move(file.functions));
  } catch (const InputError& error) {
    throw arm::located(error, file_name, cursor.line());
  }
  return file;
}

}  // namespace flexarm::measured
