#include "response/time/step_table.hpp"

namespace flexarm::response {

StepTable step_table(const LinearSystem& system, const std::shared_ptr<const ReadingModes>& watched,
                     double step_s, bool forces_vary, Precision precision) {
  StepTable table;
  table.end = propagator(system, step_s, 1.0, precision);
  if (forces_vary) table.middle = propagator(system, step_s, 0.5, precision);
  table.constant = table.end.constant_force().col(0);
  if (watched) table.watched = ReadingBound(watched, step_s, forces_vary);
  return table;
}

}  // namespace flexarm::response
