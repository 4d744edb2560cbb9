#include "diagnose/symptoms/symptoms.hpp"

#include "diagnose/symptoms/drift_symptoms.hpp"
#include "diagnose/symptoms/error_trends.hpp"

#include <functional>
#include <iterator>
#include <utility>

namespace flexarm::diagnose {

Symptoms symptoms_of(const SymptomsInput& input, std::optional<RunDrift> drift,
                     const Deadline& deadline) {
  Symptoms made;
  const auto add = [&](std::vector<Symptom> symptoms) {
    std::ranges::move(symptoms, std::back_inserter(made.statements));
  };
  const std::function<void()> parts[] = {
      [&] {
        made.bands = band_errors(input);
        add(error_symptoms(input, made.bands));
        made.regimes = regime_errors(input, made.bands);
      },
      [&] {
        // The torque is no input of an arm that is driven by motion.
        if (!is_driven_by_motion(input.problem.experiment())) add(trend_symptoms(input));
      },
      [&] {
        made.roots = root_shifts(input);
        add(root_symptoms(made.roots));
      },
      [&] {
        made.hub_torque =
            hub_torque(hub_motions(input), input.has_causes() ? 0.0 : kNegligibleError);
        add(hub_torque_symptoms(made.hub_torque));
      },
      [&] {
        made.distortion = run_distortions(input.problem.experiment());
        add(distortion_symptoms(made.distortion));
      }};
  for (const auto& part : parts) {
    made.is_complete = made.is_complete && !is_over(deadline);
    if (made.is_complete) part();
  }
  made.drift = std::move(drift);
  if (made.drift) add(drift_symptoms(*made.drift));
  sort_by_significance(made.statements);
  return made;
}

}  // namespace flexarm::diagnose
