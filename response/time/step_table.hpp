#pragma once

#include "response/time/modal_dynamics.hpp"
#include "response/time/propagator.hpp"
#include "response/time/reading_bound.hpp"

#include <Eigen/Core>

#include <memory>

namespace flexarm::response {

/// Everything that is computed once for steps of one length with the hub turning or held: what is
/// at the end of a step, and at its middle, is linear in the state X at its beginning and in the
/// StepInputs.
struct StepTable {
  /// Maps to X at the end, N rows: (X; u0; u1; f0) where forces are constant, m = 1 then, else (X;
  /// u0; u1; f0; fm; f1).
  Eigen::MatrixXd end;
  // Where forces vary: maps to their arguments (AddedForces) at the middle and, behind these, at
  // the end. Their sum over (X; u0; u1; f0), which a step begins with, and (fm; f1), which it
  // iterates.
  Eigen::MatrixXd arguments_by_known;
  Eigen::MatrixXd arguments_by_forces;
  ReadingBound watched;
};

/// Of a step of the system that the propagators are of: with a middle where forces vary. Their
/// `argument_rows` as AddedForces::argument_rows. `watched` may be null.
StepTable step_table(const StepPropagators& to, const Eigen::MatrixXd& argument_rows,
                     const std::shared_ptr<const ReadingModes>& watched, double step_s);

}  // namespace flexarm::response
