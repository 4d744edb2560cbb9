#pragma once

#include "arm/arm.hpp"
#include "arm/range.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::arm {

/// One number of the arm file. Reading, writing, checking, the starter file and docs/formats.md
/// all come from these rows; a further key is a further row.
struct ArmKey {
  std::string table;   ///< "beam"
  std::string leaf;    ///< "length"
  std::string symbol;  ///< as in the equations (arm/arm.hpp): "l"
  std::string unit;    ///< "m"
  Range range;
  bool required;        ///< must be given in the file
  std::string meaning;  ///< half a sentence for the reader of a file
  /// The value; empty when the arm does not give it.
  std::optional<double> (*get)(const Arm&);
  void (*set)(Arm&, double);

  /// "beam.length"
  std::string name() const { return table + "." + leaf; }
  /// The value of an arm whose file does not give the key; empty when it is then unknown.
  std::optional<double> default_value() const { return get(Arm{}); }
};

/// Every number of the arm file but those of effects (arm/effects.hpp), table by table, in the
/// order of docs/formats.md.
const std::vector<ArmKey>& arm_keys();

/// The tables of `arm_keys()`, in order: beam, hub, payload, damping.
const std::vector<std::string>& arm_tables();

/// Throws InputError for the first value of `table` that is given and out of its range.
void require_in_range(const Arm& arm, std::string_view table);

}  // namespace flexarm::arm
