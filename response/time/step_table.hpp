#pragma once

#include "response/time/modal_dynamics.hpp"
#include "response/time/propagator.hpp"
#include "response/time/reading_bound.hpp"

#include <Eigen/Core>

#include <memory>

namespace flexarm::response {

/// Everything that is computed once for steps of one length with the hub turning or held.
struct StepTable {
  /// X(end) of (X; u0; u1; T) for a constant torque T on the hub, m = 1, or of (X; u0; u1; f0; fm;
  /// f1) where forces vary: N rows.
  Eigen::MatrixXd end;
  // Only where forces vary: their arguments at the middle and behind them those at the end, of what
  // is known when the step begins, (X; u0; u1; f0), and of (fm; f1).
  Eigen::MatrixXd arguments_by_known;
  Eigen::MatrixXd arguments_by_forces;
  ReadingBound watched;
};

/// The arguments of forces that vary are `argument_rows` X; without rows forces are constant.
/// `watched` may be null.
StepTable step_table(const LinearSystem& system, const Eigen::MatrixXd& argument_rows,
                     const std::shared_ptr<const ReadingModes>& watched, double step_s,
                     Precision precision);

}  // namespace flexarm::response
