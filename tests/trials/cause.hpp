#pragma once

#include "measured/files/measurement.hpp"
#include "tests/trials/chance.hpp"
#include "tests/trials/trial_arms.hpp"
#include "tests/trials/true_arm.hpp"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace flexarm::trials {

/// What is natural to an arm.
struct NaturalSizes {
  explicit NaturalSizes(const TrialArm& of);

  double length_m = 0.0;
  double thickness_m = 0.0;
  double beam_kg = 0.0;
  double spring_N_m_per_rad = 0.0;  ///< EI/l
  double omega_rad_per_s = 0.0;     ///< sqrt(EI/(m l^4))
  double inertia_kg_m2 = 0.0;       ///< of the rigid arm about its axis
  double torque_N_m = 0.0;          ///< typical root mean square of a case
  double peak_N_m = 0.0;
};

/// Numbers of a hidden cause by the names and in the units of docs/formats.md: the truth that
/// answers are scored against.
using Parameters = std::map<std::string, double>;

/// The kinds of data in which a cause shows.
enum class ShownIn { time, time_and_frequency, all };

/// Where a cause acts on the arm; causes are listed in this order.
enum class ActsOn { number, linear_arm, torque_path, hub, beam, sensor };

/// A cause that can be hidden. Each file causes/NAME.cpp defines one function `Cause NAME()`, which
/// the build finds by the name of the file. What the cause does is said here in the simulator's own
/// terms, independently of effects/NAME.cpp.
struct Cause {
  std::string name;
  /// The product has no name for it.
  bool outside = false;
  /// Where the missing force acts, as answers name it (Answer::ports): of what is outside.
  std::string port = {};
  ShownIn shown_in = ShownIn::all;
  ActsOn acts_on = ActsOn::linear_arm;
  /// The largest size that is still physical: beyond, the arm is another one. Sizes are ratios to
  /// what is natural to the arm: to the beam's mass, EI/l, the torque; factors are exp(+-size).
  double largest = 1.0;
  /// Of the largest: the smallest size, of which nothing is seen.
  double smallest_part = 1e-5;
  /// The trial arm in which alone it can show; empty: any.
  std::string shows_on_arm = {};
  /// It may be drawn beside another.
  bool in_pairs = true;
  bool acts_on_drawn_sensor = false;
  bool acts_on_gauge = false;  ///< the strain gauge; poles and zeros of a trial are not of it
  std::function<Parameters(const NaturalSizes& natural, double size, const Chance& chance)>
      parameters;
  std::function<void(const Parameters& of, const arm::Sensor& sensor, TrueArm& arm)> change;

  bool shows_in(measured::RunKind kind) const;
};

/// `part` from 0 to 1 of the way from `lowest` to `highest`.
inline double between(double lowest, double highest, double part) {
  return lowest + (highest - lowest) * part;
}

/// Cause::parameters of a number that is exp(+-size) times what the file says.
Parameters changed_factor(const NaturalSizes& natural, double size, const Chance& chance);

/// The whole vocabulary by `acts_on` and name, then what is outside of it.
const std::vector<Cause>& causes();
/// The cause of that name; throws InputError where there is none.
const Cause& find_cause(const std::string& name);

}  // namespace flexarm::trials
