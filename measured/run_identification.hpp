#pragma once

#include "arm/deadline.hpp"
#include "measured/checks/data_check.hpp"
#include "measured/checks/run_check.hpp"
#include "measured/files/run_data.hpp"
#include "measured/modal/modal_fit.hpp"
#include "measured/modal/modal_gains.hpp"
#include "measured/modal/nyquist_circle.hpp"
#include "measured/spectra/distortion.hpp"
#include "measured/spectra/estimator_choice.hpp"
#include "measured/spectra/spectral_features.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::measured {

/// How poles and zeros are read off.
enum class Method {
  autopower,       ///< peaks and valleys of autopower spectra: the paper's Tables 2 and 3
  response,        ///< peaks and valleys of frequency responses: the same tables
  nyquist_circle,  ///< circles of finely spaced responses: Tables 4 and 5
  rational_fit,    ///< poles of all sensors at once, zeros of each: measured/modal/modal_fit.hpp
  table,           ///< of a `modal` run, as it is given
};

/// "autopower", "response", "circle", "fit", "table".
std::string_view to_string(Method method);

/// Poles and zeros by one method from one run, or from the runs of one fit.
struct ModalReading {
  Method method = Method::table;
  std::vector<std::string> runs;      ///< ids
  std::optional<arm::Sensor> sensor;  ///< empty: of all sensors at once
  std::optional<arm::Payload> payload;
  ModalTable table;
  /// Poles of the beam with the hub held: in the table they are zeros of the hub angle, which the
  /// same frequencies are.
  bool hub_held = false;

  bool operator==(const ModalReading&) const = default;
};

struct SensorCircles {
  arm::Sensor sensor;
  CircleSet circles;
};

/// One run by itself.
struct RunIdentification {
  Run run;
  std::string refusal = {};                ///< why nothing could be estimated; empty where it was
  std::vector<DataFinding> findings = {};  ///< faults of a `time` run
  std::vector<arm::Sensor> left_out = {};  ///< dead channels, which nothing is estimated from
  double sampling_period_s = 0.0;          ///< of a `time` run
  /// Of a `time` run that starts free, without a torque, the time of its release; a fit alone says
  /// something of it.
  std::optional<double> decay_begins_s = {};
  std::size_t left_out_before_decay = 0;  ///< samples
  bool hub_at_rest = false;               ///< of a decay: a sensor of the hub shows no motion
  /// Of a `frf` run as it is, of a `time` run as estimated, from the torque or the hub's motion.
  FrequencyRecord response = {};
  std::optional<FrequencyResponseEstimate> estimate = {};  ///< of a `time` run
  std::vector<SensorFeatures> features = {};
  std::vector<SensorCircles> circles = {};
  std::optional<Distortion> distortion = {};  ///< where the torque repeats itself, in open loop

  /// Whether poles are those with the hub held: of responses to its motion, and of a decay while it
  /// rests.
  bool hub_held() const { return hub_at_rest || response.input.has_value(); }
};

/// A rational fit of runs with one payload, torque hold and sampling period, of one `frf` run, or
/// of the estimated responses of one run.
struct RunsFit {
  std::vector<std::size_t> runs = {};  ///< indices
  std::optional<arm::Payload> payload = {};
  std::string refusal = {};  ///< why there is no fit; empty where there is
  ModalFit fit = {};
  std::string unphysical = {};  ///< what of the fit no arm can be; empty where nothing is
  bool of_responses = false;    ///< measured/modal/response_fit.hpp; else sample by sample
  bool hub_held = false;        ///< `RunIdentification::hub_held`: no gains
  std::optional<ModalGains> gains = {};
  std::string gains_refusal = {};
};

/// Why the poles and zeros of a fit are not to be relied on: it did not converge, or is unphysical.
/// Empty where neither is so, or there is no fit.
std::string doubt_of(const RunsFit& fit);

struct Identification {
  bool are_checks_complete = true;      ///< else the deadline left no time for all data checks
  std::vector<RunIdentification> runs;  ///< as they were given
  std::vector<RunsFit> fits;
  std::vector<ModalReading> readings;  ///< run by run, then the fits
};

struct IdentificationOptions {
  SpectrumSettings spectrum = {};            ///< `hold` and `estimator` are each run's own
  std::optional<RecordedSignal> input = {};  ///< of responses of `time` runs; empty: by evidence
  PeakSettings peaks = {};
  CircleSettings circles = {};
  DescribedArms arms = {};  ///< what the data checks may know
  bool fit = true;
  ModalFitOptions modal_fit = {};  ///< `torque_hold` and `initial` are each run's own
  /// For hub slopes and gains; empty: as the rigid body's motion has it.
  std::optional<double> total_inertia_kg_m2 = {};
  /// Data checks end half-way to it. What is not done by then is refused: spectra of runs, fits.
  arm::Deadline deadline = {};
  /// Called now and then with what is being done and the fraction of all work done; false ends it,
  /// with what there is until then.
  std::function<bool(std::string_view what, double fraction)> progress = {};
};

/// Spectra, frequency responses, poles, zeros, damping ratios, hub slopes and accelerometer gains
/// of runs: the paper's sections 5 and 6, and rational fits beside it. A run, or fit, that cannot
/// be used is refused with the reason; the others go on.
///
/// Throws InputError where no run can be used, with the first one's reason.
Identification identify(std::vector<MeasuredRun> runs, const IdentificationOptions& options = {});

}  // namespace flexarm::measured
