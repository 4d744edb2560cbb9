#include "measured/files/response_unit.hpp"

#include "measured/files/column_mapping.hpp"
#include "measured/files/column_name.hpp"
#include "measured/files/delimited_line.hpp"
#include "measured/files/unit_spelling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

namespace flexarm::measured {

namespace {

using std::string_view;

/// Whether a response may be to something in the unit.
bool is_input_unit(const std::string& unit) {
  constexpr std::array<string_view, 8> kOthers = {"N", "mN", "kN", "MN", "V", "mV", "A", "mA"};
  return !unit.empty() && (is_unit_of("torque", unit) || std::ranges::count(kOthers, unit) > 0);
}

bool split_at(string_view text, std::size_t at, std::size_t size, ResponseUnit& unit) {
  const std::string front = canonical_unit(text.substr(0, at));
  const std::string behind = canonical_unit(text.substr(at + size));
  if (!is_canonical_unit(front) || !is_input_unit(behind)) return false;
  unit = {front, behind};
  return true;
}

/// Endings that tell a response per N m, and what they leave of the unit.
constexpr std::array<std::pair<string_view, string_view>, 9> kPerTorque = {{
    {"*N^-1*m^-1", ""},
    {" N^-1 m^-1", ""},
    {"/(s N m)", "/s"},
    {"/(N m s)", "/s"},
    {"/(s*N*m)", "/s"},
    {"/(N*m*s)", "/s"},
    {"/(s^2 N m)", "/s^2"},
    {"/(N m s^2)", "/s^2"},
    {"/(N*m*s^2)", "/s^2"},
}};

}  // namespace

ResponseUnit split_response_unit(string_view text) {
  const std::string whole = canonical_unit(text);
  ResponseUnit unit{whole, ""};
  if (is_canonical_unit(whole)) return unit;
  const std::string plain = in_plain_signs(whole);
  for (const auto& [ending, left] : kPerTorque) {
    if (!plain.ends_with(ending)) continue;
    const std::string front =
        canonical_unit(plain.substr(0, plain.size() - ending.size()) + std::string(left));
    if (is_canonical_unit(front)) return {front, "N m"};
  }
  const string_view inside = whole;  // without brackets around
  constexpr string_view kPer = " per ";
  for (std::size_t at = inside.rfind('/'); at != string_view::npos && at > 0;
       at = inside.rfind('/', at - 1)) {
    if (split_at(inside, at, 1, unit)) return unit;
  }
  if (const auto at = inside.rfind(kPer); at != string_view::npos) {
    split_at(inside, at, kPer.size(), unit);
  }
  return unit;
}

bool is_stiffness_unit(string_view text) {
  const std::string whole = canonical_unit(text);
  if (is_canonical_unit(whole) || !split_response_unit(whole).per.empty()) return false;
  for (auto at = whole.find('/'); at != std::string::npos; at = whole.find('/', at + 1)) {
    if (is_input_unit(canonical_unit(string_view(whole).substr(0, at))) &&
        is_canonical_unit(canonical_unit(string_view(whole).substr(at + 1)))) {
      return true;
    }
  }
  return false;
}

double hertz_in_one(string_view unit) {
  if (unit == "Hz") return 1.0;
  if (unit == "kHz") return 1e3;
  if (unit == "rpm") return 1.0 / 60.0;
  return unit == "rad/s" ? 1.0 / (2.0 * std::numbers::pi) : 0.0;
}

arm::InputError no_unit_of_frequencies(const std::string& what, const std::string& unit) {
  return arm::InputError(fmt::format("{}: frequencies in {}; must be in Hz, kHz, rad/s or rpm",
                                     what, arm::shown(unit)));
}

}  // namespace flexarm::measured
