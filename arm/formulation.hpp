#pragma once

#include "arm/arm.hpp"
#include "arm/sensor.hpp"

#include <complex>
#include <concepts>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::arm {

/// What an iterative search says of itself.
struct SolveSummary {
  std::string method;             ///< in the field's terms: "Wittrick-Williams count, TOMS 748"
  int iterations = 0;             ///< iterations, or function values where those are counted
  double largest_residual = 0.0;  ///< in the sense that `method` states; 0 when none is formed
  bool converged = false;
};

/// How many roots were found beside how many there are; `expected` < 0 when nothing counted them.
struct RootCount {
  int found = 0;
  int expected = -1;
  std::string method;  ///< "Wittrick-Williams", "argument principle", "Sylvester inertia"
};

/// Undamped flexible poles s = +-i omega.
///
/// The lowest mode of an arm that turns freely is its rigid-body mode, at s = 0. A hub spring or
/// gravity turns it into one of finite frequency, which remains the lowest and is counted apart:
/// flexible poles keep their orders whatever holds the hub.
struct PoleSet {
  std::vector<double> omega_rad_per_s;            ///< ascending, the lowest mode's left out
  double lowest_omega_squared_rad2_per_s2 = 0.0;  ///< below 0 for an arm that stands up and falls
  RootCount count;
  SolveSummary summary;
};

/// The two roots of the damped characteristic equation that one undamped pair +-i omega becomes as
/// all damping grows from zero to its value: conjugates, `first` with Im > 0; or two real ones,
/// `first` the nearer to 0.
struct PolePair {
  std::complex<double> first_rad_per_s;
  std::complex<double> second_rad_per_s;
};

/// Poles of the damped arm, none twice.
struct DampedPoleSet {
  PolePair lowest;                 ///< of the lowest mode; both 0 for a free hub without friction
  std::vector<PolePair> flexible;  ///< in the order of PoleSet
  SolveSummary summary;
};

/// A root of a discrete zero problem that is not a zero of the arm, and why.
struct RejectedZero {
  std::complex<double> s_rad_per_s;
  double relative_change = 0.0;  ///< distance to the nearest root on the checking discretisation
  std::string reason;
};

/// Undamped zeros of torque to a sensor, those at s = 0 and at infinity left out.
struct ZeroSet {
  /// One of each pair +-s or quadruple +-s, +-conj(s): Re >= 0, Im >= 0; ascending in |s|.
  std::vector<std::complex<double>> s_rad_per_s;
  /// How far a finer model moves each zero, relative to |s|: what the formulation knows of its
  /// error. Empty where no finer model is made.
  std::vector<double> relative_change;
  std::vector<RejectedZero> rejected;  ///< ascending in |s|
  int infinite = 0;  ///< infinite roots of a discrete problem; 0 for the exact one
  RootCount count;
  SolveSummary summary;
};

/// One mode of the undamped arm. phi is scaled to the modal mass I_T; for the plain arm
///
///     int m phi_i phi_j dx + Ih phi_i'(0) phi_j'(0)
///         + Mp phi_i(l) phi_j(l) + Ip phi_i'(l) phi_j'(l) = I_T delta_ij,
///
/// equation (24) of the paper put right, and with effects 2 T of arm/linear_arm.hpp, so that the
/// rigid-body mode is phi_0(x) = a + x; its sign is that of a positive hub slope.
struct Mode {
  double omega_rad_per_s = 0.0;  ///< 0 for a lowest mode that nothing holds, or that falls
  /// Rotation on which the torque and the laws of hub torque act [1]: the rotor's; phi'(0) where
  /// drive and root are rigid.
  double hub_slope = 0.0;
  double damping_ratio = 0.0;    ///< projected, D_ii/(2 omega) of ModalModel; 0 where omega is 0
  std::vector<double> sensor_values;   ///< per sensor, before time derivatives: hub_slope, phi(l),
                                       ///< phi(l) - (a + l) theta, thickness/2 psi'(X)
  std::vector<double> displacement_m;  ///< phi at the stations asked for
};

/// The arm in its modes, which are those of the undamped arm: with phi = sum phi_i q_i and the
/// torque tau on the hub,
///
///     q_i'' + sum_j D_ij q_j' + omega_i^2 q_i = hub_slope_i tau/I_T,
///     D_ij = (2 R)_ij/I_T of arm/linear_arm.hpp,
///
/// equation (33) of the paper put right. Without shear (2 R)_ij is
/// kv EI int phi_i'' phi_j'' dx + c hub_slope_i hub_slope_j + ca int phi_i phi_j dx, beside what
/// the dashpots of drive, root and suspensions take.
struct ModalModel {
  double modal_mass_kg_m2 = 0.0;  ///< I_T
  std::vector<Mode> modes;        ///< n: the lowest (rigid-body) mode, then the flexible ones
  double lowest_omega_squared_rad2_per_s2 = 0.0;  ///< of modes[0], as in PoleSet
  std::vector<double> damping_rad_per_s;          ///< D, n x n, symmetric, by rows
};

