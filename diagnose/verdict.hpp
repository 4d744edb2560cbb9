#pragma once

#include "diagnose/search/explanation.hpp"

#include <string_view>

namespace flexarm::diagnose {

/// What the data say of the arm as its file describes it. "Are noise": those of the estimation and
/// those of the validation runs pass the residual test (residual_test.hpp).
enum class Verdict {
  adequate,          ///< the residuals of the arm as its file has it are noise
  explained,         ///< those of the extended arm are, and its fit converged
  partly_explained,  ///< causes are named, but the extended arm is not `explained`
  unexplained,       ///< no cause is named, and neither of the two arms leaves noise
};

/// "adequate", "explained", "partly_explained", "unexplained".
std::string_view to_string(Verdict verdict);

/// `chosen` is the extended arm: with the causes that are named, or with the uncertain numbers
/// alone refitted. `as_filed` is the arm of the file, nothing refitted.
Verdict verdict_of(const Explanation& chosen, const Explanation& as_filed);

}  // namespace flexarm::diagnose
