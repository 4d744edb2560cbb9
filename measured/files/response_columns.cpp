#include "measured/files/response_columns.hpp"

#include "arm/input_error.hpp"
#include "measured/files/record_constants.hpp"
#include "measured/files/response_unit.hpp"
#include "measured/files/unit_spelling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <optional>
#include <string_view>
#include <utility>

namespace flexarm::measured {

namespace {

using arm::InputError;
using std::string_view;

constexpr std::array<string_view, 6> kPartNames = {"frequency", "magnitude", "phase",
                                                   "real",      "imaginary", "coherence"};

/// Whether it is dB, perhaps with what it refers to; dBm and dB10 are other measures.
bool is_decibel(string_view unit) {
  if (!unit.starts_with("dB")) return false;
  return unit.size() == 2 || string_view(" (/[:,").find(unit[2]) != string_view::npos;
}

/// The columns of one response.
struct Parts {
  std::string name;
  std::array<std::optional<PartColumn>, kPartNames.size()> of_kind;

  const std::optional<PartColumn>& operator[](ResponsePart part) const {
    return of_kind[static_cast<std::size_t>(part)];
  }
  bool is_polar() const { return (*this)[ResponsePart::magnitude] && (*this)[ResponsePart::phase]; }
  bool is_cartesian() const {
    return (*this)[ResponsePart::real] && (*this)[ResponsePart::imaginary];
  }

  /// Names the part that is missing; empty for a whole response.
  std::string missing() const {
    if (is_polar() || is_cartesian()) return "";
    for (const auto& [has, lacks] : {std::pair{ResponsePart::magnitude, ResponsePart::phase},
                                     std::pair{ResponsePart::phase, ResponsePart::magnitude},
                                     std::pair{ResponsePart::real, ResponsePart::imaginary},
                                     std::pair{ResponsePart::imaginary, ResponsePart::real}}) {
      if ((*this)[has]) return fmt::format("{} without {}", to_string(has), to_string(lacks));
    }
    return "coherence alone";
  }
};

/// Gathers the parts by the names of their responses. Of two magnitudes the one in dB is taken, as
/// of gain beside amplitude; other parts that are there twice are left out.
std::vector<Parts> gathered(const std::vector<PartColumn>& parts, std::vector<std::string>& notes,
                            const ForeignTable& table) {
  std::vector<Parts> all;
  for (const auto& part : parts) {
    if (part.part == ResponsePart::frequency) continue;
    auto found = std::ranges::find(all, part.response, &Parts::name);
    if (found == all.end()) {
      all.push_back({part.response, {}});
      found = all.end() - 1;
    }
    auto& place = found->of_kind[static_cast<std::size_t>(part.part)];
    const bool is_better = !place || (!place->fault.empty() && part.fault.empty()) ||
                           (is_decibel(part.unit) && !is_decibel(place->unit));
    if (place) {
      notes.push_back(
          fmt::format("{} of columns: {} is taken, {} is not", to_string(part.part),
                      arm::shown(table.columns[(is_better ? part : *place).column].name),
                      arm::shown(table.columns[(is_better ? *place : part).column].name)));
    }
    if (is_better) place = part;
  }
  return all;
}

/// A coherence that names no response belongs to the only one, or, of as many, to that in its
/// order.
void join_coherences(std::vector<Parts>& all) {
  std::vector<Parts> alone;
  std::vector<Parts> responses;
  for (auto& parts : all) {
    const bool is_alone = parts.missing() == "coherence alone";
    (is_alone ? alone : responses).push_back(std::move(parts));
  }
  const auto has_own = [](const Parts& parts) {
    return parts[ResponsePart::coherence].has_value();
  };
  if (alone.size() == responses.size() && std::ranges::none_of(responses, has_own)) {
    for (std::size_t i = 0; i < alone.size(); ++i) {
      constexpr auto kCoherence = static_cast<std::size_t>(ResponsePart::coherence);
      responses[i].of_kind[kCoherence] = alone[i].of_kind[kCoherence];
    }
    alone.clear();
  }
  all = std::move(responses);
  std::ranges::move(alone, std::back_inserter(all));
}

/// Makes responses of their columns.
class ResponseMaker {
 public:
  ResponseMaker(const ForeignTable& table, const PartColumn& frequency)
      : table_(table), frequency_(frequency) {
    require_part(frequency);
    hertz_ = hertz_in_one(frequency.unit.empty() ? "Hz" : frequency.unit);
    if (hertz_ == 0.0) throw no_unit_of_frequencies(shown(frequency), frequency.unit);
    const string_view name = table.columns[frequency.column].name;
    if (const auto logarithm = logarithm_of_frequency(name.substr(name.rfind('.') + 1))) {
      log_base_ = logarithm->base;
      if (log_base_ == 0.0) {
        throw InputError(fmt::format(
            "frequency {0}: a logarithm to base 10 or e; call it log10({1}) or ln({1}), or write "
            "the frequencies themselves",
            shown(frequency), arm::shown(logarithm->of)));
      }
      note(fmt::format("{} holds logarithms to base {:.4g} of frequencies", shown(frequency),
                       log_base_));
    }
    if (frequency.unit.empty() || frequency.is_unit_assumed) {
      note(fmt::format("unit of {} not given; {} assumed", shown(frequency),
                       frequency.unit.empty() ? "Hz" : frequency.unit));
    }
  }

