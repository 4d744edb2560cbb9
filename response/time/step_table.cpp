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

StepTable step_table(const StepPropagators& to, const Eigen::MatrixXd& argument_rows,
                     const std::shared_ptr<const ReadingModes>& watched, double step_s) {
  StepTable table;
  if (to.middle) {
    table.end = of_all_inputs(to.end);
    Eigen::MatrixXd arguments(2 * argument_rows.rows(), table.end.cols());
    arguments << argument_rows * of_all_inputs(*to.middle), argument_rows * table.end;
    const Eigen::Index forces = 2 * to.end.force_end.cols();
    table.arguments_by_known = arguments.leftCols(arguments.cols() - forces);
    table.arguments_by_forces = arguments.rightCols(forces);
  } else {
    table.end.resize(to.end.state.rows(), to.end.state.cols() + 3);
    table.end << to.end.state, to.end.actuator_begin, to.end.actuator_end,
        to.end.constant_force().col(0);
  }
  if (watched) table.watched = ReadingBound(watched, step_s, to.middle.has_value());
  return table;
}

}  // namespace flexarm::response
