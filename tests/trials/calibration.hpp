#pragma once

#include "tests/trials/score.hpp"

#include <array>
#include <string>
#include <vector>

namespace flexarm::trials {

/// Claims of about the same probability, and how many of them were right.
struct ReliabilityBin {
  int claims = 0;
  int right = 0;
  double sum_of_probabilities = 0.0;
};

/// Claimed probabilities against what is so, over all named causes.
struct Reliability {
  static constexpr int kBins = 10;
  int claims = 0;
  double brier = 0.0;  ///< mean of (probability - right)^2 [Brier1950]; 0.25 of a coin's claims
  std::array<ReliabilityBin, kBins> bins;  ///< of equal width; 1 belongs to the last
};
Reliability reliability(const std::vector<TrialResult>& results);

/// The same as a table of Markdown.
std::string reliability_table(const std::vector<TrialResult>& results);

/// How often intervals of 95 % hold the value that was hidden, by kind of data.
std::string coverage_table(const std::vector<TrialResult>& results);

}  // namespace flexarm::trials
