#include "diagnose/planning/plan_task.hpp"

#include "diagnose/search/hypothesis_choice.hpp"

#include <utility>

namespace flexarm::diagnose {

PlanTask plan_task(const arm::Arm& arm, MeasurementPlan planned, const PlanRequest& request) {
  PlanTask task{arm::without_hypotheses(arm), std::move(planned), {}, {}};
  const auto possible = hypotheses_of(task.arm, task.planned);
  task.hypotheses = chosen_hypotheses(request.effects, possible, request.spelled("effects"));
  chosen_hypotheses(request.refitted, possible, request.spelled("refit"));  // throws for others
  task.options.unknown = request.refitted;
  return task;
}

}  // namespace flexarm::diagnose
