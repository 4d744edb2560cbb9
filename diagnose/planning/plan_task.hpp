#pragma once

#include "arm/option_name.hpp"
#include "diagnose/planning/plan.hpp"

#include <string>
#include <vector>

namespace flexarm::diagnose {

/// What a user may say of the planning of an experiment, in words. Errors name an option as
/// `spelled` does.
struct PlanRequest {
  std::vector<std::string> effects = {};   ///< to look at; empty: all of the library
  std::vector<std::string> refitted = {};  ///< nuisance parameters; none: the arm file is exact
  arm::OptionSpelling spelled = arm::on_command_line;
};

/// All that plan_experiment is given.
struct PlanTask {
  arm::Arm arm;
  MeasurementPlan planned;
  std::vector<Hypothesis> hypotheses;
  PlanOptions options;
};

/// The task of an arm, without its hypotheses, and a plan. Throws InputError for an effect that is
/// unknown or that the runs do not show.
PlanTask plan_task(const arm::Arm& arm, MeasurementPlan planned, const PlanRequest& request);

}  // namespace flexarm::diagnose
