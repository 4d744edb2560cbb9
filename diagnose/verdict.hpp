#pragma once

#include "diagnose/search/explanation.hpp"

#include <array>
#include <string_view>

namespace flexarm::diagnose {

/// What the data say of the arm as its file describes it: definition_of().
enum class Verdict { adequate, explained, partly_explained, unexplained };
inline constexpr std::array kVerdicts = {Verdict::adequate, Verdict::explained,
                                         Verdict::partly_explained, Verdict::unexplained};

enum class SearchState { complete, incomplete };

/// "adequate", "explained", "partly_explained", "unexplained".
std::string_view to_string(Verdict verdict);

/// Returns whether something is left to be explained.
constexpr bool is_open(Verdict verdict) {
  return verdict == Verdict::partly_explained || verdict == Verdict::unexplained;
}

/// An uncertain number that is refitted by more standard deviations than this is implausible:
/// something else is wrong.
inline constexpr double kPlausibleDeviation = 3.0;

/// The one definition, which the help and the documents repeat word for word. Residuals "are noise"
/// where those of the estimation and those of the validation runs pass the residual test
/// (residual_test.hpp).
std::string_view definition_of(Verdict verdict);

/// `chosen` is the extended arm: with the causes that are named, or with the uncertain numbers
/// alone refitted. `as_filed` is the arm of the file, nothing refitted. A search that is incomplete
/// has not shown that no other cause would do: what it names explains the data in part.
Verdict verdict_of(const Explanation& chosen, const Explanation& as_filed,
                   SearchState search = SearchState::complete);

}  // namespace flexarm::diagnose
