#pragma once

#include "measured/files/keyed_units.hpp"
#include "measured/files/mat_file.hpp"

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::measured {

/// How a signal of a MATLAB file is called.
struct MatSignalName {
  std::string name;  ///< that the file tells, or the path: "torque", "ScopeData.signals(1).values"
  std::string path;  ///< where it stands
  std::string unit;  ///< canonical; empty: not told
};

/// Names that structures tell of the signals in them, as Simulink and dSPACE write them: a text
/// `label`, `Name`, `SignalName` or `title` beside the values or around them, with a `Unit`; a list
/// of as many texts as a matrix has signals, or a cell array cells, with one called `units`; a cell
/// of text above one of values. Units told by the name of the signal are `KeyedUnits`. `X.Data`
/// beside `Y.Data` is a time. A `FrequencyUnit` is that of
/// the frequencies beside it, as is a `Unit` of Hz or kHz.
class MatNames {
 public:
  /// Throws InputError for a unit of a signal that is there and is no text, and for a list of units
  /// that is not as long as that of the names, of no signals beside it, or as `KeyedUnits` does.
  explicit MatNames(const std::vector<MatVariable>& variables,
                    const std::vector<std::string>& left_out);

  /// The signals of the variable `path`, `count` columns or rows that stand at `path` + suffix.
  /// Throws InputError for a unit in a name that differs from the one told beside it.
  std::vector<MatSignalName> of(const std::string& path,
                                const std::vector<std::string>& suffixes) const;

  /// The `FrequencyUnit` beside a vector, canonical; empty: not told.
  std::string told_frequency_unit(std::string_view path) const;

  const KeyedUnits& keyed_units() const { return keyed_units_; }

 private:
  /// Lists of texts, by what holds them.
  using Lists = std::map<std::string, std::vector<const MatStrings*>, std::less<>>;

  std::string told_label(std::string_view path) const;
  std::string told_unit(std::string_view path) const;
  static const MatStrings* list_beside(const Lists& lists, std::string_view path,
                                       std::size_t count);
  std::string text_of_cell(const std::string& path, const Lists& lists, int line) const;
  bool is_time_beside_signals(std::string_view path) const;

  std::map<std::string, std::string, std::less<>> texts_;  ///< by path, the field in lower case
  Lists lists_;                                            ///< of names
  Lists unit_lists_;                                       ///< called so
  KeyedUnits keyed_units_;
  std::map<std::string, std::size_t, std::less<>> signals_in_;  ///< by owner, without times
  std::map<std::string, std::size_t, std::less<>> cells_in_;    ///< cells of values, by cell array
  std::set<std::string, std::less<>> times_in_;                 ///< owners of times
  std::set<std::string, std::less<>> frequencies_in_;           ///< owners of vectors called so
};

/// The path of what holds a field: "a.b(2)" of "a.b(2).c"; empty for a variable.
std::string_view owner_of(std::string_view path);

/// The field behind the last point of a path, in lower case and without an index.
std::string mat_field(std::string_view path);

/// The unit of a vector of frequencies, by the name of its field: "rad/s" of `w`, "kHz" of `f_kHz`,
/// empty for `f`, which tells none; nothing for a field that is not called so.
std::optional<std::string> unit_of_frequency_name(std::string_view path);

/// Whether a field says how the signal beside it is stored or drawn, `dimensions`, `plotStyle`.
bool is_description(std::string_view path);

/// Numbers x(1).f, x(2).f, ... of ten structures or more as one vector x.f; all else as it is.
std::vector<MatVariable> gathered_records(std::vector<MatVariable> variables);

}  // namespace flexarm::measured
