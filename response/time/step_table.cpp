#include "response/time/step_table.hpp"

namespace flexarm::response {

namespace {

/// Maps (X; u0; u1; f0; fm; f1) to X there.
Eigen::MatrixXd of_all_inputs(const Propagator& to) {
  Eigen::MatrixXd made(to.state.rows(), to.state.cols() + 2 + 3 * to.force_begin.cols());
  made << to.state, to.actuator_begin, to.actuator_end, to.force_begin, to.force_middle,
      to.force_end;
  return made;
}

}  // namespace

StepTable step_table(const LinearSystem& system, const Eigen::MatrixXd& argument_rows,
                     const std::shared_ptr<const ReadingModes>& watched, double step_s,
                     Precision precision) {
  const bool forces_vary = argument_rows.rows() > 0;
  const Propagator end = propagator(system, step_s, 1.0, precision);
  StepTable table;
  if (forces_vary) {
    table.end = of_all_inputs(end);
    const Propagator middle = propagator(system, step_s, 0.5, precision);
    Eigen::MatrixXd arguments(2 * argument_rows.rows(), table.end.cols());
    arguments << argument_rows * of_all_inputs(middle), argument_rows * table.end;
    const Eigen::Index forces = 2 * system.force.cols();
    table.arguments_by_known = arguments.leftCols(arguments.cols() - forces);
    table.arguments_by_forces = arguments.rightCols(forces);
  } else {
    table.end.resize(end.state.rows(), end.state.cols() + 3);
    table.end << end.state, end.actuator_begin, end.actuator_end, end.constant_force().col(0);
  }
  if (watched) table.watched = ReadingBound(watched, step_s, forces_vary);
  return table;
}

}  // namespace flexarm::response