/// Payload mass over m l, and payload inertia over m l^3, that every formulation takes. The heavier
/// the payload, the further the lowest root lies below the others, which drown in its rounding: at
/// this bound assumed_modes keeps 8 digits of poles and 6 of zeros, at 1e6 it keeps 9.
inline constexpr double kLargestPayloadRatio = 1e9;

/// Sizes of m l, m l^3, EI/l and sqrt(EI/(m l^4)) in SI units, and of Ih/(m l^3), whose squares a
/// double holds with room to spare.
inline constexpr double kSmallestScale = 1e-100;
inline constexpr double kLargestScale = 1e100;

/// Sizes of effects, each relative to the beam's own: lengths to l, rotational springs to EI/l, the
/// weight beyond the root to EI/l^2, k G A to EI/l^2.
inline constexpr double kLargestLengthRatio = 100.0;
inline constexpr double kSmallestSpringRatio = 1e-6;
inline constexpr double kLargestSpringRatio = 1e9;
inline constexpr double kLargestWeightRatio = 1e4;
inline constexpr double kSmallestShearRatio = 10.0;

/// The rotor's inertia relative to m l^3, and the part of the hub's inertia that is not the rotor's
/// relative to all of it.
inline constexpr double kSmallestRotorRatio = 1e-9;
inline constexpr double kSmallestRestOfHub = 1e-9;

/// Masses on the beam relative to m l, natural frequencies of suspended ones to sqrt(EI/(m l^4)),
/// and their damping ratios.
inline constexpr double kLargestCarriedRatio = 1e3;
inline constexpr double kSmallestTunedRatio = 1e-2;
inline constexpr double kLargestTunedRatio = 1e4;
inline constexpr double kLargestTunedDampingRatio = 10.0;

/// Throws InputError for an arm that is not valid (`require_valid`) or whose numbers, each valid by
/// itself, lie outside the bounds above together.
void require_computable(const Arm& arm);

/// Throws InputError unless `count`, a number of roots or modes, is 1 or more.
void require_count(int count);

/// Throws InputError for a station that is not on the beam, from 0 to its length.
void require_stations(std::span<const double> stations_m, const Arm& arm);

/// A formulation is a model of an arm that answers the questions below, each from its own
/// equations.
///
/// - `poles(n)`, `modes(n, ...)`: the n lowest flexible ones, undamped, in ascending order; fewer
///   only where the model has fewer degrees of freedom.
/// - `damped_poles(n)`: what the lowest pair and the n lowest flexible ones become with damping, to
///   rounding and discretisation; not projected on undamped modes.
/// - `modal_model(n, ...)`: the lowest mode and `modes(n, ...)`, and how damping couples them.
/// - `zeros(sensor, n)`: the n finite non-zero roots smallest in |s| of the undamped numerator of
///   torque to sensor; a discrete model leaves out those it can tell to be spurious and reports
///   them.
/// - `transfer_function(sensor, s)`: response per unit of torque on the hub, damping included, at
///   complex s [rad/s]; s = 0 of an arm that turns freely and an s that is not finite are a
///   std::domain_error, at a pole the value is not finite or huge.
/// - `degrees_of_freedom()`: generalised coordinates, the hub rotation included; 0 for exact_tf.
///
/// All throw InputError for a sensor that the arm cannot carry (`require_valid`), for a count below
/// 1 or above what the formulation states as its limit, and for a station off the beam; `zeros`
/// also for a sensor that reads zero at every s (`require_responsive`). Constructors throw
/// InputError for an arm that is invalid or not `require_computable`, for an effect through a
/// port that is not among `kLinearArmPorts`, by name, and for an arm that stands up and whose
/// flexible modes buckle. Objects are immutable: concurrent calls are safe.
template <class F>
concept Formulation = requires(const F& f, int count, const Sensor& sensor,
                               std::span<const Sensor> sensors, std::span<const double> stations_m,
                               std::complex<double> s_rad_per_s) {
  { F::kName } -> std::convertible_to<std::string_view>;
  { f.arm() } -> std::same_as<const Arm&>;
  { f.degrees_of_freedom() } -> std::same_as<int>;
  { f.poles(count) } -> std::same_as<PoleSet>;
  { f.zeros(sensor, count) } -> std::same_as<ZeroSet>;
  { f.damped_poles(count) } -> std::same_as<DampedPoleSet>;
  { f.modes(count, sensors, stations_m) } -> std::same_as<std::vector<Mode>>;
  { f.modal_model(count, sensors, stations_m) } -> std::same_as<ModalModel>;
  { f.transfer_function(sensor, s_rad_per_s) } -> std::same_as<std::complex<double>>;
};

}  // namespace flexarm::arm