  ForeignResponse make(const Parts& parts) {
    const auto& first =
        parts.is_polar() ? parts[ResponsePart::magnitude] : parts[ResponsePart::real];
    const auto& second =
        parts.is_polar() ? parts[ResponsePart::phase] : parts[ResponsePart::imaginary];
    const auto& coherence = parts[ResponsePart::coherence];
    ForeignResponse made;
    made.name = parts.name.empty() ? table_.columns[first->column].name : parts.name;
    require_part(*first);
    require_part(*second);
    const bool is_in_second = !parts.is_polar() && first->unit.empty();
    const ResponseUnit unit = unit_of_response(is_in_second ? second->unit : first->unit);
    made.unit = unit.unit;
    made.per = unit.per;
    for (const auto* part : {&first, &second, &coherence}) {
      if (*part) made.columns.push_back((*part)->column);
    }
    const bool is_polar = parts.is_polar();
    const bool is_in_decibel = is_polar && decibel(*first);
    if (!is_polar) require_alike(*first, *second);
    require_unit_of_response(*first);
    const double radian = is_polar ? radians_in(*second) : 1.0;
    std::vector<std::size_t> lines = lines_of(made.columns);
    std::size_t no_coherences = 0;
    for (const std::size_t line : lines) {
      const double a = value(*first, line);
      const double b = value(*second, line);
      constexpr double kDecibels = 20.0;
      const double told = value(frequency_, line);
      made.frequency_Hz.push_back((log_base_ > 0.0 ? std::pow(log_base_, told) : told) * hertz_);
      made.response.push_back(is_polar ? std::polar(1.0, b * radian) *
                                             (is_in_decibel ? std::pow(10.0, a / kDecibels) : a)
                                       : std::complex<double>(a, b));
      const double coherent =
          coherence ? value(*coherence, line) * (coherence->unit == "%" ? 0.01 : 1.0) : kUnknown;
      const bool is_coherence = coherent > 0.0 && coherent <= 1.0;
      made.coherence.push_back(is_coherence ? coherent : kUnknown);
      if (coherence && !is_coherence) ++no_coherences;
    }
    if (no_coherences > 0) {
      note(fmt::format("{} of {} coherences of {} are not known: must be above 0, and at most {}",
                       no_coherences, lines.size(), shown(*coherence),
                       coherence->unit == "%" ? "100 %" : "1"));
    }
    return made;
  }

  std::vector<std::string> take_notes() { return std::move(notes_); }

 private:
  double value(const PartColumn& part, std::size_t line) const {
    return table_.columns[part.column].values[line];
  }

  void note(std::string sentence) {
    if (std::ranges::count(notes_, sentence) == 0) notes_.push_back(std::move(sentence));
  }

  /// Holds what an absolute magnitude may be called in place of a unit.
  static constexpr std::array<string_view, 4> kAbsolute = {"abs", "absolute", "lin", "linear"};

  /// "dB re 1 rad/(N m)" and "1" tell what stands behind dB, and nothing.
  static ResponseUnit unit_of_response(const std::string& unit) {
    string_view rest = unit;
    if (is_decibel(unit)) rest.remove_prefix(2);
    for (const string_view word :
         {"/", " ", "(", "rel.", "ref", "re ", "re:", " ", ":", "1 ", " "}) {
      if (is_decibel(unit) && rest.starts_with(word)) rest.remove_prefix(word.size());
    }
    if (is_decibel(unit) && std::ranges::count(rest, ')') > std::ranges::count(rest, '(')) {
      rest.remove_suffix(1);
    }
    const bool is_none = rest == "1" || std::ranges::count(kAbsolute, rest) > 0;
    return is_none ? ResponseUnit{} : split_response_unit(rest);
  }

