#pragma once

#include "diagnose/search/selection.hpp"
#include "diagnose/unknown/empirical_law.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::diagnose {

/// The outcome of a search for a law of hub torque beside the chosen causes: there may be none.
struct SoughtLaw {
  std::optional<EmpiricalLaw> found;
};

/// A selection with the predictor of `time` runs that it was made by, and why by that one.
struct PredictedSelection {
  Selection selection;
  PredictorKind predictor = PredictorKind::output_error;
  std::string reason;  ///< a sentence; empty without `time` runs
  /// The torque balance that it was selected by.
  std::optional<Problem> balance = {};
  /// By that balance, where it was looked for already.
  std::optional<SoughtLaw> law = {};
  /// By simulation, the noise of its channels as the selection by simulation left it: what
  /// simulations are compared with the data by.
  Problem simulated;
  /// With the noise of the recorded torques as the whole disturbance: the residuals of the filter,
  /// not those of a simulation, are then what may be noise.
  bool is_by_torque_noise() const {
    const auto& noise = selection.problem.predictor().noise();
    return noise && noise->is_torque_noise();
  }
  bool names_nothing() const { return selection.chosen.fit.candidate.effects.empty(); }
  /// Returns the NRMSE of a simulation of the judged runs with the chosen effects, or with the law
  /// of hub torque in their place.
  double simulated_error() const;
  /// `law`, or now. `balance` must have been formed.
  std::optional<EmpiricalLaw> law_beside_causes(const Deadline& deadline) const;
};

/// What is done by whichever predictor; both must outlive the object.
struct SelectionTask {
  const std::vector<Hypothesis>& hypotheses;
  const SelectionOptions& options;

  bool is_asked() const { return options.predictor.has_value(); }
};

/// A part of the whole progress.
DiagnosisProgress part_of(const DiagnosisProgress& progress, double from, double to);

/// What the reason says where the time limit ended the search before another predictor.
inline constexpr const char* kNoTime = "the time limit left no time for another";
/// A stage of the search that a time limit may end.
inline constexpr const char* kNoiseStage = "the noise of a Kalman filter";

/// By output error, in closed loop where the problem's runs state their controllers, or driven by
/// the motion of its runs.
PredictedSelection select_by_simulation(const SelectionTask& task, const Problem& problem,
                                        const DiagnosisProgress& progress);

/// Of what acts on beam, payload and sensors, by the measured motion of the hub. Throws InputError
/// where that is not the input of every run (driven_by_motion).
PredictedSelection select_by_motion(const SelectionTask& task, const Experiment& experiment,
                                    const DiagnosisProgress& progress);

/// Returns the selection by the balance of the hub's torque (balanced_at_hub), of the runs of a
/// simulated problem, decimated to options.filtered_samples. Throws InputError where a run does not
/// show the hub, and Cancelled.
PredictedSelection select_by_balance(const SelectionTask& task, const Problem& simulated,
                                     const DiagnosisProgress& progress);

/// The selection by a stochastic grey box. Empty where that is not asked for and the disturbance of
/// the arm that simulation made is small. Throws Cancelled, and InputError where no Kalman filter
/// can be formed.
std::optional<PredictedSelection> select_by_filter(const SelectionTask& task,
                                                   const PredictedSelection& by_simulation,
                                                   const DiagnosisProgress& progress);

/// By a stochastic grey box whose disturbance is the noise of the recorded torques
/// (torque_noise.hpp), in half of the time. Empty where these show none, or that does not leave
/// noise, in a simulation too, or is less likely than the torques as they were recorded. The
/// channels of `simulated` have what that noise adds to a simulation.
std::optional<PredictedSelection> select_with_torque_noise(const SelectionTask& task,
                                                           const Problem& problem,
                                                           const DiagnosisProgress& progress);

/// The selection by the frequency responses of the runs. Empty where no torque is rich enough.
std::optional<PredictedSelection> select_by_responses(const SelectionTask& task,
                                                      const PredictedSelection& by_simulation,
                                                      const DiagnosisProgress& progress);

}  // namespace flexarm::diagnose
