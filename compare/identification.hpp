#pragma once

#include "arm/arm.hpp"
#include "arm/sensor.hpp"
#include "compare/root_numbering.hpp"
#include "measured/run_identification.hpp"
#include "response/frequency/frequency_response.hpp"

#include <complex>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace flexarm::compare {

/// What one formulation says of the modes, modal mass I_T.
struct AnalyticalGains {
  std::string model;  ///< "exact_tf"
  double total_inertia_kg_m2 = 0.0;
  std::vector<double> hub_slope;   ///< phi_i'(0), one a mode
  std::vector<double> tip_gain_m;  ///< phi_i(l)
};

struct AnalyticalPole {
  double frequency_Hz = 0.0;  ///< |s|/(2 pi), of two real ones their geometric mean
  double damping_ratio = 0.0;
};

/// Zeros of torque to a sensor, ascending in |s| without damping.
struct AnalyticalZeros {
  arm::Sensor sensor;
  std::vector<std::complex<double>> s_rad_per_s;  ///< undamped, Re s >= 0, Im s >= 0
  /// The roots that each becomes with the arm's damping, conjugates included; empty where they
  /// could not be followed.
  std::vector<std::vector<std::complex<double>>> damped_rad_per_s = {};
};

/// What an arm, in its linear effects, should show of a measurement; poles, zeros and responses by
/// exact_tf.
struct AnalyticalModes {
  double lowest_Hz = 0.0;  ///< of the lowest mode; 0 where the arm turns freely
  std::vector<AnalyticalPole> poles;
  std::vector<AnalyticalZeros> zeros;
  std::vector<AnalyticalGains> gains;  ///< exact_tf, fem, assumed_modes
  response::FrequencyResponse
      response;  ///< through actuator and sensors; empty where not asked for

  /// Of no arm.
  bool is_empty() const { return gains.empty(); }
};

/// What measured roots are numbered by: poles, and antiresonances counted from 1.
ModelRoots model_roots(const AnalyticalModes& analytical);

/// What measured roots up to `to_Hz` are numbered by needs analytical ones up to this.
inline constexpr double needed_Hz(double to_Hz) {
  return kMostFactor * to_Hz;
}

/// Where responses are wanted.
struct FrequencyRange {
  double from_Hz = 0.0;  ///< above 0
  double to_Hz = 0.0;
};

/// Poles and modes to the first one beyond `to_Hz`, zeros of each sensor that shows any, and
/// responses over `range`, with more points around poles and zeros. Throws InputError as the
/// formulations do.
AnalyticalModes analytical_modes(const arm::Arm& arm, std::span<const arm::Sensor> sensors,
                                 double to_Hz, const std::optional<FrequencyRange>& range = {});

/// A measured pole or zero with the analytical one that it stands for.
struct IdentifiedRoot {
  measured::ModalEntry measured;
  std::optional<int> order;  ///< from 1; of zeros among the antiresonances; empty: there is none
  std::optional<double> analytical_Hz;
  std::optional<double> analytical_damping_ratio;  ///< of poles
  /// Of the alias of a mode above the Nyquist frequency: that mode's frequency, and its order where
  /// the arm file has it.
  std::optional<double> alias_of_Hz = {};
  std::optional<int> alias_of_order = {};

  /// 100 (measured - analytical)/analytical; NaN where either is unknown.
  double error_percent() const;
};

/// Numbered by compare/root_numbering.hpp, each root once a sensor. Measured zeros are
/// antiresonances, and stand beside zeros on the imaginary axis.
std::vector<IdentifiedRoot> beside_analytical(const measured::ModalTable& table,
                                              const AnalyticalModes& analytical);

/// The entries that stand for an analytical root, with its order: a table that `compare --measured`
/// and `diagnose` read.
measured::ModalTable in_analytical_order(const std::vector<IdentifiedRoot>& roots);

/// The condition of a payload: readings and fits with it, and what is expected of them.
struct IdentifiedCondition {
  arm::Payload payload = {};
  AnalyticalModes analytical = {};
  std::vector<std::size_t> runs = {};      ///< indices of measured::Identification::runs
  std::vector<std::size_t> readings = {};  ///< indices of measured::Identification::readings
  std::vector<std::vector<IdentifiedRoot>> roots = {};  ///< of each of these
  std::vector<std::size_t> fits = {};                   ///< indices
};

/// One a payload, in the order of the runs, with one order for all estimates of a root
/// (compare/reading_clusters.hpp). `arm` has the payload of runs without one of their own. Without
/// an arm nothing is analytical, and poles and zeros are counted from 1 up.
std::vector<IdentifiedCondition> conditions_of(const measured::Identification& identification,
                                               const std::optional<arm::Arm>& arm);

}  // namespace flexarm::compare
