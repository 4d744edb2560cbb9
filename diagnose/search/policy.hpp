#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace flexarm::diagnose {

/// The numbers that decide what a search for effects looks at, prefers and reports, each the bound
/// of one inequality (docs/search-numbers.md has the effect of halving and doubling each).
struct Policy {
  // Likelihood of an octave of a channel (likelihood.hpp)
  /// Effective sample size <= this.
  double sample_size = 8.0;
  /// Error of any model, relative to the signal, >= this.
  double discrepancy = 3e-3;
  /// Error by a measured motion, in draws of the error of that motion, >= this.
  double motion_draws = 6.0;

  // Whether residuals are noise (likelihood.hpp)
  /// Squares of noise in an octave above their expected sum, in its standard deviations, <= this.
  double band_deviations = 4.0;
  /// The same of all octaves together.
  double total_deviations = 2.5;
  /// Squares of the simulation's own error, over those of the arm as filed, <= this.
  double error_factor = 10.0;

  // Price of parameters (scored_fit.hpp)
  /// Standard deviation of the prior of a place in the range of a parameter <= this.
  double place_deviation = 0.3;

  // Search (set_search.hpp, moves.hpp)
  /// Samples of each run on the first rung <= this; on the next ones 4 and 16 times as many.
  std::size_t first_samples = 400;
  /// Flexible modes on the rungs below all data <= this.
  std::size_t coarse_modes = 6;
  /// Sets kept on the first rung, starts of one set, and rivals of an effect beside its family <=
  /// this.
  std::size_t beam = 3;
  /// Moves of a set that are fitted, those of the best prediction, <= this.
  std::size_t looks = 6;
  /// Effects of the sets of the first climb with all effects <= this.
  std::size_t depth = 3;
  /// Frequencies that an effect with one is looked at, those of peaks of the residuals, <= this.
  std::size_t peaks = 4;
  /// Rise of the score by an effect, or by a rival, that is looked at on more data <= this.
  double near = 10.0;
  /// A delay or a lag, in half sampling periods, >= this.
  double least_time = 0.1;

  // Report (selection.hpp, rivals.hpp, evidence.hpp, predictor_choice.hpp)
  /// Posterior odds against a rival that is indistinguishable <= this.
  double odds = 20.0;
  /// The score that an effect is worth > this, a bare mention [KassRaftery1995].
  double bare_mention = 2.0;
  /// Loss of -2 ln L of the validation runs without a supported effect >= this.
  double beyond_doubt = 10.0;
  /// P-value of the estimates of an established effect in each run >= this.
  double least_agreement = 0.01;
  /// NRMSE of a simulation beside which no other predictor is tried <= this.
  double useless = 0.5;
};

/// A number of the policy by its name.
struct PolicyNumber {
  std::string_view name;
  std::variant<double Policy::*, std::size_t Policy::*> member;

  double of(const Policy& policy) const;
  /// Throws InputError where an integer is given another number, or a number is not above 0.
  void set(Policy& policy, double value) const;
};

/// Returns the numbers in the order of the struct.
std::span<const PolicyNumber> policy_numbers();

/// Sets "NAME=NUMBER". Throws InputError for another text, a name that there is not, and as
/// PolicyNumber::set.
void set_number(Policy& policy, const std::string& text);

}  // namespace flexarm::diagnose
