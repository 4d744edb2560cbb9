#include "arm/input_error.hpp"
#include "measured/files/atomic_file.hpp"
#include "measured/files/number_cell.hpp"
#include "measured/files/universal_file.hpp"
#include "measured/files/universal_grid.hpp"
#include "measured/files/universal_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>

namespace flexarm::measured {

namespace {

using arm::InputError;
using std::string_view;

constexpr int kFewDecimals = 5;    // E13.5
constexpr int kManyDecimals = 12;  // E20.12

void require_writable(const UniversalFunction& function) {
  const std::size_t points = function.abscissa.size();
  const bool is_real = function.imaginary.empty();
  if (points == 0 || function.real.size() != points ||
      (!is_real && function.imaginary.size() != points)) {
    throw std::invalid_argument("universal function with vectors of different length, or empty");
  }
  for (const auto* values : {&function.abscissa, &function.real, &function.imaginary}) {
    const auto bad =
        std::ranges::find_if(*values, [](double value) { return !std::isfinite(value); });
    if (bad == values->end()) continue;
    throw InputError(fmt::format("{} = {} in point {}: must be a finite number",
                                 arm::shown(function.id[0]), *bad, bad - values->begin() + 1));
  }
}

/// Text of one line, at most `width` bytes.
std::string fitted(string_view text, std::size_t width) {
  std::string out(text.substr(0, width));
  std::ranges::replace_if(
      out, [](char c) { return c < ' '; }, ' ');
  return out;
}

/// A line of no more than 80 bytes that is none of -1 alone.
std::string id_line(string_view text) {
  constexpr std::size_t kWidth = 80;
  const std::string line = fitted(text, kWidth);
  return line.empty() ? "NONE" : line;
}

std::string axis_line(const UniversalAxis& axis) {
  return fmt::format("{:>10}{:>5}{:>5}{:>5} {:<20} {:<20}\n", axis.quantity, axis.length_exponent,
                     axis.force_exponent, axis.temperature_exponent, fitted(axis.label, 20),
                     fitted(axis.units, 20));
}

std::string place_fields(const UniversalPlace& place) {
  return fmt::format(" {:<10}{:>10}{:>4}", fitted(place.entity, 10), place.node, place.direction);
}

/// The grid that a function's abscissa is near enough to (1e-6 of a step) to be called even.
UniversalGrid grid_of(const std::vector<double>& abscissa, bool& is_even) {
  constexpr double kNear_steps = 1e-6;
  is_even = false;
  UniversalGrid grid{abscissa.front(), 1.0};
  if (abscissa.size() > 1) {
    grid.step = (abscissa.back() - abscissa.front()) / static_cast<double>(abscissa.size() - 1);
  }
  if (!(grid.step > 0.0) || !std::isfinite(grid.step)) return grid;
  for (std::size_t k = 0; k < abscissa.size(); ++k) {
    const double off = abscissa[k] - (grid.first + static_cast<double>(k) * grid.step);
    if (!(std::abs(off) <= kNear_steps * grid.step)) return grid;
  }
  is_even = true;
  return {in_six_digits(grid.first), in_six_digits(grid.step)};
}

/// A data set as it stands in the file, and what a reader gets from it.
class Writer {
 public:
  Writer(std::string& out, const UniversalOptions& options) : out_(out), options_(options) {}

  /// Appends the function; returns the abscissa and the ordinates that are read back.
  UniversalFunction write(const UniversalFunction& function) {
    layout_.is_complex = !function.imaginary.empty();
    layout_.is_double = !options_.single_precision;
    grid_ = grid_of(function.abscissa, layout_.is_even);
    UniversalFunction read = function;
    if (layout_.is_even) {
      read.abscissa = grid_points(grid_, function.abscissa.size());
      // Bytes hold what the digits of the grid do not.
      if (options_.binary && layout_.is_double && read.abscissa != function.abscissa) {
        layout_.is_even = false;
        read.abscissa = function.abscissa;
      }
    }
    write_head(function);
    if (options_.binary) {
      write_bytes(function);
    } else {
      write_text(function, read);
    }
    out_ += "    -1\n";
    return read;
  }

