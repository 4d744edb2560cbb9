#pragma once

#include "response/time/modal_dynamics.hpp"
#include "response/time/propagator.hpp"
#include "response/time/reading_bound.hpp"

#include <Eigen/Core>

#include <memory>

namespace flexarm::response {

/// Everything that is computed once for steps of one length with the hub turning or held.
struct StepTable {
  Propagator end;
  Propagator middle;         ///< only where forces vary
  Eigen::VectorXd constant;  ///< X(end) per unit of a constant torque on the hub, m = 1
  ReadingBound watched;
};

/// `watched` may be null.
StepTable step_table(const LinearSystem& system, const std::shared_ptr<const ReadingModes>& watched,
                     double step_s, bool forces_vary, Precision precision);

}  // namespace flexarm::response
