#pragma once

#include "arm/arm.hpp"
#include "measured/files/frequency_record.hpp"
#include "report/figures/figure.hpp"
#include "report/tables/table.hpp"
#include "experiment/simulated_experiment.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace flexarm::report {

using experiment::SteppedSineRun;

/// The response as a frequency record has it.
measured::FrequencyRecord frequency_record(const SteppedSineRun& run);

/// How many frequencies, how finely sampled, how long, and what is left of the transient.
Table stepped_sine_table(const std::vector<SteppedSineRun>& runs);

/// Where each sensor's response is largest and smallest, and its noise.
Table stepped_response_table(const std::vector<SteppedSineRun>& runs);

/// Reversals, stops and rests of the hub in the measured cycles; for arms with dry friction.
Table stepped_hub_motion_table(const std::vector<SteppedSineRun>& runs);

/// A Bode diagram a sensor, `ID-SENSOR`, with gaps between the bands; none of a sensor that
/// reads nothing, as a hub that friction holds.
std::vector<NamedFigure> stepped_sine_plots(const std::string& arm_name, const SteppedSineRun& run);

/// Member `stepped_runs` of schema `flexarm.simulate/1` (docs/json.md).
nlohmann::ordered_json stepped_runs_json(const std::vector<SteppedSineRun>& runs);

}  // namespace flexarm::report