 private:
  void write_head(const UniversalFunction& function) {
    const std::size_t points = function.abscissa.size();
    if (points > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
      throw InputError(fmt::format("{}: {} points; a universal file has fewer",
                                   arm::shown(function.id[0]), points));
    }
    out_ += "    -1\n    58";
    if (options_.binary) {
      out_ +=
          fmt::format("b{:>6}{:>6}{:>12}{:>12}{:>6}{:>6}{:>12}{:>12}", options_.big_endian ? 2 : 1,
                      2, 11, points * layout_.numbers() * layout_.bytes(), 0, 0, 0, 0);
    }
    out_ += '\n';
    for (const auto& id : function.id) out_ += fmt::format("{:<80}\n", id_line(id));
    out_ += fmt::format("{:>5}{:>10}{:>5}{:>10}{}{}\n", function.type, function.number,
                        function.version, function.load_case, place_fields(function.response),
                        place_fields(function.reference));
    const int form =
        (layout_.is_complex ? 5 : 2) + (layout_.is_double ? (layout_.is_complex ? 1 : 2) : 0);
    out_ += fmt::format("{:>10}{:>10}{:>10}", form, points, layout_.is_even ? 1 : 0);
    for (const double value :
         {layout_.is_even ? grid_.first : 0.0, layout_.is_even ? grid_.step : 0.0, function.z}) {
      out_ += fortran_number(value, 13, kFewDecimals);
    }
    out_ += '\n';
    out_ += axis_line(function.abscissa_axis) + axis_line(function.ordinate_axis) +
            axis_line(function.denominator_axis) + axis_line(function.z_axis);
  }

  static double number(const UniversalFunction& function, const UniversalLayout& layout,
                       std::size_t point, std::size_t k) {
    if (layout.is_abscissa(k)) return function.abscissa[point];
    const bool is_imaginary = layout.is_complex && k + 1 == layout.numbers();
    return is_imaginary ? function.imaginary[point] : function.real[point];
  }

  void write_bytes(const UniversalFunction& function) {
    for (std::size_t point = 0; point < function.abscissa.size(); ++point) {
      for (std::size_t k = 0; k < layout_.numbers(); ++k) {
        const double value = number(function, layout_, point, k);
        std::uint64_t bits = std::bit_cast<std::uint64_t>(value);
        if (!layout_.is_double) {
          const auto rounded = static_cast<float>(value);
          if (!std::isfinite(rounded)) {
            throw InputError(fmt::format("{} = {}: does not fit single precision",
                                         arm::shown(function.id[0]), value));
          }
          bits = std::bit_cast<std::uint32_t>(rounded);
        }
        const std::size_t size = layout_.bytes();
        for (std::size_t byte = 0; byte < size; ++byte) {
          const std::size_t place = options_.big_endian ? size - 1 - byte : byte;
          out_ += static_cast<char>(static_cast<unsigned char>((bits >> (8U * place)) & 0xffU));
        }
      }
    }
  }

  void write_text(const UniversalFunction& function, UniversalFunction& read) {
    std::size_t on_line = 0;
    for (std::size_t point = 0; point < function.abscissa.size(); ++point) {
      for (std::size_t k = 0; k < layout_.numbers(); ++k) {
        const int width = layout_.width(k);
        const std::string field = fortran_number(number(function, layout_, point, k), width,
                                                 width == 20 ? kManyDecimals : kFewDecimals);
        out_ += field;
        store(read, point, k, field);
        if (++on_line == layout_.numbers_a_line()) {
          out_ += '\n';
          on_line = 0;
        }
      }
    }
    if (on_line > 0) out_ += '\n';
  }

  void store(UniversalFunction& read, std::size_t point, std::size_t k,
             const std::string& field) const {
    const double value = *number_cell<double>(field.substr(field.find_first_not_of(' ')));
    if (layout_.is_abscissa(k)) {
      read.abscissa[point] = value;
    } else if (layout_.is_complex && k + 1 == layout_.numbers()) {
      read.imaginary[point] = value;
    } else {
      read.real[point] = value;
    }
  }

