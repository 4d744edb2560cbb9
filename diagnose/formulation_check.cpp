#include "diagnose/formulation_check.hpp"

#include "arm/input_error.hpp"
#include "arm/rigid_hub.hpp"
#include "compare/comparison.hpp"

namespace flexarm::diagnose {

FormulationCheck check_formulations(const arm::Arm& arm, const std::vector<arm::Sensor>& sensors,
                                    const arm::Deadline& deadline) {
  if (!arm::has_beam(arm)) return {.refused = "an arm without a beam has one formulation"};
  compare::Options options;
  options.poles = kCheckedRoots;
  options.non_collocated_zeros = kCheckedRoots;
  if (!sensors.empty()) options.sensors = sensors;
  options.refinements = false;
  options.response_points = 50;
  options.progress = [&](int /*done*/, int /*total*/) { arm::require_time(deadline); };
  try {
    arm::require_time(deadline);
    const compare::Verdict verdict = compare::compare(arm, options).verdict;
    return {verdict.agree, verdict.worst.distance, verdict.worst.tolerance, verdict.worst.quantity,
            ""};
  } catch (const arm::InputError& error) {
    return {.refused = error.what()};
  } catch (const arm::Cancelled&) {
    return {.refused = "the time limit left no time for it"};
  }
}

}  // namespace flexarm::diagnose
