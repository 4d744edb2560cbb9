#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace flexarm::diagnose {

/// What a statement of what is wrong is about.
enum class SymptomKind {
  error,       ///< of the simulation against the noise, by sensor
  trend,       ///< of that error with torque or payload
  roots,       ///< poles and zeros that moved, or did not
  hub_torque,  ///< what would have to be added to the torque on the hub
  distortion,  ///< at lines of a periodic torque that it does not drive
  drift,       ///< of a parameter that is refitted run by run
};

/// "error", "trend", "roots", "hub_torque", "distortion", "drift".
std::string_view to_string(SymptomKind kind);

/// One statement, in a sentence or two.
struct Symptom {
  SymptomKind kind = SymptomKind::error;
  std::string text;
  /// That chance alone makes this, or more, in any of the tests of its kind (Bonferroni), 0 to 1.
  double probability = 1.0;
  /// The same as a deviate of the standard normal distribution, of either sign; at most
  /// `kMostDeviate`.
  double deviate = 0.0;
  bool is_significant = false;  ///< probability below `kSignificantSymptom`
  std::string run = {};         ///< where it is of one
  std::string sensor = {};      ///< where it is of one
};
/// Any statement of one kind, of data that hold nothing but noise.
inline constexpr double kSignificantSymptom = 1e-3;
inline constexpr double kMostDeviate = 37.0;  ///< where probabilities leave the range of a double

/// A statement of the smallest probability of `tests`.
Symptom symptom(SymptomKind kind, std::string text, double probability, std::size_t tests);

/// A part as an engineer says it: "503 %", "41 %", "0.43 %", "less than 0.1 %".
std::string percent(double part);

/// The significant ones first, the least probable before the others; equals in the order of kinds.
void sort_by_significance(std::vector<Symptom>& symptoms);

}  // namespace flexarm::diagnose
