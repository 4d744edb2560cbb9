#pragma once

#include "arm/sensor.hpp"

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace flexarm::arm {

/// Discrete PID controller of one sensor y with reference r, both in the sensor's unit. With
/// e = r - y, the period T of the controller and samples k = 0, 1, ...:
///
///     u_k = kp e_k + kd d_k + I_k,    I_k = I_(k-1) + ki T e_k,    I_(-1) = 0,
///     d_k = (v_k - v_(k-1))/T,  d_0 = 0,    v = e, or -y where the derivative is of the
///     measurement
///
/// and anti-windup by conditional integration: where |u_k| exceeds the limit and ki e_k has the
/// sign of u_k, I_k = I_(k-1), and u_k is formed with that. Then u_k is cut at +-limit.
struct PidController {
  enum class Derivative { error, measurement };

  double kp = 0.0;  ///< N m per unit of the sensor
  double kd = 0.0;  ///< N m s per unit
  double ki = 0.0;  ///< N m/s per unit
  Derivative derivative = Derivative::error;

  bool operator==(const PidController&) const = default;
};

/// Discrete state space, x_0 = 0 unless stated where it is run:
///
///     u_k = C x_k + D w_k,    x_(k+1) = A x_k + B w_k,    w = (reference, sensors in their order).
///
/// u [N m] is cut at +-limit where there is one; the state does not see that.
struct StateSpaceController {
  using Rows = std::vector<std::vector<double>>;  ///< a matrix by its rows

  Rows a = {};    ///< n x n; n may be 0
  Rows b = {};    ///< n x (1 + sensors)
  Rows c = {{}};  ///< 1 x n
  Rows d = {};    ///< 1 x (1 + sensors)

  bool operator==(const StateSpaceController&) const = default;
};

/// A controller that made the commanded torque from a reference and what sensors read. It reads at
/// every period; between its samples the torque is held.
struct Controller {
  std::vector<Sensor> sensors;  ///< read by it: one of a PID, one or more of a state space
  std::variant<PidController, StateSpaceController> law;
  std::optional<double> limit_N_m = {};      ///< above 0: |u| at most
  std::optional<double> sample_time_s = {};  ///< its period T; empty: that of the record

  bool operator==(const Controller&) const = default;
};

/// Throws InputError "KEY = VALUE: ..." whose key is that of docs/formats.md ("kp", "A", "limit"):
/// a number that is not finite or out of its range, matrices that do not fit together, the wrong
/// number of sensors or one twice, and a law by which no sensor acts on the torque.
void require_valid(const Controller& controller);

/// The whole number of samples of a record in the controller's period; 1 where that is not given.
/// Throws InputError with the key "sample_time" where it is no whole multiple of `period_s`.
int samples_per_period(const Controller& controller, double period_s);

/// Relative deviation from a whole multiple that counts as rounding of the file's times.
inline constexpr double kWholeMultiple = 1e-6;

}  // namespace flexarm::arm
