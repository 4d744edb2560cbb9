#pragma once

#include "arm/arm.hpp"
#include "compare/finding.hpp"
#include "compare/standard_models.hpp"

#include <optional>
#include <string>
#include <vector>

namespace flexarm::random_arms {

/// What the three formulations make of an arm.
enum class Outcome {
  agree,     ///< all three have all roots, and they agree
  refused,   ///< a formulation refuses the arm or the roots by an InputError; the others agree
  stated,    ///< they differ, by no more than the error that one states (compare::stated_error)
  disagree,  ///< they differ, and none says that it may
  failed,    ///< a formulation threw anything else
};

/// A formulation and its message.
struct Refusal {
  std::string formulation;
  std::string message;
};

struct Agreement {
  Outcome outcome = Outcome::agree;
  std::vector<Refusal> refusals;          ///< in the order of the formulations
  std::optional<compare::Finding> worst;  ///< of the roots; empty where fewer than two have any
  std::string alone;                      ///< as in compare::Verdict
};

/// Relative difference up to which two roots agree.
inline constexpr double kRootTolerance = 1e-9;

/// exact_tf, fem and assumed_modes at the settings of `flexarm compare`, in its ten poles, ten
/// zeros of the hub angle and six zeros of the tip.
Agreement agreement_of(const arm::Arm& arm);
/// The same of other models, two or more.
Agreement agreement_of(const arm::Arm& arm, const std::vector<compare::Model>& models);

}  // namespace flexarm::random_arms
