#pragma once

#include "diagnose/formulation_check.hpp"
#include "diagnose/planning/next_experiments.hpp"
#include "diagnose/search/selection.hpp"
#include "diagnose/symptoms/symptoms.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::diagnose {

/// What the data say of the arm as its file describes it.
enum class Verdict {
  adequate,          ///< nothing beyond noise
  explained,         ///< causes named, what is left is noise
  partly_explained,  ///< causes named, a significant misfit is left
  unexplained,       ///< a significant misfit that no effect, nor a pair of them, accounts for
};

/// "adequate", "explained", "partly_explained", "unexplained".
std::string_view to_string(Verdict verdict);

struct ParameterEstimate {
  std::string name;
  double value = 0.0;
  double std_error = 0.0;
  std::string unit;
};

/// An uncertain number of the arm file (arm/uncertainties.hpp), fitted beside the causes.
struct RefittedNumber {
  std::string key;           ///< "beam.youngs_modulus"
  double file_value = 0.0;   ///< in `unit`
  double uncertainty = 0.0;  ///< relative, as the file says
  double value = 0.0;
  double std_error = 0.0;
  std::string unit;
};

/// One effect that the arm file lacks.
struct Cause {
  std::string effect;
  std::string sensor;  ///< of a sensor_lag
  std::vector<ParameterEstimate> parameters;
  /// Of this effect against the others in its place, 0 to 1.
  double confidence = 0.0;
  double share = 0.0;  ///< of what is beyond noise without it, the others refitted
  std::vector<std::string> confusable_with;
  std::vector<std::string> evidence;  ///< sentences
  std::string refuted_by;
};

/// What came nearest: an effect, or several, that was tried against all data.
struct NearMiss {
  std::string effects;       ///< "root_compliance + time_delay"
  double share = 0.0;        ///< of what is beyond noise that it takes away
  double information = 0.0;  ///< by which it leads the arm without causes; 10 is decisive
  double error = 0.0;        ///< that is left, as Gain::after
};

/// Relative errors, averaged over the channels: root mean square over that of the signal.
struct Gain {
  double before = 0.0;
  double after = 0.0;
  double noise_floor = 0.0;
};

struct ChannelGain {
  std::string run;
  std::string sensor;
  Gain error;
};

/// A channel as it was measured and as the simulation has it, without causes and with them; numbers
/// as `Observations` has them.
struct Overlay {
  std::size_t run = 0;  ///< index of Experiment::runs
  std::string sensor;
  std::vector<double> measured;
  std::vector<double> before;
  std::vector<double> after;
};

struct Diagnosis {
  Verdict verdict = Verdict::adequate;
  std::vector<Cause> causes;  ///< in order of what each explains
  Gain estimation;
  std::optional<Gain> validation;
  std::vector<ChannelGain> channels;
  std::vector<Overlay> overlays;  ///< one a channel
  Symptoms symptoms;              ///< what is wrong without causes
  std::vector<RefittedNumber> refitted;
  FormulationCheck formulations;  ///< of the extended arm
  arm::Arm extended_arm;  ///< the experiment's with the causes, uncertain numbers as refitted
  /// Where a significant misfit is left: the best that were not named, by error.
  std::vector<NearMiss> near_misses;
  std::vector<NextExperiment> next_experiments;  ///< what_next
  std::vector<std::string> notices;
  bool cancelled = false;
};

/// Diagnoses an experiment by these hypotheses.
Diagnosis diagnose(const Experiment& experiment, const std::vector<Hypothesis>& hypotheses,
                   const SelectionOptions& options = {}, const DiagnosisProgress& progress = {});

}  // namespace flexarm::diagnose
