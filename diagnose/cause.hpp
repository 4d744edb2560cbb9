#pragma once

#include "diagnose/search/posterior.hpp"
#include "diagnose/search/selection.hpp"

#include <optional>
#include <string>
#include <vector>

namespace flexarm::diagnose {

struct ParameterEstimate {
  std::string name;
  double value = 0.0;
  double std_error = 0.0;
  std::string unit;
};

/// An uncertain number of the arm file (arm/uncertainties.hpp), fitted beside the causes.
struct RefittedNumber {
  std::string key;           ///< "beam.youngs_modulus"
  double file_value = 0.0;   ///< in `unit`
  double uncertainty = 0.0;  ///< relative, as the file says
  double value = 0.0;
  double std_error = 0.0;
  std::string unit;
  double deviation = 0.0;  ///< ln(value/file_value)/uncertainty: in standard deviations

  /// It differs from the file's by more than `kMoved` standard errors of the fit.
  bool has_moved() const;
};
inline constexpr double kMoved = 2.0;

/// One effect that the arm file lacks.
struct Cause {
  std::string effect;
  std::string sensor;  ///< of an effect on one sensor
  std::vector<ParameterEstimate> parameters;
  /// Posterior probability of this effect (posterior.hpp), which names of the same model share.
  double confidence = 0.0;
  /// The same of this effect or one of `confusable_with` in its place.
  double class_confidence = 0.0;
  std::string family;  ///< of effects, in words
  /// Whether effects of its family, and no others, do about as well: the data determine the family
  /// and not which of its effects acts.
  bool names_family = false;
  /// The evidence and its grade; none where the time limit left no time for it.
  std::optional<EffectEvidence> figures = {};
  Grade grade = Grade::candidate;
  /// Whether its size is at an end of the range of its search, which makes it a candidate.
  bool is_at_end_of_range = false;
  double share = 0.0;  ///< explained of the excess residual without it, the others refitted
  /// Effects that these data do not distinguish from it: other names of the same model, and rivals
  /// (rivals.hpp).
  std::vector<std::string> confusable_with;
  std::vector<std::string> evidence;  ///< sentences
  std::string refuted_by;

  /// Returns the effect as texts name it (arm::effect_label).
  std::string label() const;
};

/// The chosen effects in order of what each explains. `errors` are `standard_errors` of the choice.
std::vector<Cause> causes_of(const Selection& selection, const Posterior& posterior,
                             const std::vector<double>& errors);

/// The uncertain numbers of the arm with these deviations, in standard deviations of their
/// uncertainty; `errors` are theirs.
std::vector<RefittedNumber> refitted_numbers(const arm::Arm& arm,
                                             const std::vector<double>& deviations,
                                             const std::vector<double>& errors);

}  // namespace flexarm::diagnose
