#pragma once

#include "measured/files/frequency_record.hpp"
#include "measured/files/modal_table.hpp"
#include "measured/files/time_record.hpp"
#include "measured/modal/alias_placement.hpp"
#include "measured/modal/block_search.hpp"
#include "measured/modal/fitted_transfer.hpp"
#include "measured/modal/fitted_zeros.hpp"
#include "measured/modal/residual_quality.hpp"
#include "measured/modal/stabilisation.hpp"

#include <Eigen/Core>

#include <array>
#include <complex>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace flexarm::measured {

struct ModalFit;

struct ModalFitOptions {
  TorqueHold torque_hold = TorqueHold::zero;
  /// Of each record, or of all when it is one; at rest when empty.
  std::vector<InitialState> initial = {};
  bool rigid_body = true;  ///< the arm turns freely: a block with a0 = 0
  /// Flexible blocks; empty: as many as BIC asks for, up to `most_blocks`.
  std::optional<int> modes = {};
  /// Where modes are looked for; empty: where the torque has power (time), all lines (FRF).
  std::optional<FitBand> band = {};
  bool undamped_residues = false;  ///< every block b0 s^k alone (measured/files/sensor_columns.hpp)
  bool static_remainder = true;    ///< of modes far above the band
  bool offset = true;              ///< a constant in every reading of every run
  int most_blocks = 16;
  double bic_margin = 10.0;
  double most_damping_ratio = 0.7;  ///< blocks above it are no modes
  /// Nor are those above this, 20 degrees; lightly damped ones only if the chart has no column for
  /// them, for a delay turns residues too.
  double most_residue_turn = 0.35;
  int highest_order = 32;  ///< of the stabilisation chart, orders 2, 4, ...
  int least_stable_orders = 3;
  StabilisationTolerances stabilisation = {};
  /// Blocks are searched for in this many first samples of each record, then fitted to all.
  std::size_t search_samples = 16384;
  /// FRF: standard deviation of real and of imaginary part, per channel and frequency; else from
  /// coherence and `averages`; else 1 % of |H|. Only ratios matter: the scale is estimated.
  std::vector<std::vector<double>> response_std = {};
  double averages = 1.0;
  /// Intervals right for coloured residuals: where they are coloured (empty), always, or never.
  std::optional<bool> robust = {};
  /// The covariance in place of `ModalFit::covariance`, of a fit whose blocks, transfers and
  /// covariance are known; empty: that.
  std::function<Eigen::MatrixXd(const ModalFit&)> covariance = {};
  int most_iterations = 60;
  /// Called now and then with the fraction done; false ends the fit, which then says nothing, and
  /// what it throws passes through.
  std::function<bool(double fraction)> progress = {};
};

/// A flexible block as a pole, or two real ones.
struct FittedPole {
  double frequency_Hz = 0.0;  ///< undamped natural, sqrt(a0)/(2 pi)
  double frequency_std_Hz = 0.0;
  double damping_ratio = 0.0;  ///< a1/(2 sqrt(a0)); 1 or more: both poles are real
  double damping_ratio_std = 0.0;
  std::array<std::complex<double>, 2> s_rad_per_s;
  double residue_turn = 0.0;  ///< measured/modal/fitted_residues.hpp, the delay taken off
  /// In the band and damped no more than a mode may be; with a column of the chart nearby, or
  /// residues turned no more than a mode's may be, 0.03 where it is damped by more than 0.1. Where
  /// residuals are no noise, poles beside one that has a column are none. Others stand for what
  /// lies outside the band or for what is not linear.
  bool is_mode = false;
};

struct FittedNumerator {
  double b1 = 0.0;
  double b0 = 0.0;
  double b1_std = 0.0;  ///< infinite where the fit says nothing of it, as the next
  double b0_std = 0.0;
};

/// One sensor: G = s^k [sum (b1 s + b0)/(s^2 + a1 s + a0) + remainder].
struct FittedSensor {
  arm::Sensor sensor;
  std::vector<FittedNumerator>
      numerators;  ///< one a block that is not held, the rigid body's first
  double remainder = 0.0;
  double remainder_std = 0.0;
  std::vector<FittedZero> zeros;
  ResidualQuality residual;
};

struct ModalFit {
  /// The rigid body's first, then ascending in frequency, then held ones for what lies beyond the
  /// band (measured/modal/modes_beyond.hpp).
  BlockSet blocks;
  /// No record had a torque: the numerators are unknown, and `sensors` have no zeros.
  bool free_decay = false;
  double rigid_a1_rad_per_s = 0.0;  ///< hub friction over inertia
  double rigid_a1_std_rad_per_s = 0.0;
  std::vector<FittedPole> poles;  ///< one a flexible block
  std::vector<FittedSensor> sensors;
  std::vector<FittedTransfer> transfers;  ///< one a sensor
  /// Of theta (measured/modal/second_order_block.hpp), then the parameters of each sensor in turn.
  Eigen::VectorXd parameters;
  Eigen::MatrixXd covariance;
  bool robust_covariance = false;  ///< residuals were coloured or something is left unexplained
  FitBand band;
  StabilisationChart chart;
  std::vector<OrderTrial> order_trials;
  std::string order_reason;
  std::vector<MovedBlock> aliases;
  /// By which the residues of all sensors say that they answer late
  /// (measured/modal/fitted_residues.hpp); 0 where they say nothing of it. Poles are right under a
  /// delay; zeros, slopes and gains are not.
  double delay_s = 0.0;
  int iterations = 0;
  bool converged = false;
  bool cancelled = false;

  /// Index of a sensor's first parameter in `parameters`.
  Eigen::Index first_parameter(std::size_t sensor) const;
  /// Covariance of theta and one sensor's parameters, as its transfer has them.
  Eigen::MatrixXd covariance_of(std::size_t sensor) const;
  /// Index of a sensor in `sensors`; empty where it was not measured.
  std::optional<std::size_t> find(arm::SensorKind kind) const;
};

/// Poles, zeros and numerators of all sensors at once, by maximum likelihood for white noise in
/// each sensor (measured/modal/variable_projection.hpp). Records are runs of one condition: they
/// share poles and numerators, not offsets and initial states. Start values are poles of a common
/// denominator that are stable over its order (measured/modal/common_denominator.hpp).
///
/// Cost: samples x (4 blocks + sensors + 3)^2 x 2 operations a pass, some 5 passes a fit and as
/// many with the held blocks among them.
///
/// Throws InputError for no record or channel, records shorter than kLeastSamples samples or
/// kLeastLines frequencies, a torque that is zero in a run from rest, a sensor that is constant, a
/// value that is not finite, a band that holds nothing, and options out of their range;
/// std::invalid_argument for vectors of unlike length or a sensor twice in a record.
ModalFit fit_modes(std::span<const TimeRecord> records, const ModalFitOptions& options = {});
ModalFit fit_modes(const FrequencyRecord& record, const ModalFitOptions& options = {});
inline constexpr std::size_t kLeastSamples = 64;
inline constexpr std::size_t kLeastLines = 16;

/// Modes and the antiresonances of each sensor in the band, without orders, with standard
/// deviations. Zeros whose damping ratio is above `options`' bound for modes in size, the real ones
/// of a tip that moves against the hub for one, are no antiresonances and left out.
ModalTable modal_table(const ModalFit& fit, double most_damping_ratio = 0.7);

}  // namespace flexarm::measured
