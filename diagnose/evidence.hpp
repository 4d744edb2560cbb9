#pragma once

#include "diagnose/search/policy.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::diagnose {

/// Grades how well the data show an effect (grade_of, docs/effect-search.md).
enum class Grade { candidate, supported, established };

/// Returns "candidate", "supported", "established".
std::string_view to_string(Grade grade);

/// The parameters of an effect by one run alone, the other effects held: in the parameters' units.
struct RunEstimate {
  std::string run;  ///< its id
  std::vector<double> values;
  std::vector<double> std_errors;
};

/// The losses by leaving an effect out of a set, the others refitted to the estimation runs, and
/// its estimates in each run.
struct EffectEvidence {
  double score = 0.0;                     ///< of the search (scored_fit.hpp)
  double estimation = 0.0;                ///< of -2 ln L on the estimation runs
  std::optional<double> held_out = {};    ///< the same on the validation runs, if there are any
  double error_without = 0.0;             ///< NRMSE of the validation runs, else of all runs
  double error_increase = 0.0;            ///< of that NRMSE
  double error_increase_std_error = 0.0;  ///< over kErrorBlocks blocks of each channel
  std::vector<RunEstimate> runs = {};     ///< that tell its parameters
  double agreement = 1.0;  ///< p-value of the estimates of the runs, if one value holds in all
};

inline constexpr int kErrorBlocks = 10;

/// Returns the grade of an effect: `supported` where the validation runs are predicted worse
/// without it beyond doubt (Policy::beyond_doubt, odds of e^5 = 150 to 1), `established` where
/// besides its estimates agree between runs, no effect of another family does about as well in its
/// place (`has_rival`), and the residuals of the whole set are noise (`leaves_noise`).
Grade grade_of(const EffectEvidence& evidence, bool has_rival, bool leaves_noise,
               const Policy& policy = {});

}  // namespace flexarm::diagnose