  void require_part(const PartColumn& part) const {
    if (part.fault.empty()) return;
    throw InputError(fmt::format("{} {}: {}", to_string(part.part), shown(part), part.fault));
  }

  /// Parts of which one tells no unit have that of the other.
  void require_alike(const PartColumn& real, const PartColumn& imaginary) const {
    require_unit_of_response(imaginary);
    if (real.unit.empty() || imaginary.unit.empty() || real.unit == imaginary.unit) return;
    throw InputError(fmt::format("real part {} in {}, imaginary part {} in {}: must be in one unit",
                                 shown(real), arm::shown(real.unit), shown(imaginary),
                                 arm::shown(imaginary.unit)));
  }

  /// A magnitude, a real or an imaginary part is in the unit of a sensor, perhaps per torque.
  void require_unit_of_response(const PartColumn& part) const {
    const ResponseUnit unit = unit_of_response(part.unit);
    if (unit.unit.empty() || is_canonical_unit(unit.unit)) return;
    throw InputError(fmt::format(
        "{0} {1} in {2}: {3}; state it with --column 'SENSOR.{0}=NAME:UNIT', beside frequency and "
        "the other part",
        to_string(part.part), shown(part), arm::shown(part.unit),
        is_stiffness_unit(unit.unit)
            ? "a stiffness, not a response to a torque"
            : "must be absolute, or in the unit of a sensor per torque, as rad/(N m), or in dB"));
  }

  bool decibel(const PartColumn& part) {
    if (is_decibel(part.unit)) return true;
    if (!part.unit.empty()) return false;
    const auto& values = table_.columns[part.column].values;
    const bool is_negative = std::ranges::any_of(values, [](double value) { return value < 0.0; });
    note(fmt::format("unit of {} not given; {} assumed", shown(part),
                     is_negative ? "dB" : "an absolute magnitude"));
    return is_negative;
  }

  double radians_in(const PartColumn& part) {
    constexpr double kDegree_rad = std::numbers::pi / 180.0;
    if (part.unit == "deg") return kDegree_rad;
    if (part.unit == "rad") return 1.0;
    if (part.unit == "mrad") return 1e-3;
    if (!part.unit.empty()) {
      throw InputError(
          fmt::format("phase {} in {}: must be in deg or rad", shown(part), arm::shown(part.unit)));
    }
    double largest = 0.0;
    for (const double value : table_.columns[part.column].values) {
      if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
    }
    constexpr double kMostRadians = 6.3;     // a turn
    constexpr double kFewestDegrees = 30.0;  // five turns, which no arm has in its band
    if (largest > kMostRadians && largest < kFewestDegrees) {
      throw InputError(
          fmt::format("phase {}: unit not given, deg or rad; state it with --column "
                      "'SENSOR.phase={}:deg', beside frequency and SENSOR.magnitude",
                      shown(part), shown(part)));
    }
    const bool is_degrees = largest >= kFewestDegrees;
    note(fmt::format("unit of {} not given; {} assumed", shown(part), is_degrees ? "deg" : "rad"));
    return is_degrees ? kDegree_rad : 1.0;
  }

  std::string shown(const PartColumn& part) const {
    return arm::shown(table_.columns[part.column].name);
  }

  /// Returns the rows that have all numbers, by ascending frequency.
  std::vector<std::size_t> lines_of(const std::vector<std::size_t>& columns) {
    const auto& frequencies = table_.columns[frequency_.column].values;
    for (const std::size_t column : columns) {
      if (table_.columns[column].values.size() == frequencies.size()) continue;
      throw InputError(fmt::format("column {}: {} numbers; the frequencies are {}",
                                   arm::shown(table_.columns[column].name),
                                   table_.columns[column].values.size(), frequencies.size()));
    }
    std::vector<std::size_t> lines;
    for (std::size_t line = 0; line < frequencies.size(); ++line) {
      const bool is_whole = std::ranges::all_of(columns, [&](std::size_t column) {
        return is_reading(table_.columns[column].values[line]);
      });
      if (is_whole && is_reading(frequencies[line])) lines.push_back(line);
    }
    if (lines.size() < frequencies.size()) {
      note(
          fmt::format("{} of {} lines left out: a cell is empty, not finite or an instrument's "
                      "sign of no measurement",
                      frequencies.size() - lines.size(), frequencies.size()));
    }
    if (lines.empty()) throw InputError("no line has a frequency and a response");
    std::ranges::stable_sort(lines, {}, [&](std::size_t line) { return frequencies[line]; });
    return lines;
  }

