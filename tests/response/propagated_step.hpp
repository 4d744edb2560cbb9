#pragma once

#include "response/time/propagator.hpp"
#include "response/time/step_inputs.hpp"

namespace flexarm::response {

/// X at the end of a step.
inline Eigen::VectorXd propagated(const Propagator& to, const Eigen::VectorXd& x,
                                  const StepInputs& inputs) {
  return to.state * x + to.actuator_begin * inputs.u0 + to.actuator_end * inputs.u1 +
         to.force_begin * inputs.f0 + to.force_middle * inputs.fm + to.force_end * inputs.f1;
}

/// The inputs of a step from r = `from` to r = `to`, as those of a step of their own.
inline StepInputs part_of(const StepInputs& step, double from, double to) {
  const auto force = [&](double r) -> Eigen::VectorXd {
    return step.f0 + r * step.force_slope() + r * r * step.force_square();
  };
  return {step.torque(from), step.torque(to),          step.time(from), (to - from) * step.length_s,
          force(from),       force(0.5 * (from + to)), force(to)};
}

}  // namespace flexarm::response
