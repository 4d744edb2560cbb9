#pragma once

#include "measured/files/mat_file.hpp"

#include <cstddef>
#include <map>
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
/// of as many texts as a matrix has signals, or a cell array cells; a cell of text above one of
/// values. `X.Data` beside `Y.Data` is a time.
class MatNames {
 public:
  explicit MatNames(const std::vector<MatVariable>& variables);

  /// The signals of the variable `path`, `count` columns or rows that stand at `path` + suffix.
  std::vector<MatSignalName> of(const std::string& path,
                                const std::vector<std::string>& suffixes) const;

 private:
  std::string told_label(std::string_view path) const;
  std::string told_unit(std::string_view path) const;
  const MatStrings* list_beside(std::string_view path, std::size_t count) const;
  std::string label_of_cell(const std::string& path) const;
  bool is_time_beside_signals(std::string_view path) const;

  std::map<std::string, std::string, std::less<>> texts_;  ///< by path, the field in lower case
  std::map<std::string, std::vector<const MatStrings*>, std::less<>> lists_;  ///< by owner
  std::map<std::string, std::size_t, std::less<>> signals_in_;  ///< by owner, without times
  std::map<std::string, std::size_t, std::less<>> cells_in_;    ///< cells of values, by cell array
};

/// The field behind the last point of a path, in lower case and without an index.
std::string mat_field(std::string_view path);

/// Numbers x(1).f, x(2).f, ... of ten structures or more as one vector x.f; all else as it is.
std::vector<MatVariable> gathered_records(std::vector<MatVariable> variables);

}  // namespace flexarm::measured
