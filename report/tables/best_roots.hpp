#pragma once

#include "compare/identification.hpp"
#include "measured/run_identification.hpp"

#include <string>
#include <tuple>
#include <vector>

namespace flexarm::report {

/// A root as one method reads it from one sensor. It is valid as long as its condition is.
struct ReadRoot {
  const compare::IdentifiedRoot* root = nullptr;
  measured::Method method = measured::Method::table;
  std::string runs;    ///< "random-low+random-high"
  std::string sensor;  ///< "all" of all sensors at once
  bool hub_held = false;

  /// With the hub held, the zeros of the hub angle are poles.
  bool is_pole() const { return root->measured.feature == measured::Feature::pole || hub_held; }

  /// A given table may have its poles sensor by sensor.
  bool is_of_all() const { return is_pole() && method != measured::Method::table; }

  /// Roots with the same key are the same root.
  std::tuple<measured::Feature, bool, std::string, int, double> key() const;

  /// "3", "alias of pole 6 at 216 Hz" or "unmatched", with what tells it from others of its key's
  /// number: "2, hub held".
  std::string name() const;
};

/// Returns the roots with a frequency, in the order of the condition's readings.
std::vector<ReadRoot> read_roots(const measured::Identification& identification,
                                 const compare::IdentifiedCondition& condition);

/// Returns one reading of each numbered root and each alias: that of the best method (a rational
/// fit, a given table, circles, responses, autopower spectra) with the smallest standard error.
/// Poles come first, then zeros sensor by sensor.
std::vector<ReadRoot> best_roots(std::vector<ReadRoot> roots);

/// Whether a root is by a method that `best` has it by; of one without a number, whether `best` has
/// any by its method, or nothing at all.
bool is_by_best(const ReadRoot& one, const std::vector<ReadRoot>& best);

}  // namespace flexarm::report
