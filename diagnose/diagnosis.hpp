#pragma once

#include "diagnose/cause.hpp"
#include "diagnose/formulation_check.hpp"
#include "diagnose/planning/next_experiments.hpp"
#include "diagnose/posterior_sets.hpp"
#include "diagnose/prediction_errors.hpp"
#include "diagnose/search/predictor_choice.hpp"
#include "diagnose/symptoms/symptoms.hpp"
#include "diagnose/unknown/empirical_law.hpp"
#include "diagnose/unknown/missing_force.hpp"
#include "diagnose/verdict.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::diagnose {

/// A set of effects that was fitted and not named; each set stands once.
struct NearMiss {
  std::string effects;       ///< "root_compliance + time_delay", in alphabetical order
  double probability = 0.0;  ///< posterior, of exactly this set
  double share = 0.0;        ///< of the excess residual without causes that it explains
  double information = 0.0;  ///< delta BIC of no cause beyond it; 10 is decisive
  double error = 0.0;        ///< NRMSE that is left, as Gain::after
};

/// Relative errors, averaged over the channels: root mean square over that of the signal.
struct Gain {
  double before = 0.0;
  double after = 0.0;
  double noise_floor = 0.0;
  double numerical_error = 0.0;  ///< of the simulation (ObservedChannel::numerical_error)
};

struct ChannelGain {
  std::string run;
  std::string sensor;
  Gain error;
};

/// What the stochastic grey box leaves to a torque on the hub that nobody recorded, root mean
/// squares of the filter's estimates.
struct DisturbanceGain {
  double correlation_time_s = 0.0;
  double before_N_m = 0.0;      ///< of the arm file, uncertain numbers refitted
  double after_N_m = 0.0;       ///< of the extended arm
  double torque_rms_N_m = 0.0;  ///< of the commanded torque
  /// Of forces on the flexible modes (response::ProcessNoise); 0 where the data ask for none.
  double modal_force_N_m = 0.0;
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
  /// What the extended arm may be by these data, with the joint distribution of the estimates.
  std::vector<PosteriorSet> posterior = {};
  double something_else = 0.0;  ///< posterior probability of it, beside causes or by itself
  PredictorKind predictor = PredictorKind::output_error;  ///< that the causes were named by
  std::string predictor_reason;                           ///< a sentence; empty without `time` runs
  std::optional<DisturbanceGain> disturbance;             ///< by grey_box
  /// Errors of the torque that the measured motion takes, against the recorded one, on the
  /// validation runs, or the estimation runs without any; given with torque_balance alone.
  std::optional<Gain> torque = {};
  Gain estimation;  ///< by output error, as the residuals and tests below
  std::optional<Gain> validation;
  /// Of the arm file and the extended arm, where a Kalman filter was formed.
  std::vector<PredictionError> prediction_errors = {};
  ResidualTest estimation_test;  ///< of the extended arm
  ResidualTest validation_test;
  bool is_tested_by_filter = false;  ///< these tests are of prediction errors of a Kalman filter
  bool converged = false;            ///< the fit of the extended arm
  int evaluations = 0;               ///< of the simulation in that fit
  std::vector<ChannelGain> channels;
  std::vector<Overlay> overlays;  ///< one a channel
  Symptoms symptoms;              ///< what is wrong without causes
  std::vector<RefittedNumber> refitted;
  FormulationCheck formulations;  ///< of the extended arm
  /// What the causes leave of the hub torque, where no effect is it and a law describes it.
  std::optional<EmpiricalLaw> empirical_law = {};
  /// Where the force acts that the causes leave unexplained.
  std::optional<MissingForce> missing_force = {};
  /// The experiment's with the causes, uncertain numbers as refitted, and the empirical law.
  arm::Arm extended_arm;
  /// Where the residuals are not noise: the most probable sets that were not named.
  std::vector<NearMiss> near_misses;
  std::vector<NextExperiment> next_experiments;  ///< what_next
  std::vector<std::string> notices;
  std::vector<std::string> excluded;      ///< effects that whoever asked left out of the search
  std::optional<double> time_limit_s;     ///< as asked for
  std::optional<SearchEnd> search_end;    ///< where the time limit ended the search
  std::vector<AcceptedFinding> accepted;  ///< of the experiment
  bool cancelled = false;
};

/// Diagnoses an experiment by these hypotheses. After options.deadline: by what had been fitted; a
/// notice names what the report lacks, as the further runs. What was fitted is always evaluated on
/// all data, once by the arm as filed and once by what is reported. Throws Cancelled after
/// options.last where not even the arm as filed has been simulated.
Diagnosis diagnose(const Experiment& experiment, const std::vector<Hypothesis>& hypotheses,
                   const SelectionOptions& options = {}, const DiagnosisProgress& progress = {});

/// Time after the search in which optional parts of a report are still computed.
inline constexpr std::chrono::seconds kReportTime{1};

}  // namespace flexarm::diagnose