  const ForeignTable& table_;
  const PartColumn& frequency_;
  double hertz_ = 1.0;     ///< in one of the frequencies' unit
  double log_base_ = 0.0;  ///< of the frequencies' logarithms; 0: they are none
  std::vector<std::string> notes_;
};

/// The only two columns of a response belong together, whatever else their names have: "Gain" and
/// "Phase angle".
void name_only_pairs_alike(std::vector<PartColumn>& parts) {
  for (const auto& [first, second] : {std::pair{ResponsePart::magnitude, ResponsePart::phase},
                                      std::pair{ResponsePart::real, ResponsePart::imaginary}}) {
    if (std::ranges::count(parts, first, &PartColumn::part) != 1 ||
        std::ranges::count(parts, second, &PartColumn::part) != 1) {
      continue;
    }
    const auto named = std::ranges::find(parts, first, &PartColumn::part);
    std::ranges::find(parts, second, &PartColumn::part)->response = named->response;
  }
}

const PartColumn* frequency_of(const std::vector<PartColumn>& parts) {
  const auto found = std::ranges::find(parts, ResponsePart::frequency, &PartColumn::part);
  return found == parts.end() ? nullptr : &*found;
}

}  // namespace

string_view to_string(ResponsePart part) {
  return kPartNames[static_cast<std::size_t>(part)];
}

ResponseColumns responses_of(const ForeignTable& table, const std::vector<PartColumn>& parts) {
  ResponseColumns made;
  const PartColumn* frequency = frequency_of(parts);
  if (frequency == nullptr) {
    throw InputError(
        "frequency: no column; state it with --column frequency=NAME:UNIT, UNIT Hz or rad/s");
  }
  for (const auto& part : parts) {
    const auto& column = table.columns[part.column];
    if (std::ranges::count(parts, part.column, &PartColumn::column) > 1) {
      throw InputError(
          fmt::format("column {}: given for two parts of a response", arm::shown(column.name)));
    }
    if (!column.is_text()) continue;
    throw InputError(fmt::format("column {} = {}: not a number; {} must be numeric",
                                 arm::shown(column.name), arm::shown(column.texts.front()),
                                 to_string(part.part)));
  }
  ResponseMaker maker(table, *frequency);
  for (const auto& response : gathered(parts, made.notes, table)) {
    if (const std::string missing = response.missing(); !missing.empty()) {
      throw InputError(fmt::format(
          "{}: {}; a response takes a magnitude and a phase, or a real and an imaginary part",
          arm::shown(response.name), missing));
    }
    made.responses.push_back(maker.make(response));
  }
  std::ranges::move(maker.take_notes(), std::back_inserter(made.notes));
  return made;
}

ResponseColumns responses_in(const ForeignTable& table) {
  ResponseColumns made;
  auto parts = response_parts(table);
  name_only_pairs_alike(parts);
  const PartColumn* frequency = frequency_of(parts);
  if (frequency == nullptr) {
    const bool has_complex = std::ranges::any_of(table.columns, [](const ForeignColumn& column) {
      return column.name.starts_with("imaginary part of ");
    });
    if (has_complex) {
      made.incomplete =
          "complex numbers, but no column is called frequency; state the parts with --column "
          "frequency=NAME:Hz, --column hub_angle.real=NAME and --column hub_angle.imaginary=NAME";
    }
    return made;
  }
  auto all = gathered(parts, made.notes, table);
  join_coherences(all);
  if (all.empty()) {
    made.incomplete = fmt::format("column {} has frequencies, but no response is beside them",
                                  arm::shown(table.columns[frequency->column].name));
    return made;
  }
  ResponseMaker maker(table, *frequency);
  for (const auto& response : all) {
    const std::string missing = response.missing();
    if (missing.empty()) {
      made.responses.push_back(maker.make(response));
      continue;
    }
    made.incomplete =
        fmt::format("response {}: {}",
                    response.name.empty() ? "without a name" : arm::shown(response.name), missing);
    made.notes.push_back(made.incomplete + "; left out");
  }
  std::ranges::move(maker.take_notes(), std::back_inserter(made.notes));
  if (made.responses.empty()) made.notes.clear();
  return made;
}

}  // namespace flexarm::measured