  std::string& out_;
  UniversalOptions options_;
  UniversalLayout layout_;
  UniversalGrid grid_;
};

void subtract(std::vector<double>& from, const std::vector<double>& other) {
  for (std::size_t i = 0; i < from.size(); ++i) from[i] -= other[i];
}

UniversalFunction companion(const UniversalFunction& function, string_view mark) {
  UniversalFunction made;
  made.id[0] = function.id[0];
  made.id[4] = std::string(mark);
  made.type = kUniversalGeneral;
  made.response = function.response;
  made.reference = function.reference;
  for (std::size_t i = 0; i < function.abscissa.size(); ++i) {
    made.abscissa.push_back(static_cast<double>(i));
  }
  return made;
}

/// What the 13 digits of a field leave of a double is a whole number of its last places, at most
/// 2^13 of them: 13 digits of that restore it.
void write_ordinates(Writer& writer, const UniversalFunction& function, bool exactly,
                     UniversalFunction& read) {
  read = writer.write(function);
  if (!exactly || (read.real == function.real && read.imaginary == function.imaginary)) return;
  UniversalFunction rest = companion(function, kRemainderMark);
  rest.real = function.real;
  rest.imaginary = function.imaginary;
  subtract(rest.real, read.real);
  subtract(rest.imaginary, read.imaginary);
  writer.write(rest);
}

void write_abscissa(Writer& writer, const UniversalFunction& function) {
  UniversalFunction abscissa = companion(function, kAbscissaMark);
  abscissa.real = function.abscissa;
  UniversalFunction ignored;
  write_ordinates(writer, abscissa, true, ignored);
}

}  // namespace

std::vector<UniversalFunction> joined(std::vector<UniversalFunction> functions) {
  std::vector<UniversalFunction> out;
  bool is_abscissa = false;  // what the data set above held
  const auto add = [](std::vector<double>& to, const std::vector<double>& rest) {
    // Adding 0 would take the sign of -0.
    for (std::size_t i = 0; i < rest.size(); ++i) {
      if (rest[i] != 0.0) to[i] += rest[i];
    }
  };
  for (auto& function : functions) {
    const string_view mark = function.id[4];
    const bool is_remainder = mark == kRemainderMark;
    if (!is_remainder && mark != kAbscissaMark) {
      is_abscissa = false;
      out.push_back(std::move(function));
      continue;
    }
    is_abscissa = is_abscissa || !is_remainder;
    const bool fits = !out.empty() && out.back().real.size() == function.real.size() &&
                      (is_abscissa ? function.imaginary.empty()
                                   : function.imaginary.size() == out.back().imaginary.size());
    if (!fits) throw InputError("a FLEXARM data set does not match the one before it");
    if (!is_remainder) {
      out.back().abscissa = std::move(function.real);
    } else if (is_abscissa) {
      add(out.back().abscissa, function.real);
    } else {
      add(out.back().real, function.real);
      add(out.back().imaginary, function.imaginary);
    }
  }
  if (out.empty()) throw InputError("has no data set 58 of its own");
  return out;
}

std::string format_universal_file(const std::vector<UniversalFunction>& functions,
                                  const UniversalOptions& options) {
  std::string out;
  Writer writer(out, options);
  for (std::size_t i = 0; i < functions.size(); ++i) {
    const UniversalFunction& function = functions[i];
    require_writable(function);
    const bool exactly = !options.single_precision;
    UniversalFunction read;
    write_ordinates(writer, function, exactly, read);
    if (!exactly || read.abscissa == function.abscissa) continue;
    write_abscissa(writer, function);
  }
  return out;
}

void write_universal_file(const std::vector<UniversalFunction>& functions,
                          const std::filesystem::path& path, const UniversalOptions& options) {
  measured::write_atomically(path, format_universal_file(functions, options));
}

}  // namespace flexarm::measured
